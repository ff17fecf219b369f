// Outline of a hull at the water, from the triangles that cross it. Numbers only.

const STATIONS = 36;

/** Adds to `crossings` where a triangle [[x, y, z], ...] in b crosses the water: the two ends of a piece, or nothing. */
export function crossWater(corners, crossings) {
  for (let k = 0; k < 3; k++) {
    const a = corners[k], b = corners[(k + 1) % 3];
    if (a[2] < 0 === b[2] < 0) continue;
    const share = a[2] / (a[2] - b[2]);
    crossings.push([a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]);
  }
}

/** Half breadths to port and starboard over stations from stern to bow, of pieces of a waterline: {x, port, starboard} [m]. */
export function traceOutline(crossings) {
  let aft = Infinity, fore = -Infinity;
  for (const [x] of crossings) {
    aft = Math.min(aft, x);
    fore = Math.max(fore, x);
  }
  const x = Array.from({ length: STATIONS }, (_, i) => aft + ((fore - aft) * (1 - Math.cos((Math.PI * i) / (STATIONS - 1)))) / 2);
  return { x, port: x.map((at) => reach(crossings, at, -1)), starboard: x.map((at) => reach(crossings, at, 1)) };
}

/** How far the crossings reach to a side at a station: of the pieces of the waterline there, the outermost. */
function reach(crossings, at, side) {
  let widest = 0;
  for (let i = 0; i < crossings.length; i += 2) {
    const [a, b] = crossings[i][0] < crossings[i + 1][0] ? [crossings[i], crossings[i + 1]] : [crossings[i + 1], crossings[i]];
    if (at < a[0] - 1e-3 || at > b[0] + 1e-3) continue;
    const isAcross = b[0] - a[0] < 1e-6, share = isAcross ? 0 : Math.min(1, Math.max(0, (at - a[0]) / (b[0] - a[0])));
    widest = Math.max(widest, side * (a[1] + share * (b[1] - a[1])), isAcross ? side * b[1] : 0);
  }
  return widest;
}
