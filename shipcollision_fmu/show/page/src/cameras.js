// Where the camera looks: at everything, along with a ship, at the impact, or wherever it is turned to.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { toWorld } from "./tracks.js";

const UP = new THREE.Vector3(0, 1, 0);
const LOW = (4.6 * Math.PI) / 180; // elevation of the first view: from a launch, with sky over the ships
const CLOSE = 0.12; // and of the view of an impact [rad]
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
      const effect = this.effectAt(time);
      const { node, info } = this.ships.find((ship) => ship.info.name === effect.ship);
      const point = node.localToWorld(new THREE.Vector3(...effect.point));
      return point.setY(Math.min(Math.max(point.y, 0.3 * info.height), 0.45 * info.height + 1)); // what opens is between deck and water
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

  /** The latest impact that throws up dust, or the first one if there has been none. */
  effectAt(time) {
    const impacts = this.data.effects.filter(({ kind }) => kind === "dust");
    const known = impacts.length ? impacts : this.data.effects;
    return known.filter((effect) => effect.time <= time).at(-1) ?? known[0];
  }

  choose(mode, time) {
    this.mode = mode;
    this.moved = false;
    if (mode === "free") return;
    const at = mode === "all" ? this.overview(time) : this.closeUp(mode, time);
    this.controls.target.copy(at.target);
    this.camera.position.copy(at.position);
    this.last = this.anchor(mode, time);
    this.lastSpan = this.fleet().span;
    this.controls.update();
  }

  /** Moves with what is followed; the user's turning and zooming stay. */
  follow(time) {
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
    if (this.mode === "all" && this.last && !this.moved) this.fitAgain();
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
    const tanY = Math.tan((this.camera.fov * Math.PI) / 360) * 0.72;
    const tanX = Math.tan((this.camera.fov * Math.PI) / 360) * this.camera.aspect * 0.86;
    let distance = 60;
    for (const point of points) {
      const v = point.clone().sub(target);
      const depth = v.dot(forward);
      distance = Math.max(distance, Math.abs(v.dot(right)) / tanX - depth, Math.abs(v.dot(above)) / tanY - depth);
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

  /** How many of some points in the world a hull or what stands on it hides from an eye. */
  countHidden(eye, points) {
    const solids = [];
    for (const { node, info } of this.ships) {
      if (this.isFarFrom(node, info, points[0])) continue;
      node.traverse((mesh) => {
        if (mesh.isMesh && mesh.material.isMeshStandardMaterial && mesh.userData.scratch === undefined) solids.push(mesh);
      });
    }
    return points.filter((point) => {
      const way = point.clone().sub(eye);
      const ray = new THREE.Raycaster(eye, way.clone().normalize(), 0, way.length() - 0.2);
      return ray.intersectObjects(solids, false).length > 0;
    }).length;
  }

  /** The direction from a place of impact in which the opened side is seen best: low, if no ship stands in the way. */
  openSide(effect, struck, distance) {
    const tried = [];
    for (const rise of [CLOSE, 0.22]) {
      for (let i = -9; i <= 9; i++) {
        tried.push({ turn: 0.16 * i, rise, score: -Math.abs(Math.abs(0.16 * i) - 0.75) - 6 * (rise - CLOSE) - (Math.abs(i) > 7 ? 5 : 0) + 1e-3 * i });
      }
    }
    const outwards = new THREE.Vector3();
    for (const later of [0.05, 0.6, 3]) {
      this.posedAt(Math.max(this.data.start, effect.time + later), () => {
        outwards.set(...effect.outwards).transformDirection(struck.node.matrixWorld).setY(0).normalize();
        const point = struck.node.localToWorld(new THREE.Vector3(...effect.point)).addScaledVector(outwards, 0.4);
        point.setY(Math.max(point.y, 0.3 * struck.info.height));
        const low = point.clone().setY(0.5 * point.y);
        for (const one of tried) {
          const eye = low.clone().addScaledVector(outwards.clone().applyAxisAngle(UP, one.turn), distance).setY(low.y + one.rise * distance);
          one.score -= this.countHidden(eye, [point, low]) + (this.isWithinAnother(struck.node, eye) ? 3 : 0); // from within, walls do not hide
        }
      });
    }
    const { turn, rise } = tried.reduce((a, b) => (b.score > a.score ? b : a));
    outwards.set(...effect.outwards).transformDirection(struck.node.matrixWorld).setY(0).normalize();
    return { from: outwards.applyAxisAngle(UP, turn), rise };
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
    let distance, height = 0.32;
    if (mode === "impact") {
      const effect = this.effectAt(time);
      const struck = this.ships.find(({ info }) => info.name === effect.ship);
      distance = Math.min(170, Math.max(25, 0.52 * struck.info.L_oa));
      const { from, rise } = this.openSide(effect, struck, distance);
      out.copy(from);
      height = rise;
    } else {
      const { node, info } = this.ships[Number(mode.slice(5))];
      distance = 1.5 * info.L_oa;
      height = 0.16;
      const sides = [[-1, 0.75], [-1, -0.75], [1, 0.75], [1, -0.75]].map(([along, across]) => new THREE.Vector3(along, across, 0).transformDirection(node.matrixWorld).setY(0).normalize());
      const isFree = (side) => !this.isAnotherInTheWay(node, target, target.clone().addScaledVector(side, distance));
      out.copy(sides.find(isFree) ?? sides[0]);
    }
    out.y = 0;
    out.normalize().addScaledVector(UP, height).normalize();
    return { target, position: target.clone().addScaledVector(out, distance) };
  }
}
