// The effects of a collision that has just happened, as show/scene/effects.py makes them of a run that is over.

const FULL = 1e8; // energy of an effect at full strength [J]
const FAINTEST = 0.05;
const LARGEST = 6; // [m]
const KINDS = { explosion: [0, 1], debris: [0, 1], fire: [0.4, 25], smoke: [0.8, 60] }; // delay, duration [s]

/** Effects of {id, time, point, energy} on the ship that is struck: that whose contact point is farther aft. */
export function effectsOf(collision, ships) {
  const borne = ships.filter(({ info }) => info.name === collision.ship_a || info.name === collision.ship_b)
    .map(({ info, eta }) => ({ info, point: inShip(eta, collision.point) }));
  if (!borne.length) return [];
  const { info, point } = borne.reduce((a, b) => (b.point[0] / b.info.L_oa < a.point[0] / a.info.L_oa ? b : a));
  const intensity = Math.min(1, Math.max(FAINTEST, Math.cbrt(Math.max(0, collision.energy) / FULL)));
  return Object.entries(KINDS).map(([kind, [delay, duration]], k) => ({
    kind, ship: info.name, point, outwards: [0, Math.sign(point[1]) || 1, 0], time: collision.time + delay * intensity,
    duration: duration * intensity, intensity, size: LARGEST * intensity, seed: 4 * collision.id + k,
  }));
}

/** A point of n in a ship's b, for a ship that is upright. */
function inShip(eta, point) {
  const [north, east, down] = [0, 1, 2].map((k) => point[k] - eta[k]);
  const [cos, sin] = [Math.cos(eta[5]), Math.sin(eta[5])];
  return [cos * north + sin * east, -sin * north + cos * east, down];
}
