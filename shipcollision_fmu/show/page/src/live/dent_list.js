// The dents that the picture of a run that goes on has: of the greatest energies of all collisions so far.
import { dentsOf, largestOf } from "./effects_live.js";

const MORE = 1.5; // of the energy that dents were made for: then larger ones take their place

export class DentList {
  /** `add(dents)` brings dents into the picture, and returns what takes them away. */
  constructor(add) {
    Object.assign(this, { add, drawn: new Map() }); // collision -> {energy, made, remove}
  }

  /** A collision, by its key, with its energy so far; `infos`: what is known of the ships that take part. */
  meet(key, collision, infos) {
    const { energy } = collision;
    if (energy <= MORE * (this.drawn.get(key)?.energy ?? 0)) return;
    const made = new Map([...this.drawn].map(([other, known]) => [other, known.made]));
    made.set(key, dentsOf(collision, infos, energy));
    const largest = new Set(largestOf([...made.values()].flat()));
    const changed = [...made].map(([other, dents]) => [other, dents.filter((dent) => largest.has(dent))])
      .filter(([other, dents]) => other === key || dents.length < made.get(other).length);
    for (const [other] of changed) this.remove(other); // first: a bow that is crushed anew was whole before
    for (const [other, dents] of changed) {
      if (dents.length) this.drawn.set(other, { energy: dents[0].energy, made: dents, remove: this.add(dents) });
    }
  }

  remove(key) {
    this.drawn.get(key)?.remove();
    this.drawn.delete(key);
  }

  clear() {
    for (const key of [...this.drawn.keys()]) this.remove(key);
  }

  get dents() {
    return [...this.drawn.values()].flatMap(({ made }) => made);
  }
}
