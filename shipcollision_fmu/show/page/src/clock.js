// The one time that everything on the page is a function of.

export class Clock {
  constructor(start, end) {
    Object.assign(this, { start, end, time: start, speed: 1, playing: false });
    this.listeners = [];
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
    this.time += Math.max(0, (now - this.last) / 1000) * this.speed;
    this.last = now;
    if (this.time >= this.end) {
      this.time = this.end;
      this.playing = false;
    }
    this.tell();
    requestAnimationFrame((next) => this.tick(next));
  }

  tell() {
    for (const listener of this.listeners) listener(this);
  }
}
