// What a ship leaves on the water along her track: the churned water abaft her stern, and the foam that her bow throws aside.
// Functions of the track up to a time, so that going back in time brings back the water of that time. Numbers only.

export const OLDEST = 260; // age of the oldest wake [s]
const STEPS = [[16, 1], [60, 4], [OLDEST, 10]]; // up to an age, sections were left so many seconds apart
export const MOST = 56; // sections at once, at most
const KELVIN = Math.SQRT1_2 / 2; // tangent of half the angle of Kelvin's wedge
const MOMENT = 0.5; // speeds are those since the section before, or over so many seconds at least
const FADES = { white: 38, churned: 110, thrown: 20, waves: 60 }; // ages at which they have faded to a third [s]
const CATCHES_UP = 15; // water that is churned runs after a ship that slows down, for so long [s]

/** Times at which sections were left, newest first. But for the first and the last they are the same at all times: they stay in place. */
export function sectionTimes(time) {
  const times = [time];
  for (const [until, step] of STEPS) {
    for (let t = step * Math.ceil(times.at(-1) / step - 1 - 1e-9); t > time - until; t -= step) times.push(t);
  }
  times.push(time - OLDEST);
  return times;
}

/**
 * Sections of the track, newest first: {age [s], speed ahead, churn: speed that the water abaft the stern has seen [m/s], ahead: unit vector, stern and bow: places in plan, behind
 * and run: how far stern and bow have come since [m]}. `poseAt(time)`: [x, z, cosine and sine of the heading] of midship;
 * `aft`, `fore`: stations of stern and bow [m].
 */
export function followTrack(poseAt, time, { aft, fore }) {
  const times = sectionTimes(time), poses = times.map(poseAt);
  let behind = 0, run = 0, last = null;
  const sections = poses.map(([x, z, c, s], i) => {
    const stern = [x + aft * c, z + aft * s], bow = [x + fore * c, z + fore * s];
    if (last) {
      behind += Math.hypot(stern[0] - last.stern[0], stern[1] - last.stern[1]);
      run += Math.hypot(bow[0] - last.bow[0], bow[1] - last.bow[1]);
    }
    let j = Math.min(i + 1, times.length - 1);
    while (times[i] - times[j] < MOMENT && j + 1 < times.length) j++;
    const speed = j > i ? Math.max(0, ((x - poses[j][0]) * c + (z - poses[j][1]) * s) / (times[i] - times[j])) : last.speed;
    return (last = { age: time - times[i], speed, churn: speed, ahead: [c, s], stern, bow, behind, run });
  });
  for (let i = sections.length - 2; i >= 0; i--) {
    const { speed, age } = sections[i], before = sections[i + 1];
    sections[i].churn = speed + (before.churn - speed) * Math.exp((age - before.age) / CATCHES_UP);
  }
  return sections;
}

const smoothstep = (a, b, x) => {
  const t = Math.min(1, Math.max(0, (x - a) / (b - a)));
  return t * t * (3 - 2 * t);
};

/** Abaft the stern, at a section: half the breadth of the churned water [m], how white and how green it is, 0 to 1. */
export function churnedAt({ age, churn, behind }, { B }) {
  const strength = smoothstep(0.4, 6.5, churn) * Math.max(0, 1 - age / OLDEST);
  return {
    half: 0.42 * B + 0.55 * Math.sqrt(behind) + 0.006 * behind,
    white: 0.92 * strength * Math.exp(-age / FADES.white),
    green: strength * Math.exp(-age / FADES.churned),
  };
}

/** What the bow sends aside, at a section: [distance from its track, half the breadth [m], how white, how green] of foam and of waves. */
export function thrownAt({ age, speed, run }, { L, B }) {
  const reach = Math.min(1, run / (0.5 * L)), begins = smoothstep(0, 0.08 * L, run) * smoothstep(2, 8, speed);
  return [
    [0.5 * B * (1 - Math.exp(-run / (0.1 * L))) + 0.17 * run, 1 + 0.09 * B * reach + 0.02 * run,
      0.75 * begins * Math.exp(-run / (0.8 * L)) * Math.exp(-age / FADES.thrown), 0],
    // The edge of Kelvin's wedge, where waves are steepest.
    [0.5 * B * reach + KELVIN * run, 2 + 0.03 * run,
      0.3 * begins * reach * Math.exp(-run / (1.5 * L)) * Math.exp(-age / FADES.waves), 0.4 * begins * reach * Math.exp(-run / (2 * L)) * Math.exp(-age / FADES.waves)],
  ];
}
