// The table of collisions; each row goes to its moment.
import { element } from "./dom.js";
import { clockTime, degrees, number } from "./format.js";

const HEADINGS = ["Time", "Between", "Closing", "Angle", "Impulse", "Energy"];
const UNITS = ["min:s", "", "m/s", "°", "MN s", "MJ"];

export function makeEvents(data, clock, digits, jump) {
  if (!data.events.length) {
    const least = data.least_clearance;
    return element("p", { class: "none", text: `No contact. The hulls came within ${number(least, 1)} m of each other.` });
  }
  const rows = data.events.map((event) => {
    const go = element("button", { type: "button", text: clockTime(event.time, digits), onclick: () => jump(event) });
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
      ...figures.map((text) => element("td", { class: "number", text })),
    );
  });
  clock.watch(({ time }) => {
    rows.forEach((row, i) => row.classList.toggle("past", data.events[i].time <= time));
  });
  return element(
    "table",
    {},
    element(
      "thead",
      {},
      element("tr", {}, ...HEADINGS.map((text, i) => element("th", { scope: "col", class: i > 1 ? "number" : "" }, text, element("small", { text: UNITS[i] })))),
    ),
    element("tbody", {}, ...rows),
  );
}
