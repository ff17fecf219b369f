// What a bridge's instruments show, from a ship's state: eta = (N, E, D, roll, pitch, yaw), nu = (u, v, w, p, q, r).

const TURN = 2 * Math.PI;
export const KNOT = 1852 / 3600; // [m/s]
export const MILE = 1852; // [m]
export const toDegrees = (angle) => (angle * 180) / Math.PI;
export const toRadians = (angle) => (angle * Math.PI) / 180;

/** An angle [rad] in [0, 2 pi). */
export const wholeTurn = (angle) => ((angle % TURN) + TURN) % TURN;

/** Velocity over ground in n [m/s], [north, east, down]: R_nb nu. */
export function velocityOverGround({ eta, nu }) {
  const [phi, theta, psi] = eta.slice(3);
  const [cf, sf, ct, st, cp, sp] = [Math.cos(phi), Math.sin(phi), Math.cos(theta), Math.sin(theta), Math.cos(psi), Math.sin(psi)];
  const [u, v, w] = nu;
  return [
    cp * ct * u + (cp * st * sf - sp * cf) * v + (cp * st * cf + sp * sf) * w,
    sp * ct * u + (sp * st * sf + cp * cf) * v + (sp * st * cf - cp * sf) * w,
    -st * u + ct * sf * v + ct * cf * w,
  ];
}

/** Heading [rad], rate of turn [rad/s], SOG [m/s], COG [rad] or null at rest, speed log along the keel [m/s]. */
export function instruments(ship, current = [0, 0]) {
  const [phi, theta, psi] = ship.eta.slice(3);
  const [north, east] = velocityOverGround(ship);
  const sog = Math.hypot(north, east);
  return {
    heading: wholeTurn(psi),
    rot: (Math.sin(phi) * ship.nu[4] + Math.cos(phi) * ship.nu[5]) / Math.cos(theta),
    sog,
    cog: sog < 0.02 ? null : wholeTurn(Math.atan2(east, north)),
    log: ship.nu[0] - (Math.cos(psi) * current[0] + Math.sin(psi) * current[1]),
  };
}

/** A ship as cpa.js takes it. */
export const moving = (ship) => ({ position: ship.eta.slice(0, 2), velocity: velocityOverGround(ship).slice(0, 2) });

/** Bearing [rad] and range [m] of another ship. */
export function bearing(own, other) {
  const [north, east] = [0, 1].map((k) => other.eta[k] - own.eta[k]);
  return { bearing: wholeTurn(Math.atan2(east, north)), range: Math.hypot(north, east) };
}
