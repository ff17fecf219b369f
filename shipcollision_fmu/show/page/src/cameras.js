// Where the camera looks: at everything, along with a ship, at the impact, or wherever it is turned to.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { measureFreeRectangle } from "./free_rectangle.js";
import { ImpactView } from "./impact_view.js";
import { isAnotherInTheWay } from "./in_the_way.js";
import { toWorld } from "./tracks.js";

const UP = new THREE.Vector3(0, 1, 0);
const LOW = (4.6 * Math.PI) / 180; // elevation of the first view: from a launch, with sky over the ships
const FILLED = 0.94; // of the free part of the picture, by all ships
const NEAREST = 60; // [m] from the middle of the ships
const ROUNDS = 6; // until both edges are as near as each other
const CHECK = 0.5, PATIENCE = 4; // [s] of the run: between two looks whether the view is still free, and between two new views
const CREST = 1.2; // the highest wave that sea.js draws [m]
const LOWEST = 2; // height of the eye [m]

export class Cameras {
  constructor(canvas, ships, data, changed) {
    this.ships = ships; // [{node, info, track}], poses current
    this.data = data;
    this.impact = new ImpactView(ships, data, () => this.freeAngles());
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
      return this.impact.placesOf(this.impact.effectAt(time))[0];
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

  /** How many places of the latest impact a hull hides now. */
  hidden(time) {
    return this.impact.hidden(this.camera.position, time);
  }

  /** A new view of the impact where a ship has come between it and the eye. */
  clearTheView(time) {
    if (this.mode !== "impact" || this.moved || Math.abs(time - this.checked) < CHECK) return;
    this.checked = time;
    if (Math.abs(time - this.chosen) < PATIENCE && time >= this.chosen) return;
    if (this.impact.isOver(this.chosen, time)) return this.choose("impact", time);
    if (!this.impact.mayBeHidden(this.camera.position, time)) return; // rays take long
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
    if (this.mode === "all" && !this.moved) {
      this.fitAgain(); // ships that part or meet fill the picture as before
    } else if (this.mode === "all") {
      const { span } = this.fleet(); // as much nearer or farther as the ships
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

  /** The overview where ships have moved, or in a picture of another shape: all ships fill it again, seen from the same direction. */
  fitAgain() {
    const { middle, span } = this.fleet();
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    const { target, position } = this.frame(middle, direction, this.ends());
    this.controls.target.copy(target);
    this.camera.position.copy(position);
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
    return this.frame(target, this.bestDirection(centres), this.ends());
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

  /** The nearest view in a direction that has all points in the picture, as far from its left edge as from its right: {target, position}. */
  frame(near, direction, points) {
    const forward = direction.clone().negate();
    const right = new THREE.Vector3().crossVectors(forward, UP).normalize();
    const above = new THREE.Vector3().crossVectors(right, forward);
    const { tanX, tanY } = this.freeAngles();
    const target = near.clone();
    let distance = NEAREST;
    for (let round = 0; round < ROUNDS; round++) {
      const places = points.map((point) => point.clone().sub(target)).map((v) => [v.dot(right), v.dot(above), v.dot(forward)]);
      if (round) { // what is near fills more of the picture than what is far
        const across = places.map(([x, , depth]) => x / (distance + depth));
        target.addScaledVector(right, 0.5 * distance * (Math.min(...across) + Math.max(...across)));
      }
      distance = Math.max(NEAREST, ...places.map(([x, y, depth]) => Math.max(Math.abs(x) / (FILLED * tanX), Math.abs(y) / (FILLED * tanY)) - depth));
    }
    return { target, position: target.clone().addScaledVector(direction, distance) };
  }

  closeUp(mode, time) {
    const target = this.anchor(mode, time);
    const out = new THREE.Vector3();
    if (mode === "impact") return { target, position: this.impact.find(this.impact.effectAt(time), time) };
    const { node, info } = this.ships[Number(mode.slice(5))];
    const distance = 1.5 * info.L_oa, height = 0.16;
    const sides = [[-1, 0.75], [-1, -0.75], [1, 0.75], [1, -0.75]].map(([along, across]) => new THREE.Vector3(along, across, 0).transformDirection(node.matrixWorld).setY(0).normalize());
    const isFree = (side) => !isAnotherInTheWay(this.ships, node, target, target.clone().addScaledVector(side, distance));
    out.copy(sides.find(isFree) ?? sides[0]);
    out.y = 0;
    out.normalize().addScaledVector(UP, height).normalize();
    return { target, position: target.clone().addScaledVector(out, distance) };
  }
}
