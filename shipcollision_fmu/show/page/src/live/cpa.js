// The closest point of approach (CPA) of two bodies that keep course and speed, in closed form.
//
//   r(t) = r + v t            position and velocity of the other relative to own
//   TCPA = -(r . v) / (v . v) where |r(t)|, a parabola in t when squared, is least
//   CPA  = |r + v TCPA|
//
// Positions are [north, east] in m, velocities in m/s over ground, times in s.

const STILL = 1e-6; // relative speed [m/s] below which the distance stays: the course would be that of rounding errors

/** {tcpa, cpa, own, other}: time until the CPA (negative when it is past), distance then, and both places then. */
export function closestApproach(own, other) {
  const r = [0, 1].map((k) => other.position[k] - own.position[k]);
  const v = [0, 1].map((k) => other.velocity[k] - own.velocity[k]);
  const speed2 = v[0] * v[0] + v[1] * v[1];
  const tcpa = speed2 < STILL * STILL ? 0 : -(r[0] * v[0] + r[1] * v[1]) / speed2;
  return {
    tcpa,
    cpa: Math.hypot(r[0] + v[0] * tcpa, r[1] + v[1] * tcpa),
    own: [0, 1].map((k) => own.position[k] + own.velocity[k] * tcpa),
    other: [0, 1].map((k) => other.position[k] + other.velocity[k] * tcpa),
  };
}

/** Whether the CPA is ahead within a time and nearer than a distance. Bodies that part are no danger, however near. */
export function isTooClose(own, other, { cpa: least, tcpa: within }) {
  const at = closestApproach(own, other);
  return at.tcpa >= 0 && at.tcpa <= within && at.cpa < least;
}
