// Where a ship has been, as far as this page has seen: for wakes and for the tracks in the chart.

const APART = 0.5; // least time between two places [s]
const MOST = 4000;

export class History {
  constructor() {
    this.places = []; // {time, eta}, by time
    this.now = null;
  }

  /** The ship's present state. Where time has gone back, what was later has not happened. */
  push(time, eta, nu) {
    const { places } = this;
    while (places.length && places.at(-1).time > time) places.pop();
    this.now = { time, eta, nu };
    if (places.length && time - places.at(-1).time < APART) return;
    places.push({ time, eta });
    if (places.length > MOST) places.shift();
  }

  /** Time has gone back, perhaps to less than one push ago: what was later has not happened. */
  goBack(time) {
    if (this.now !== null && time < this.now.time) this.push(time, this.at(time), this.now.nu);
  }

  /** eta at a time: linear between what was seen, straight ahead before, and as it is now after. */
  at(time) {
    const { places, now } = this;
    if (time >= now.time) return now.eta;
    if (time <= places[0].time) return this.extrapolate(time - places[0].time);
    let low = 0;
    let high = places.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      places[middle].time <= time ? (low = middle) : (high = middle);
    }
    const a = places[low];
    const b = places[low + 1] ?? now;
    const share = b.time > a.time ? (time - a.time) / (b.time - a.time) : 1;
    return a.eta.map((value, k) => value + share * (b.eta[k] - value));
  }

  /** Before the first place: on the first heading, at the first speed over ground that was seen. */
  extrapolate(dt) {
    const { eta } = this.places[0];
    this.first ??= this.now.nu;
    const [u, v] = this.first;
    const [cos, sin] = [Math.cos(eta[5]), Math.sin(eta[5])];
    return [eta[0] + (u * cos - v * sin) * dt, eta[1] + (u * sin + v * cos) * dt, ...eta.slice(2)];
  }
}
