// What collisions of two runs have in common, and by how much they differ.
import { element } from "./dom.js";
import { degrees } from "./format.js";
import { describeRow, pairCollisions } from "./pairs.js";
import "./texts_replay.js";
import { inWords } from "./texts.js";

// Text, unit, value of a collision in that unit, digits.
const ROWS = [
  { words: "time", unit: "s", of: ({ time }) => time, digits: 2 },
  { words: "closing", unit: "m/s", of: ({ closing_speed }) => closing_speed, digits: 2 },
  { words: "angle", unit: "°", of: ({ angle }) => degrees(angle), digits: 0 },
  { words: "impulse", unit: "MN s", of: ({ impulse }) => impulse / 1e6, digits: 2 },
  { words: "energy", unit: "MJ", of: ({ energy }) => energy / 1e6, digits: 1 },
];
const CLEARANCE = { words: "least_clearance", unit: "m", of: (value) => value, digits: 2 };

/** Nodes: how each run is drawn, and the table. */
export function makeComparison(first, second) {
  const names = (pair) => (({ ship_a, ship_b }) => `${ship_a} \u2013 ${ship_b}`)(pair.find((event) => event !== null));
  const line = (row, pair) => element("tr", {}, element("th", { scope: "row" }, inWords(element("span"), { text: row.words }), ` ${row.unit}`),
    ...describeRow(row, pair).map((text) => element("td", { class: "number", text })));
  const bodies = pairCollisions(first.events, second.events).map((pair) => element("tbody", {},
    element("tr", {}, element("th", { scope: "rowgroup", colspan: "4", class: "pair", text: names(pair) })), ...ROWS.map((row) => line(row, pair))));
  const whole = element("tbody", {}, line(CLEARANCE, [first.least_clearance, second.least_clearance]));
  const head = element("tr", {}, element("td"), ...[first, second].map(({ label }) => element("th", { scope: "col", class: "number", text: label })),
    inWords(element("th", { scope: "col", class: "number" }), { text: "difference" }));
  const run = (words, label) => inWords(element("p", { class: "run" }), { text: words }, { run: label });
  const table = inWords(element("table", { class: "comparison" }, element("thead", {}, head), ...bodies, whole), { "aria-label": "comparison" });
  return [run("first_run", first.label), run("second_run", second.label), table];
}
