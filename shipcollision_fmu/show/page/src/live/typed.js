// Numbers as people type them: speeds "12", "12 kn", "6,2 m/s", directions "270", "270°", times "12:30", distances "0.5",
// "900 m".
import { KNOT, MILE } from "./navigation.js";

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

/** The time [s] of a text such as "12:30" or "1:05:00"; null: it is none. */
export function parseTime(text) {
  const found = /^(?:(\d+):)?(\d{1,4}):([0-5]\d(?:[.,]\d+)?)$/.exec(text.trim());
  if (!found || (found[1] !== undefined && Number(found[2]) > 59)) return null;
  return 3600 * Number(found[1] ?? 0) + 60 * Number(found[2]) + Number(found[3].replace(",", "."));
}

const RANGES = [[/^(|nm|sm|海里)$/i, MILE], [/^(m|米)$/i, 1], [/^km$/i, 1000]];

/** The distance [m] of a text such as "0.5", in nautical miles, or "900 m"; null: it is none. */
export function parseRange(text) {
  const found = read(text);
  const unit = found && RANGES.find(([words]) => words.test(found.rest));
  return unit && found.value > 0 ? found.value * unit[1] : null;
}
