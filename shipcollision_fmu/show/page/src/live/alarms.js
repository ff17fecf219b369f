// Alarms as IEC 62923 has them: raised, seen and heard until somebody acknowledges; kept until the cause is gone.
//
//   raised    cause there, not acknowledged: flashes, sounds
//   silent    cause there, acknowledged: steady
//   over      cause gone, not acknowledged: flashes no more, is listed until it is acknowledged

export const PRIORITIES = ["alarm", "warning", "caution"]; // red, orange, yellow; cautions are not heard

export class Alarms {
  constructor() {
    this.list = new Map(); // key -> {key, priority, words, state}
  }

  /** Says whether the cause of an alarm is there, and what it is: words() gives the text in the present language. */
  set(key, isThere, priority, words) {
    const known = this.list.get(key);
    if (isThere) {
      if (!known || known.state === "over") this.list.set(key, { key, priority, words, state: "raised" });
      else known.words = words;
    } else if (known?.state === "raised" && priority !== "caution") known.state = "over";
    else if (known && known.state !== "over") this.list.delete(key);
  }

  /** Takes an alarm away whose end needs no acknowledgement. */
  clear(key) {
    this.list.delete(key);
  }

  acknowledge() {
    for (const alarm of this.list.values()) {
      if (alarm.state === "over") this.list.delete(alarm.key);
      else alarm.state = "silent";
    }
  }

  /** The most urgent priority that is not acknowledged and has to be heard, or null. */
  get sounding() {
    const raised = [...this.list.values()].filter(({ state }) => state === "raised").map(({ priority }) => priority);
    return PRIORITIES.slice(0, 2).find((priority) => raised.includes(priority)) ?? null;
  }

  /** All, the most urgent first. */
  get sorted() {
    const order = ({ priority, state }) => (state === "silent" ? 10 : 0) + PRIORITIES.indexOf(priority);
    return [...this.list.values()].sort((a, b) => order(a) - order(b));
  }
}
