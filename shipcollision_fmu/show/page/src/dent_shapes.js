// How far dents have grown at a time, and the shape of a crushed bow; see dents.js.

const STEPS = 24; // in which a dent grows
const EASE = (x) => 1 - (1 - x) * (1 - x);

/** How far a dent has grown at a time [s]: 0 before, 1 at the end. */
export function grownAt({ time, duration }, now) {
  if (now <= time) return 0;
  return Math.max(1, Math.round(STEPS * EASE(Math.min(1, (now - time) / duration)))) / STEPS;
}

/** Where a place of the bow is once it is crushed, and how much paint it has lost (0 to 1): folds as deep as they are long. */
export function crush([x, y, z], { point, depth }) {
  const begin = point[0] - 2.2 * depth;
  const share = Math.min(1, (x - begin) / (2.2 * depth));
  if (share <= 0) return { place: [x, y, z], worn: 0 };
  const [u, w] = [x / depth, z / depth];
  const fold = 0.7 * Math.sin(5 * u + 1.9 * w) + 0.45 * Math.sin(9.7 * u - 4.6 * w + 0.7), buckle = Math.sin(4.4 * w - 1.6 * u + 1.3);
  const side = Math.tanh(2 * y);
  return {
    place: [
      x - depth * share * (0.55 + 0.16 * buckle),
      y + depth * share * (side * (0.16 + 0.15 * fold) + 0.07 * buckle),
      z + 0.12 * depth * share * fold,
    ],
    worn: Math.min(1, Math.max(0.02, 1.6 * share - 0.25 + 0.35 * fold)),
  };
}
