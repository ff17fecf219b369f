// The effects of a collision, as show/scene/effects.py makes them of a run that is over: dust and splash at once, fire
// from the moment at which the energy dissipated so far reaches what sets a cargo on fire.

const FULL = 1e9; // energy of an effect at full strength [J]
const FAINTEST = 0.023;
const LARGEST = 13; // [m]
const IGNITION = 5e7; // [J], and where a tanker or a gas carrier takes part:
const IGNITION_OF_OIL_AND_GAS = 3.27e7;
const HITS = { dust: [0, 2.6], splash: [0, 2.2] }; // delay, duration [s]
const FIRES = { explosion: [0, 1.5], debris: [0, 1.5], fire: [0.6, 54], smoke: [0.9, 130] };

// Sizes of dents, as in show/scene/dents.py, which says what they mean.
const STEEL = 47.2e6, PLATES = 0.06, SLOPE = Math.tan(Math.PI / 6), CRUSH = 0.25;
const BOW = 0.3, STEM = 0.47, SMALLEST = 0.25, WIDEST = 0.1, MOST = 8;
const GROWS = 1; // a dent [s]: the closing speed is not told, and here it is always to the side that the plating opens

/**
 * Dents of a collision of an energy [J]: an opening in the side that is struck, a crushed bow on the ship that strikes.
 * `infos`: name and L_pp of the ships that take part.
 */
export function dentsOf(collision, infos, energy) {
  const depth = Math.sqrt(Math.max(0, energy) / STEEL / (PLATES * SLOPE));
  const pointOf = ({ name }) => (name === collision.ship_a ? collision.a : collision.b);
  const ahead = (info) => pointOf(info)[0] / info.L_pp, foremost = Math.max(...infos.map(ahead));
  return infos.map((info) => {
    const point = pointOf(info), isBow = ahead(info) > (ahead(info) === foremost ? BOW : STEM);
    return {
      kind: isBow ? "bow" : "side", ship: info.name, point, outwards: [0, Math.sign(point[1]) || 1, 0],
      time: collision.time, duration: GROWS, energy, depth: isBow ? CRUSH * depth : depth, half_width: Math.min(depth * SLOPE, WIDEST * info.L_pp),
    };
  }).filter(({ half_width }) => half_width >= SMALLEST);
}

/** Of dents those of the greatest energies, as many as a picture has; a bow is crushed once. */
export function largestOf(dents) {
  const found = [];
  for (const dent of [...dents].sort((a, b) => b.energy - a.energy)) {
    const isCrushed = dent.kind === "bow" && found.some(({ kind, ship }) => kind === "bow" && ship === dent.ship);
    if (!isCrushed && found.length < MOST) found.push(dent);
  }
  return found;
}

/** The energy [J] that sets something on fire. `infos`: what is known of the ships that take part. */
export const ignitionOf = (infos) => (infos.some(({ kind }) => /tanker|gas/i.test(kind)) ? IGNITION_OF_OIL_AND_GAS : IGNITION);

/**
 * Effects of {id, ship_a, ship_b, a, b} of an energy [J] from a time on, on the ship that is struck: that whose contact
 * point is farther aft. `infos`: what is known of the ships that take part.
 */
export function effectsOf(collision, infos, time, energy, isFire) {
  const borne = infos.map((info) => ({ info, point: info.name === collision.ship_a ? collision.a : collision.b }));
  if (!borne.length) return [];
  const { info, point } = borne.reduce((a, b) => (b.point[0] / b.info.L_pp < a.point[0] / a.info.L_pp ? b : a));
  const intensity = Math.min(1, Math.max(FAINTEST, Math.cbrt(Math.max(0, energy) / FULL)));
  return Object.entries(isFire ? FIRES : HITS).map(([kind, [delay, duration]], k) => ({
    kind, ship: info.name, point, outwards: [0, Math.sign(point[1]) || 1, 0],
    time: time + delay * intensity, duration: duration * intensity, intensity, size: LARGEST * intensity,
    seed: 6 * collision.id + k + (isFire ? 2 : 0),
  }));
}
