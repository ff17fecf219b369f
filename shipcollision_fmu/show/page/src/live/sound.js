// What is heard: horns and alarms, by WebAudio. Browsers allow sound only after the first click or key.

const ALARM = { alarm: 3, warning: 2 }; // short tones in a row (IEC 62923-1)
const AGAIN = 7; // between two rows [s]
const REACH = 400; // a horn is half as loud at this distance [m]

/** Frequency of a ship's whistle [Hz] by its length: 70-200 over 200 m, 130-350 over 75 m, 250-700 (COLREGs, Annex III). */
export const whistle = (length) => (length >= 200 ? 110 : length >= 75 ? 200 : 370);

export class Sound {
  constructor() {
    Object.assign(this, { context: null, horns: new Map(), next: 0 });
    const wake = ({ isTrusted }) => {
      if (!isTrusted) return; // the browser allows no sound for what no hand has done
      this.context ??= new AudioContext();
      this.context.resume();
    };
    for (const kind of ["pointerdown", "keydown"]) window.addEventListener(kind, wake);
  }

  get isAllowed() {
    return this.context?.state === "running";
  }

  /** Sounds the horns of {name, length, distance} and no others. */
  blow(ships) {
    if (!this.isAllowed) return;
    const { context, horns } = this;
    for (const { name, length, distance } of ships) {
      const horn = horns.get(name) ?? this.makeHorn(length);
      horns.set(name, horn);
      horn.gain.setTargetAtTime(0.25 / (1 + distance / REACH), context.currentTime, 0.08);
    }
    for (const [name, { gain, voices }] of horns) {
      if (ships.some((ship) => ship.name === name)) continue;
      gain.setTargetAtTime(0, context.currentTime, 0.12);
      for (const voice of voices) voice.stop(context.currentTime + 1);
      horns.delete(name);
    }
  }

  makeHorn(length) {
    const { context } = this;
    const volume = new GainNode(context, { gain: 0 });
    const filter = new BiquadFilterNode(context, { type: "lowpass", frequency: 6 * whistle(length) });
    filter.connect(volume).connect(context.destination);
    const voices = [1, 1.503].map((ratio) => {
      const voice = new OscillatorNode(context, { type: "sawtooth", frequency: ratio * whistle(length) });
      voice.connect(filter);
      voice.start();
      return voice;
    });
    return { gain: volume.gain, voices };
  }

  /** Sounds an alarm of a priority ("alarm", "warning" or null), every few seconds as long as this is called. */
  alarm(priority) {
    if (!this.isAllowed || priority === null) return void (this.next = 0);
    const now = this.context.currentTime;
    if (now < this.next) return;
    this.next = now + AGAIN;
    for (let i = 0; i < ALARM[priority]; i++) {
      const volume = new GainNode(this.context, { gain: 0 });
      const tone = new OscillatorNode(this.context, { type: "square", frequency: 880 });
      const start = now + 0.05 + 0.3 * i;
      volume.gain.setTargetAtTime(0.06, start, 0.01);
      volume.gain.setTargetAtTime(0, start + 0.15, 0.02);
      tone.connect(volume).connect(this.context.destination);
      tone.start(start);
      tone.stop(start + 0.4);
    }
  }
}
