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

  /**
   * Says whether the cause of an alarm is there, and what it is: words() gives the text in the present language, past()
   * that once the cause is gone, where words() has numbers, which then would be old.
   */
  set(key, isThere, priority, words, past = words) {
    const known = this.list.get(key);
    if (isThere) {
      if (known?.state === "over") this.list.delete(key); // raised anew, it is the newest
      if (!known || known.state === "over") this.list.set(key, { key, priority, words, state: "raised" });
      else known.words = words;
    } else if (known?.state === "raised" && priority !== "caution") Object.assign(known, { state: "over", words: past });
    else if (known && known.state !== "over") this.list.delete(key);
  }

  /** Takes an alarm away whose end needs no acknowledgement. */
  clear(key) {
    this.list.delete(key);
  }

  /** All causes are gone or have not been: of a run that has ended, or gone back. */
  clearAll() {
    this.list.clear();
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

  /** All, the most urgent first: what is to be acknowledged; what else is there; what is over. In each by priority, a collision before others, the newest first. */
  get sorted() {
    const group = ({ priority, state }) => (state === "over" ? 2 : state === "silent" || priority === "caution" ? 1 : 0);
    const order = (alarm) => 10 * group(alarm) + 2 * PRIORITIES.indexOf(alarm.priority) - (alarm.key === "contact" ? 1 : 0);
    return [...this.list.values()].reverse().sort((a, b) => order(a) - order(b));
  }
}
