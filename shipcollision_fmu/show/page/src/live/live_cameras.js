// Cameras of the bridge: on the wheelhouse and its wings, where one looks around, behind the ship, and around it.
import * as THREE from "three";
import { Cameras } from "../cameras.js";

const UP = new THREE.Vector3(0, 1, 0);
const FIELD = 60; // of view on the bridge [deg]; on a narrow screen more, see field()
const OUTSIDE_FIELD = 38;
const BINOCULARS = 7; // magnification of a ship's 7 x 50
const WIDE = matchMedia("(min-width: 1201px)");
const ROOM = 0.12; // of the picture's width
const STATIONS = { bridge: 0, port: -1, starboard: 1 };
const LOOK = { bridge: [0, -0.12], port: [-0.12, -0.14], starboard: [0.12, -0.14] }; // yaw, pitch at first [rad]

export const MODES = ["bridge", "port", "starboard", "chase", "outside", "all"];

export class LiveCameras extends Cameras {
  constructor(canvas, ships, data, changed) {
    super(canvas, ships, data, changed);
    Object.assign(this, { own: 0, yaw: 0, pitch: 0, zoom: 1, changed });
    let last = null;
    canvas.addEventListener("pointerdown", ({ clientX, clientY }) => (last = [clientX, clientY]));
    window.addEventListener("pointerup", () => (last = null));
    window.addEventListener("pointermove", ({ clientX, clientY }) => {
      if (!last || !this.isAboard) return;
      const radians = (this.camera.fov * Math.PI) / 180 / canvas.clientHeight; // of a pixel
      this.turn((last[0] - clientX) * radians, (clientY - last[1]) * radians);
      last = [clientX, clientY];
    });
    canvas.addEventListener("wheel", (event) => {
      if (!this.isAboard) return;
      event.preventDefault();
      this.setZoom(this.zoom * Math.exp(-0.0015 * event.deltaY));
    }, { passive: false });
  }

  get choices() {
    return MODES.map((mode) => [mode, mode]);
  }

  get isAboard() {
    return this.mode in STATIONS;
  }

  get ship() {
    return this.ships[this.own];
  }

  /** Turns the head, [rad]. */
  turn(yaw, pitch) {
    this.yaw = (this.yaw + yaw) % (2 * Math.PI);
    this.pitch = Math.min(1.2, Math.max(-1.2, this.pitch + pitch));
    this.changed();
  }

  setZoom(zoom) {
    this.zoom = Math.min(15, Math.max(0.7, zoom));
    this.changed();
  }

  toggleBinoculars() {
    if (!this.isAboard) return;
    this.pitch = this.hasBinoculars ? LOOK[this.mode][1] : 0; // to the horizon, and back
    this.setZoom(this.hasBinoculars ? 1 : BINOCULARS);
  }

  get hasBinoculars() {
    return this.isAboard && this.zoom > 2;
  }

  resize(width, height) {
    this.size = [width, height];
    this.makeRoom();
    super.resize(width, height);
  }

  /** On a wide screen a chart covers the lower right: what is looked at from outside stands left of the middle. */
  makeRoom() {
    const [width, height] = this.size;
    if (!["chase", "outside"].includes(this.mode) || !WIDE.matches) this.camera.clearViewOffset();
    else this.camera.setViewOffset(width, height, ROOM * width, 0, width, height);
  }

  choose(mode, time) {
    this.controls.enabled = !(mode in STATIONS);
    this.zoom = 1;
    if (mode in STATIONS) {
      this.mode = mode;
      [this.yaw, this.pitch] = LOOK[mode];
      this.makeRoom();
      this.follow(time);
      return;
    }
    this.setField(OUTSIDE_FIELD);
    this.camera.up.copy(UP);
    super.choose(mode, time);
    this.makeRoom();
  }

  anchor(mode, time) {
    return mode === "chase" || mode === "outside" ? this.ship.node.getWorldPosition(new THREE.Vector3()) : super.anchor(mode, time);
  }

  closeUp(mode) {
    const { node, info } = this.ship;
    const target = this.anchor(mode);
    const direction = new THREE.Vector3(...(mode === "chase" ? [-1, 0, 0] : [0.75, 0.66, 0])).transformDirection(node.matrixWorld).setY(0).normalize();
    if (mode === "chase") target.addScaledVector(direction, -0.3 * info.L_oa);
    direction.addScaledVector(UP, mode === "chase" ? 0.2 : 0.16).normalize();
    return { target, position: target.clone().addScaledVector(direction, (mode === "chase" ? 1.6 : 1.5) * info.L_oa) };
  }

  follow(time) {
    if (!this.isAboard) {
      const before = this.heading;
      this.heading = this.headingOfShip();
      if (this.mode === "chase" && before !== undefined) this.swing(this.heading - before);
      return super.follow(time);
    }
    this.heading = this.headingOfShip();
    const { node, info } = this.ship;
    const side = STATIONS[this.mode];
    const [x, y, z] = info.bridge;
    this.camera.position.copy(node.localToWorld(new THREE.Vector3(x, side * y, z)));
    const look = ([yaw, pitch]) => new THREE.Vector3(Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), -Math.sin(pitch));
    const ahead = look([this.yaw, this.pitch]).transformDirection(node.matrixWorld);
    this.camera.up.set(0, 0, -1).transformDirection(node.matrixWorld);
    this.controls.target.copy(this.camera.position).addScaledVector(ahead, 250);
    this.camera.lookAt(this.controls.target);
    this.setField(this.fieldAboard());
  }

  headingOfShip() {
    const ahead = new THREE.Vector3(1, 0, 0).transformDirection(this.ship.node.matrixWorld);
    return Math.atan2(ahead.z, ahead.x);
  }

  /** Behind the ship when it turns: the camera goes around it. */
  swing(angle) {
    const offset = this.camera.position.clone().sub(this.controls.target).applyAxisAngle(UP, -angle);
    const from = this.anchor("chase");
    this.controls.target.sub(from).applyAxisAngle(UP, -angle).add(from);
    this.camera.position.copy(this.controls.target).add(offset);
  }

  /** Vertical field of view [deg]: on an upright screen one sees as far to the sides as on a square one. */
  fieldAboard() {
    const half = Math.tan((FIELD * Math.PI) / 360) / Math.min(1, this.camera.aspect) / this.zoom;
    return Math.min(75, (Math.atan(half) * 360) / Math.PI);
  }

  setField(degrees) {
    const near = this.isAboard ? 0.6 : this.camera.near;
    if (Math.abs(this.camera.fov - degrees) < 1e-6 && this.camera.near === near) return;
    Object.assign(this.camera, { fov: degrees, near });
    this.camera.updateProjectionMatrix();
  }
}
