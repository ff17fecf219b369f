// Where the camera looks: at everything, along with a ship, at the impact, or wherever it is turned to.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { toWorld } from "./tracks.js";

const UP = new THREE.Vector3(0, 1, 0);

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
      const { node } = this.ships.find(({ info }) => info.name === effect.ship);
      return node.localToWorld(new THREE.Vector3(...effect.point));
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

  /** The latest explosion, or the first one if there has been none. */
  effectAt(time) {
    const explosions = this.data.effects.filter(({ kind }) => kind === "explosion");
    return explosions.filter((effect) => effect.time <= time).at(-1) ?? explosions[0];
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
    const distance = this.camera.position.distanceTo(this.controls.target);
    const near = Math.max(0.4, 0.03 * distance);
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

  /** The horizontal direction, raised by 17 deg, from which ships lie side by side and the struck side shows. */
  bestDirection(centres) {
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
      const score = apart + 0.9 * Math.min(from.dot(outwards), 0.75);
      if (score > highest + 1e-9) {
        highest = score;
        best = from;
      }
    }
    return best.addScaledVector(UP, Math.tan((17 * Math.PI) / 180)).normalize();
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

  /** From outside the struck side, across the ship that strikes rather than along her. */
  clearOf(effect, node, point) {
    const outwards = new THREE.Vector3(...effect.outwards).transformDirection(node.matrixWorld);
    const scratch = this.data.scratches.find(({ id, ship }) => id === effect.scratch && ship === effect.ship);
    const other = this.ships.find(({ info }) => info.name === scratch?.other);
    const towards = other ? other.node.getWorldPosition(new THREE.Vector3()).sub(point).setY(0).normalize() : null;
    const turned = [-1.0, 1.0].map((angle) => outwards.clone().applyAxisAngle(UP, angle));
    return towards && turned[1].dot(towards) < turned[0].dot(towards) ? turned[1] : turned[0];
  }

  closeUp(mode, time) {
    const target = this.anchor(mode, time);
    const out = new THREE.Vector3();
    let distance;
    if (mode === "impact") {
      const effect = this.effectAt(time);
      const { node, info } = this.ships.find((ship) => ship.info.name === effect.ship);
      out.copy(this.clearOf(effect, node, target));
      distance = Math.max(60, 0.85 * info.L_oa);
    } else {
      const { node, info } = this.ships[Number(mode.slice(5))];
      out.set(-1, 0.75, 0).transformDirection(node.matrixWorld);
      distance = 1.7 * info.L_oa;
    }
    out.y = 0;
    out.normalize().addScaledVector(UP, 0.32).normalize();
    return { target, position: target.clone().addScaledVector(out, distance) };
  }
}
