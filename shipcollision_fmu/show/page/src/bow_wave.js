// The wave that a ship pushes up at her bow: how high it stands, where, and how white it is. Numbers only.
//
//     height       2.2 / (1 + F) tan(a) / cos(a) U^2/g, levelling off at LARGEST U^2/g
//     of its crest 1.1 / (1 + F) U^2/g abaft the stem
//
// with F = U / sqrt(g T), T draught, U speed, a half the angle of entrance of the waterline. Source: Noblesse et al., Simple
// analytical relations for ship bow waves, J. Fluid Mech. 600 (2008). From its crest the wave leaves the hull and sinks.

const G = 9.81;
const BLUNT = 1.13; // greatest half angle of entrance [rad]
const LARGEST = 0.28; // before blunt bows the water is pushed ahead, too, and stays below the stagnation head, 0.5 U^2/g
const WHITE = [0.2, 1.1]; // heights of a wave that does not break, and of one whose front is all foam [m]

/**
 * Side of a waterline from the stem aft, as points [along, out] with `s`, the length of plating from the stem [m]. `x`: stations
 * from stern to bow, `half`: half breadths there [m]; along counts forward, as x.
 */
export function traceSide(x, half) {
  const points = [{ s: 0, along: x.at(-1), out: 0 }];
  for (let i = x.length - 1; i >= 0; i--) {
    const { s, along, out } = points.at(-1);
    const step = Math.hypot(x[i] - along, half[i] - out);
    if (step > 1e-6) points.push({ s: s + step, along: x[i], out: half[i] });
  }
  return points;
}

/** Point at a length `s` from the stem along a side, and the unit normal [along, out] there, over `smooth` metres. */
export function pointOn(side, s, smooth) {
  const at = (length) => {
    const i = Math.max(1, side.findIndex((point) => point.s >= length)) || 1;
    const [a, b] = [side[Math.max(0, i - 1)], side[i]];
    const share = Math.min(1, Math.max(0, (length - a.s) / (b.s - a.s)));
    return [a.along + share * (b.along - a.along), a.out + share * (b.out - a.out)];
  };
  const end = side.at(-1).s;
  const [here, before, after] = [s, s - smooth, s + smooth].map((length) => at(Math.min(Math.max(length, 0), end)));
  const [along, out] = [after[0] - before[0], after[1] - before[1]];
  const length = Math.hypot(along, out) || 1;
  return { point: here, normal: [out / length, -along / length] };
}

/** Half the angle of entrance [rad] of a side: of its first twentieth. */
export function findEntrance(side) {
  const length = 0.05 * (side[0].along - side.at(-1).along);
  const { point } = pointOn(side, length, 0);
  return Math.min(BLUNT, Math.atan2(point[1], Math.max(side[0].along - point[0], 1e-3)));
}

/** The bow wave of a side: {height, crest: abaft the stem} [m]. `speed` through the water [m/s], `draught` [m], `entrance` [rad]. */
export function measureBowWave(speed, draught, entrance) {
  const u = Math.max(0, speed), a = Math.min(BLUNT, Math.max(0, entrance));
  const froude = u / Math.sqrt(G * draught);
  const share = (2.2 / (1 + froude)) * (Math.tan(a) / Math.cos(a));
  const height = LARGEST * (1 - Math.exp(-share / LARGEST)) * ((u * u) / G);
  return { height, crest: (1.1 / (1 + froude)) * ((u * u) / G) };
}

const smoothstep = (a, b, x) => {
  const t = Math.min(1, Math.max(0, (x - a) / (b - a)));
  return t * t * (3 - 2 * t);
};

/** Where the ridge of the wave runs: its distance from the plating and its width [m], at `s` from the stem. */
export function findRidge(wave, s) {
  const abaft = Math.max(0, s - wave.crest);
  return { distance: 0.26 * abaft + 0.1 * wave.crest, width: 0.5 * wave.crest + 0.09 * abaft + 0.2 };
}

/** Height of the water [m] at `s` from the stem and `out` from the plating. Before the stem s < 0. */
export function heightOf(wave, s, out) {
  if (!(wave.height > 0)) return 0;
  const { distance, width } = findRidge(wave, s), from = (s - wave.crest) / wave.crest;
  const along = from < 0 ? smoothstep(-1.7, 0, from) : Math.exp(-0.24 * from) / (1 + 0.15 * from);
  const across = out < distance ? Math.exp(-(((distance - out) / (2.2 * width)) ** 2)) : Math.exp(-(((out - distance) / width) ** 2));
  return wave.height * along * across;
}

/** How white the water is, 0 to 1, at `s` and `out`: the front of the ridge breaks, more so the higher it is there. */
export function whitenessOf(wave, s, out) {
  const { distance, width } = findRidge(wave, s);
  const top = heightOf(wave, s, distance);
  const front = smoothstep(-1.6, 0.2, (out - distance) / width);
  return smoothstep(...WHITE, top) * (0.35 + 0.65 * front);
}

/** How little of what is behind shines through water of this height [m]: only its edge, which lies on the sea, is thin. */
export const opacityOf = (height) => smoothstep(0.02, 0.11, height);
