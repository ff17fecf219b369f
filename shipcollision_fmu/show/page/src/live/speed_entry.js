// Speeds and directions as people type them: "12", "12 kn", "6,2 m/s", "270", "270°".
import { KNOT } from "./navigation.js";

/** A unit by its name in the page: metres per second in one. */
export const UNITS = { kn: KNOT, "m/s": 1 };

const WORDS = { kn: /^(kn|kt|kts|knots?|knoten|knop|节)$/i, "m/s": /^(m\/s|mps|米\/秒)$/i };
const NUMBER = /^([+-]?\d+(?:[.,]\d*)?|[.,]\d+)\s*(.*)$/;

const read = (text) => {
  const found = NUMBER.exec(text.trim());
  return found && { value: Number(found[1].replace(",", ".")), rest: found[2].trim() };
};

/** The speed [m/s] of a text; without a unit of its own it is in `unit`. null: it is no speed. */
export function parseSpeed(text, unit) {
  const found = read(text);
  if (!found) return null;
  const named = found.rest === "" ? unit : Object.keys(WORDS).find((name) => WORDS[name].test(found.rest));
  return named === undefined || found.value < 0 ? null : found.value * UNITS[named];
}

/** The direction [deg] of a text, 0 to 360; null: it is none. */
export function parseDirection(text) {
  const found = read(text);
  return found && ["", "°"].includes(found.rest) && found.value >= 0 && found.value <= 360 ? found.value : null;
}
