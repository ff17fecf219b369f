// Where the camera looks: at everything, along with a ship, at the impact, or wherever it is turned to.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { measureFreeRectangle } from "./free_rectangle.js";
import { toWorld } from "./tracks.js";

const UP = new THREE.Vector3(0, 1, 0);
const LOW = (4.6 * Math.PI) / 180; // elevation of the first view: from a launch, with sky over the ships
const FILLED = 0.86; // of the free part of the picture, by all ships
const AROUND = { two: 0.65, one: 0.4, upright: 0.25 }; // of the ships' length: across, while both are there, and upright
const RISES = [0.13, 0.2, 0.32]; // elevations from which an impact may be seen [rad]
const BESIDE = 0.65; // best angle between the eye and the normal of the side that is struck [rad]
const BLOCKED = 4; // worse than a place that is hidden once: the eye is within a ship
const OBLIQUE = 0.95; // and the greatest from which an opening is still seen well
const LOOKS = 12; // directions that are tried for a free view
const MOMENTS = [0.05, 0.6, 3]; // after the impact [s], at which its place must be seen
const STRONG = 0.5; // of the strongest impact so far: a weaker one is not what is looked at
const CHECK = 0.5, PATIENCE = 4; // [s] of the run: between two looks whether the view is still free, and between two new views
const CREST = 1.2; // the highest wave that sea.js draws [m]
const LOWEST = 2; // height of the eye [m]

export class Cameras {
  constructor(canvas, ships, data, changed) {
    this.ships = ships; // [{node, info, track}], poses current
    this.data = data;
    this.camera = new THREE.PerspectiveCamera(38, 1, 1, 80000);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = 0.497 * Math.PI; // stays above the water
    this.controls.minDistance = 8;
    this.controls.maxDistance = 15000;
    this.controls.zoomSpeed = 1.4;
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("start", () => (this.moved = true));
    this.canvas = canvas;
    this.free = null; // the part of the picture that nothing covers, once measured
    this.mode = "all";
    this.moved = false; // whether the user has turned or zoomed since the choice
  }

  /** What can be chosen: [value, label]. */
  get choices() {
    const ships = this.ships.map(({ info }, i) => [`ship-${i}`, `Follow ${info.name}`]);
    const impact = this.data.effects.length ? [["impact", "Impact"]] : [];
    return [["all", "Overview"], ...impact, ...ships, ["free", "Free"]];
  }

  /** The point in the world that a mode keeps in view, or null. */
  anchor(mode, time) {
    if (mode.startsWith("ship-")) return this.ships[Number(mode.slice(5))].node.getWorldPosition(new THREE.Vector3());
    if (mode === "all") return this.fleet().middle;
    if (mode === "impact") {
      return this.placesOf(this.effectAt(time))[0];
    }
    return null;
  }

  /** The middle of the ships as they lie now, a little above the water, and the distance from it to the farthest end. */
  fleet() {
    const places = this.ships.map(({ node }) => node.getWorldPosition(new THREE.Vector3()));
    const middle = new THREE.Box3().setFromPoints(places).getCenter(new THREE.Vector3()).setY(6);
    const span = Math.max(...places.map((place, i) => place.distanceTo(middle) + 0.5 * this.ships[i].info.L_oa));
    return { middle, span };
  }

  /** Bow and stern of every ship, as they lie now. */
  ends() {
    return this.ships.flatMap(({ node, info }) =>
      [-0.5, 0.5].map((along) => node.localToWorld(new THREE.Vector3(along * info.L_oa, 0, 0))),
    );
  }

  /** The latest impact so far that is among the strongest, or the first one if there has been none. */
  effectAt(time) {
    const impacts = this.data.effects.filter(({ kind }) => kind === "dust");
    const known = impacts.length ? impacts : this.data.effects;
    const past = known.filter((effect) => effect.time <= time);
    const strongest = Math.max(...past.map(({ intensity }) => intensity));
    return past.findLast(({ intensity }) => intensity >= STRONG * strongest) ?? known[0];
  }

  choose(mode, time) {
    this.mode = mode;
    this.moved = false;
    if (mode === "free") return;
    this.makeRoom();
    this.checked = this.chosen = time;
    const at = mode === "all" ? this.overview(time) : this.closeUp(mode, time);
    this.controls.target.copy(at.target);
    this.camera.position.copy(at.position);
    this.last = this.anchor(mode, time);
    this.lastSpan = this.fleet().span;
    this.controls.update();
  }

  /** Puts what is looked at in the middle of the part of the picture that nothing covers. */
  makeRoom() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.free = measureFreeRectangle(this.canvas);
    const { left, top, right, bottom } = this.free;
    this.camera.setViewOffset(width, height, 0.5 * (width - left - right), 0.5 * (height - top - bottom), width, height);
  }

  /** Tangents of the half angles that the free part of the picture takes up, across and upright. */
  freeAngles() {
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    if (!this.free) return { tanX: half * this.camera.aspect, tanY: half * 0.84 };
    const { left, top, right, bottom } = this.free;
    return { tanX: (half * (right - left)) / this.canvas.clientHeight, tanY: (half * (bottom - top)) / this.canvas.clientHeight };
  }

  /** How many places of the latest impact a hull hides from the eye now; all where the eye is within a ship. Zero without one. */
  hidden(time) {
    if (!this.data.effects?.length) return 0;
    const places = this.placesOf(this.effectAt(time));
    return this.isWithin(this.camera.position) ? places.length : this.countHidden(this.camera.position, places);
  }

  /** A new view of the impact where a ship has come between it and the eye. */
  clearTheView(time) {
    if (this.mode !== "impact" || this.moved || Math.abs(time - this.checked) < CHECK) return;
    this.checked = time;
    if (Math.abs(time - this.chosen) < PATIENCE && time >= this.chosen) return;
    const effect = this.effectAt(time), struck = this.ships.find(({ info }) => info.name === effect.ship);
    // Rays take long, and most of the time there is not even a ship in plan.
    if (!this.isAnotherInTheWay(struck.node, this.placesOf(effect)[0], this.camera.position) && !this.isWithin(this.camera.position)) return;
    if (this.hidden(time)) this.choose("impact", time);
  }

  /** Moves with what is followed; the user's turning and zooming stay. */
  follow(time) {
    this.clearTheView(time);
    const anchor = this.anchor(this.mode, time);
    if (anchor && this.last) {
      const moved = anchor.clone().sub(this.last);
      this.controls.target.add(moved);
      this.camera.position.add(moved);
    }
    this.last = anchor;
    if (this.mode === "all") {
      const { span } = this.fleet(); // ships that part or meet fill the picture as before
      const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(span / this.lastSpan);
      this.camera.position.copy(this.controls.target).add(offset);
      this.lastSpan = span;
    }
    this.controls.update();
    this.camera.position.y = Math.max(this.camera.position.y, LOWEST);
    const distance = this.camera.position.distanceTo(this.controls.target);
    // No nearer than needed, for depth; and no farther than the water below the picture's lower edge, which would be missing.
    const near = Math.max(0.4, Math.min(0.03 * distance, 0.6 * (this.camera.position.y - CREST)));
    if (Math.abs(this.camera.near - near) > 0.1 * near) {
      this.camera.near = near;
      this.camera.updateProjectionMatrix();
    }
  }

  resize(width, height) {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.makeRoom();
    if (this.mode === "all" && this.last && !this.moved) this.fitAgain();
    if (this.mode === "impact" && !this.moved) this.choose("impact", this.chosen);
  }

  /** The overview in a picture of another shape: all ships fill it again, seen from the same direction. */
  fitAgain() {
    const { middle, span } = this.fleet();
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.copy(middle);
    this.camera.position.copy(this.backOff(middle, direction, this.ends()));
    this.last = middle;
    this.lastSpan = span;
    this.controls.update();
  }

  /** All ships as they lie now, seen from where they will hide each other least when they meet. */
  overview(time) {
    const target = this.fleet().middle;
    const { start, end, events } = this.data;
    const impact = events.find((event) => event.time >= time) ?? events.at(-1);
    const moment = (impact ? Math.max(impact.time, time) : Math.min(end, time + 30)) - start;
    const centres = this.ships.map(({ track }) => {
      const position = new THREE.Vector3();
      track.at(moment, position, new THREE.Quaternion());
      return toWorld(position);
    });
    return { target, position: this.backOff(target, this.bestDirection(centres), this.ends()) };
  }

  /** The direction, raised by LOW, from which ships lie side by side in three-quarter view and the struck side shows. */
  bestDirection(centres) {
    const headings = this.ships.map(({ node }) => new THREE.Vector3(1, 0, 0).transformDirection(node.matrixWorld));
    const effect = this.data.effects[0];
    const outwards = new THREE.Vector3();
    if (effect) {
      const { track } = this.ships.find(({ info }) => info.name === effect.ship);
      const quaternion = new THREE.Quaternion();
      track.at(effect.time - this.data.start, new THREE.Vector3(), quaternion);
      toWorld(outwards.fromArray(effect.outwards).applyQuaternion(quaternion)).normalize();
    }
    let best = null;
    let highest = -Infinity;
    for (let i = 0; i < 24; i++) {
      const angle = (i / 24) * 2 * Math.PI;
      const from = new THREE.Vector3(Math.cos(angle), 0, Math.sin(angle));
      const side = new THREE.Vector3(-from.z, 0, from.x);
      let apart = 0;
      for (const a of centres) for (const b of centres) apart = Math.max(apart, Math.abs(a.clone().sub(b).normalize().dot(side)));
      // Sine of twice the angle to the keel: 1 where bow and side show alike.
      const threeQuarter = headings.reduce((sum, ahead) => sum + 2 * Math.abs(ahead.dot(from) * ahead.dot(side)), 0) / headings.length;
      const score = apart + 0.9 * Math.min(from.dot(outwards), 0.75) + 0.35 * threeQuarter;
      if (score > highest + 1e-9) {
        highest = score;
        best = from;
      }
    }
    return best.addScaledVector(UP, Math.tan(LOW)).normalize();
  }

  /** The nearest place from the target in a direction from which all points are in the picture. */
  backOff(target, direction, points) {
    const forward = direction.clone().negate();
    const right = new THREE.Vector3().crossVectors(forward, UP).normalize();
    const above = new THREE.Vector3().crossVectors(right, forward);
    const { tanX, tanY } = this.freeAngles();
    let distance = 60;
    for (const point of points) {
      const v = point.clone().sub(target);
      const depth = v.dot(forward);
      distance = Math.max(distance, Math.abs(v.dot(right)) / (FILLED * tanX) - depth, Math.abs(v.dot(above)) / (FILLED * tanY) - depth);
    }
    return target.clone().addScaledVector(direction, distance);
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

  isFarFrom(node, info, point) {
    return node.getWorldPosition(new THREE.Vector3()).distanceTo(point) > 2 * info.L_oa + 200;
  }

  /** How many of some places of an impact a hull or what stands on it hides from an eye; what is close to a place touches there. */
  countHidden(eye, places) {
    const solids = [], close = Math.max(1, 0.03 * this.lengthAt(places[0]));
    for (const { node, info } of this.ships) {
      if (this.isFarFrom(node, info, places[0])) continue;
      node.traverse((mesh) => {
        if (mesh.isMesh && mesh.material.isMeshStandardMaterial && mesh.userData.scratch === undefined) solids.push(mesh);
      });
    }
    return places.filter((place) => {
      const way = place.clone().sub(eye);
      const ray = new THREE.Raycaster(eye, way.clone().normalize(), 0, Math.max(0, way.length() - close));
      return ray.intersectObjects(solids, false).length > 0;
    }).length;
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

  /** Where an impact is seen, between deck and water, and a little below; the ships as they lie now. */
  placesOf(effect) {
    const { node, info } = this.ships.find((ship) => ship.info.name === effect.ship);
    const outwards = new THREE.Vector3(...effect.outwards).transformDirection(node.matrixWorld).setY(0).normalize();
    const point = node.localToWorld(new THREE.Vector3(...effect.point)).addScaledVector(outwards, 0.4);
    point.setY(Math.min(Math.max(point.y, 0.3 * info.height), 0.45 * info.height + 1));
    return [point, point.clone().setY(0.75 * point.y)];
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

  /**
   * Where an impact is best seen from: low, in three-quarter view, with much of both ships, never within a ship, and
   * with no hull before its place. Directions are sorted by all but the last, which takes long, and tried one after the other.
   */
  viewOfImpact(effect, time) {
    const begins = Math.max(this.data.start, time, effect.time);
    const offset = this.posedAt(begins, () => {
      const tried = this.rankViews(effect);
      const cost = (one) => MOMENTS.reduce((sum, later) => (sum >= BLOCKED ? sum : sum + this.posedAt(begins + later, () => {
        const places = this.placesOf(effect), eye = places[0].clone().add(one.offset);
        return this.isWithin(eye) ? BLOCKED : this.countHidden(eye, places);
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
  rankViews(effect) {
    const { node } = this.ships.find(({ info }) => info.name === effect.ship);
    const outwards = new THREE.Vector3(...effect.outwards).transformDirection(node.matrixWorld).setY(0).normalize();
    const target = this.placesOf(effect)[0];
    const { tanX, tanY } = this.freeAngles(), length = this.lengthAt(target);
    const near = this.shipsAt(target), across = near.length > 1 ? AROUND.two : AROUND.one;
    const distance = Math.max(25, (across * length) / (2 * tanX), (AROUND.upright * length) / (2 * tanY));
    const tried = [];
    for (const rise of RISES) {
      for (let i = -17; i <= 17; i++) {
        const turn = (i * Math.PI) / 18;
        const offset = outwards.clone().applyAxisAngle(UP, turn).addScaledVector(UP, rise).setLength(distance);
        const seen = near.map((ship) => this.shareSeen(ship, target, target.clone().add(offset)));
        const score = 1.2 * Math.min(...seen) + 0.4 * Math.max(...seen) - 0.8 * Math.abs(Math.abs(turn) - BESIDE) - 3 * Math.max(0, Math.abs(turn) - OBLIQUE) - 3 * (rise - RISES[0]) + 1e-4 * i;
        tried.push({ offset, score });
      }
    }
    return tried.sort((a, b) => b.score - a.score);
  }

  /** Whether a place in the world is within a ship in plan, or beside it. */
  isWithin(place) {
    return this.isWithinAnother(null, place);
  }

  /** Whether a place in the world is within a ship other than `node` in plan, or beside it. */
  isWithinAnother(node, place) {
    return this.ships.some((ship) => {
      if (ship.node === node) return false;
      const { x, y } = ship.node.worldToLocal(place.clone());
      return Math.abs(x) < 0.55 * ship.info.L_oa && Math.abs(y) < 0.5 * ship.info.B + 4;
    });
  }

  /** Whether another ship takes the view of a point: not close to the point, for ships may touch there. */
  isAnotherInTheWay(node, point, eye) {
    return Array.from({ length: 30 }, (_, i) => eye.clone().lerp(point, i / 40)).some((place) => this.isWithinAnother(node, place));
  }

  closeUp(mode, time) {
    const target = this.anchor(mode, time);
    const out = new THREE.Vector3();
    if (mode === "impact") return { target, position: this.viewOfImpact(this.effectAt(time), time) };
    const { node, info } = this.ships[Number(mode.slice(5))];
    const distance = 1.5 * info.L_oa, height = 0.16;
    const sides = [[-1, 0.75], [-1, -0.75], [1, 0.75], [1, -0.75]].map(([along, across]) => new THREE.Vector3(along, across, 0).transformDirection(node.matrixWorld).setY(0).normalize());
    const isFree = (side) => !this.isAnotherInTheWay(node, target, target.clone().addScaledVector(side, distance));
    out.copy(sides.find(isFree) ?? sides[0]);
    out.y = 0;
    out.normalize().addScaledVector(UP, height).normalize();
    return { target, position: target.clone().addScaledVector(out, distance) };
  }
}
