// The range of a plot's axis from the range of what it shows.

const PAD = 0.08; // of the span, so that no curve runs along the edge
const EDGE = 0.03; // the same below an axis that begins at zero

/** [low, high] of an axis, at least `least` wide; with zero in it where the distance from zero is what matters. */
export function axisRange(low, high, least, hasZero) {
  if (low === null || high === null) return [0, least];
  if (!hasZero) {
    const middle = (low + high) / 2;
    const half = Math.max((high - low) * (0.5 + PAD), least / 2);
    return [middle - half, middle + half];
  }
  const [bottom, top] = [Math.min(low, 0), Math.max(high, 0)];
  const span = Math.max(top - bottom, least);
  const isBelow = top === 0 && bottom < 0;
  return [isBelow ? -span * (1 + PAD) : bottom - span * (bottom < 0 ? PAD : EDGE), isBelow ? span * EDGE : bottom + span * (1 + PAD)];
}

/** Whether a curve's value, shown with so many digits, ever changes. */
export function isMoving(values, digits) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return high - low >= 0.5 * 10 ** -digits;
}
