// The one time that everything on the page is a function of. Around an impact it goes slower by itself, unless told not to.

const SLOWEST = 0.25; // of real time, at an impact
const BEFORE = 1, AFTER = 2.5; // seconds of the run around an impact that pass at SLOWEST
const EASE = 0.8; // seconds of the run in which the rate changes

export class Clock {
  /** `impacts`: times at which it goes slower. */
  constructor(start, end, impacts = []) {
    Object.assign(this, { start, end, time: start, speed: 1, playing: false, impacts, isSlow: true });
    this.listeners = [];
  }

  /** Seconds of the run per second: the chosen speed, or less around an impact. */
  get rate() {
    if (!this.isSlow || this.speed <= SLOWEST) return this.speed;
    const away = Math.min(...this.impacts.map((time) => Math.max(time - BEFORE - this.time, this.time - time - AFTER, 0)), Infinity);
    const share = Math.min(1, away / EASE);
    return SLOWEST * (this.speed / SLOWEST) ** share;
  }

  /** Calls `listener(clock)` now and after every change. */
  watch(listener) {
    this.listeners.push(listener);
    listener(this);
  }

  seek(time) {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.tell();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.tell();
  }

  setSlow(isSlow) {
    this.isSlow = isSlow;
    this.tell();
  }

  play() {
    if (this.time >= this.end) this.time = this.start;
    this.playing = true;
    this.last = performance.now();
    this.tell();
    requestAnimationFrame((now) => this.tick(now));
  }

  pause() {
    this.playing = false;
    this.tell();
  }

  toggle() {
    this.playing ? this.pause() : this.play();
  }

  tick(now) {
    if (!this.playing) return;
    this.advance(Math.max(0, (now - this.last) / 1000));
    this.last = now;
    if (this.time >= this.end) {
      this.time = this.end;
      this.playing = false;
    }
    this.tell();
    requestAnimationFrame((next) => this.tick(next));
  }

  /** Moves on by real time [s], in steps short enough that no impact is passed at full speed. */
  advance(seconds) {
    const steps = Math.max(1, Math.ceil((seconds * this.speed) / (0.5 * BEFORE)));
    for (let i = 0; i < steps; i++) this.time += (seconds / steps) * this.rate;
  }

  tell() {
    for (const listener of this.listeners) listener(this);
  }
}
