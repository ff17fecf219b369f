// The newest two states of the simulation, and what is shown in between: one interval late, so that there is always a
// later state to go to. Between them, everything is linear. Time that went back (to a mark) is shown at once.

const USUAL = 50; // between two states [ms of the wall clock], as long as nothing is known
const MOST = 500; // longest interval: after a gap the ships do not crawl

const mix = (a, b, share) => (a === null || b === null || a === undefined ? b : a + (b - a) * share);
const mixAll = (a, b, share) => b.map((value, k) => mix(a[k], value, share));

export class Snapshots {
  constructor() {
    Object.assign(this, { before: null, newest: null, interval: USUAL });
  }

  /** A state that came at a wall time [ms]. Returns whether time went back. */
  push(state, wall) {
    const last = this.newest;
    const isBack = last !== null && state.time < last.state.time;
    if (last !== null) this.interval += 0.2 * (Math.min(MOST, wall - last.wall) - this.interval);
    this.newest = { state, wall };
    this.before = last === null || isBack ? this.newest : last;
    return isBack;
  }

  /** The state to be shown at a wall time [ms]; null before the first has come. */
  at(wall) {
    if (this.newest === null) return null;
    const a = this.before.state;
    const b = this.newest.state;
    const share = Math.min(1, Math.max(0, (wall - this.newest.wall) / this.interval));
    const ships = Object.fromEntries(Object.entries(b.ships).map(([name, ship]) => {
      const was = a.ships[name] ?? ship;
      return [name, {
        ...ship,
        eta: mixAll(was.eta, ship.eta, share),
        nu: mixAll(was.nu, ship.nu, share),
        rudder: mix(was.rudder, ship.rudder, share),
        rev_per_s: mix(was.rev_per_s, ship.rev_per_s, share),
      }];
    }));
    return { ...b, time: mix(a.time, b.time, share), ships };
  }
}
