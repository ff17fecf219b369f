// Collisions of two runs side by side, as numbers.
import { number } from "./format.js";

/** Pairs [a, b] of the collisions of two runs: the first of the same two ships, the second and so on; null where none. */
export function pairCollisions(first, second) {
  const pairs = new Map();
  [first, second].forEach((events, run) => {
    const counts = {};
    for (const event of events) {
      const ships = JSON.stringify([event.ship_a, event.ship_b].sort());
      counts[ships] = (counts[ships] ?? 0) + 1;
      const key = `${ships} ${counts[ships]}`;
      if (!pairs.has(key)) pairs.set(key, [null, null]);
      pairs.get(key)[run] = event;
    }
  });
  return [...pairs.values()];
}

/** The texts of a row: both values, and the second less the first; a dash where a run has none. */
export function describeRow(row, pair) {
  const values = pair.map((one) => (one === null ? null : row.of(one)));
  const change = values.includes(null) ? null : values[1] - values[0];
  const sign = change !== null && Number(change.toFixed(row.digits)) > 0 ? "+" : "";
  return [...values.map((value) => number(value, row.digits)), sign + number(change, row.digits)];
}
