// The instructor's form for wind and current: in knots or metres per second, each with the other beside it.
import { element } from "../dom.js";
import { number } from "../format.js";
import { inWords, onLanguage, say } from "../texts.js";
import { toDegrees, toRadians, wholeTurn } from "./navigation.js";
import { textButton } from "./page_tools.js";
import { parseDirection, parseSpeed, UNITS } from "./typed.js";

const ROWS = [["wind", "wind_speed", "wind_from", "wind-from"], ["current", "current_speed", "current_towards", "current-towards"]];
const KEY = "shipcollision-speed-unit";

/** A speed [m/s] in a unit, with the unit. */
const inUnit = (speed, unit) => `${number(speed / UNITS[unit], 1)} ${unit === "kn" ? say("knots") : unit}`;
/** A speed [m/s] in both units. */
export const inBothUnits = (speed) => `${inUnit(speed, "kn")} (${inUnit(speed, "m/s")})`;

/** `ask(type, fields)` asks the server, `tell(text)` says what cannot be; `limits()`: the largest speeds [m/s] by row. */
export function makeEnvironment(ask, tell, limits) {
  let unit = firstUnit();
  const other = () => (unit === "kn" ? "m/s" : "kn");
  const rows = ROWS.map(([what, speedKey, directionKey, id]) => makeRow(what, speedKey, directionKey, id));
  const chosen = inWords(element("select", { id: "speed-unit", onchange: () => change(chosen.value) },
    ...Object.keys(UNITS).map((value) => element("option", { value, text: value }))), { "aria-label": "speed_unit", title: "speed_unit" });
  chosen.value = unit;

  function makeRow(what, speedKey, directionKey, id) {
    const field = (attributes) => {
      const input = element("input", { type: "text", inputmode: "decimal", autocomplete: "off", maxlength: 20, ...attributes });
      input.addEventListener("keydown", (event) => {
        event.stopPropagation();
        if (event.key === "Enter") set();
      });
      input.addEventListener("input", () => (row.touched.add(input), hint()));
      return input;
    };
    const [speed, direction] = [field({ id: `${what}-speed` }), field({ id })];
    const label = element("span");
    const converted = element("small", { class: "converted" });
    const hint = () => {
      const value = parseSpeed(speed.value, unit);
      const typed = /[^\d.,\s]/.test(speed.value.trim()) && value !== null; // with a unit of its own: both are shown
      converted.textContent = value === null ? "" : typed ? `= ${inBothUnits(value)}` : `= ${inUnit(value, other())}`;
    };
    const relabel = () => {
      label.textContent = say(speedKey, { unit: unit === "kn" ? say("knots") : unit });
      hint();
    };
    const set = async () => {
      const [given, towards, most] = [parseSpeed(speed.value, unit), parseDirection(direction.value), limits()[what]];
      if (given === null) return tell(say("no_speed", { text: speed.value }));
      if (given > most) return tell(say("too_fast", { text: speed.value, most: inBothUnits(most) }));
      if (towards === null) return tell(say("no_direction", { text: direction.value }));
      const [north, east] = [given * Math.cos(toRadians(towards)), given * Math.sin(toRadians(towards))];
      const answer = await ask("environment", what === "wind" ? { wind: { speed: given, from_deg: towards } } : { current: [north, east] });
      if (answer) row.touched.clear();
    };
    const row = {
      what, speed, direction, relabel, hint, touched: new Set(),
      node: element("div", { class: "row set-row" }, element("label", {}, label, speed, converted),
        element("label", {}, inWords(element("span", {}), { text: directionKey }), direction), textButton("set", set, { id: `set-${what}` })),
    };
    onLanguage(relabel);
    return row;
  }

  /** What has been typed without a unit stays the same speed. */
  function change(name) {
    const typed = rows.map(({ speed }) => parseSpeed(speed.value, unit));
    unit = name;
    rows.forEach(({ speed, relabel }, i) => {
      if (typed[i] !== null) speed.value = shown(typed[i] / UNITS[unit], 1);
      relabel();
    });
    try {
      localStorage.setItem(KEY, unit);
    } catch {
      // not kept, then
    }
  }

  return {
    node: element("section", {}, element("div", { class: "head" }, inWords(element("h2", {}), { text: "environment" }), chosen), ...rows.map(({ node }) => node)),
    /** The environment as it is, where nobody is typing. */
    show({ wind, current: [north, east] }) {
      const now = { wind: [wind.speed, wind.from_deg], current: [Math.hypot(north, east), toDegrees(wholeTurn(Math.atan2(east, north)))] };
      for (const { what, speed, direction, hint, touched } of rows) {
        const texts = [shown(now[what][0] / UNITS[unit], 1), shown(now[what][1], 0)];
        [speed, direction].forEach((input, i) => {
          if (!touched.has(input) && document.activeElement !== input) input.value = texts[i];
        });
        hint();
      }
    },
  };
}

const shown = (value, digits) => String(Number(value.toFixed(digits)));

/** Knots, as on board, until somebody chooses. */
function firstUnit() {
  try {
    return localStorage.getItem(KEY) in UNITS ? localStorage.getItem(KEY) : "kn";
  } catch {
    return "kn";
  }
}
