// The table of collisions; each row goes to its moment.
import { element } from "./dom.js";
import { clockTime, degrees, number } from "./format.js";
import { KNOT } from "./live/navigation.js";
import "./texts_replay.js";
import { inWords, onLanguage, say } from "./texts.js";

const HEADINGS = ["time", "between", "closing", "angle", "impulse", "energy"];
const UNITS = ["min:s", "", "m/s", "°", "MN s", "MJ"];

export function makeEvents(data, clock, digits, jump) {
  if (!data.events.length) {
    const least = data.least_clearance;
    return inWords(element("p", { class: "none" }), { text: "no_contact" }, { distance: number(least, 1) });
  }
  const rows = data.events.map((event) => {
    const go = element("button", { type: "button", text: clockTime(event.time, digits), onclick: () => jump(event) });
    const knots = element("small");
    onLanguage(() => (knots.textContent = event.closing_speed === null ? "" : `${number(event.closing_speed / KNOT, 1)} ${say("knots")}`));
    const figures = [
      number(event.closing_speed, 2),
      number(degrees(event.angle), 0),
      number(event.impulse / 1e6, 2),
      number(event.energy / 1e6, 1),
    ];
    return element(
      "tr",
      {},
      element("td", {}, go),
      element("td", { text: `${event.ship_a} \u2013 ${event.ship_b}` }),
      ...figures.map((text, i) => element("td", { class: "number" }, text, ...(i ? [] : [knots]))),
    );
  });
  clock.watch(({ time }) => {
    rows.forEach((row, i) => row.classList.toggle("past", data.events[i].time <= time));
  });
  const table = element(
    "table",
    {},
    element(
      "thead",
      {},
      element("tr", {}, ...HEADINGS.map((key, i) => element("th", { scope: "col", class: i > 1 ? "number" : "" }, inWords(element("span"), { text: key }), element("small", { text: UNITS[i] })))),
    ),
    element("tbody", {}, ...rows),
  );
  return inWords(table, { "aria-label": "collisions" });
}
