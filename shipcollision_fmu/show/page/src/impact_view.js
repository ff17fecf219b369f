// Where an impact is best seen from: low, in three-quarter view, with both ships, and with no hull before its place.
import * as THREE from "three";
import { countHidden, isAnotherInTheWay, isWithin } from "./in_the_way.js";

const UP = new THREE.Vector3(0, 1, 0);
const AROUND = { two: 0.65, one: 0.4, upright: 0.25 }; // of the ships' length: across, while both are there, and upright
const RISES = [0.13, 0.2, 0.32]; // elevations from which an impact may be seen [rad]
const BESIDE = 0.65; // best angle between the eye and the normal of the side that is struck [rad]
const BLOCKED = 4; // worse than a place that is hidden once: the eye is within a ship
const OBLIQUE = 0.95; // and the greatest from which an opening is still seen well
const LOOKS = 12; // directions that are tried for a free view
const MOMENTS = [0.05, 0.6, 3]; // after the impact [s], at which its place must be seen
// [s] after the impact at its wound: so many of its widths, no nearer than a share of the view before, nearly square on [rad].
const LOOK_BACK = { after: 6, across: 4, nearest: 0.6, beside: 0.35 };
const STRONG = 0.5; // of the strongest impact so far: a weaker one is not what is looked at

export class ImpactView {
  /** `ships`: [{node, info, track}], posed as they lie now; `freeAngles()`: of the part of the picture that nothing covers. */
  constructor(ships, data, freeAngles) {
    Object.assign(this, { ships, data, freeAngles });
  }

  /** The latest impact so far that is among the strongest, or the first one if there has been none. */
  effectAt(time) {
    const impacts = this.data.effects.filter(({ kind }) => kind === "dust");
    const known = impacts.length ? impacts : this.data.effects;
    const past = known.filter((effect) => effect.time <= time);
    const strongest = Math.max(...past.map(({ intensity }) => intensity));
    return past.findLast(({ intensity }) => intensity >= STRONG * strongest) ?? known[0];
  }

  /** Width [m] of the opening of an impact that is over; 0 before that, and without one. */
  woundOf(effect, time) {
    if (time < effect.time + LOOK_BACK.after) return 0;
    const dent = this.data.dents?.find(({ kind, ship, time: begins }) => kind === "side" && ship === effect.ship && begins === effect.time);
    return dent ? 2 * dent.half_width : 0;
  }

  /** Whether a view that was chosen at a time shows the impact, and by now its wound is to be seen. */
  isOver(chosen, time) {
    if (!this.data.effects?.length) return false;
    const effect = this.effectAt(time);
    return !this.woundOf(effect, chosen) && this.woundOf(effect, time) > 0;
  }

  /** Where an impact is seen, between deck and water, and a little below; the ships as they lie now. */
  placesOf(effect) {
    const { node, info } = this.ships.find((ship) => ship.info.name === effect.ship);
    const outwards = new THREE.Vector3(...effect.outwards).transformDirection(node.matrixWorld).setY(0).normalize();
    const point = node.localToWorld(new THREE.Vector3(...effect.point)).addScaledVector(outwards, 0.4);
    point.setY(Math.min(Math.max(point.y, 0.3 * info.height), 0.45 * info.height + 1));
    return [point, point.clone().setY(0.75 * point.y)];
  }

  /** How many places of the latest impact a hull hides from an eye; all where the eye is within a ship. Zero without one. */
  hidden(eye, time) {
    if (!this.data.effects?.length) return 0;
    const places = this.placesOf(this.effectAt(time));
    return isWithin(this.ships, eye) ? places.length : this.countHidden(eye, places);
  }

  countHidden(eye, places) {
    return countHidden(this.ships, eye, places, Math.max(1, 0.03 * this.lengthAt(places[0])));
  }

  /** Whether a ship may be in the way of an eye: found in plan, as most of the time there is not even one there. */
  mayBeHidden(eye, time) {
    const effect = this.effectAt(time), struck = this.ships.find(({ info }) => info.name === effect.ship);
    return isWithin(this.ships, eye) || isAnotherInTheWay(this.ships, struck.node, this.placesOf(effect)[0], eye);
  }

  /** The ships that are at a place: not those that have left it. */
  shipsAt(place) {
    const near = this.ships.filter(({ node, info }) => node.getWorldPosition(new THREE.Vector3()).distanceTo(place) < 0.75 * info.L_oa);
    return near.length ? near : this.ships;
  }

  /** A ship's length [m] as it matters at a place: the mean of the logarithms of all that are near. */
  lengthAt(place) {
    const lengths = this.shipsAt(place).map(({ info }) => info.L_oa);
    return Math.exp(lengths.reduce((sum, length) => sum + Math.log(length), 0) / lengths.length);
  }

  /**
   * Where an impact is best seen from: low, in three-quarter view, with much of both ships, never within a ship, and
   * with no hull before its place. Directions are sorted by all but the last, which takes long, and tried one after the other.
   */
  find(effect, time) {
    const begins = Math.max(this.data.start, time, effect.time);
    const offset = this.posedAt(begins, () => {
      const tried = this.rankViews(effect, begins);
      const cost = (one) => MOMENTS.reduce((sum, later) => (sum >= BLOCKED ? sum : sum + this.posedAt(begins + later, () => {
        const places = this.placesOf(effect), eye = places[0].clone().add(one.offset);
        return isWithin(this.ships, eye) ? BLOCKED : this.countHidden(eye, places);
      })), 0);
      let best = tried[0], least = Infinity, looks = 0;
      for (const one of tried) {
        const hidden = cost(one);
        if (hidden - one.score < least) [best, least] = [one, hidden - one.score];
        if (hidden === 0 || (hidden < BLOCKED && ++looks >= LOOKS)) break;
      }
      return best.offset;
    });
    return this.placesOf(effect)[0].add(offset);
  }

  /** Places of the eye from that of an impact, with a score by angle, elevation and what is seen of the ships; the best first. */
  rankViews(effect, time) {
    const wound = this.woundOf(effect, time), beside = wound ? LOOK_BACK.beside : BESIDE;
    const { node } = this.ships.find(({ info }) => info.name === effect.ship);
    const outwards = new THREE.Vector3(...effect.outwards).transformDirection(node.matrixWorld).setY(0).normalize();
    const target = this.placesOf(effect)[0];
    const { tanX, tanY } = this.freeAngles(), length = this.lengthAt(target);
    const near = this.shipsAt(target), across = near.length > 1 ? AROUND.two : AROUND.one;
    const ordinary = Math.max(25, (across * length) / (2 * tanX), (AROUND.upright * length) / (2 * tanY));
    const distance = wound ? Math.min(ordinary, Math.max(25, LOOK_BACK.nearest * ordinary, (LOOK_BACK.across * wound) / (2 * tanX))) : ordinary;
    const tried = [];
    for (const rise of RISES) {
      for (let i = -17; i <= 17; i++) {
        const turn = (i * Math.PI) / 18;
        const offset = outwards.clone().applyAxisAngle(UP, turn).addScaledVector(UP, rise).setLength(distance);
        const seen = near.map((ship) => this.shareSeen(ship, target, target.clone().add(offset)));
        const score = 1.2 * Math.min(...seen) + 0.4 * Math.max(...seen) - 0.8 * Math.abs(Math.abs(turn) - beside) - 3 * Math.max(0, Math.abs(turn) - OBLIQUE) - 3 * (rise - RISES[0]) + 1e-4 * i;
        tried.push({ offset, score });
      }
    }
    return tried.sort((a, b) => b.score - a.score);
  }

  /** Share of a ship's length, and of the house above it, that the free part of the picture shows to an eye that looks at a target. */
  shareSeen({ node, info }, target, eye) {
    const forward = target.clone().sub(eye).normalize();
    const right = new THREE.Vector3().crossVectors(forward, UP).normalize(), above = new THREE.Vector3().crossVectors(right, forward);
    const { tanX, tanY } = this.freeAngles();
    const places = [-0.5, -0.35, -0.2, 0, 0.2, 0.35, 0.5].map((along) => node.localToWorld(new THREE.Vector3(along * info.L_oa, 0, -info.height)).sub(eye));
    return places.filter((v) => {
      const depth = v.dot(forward);
      return depth > 1 && Math.abs(v.dot(right)) < tanX * depth && Math.abs(v.dot(above)) < 1.1 * tanY * depth;
    }).length / places.length;
  }

  /** Calls `look` with the ships posed as they are at a time, and puts them back. */
  posedAt(time, look) {
    const kept = this.ships.map(({ node }) => [node.position.clone(), node.quaternion.clone()]);
    for (const { node, track } of this.ships) {
      track.at(time - this.data.start, node.position, node.quaternion);
      node.updateWorldMatrix(true, true);
    }
    const found = look();
    this.ships.forEach(({ node }, i) => {
      node.position.copy(kept[i][0]);
      node.quaternion.copy(kept[i][1]);
      node.updateWorldMatrix(true, true);
    });
    return found;
  }
}
