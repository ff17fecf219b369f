// The ships' tracks, read off the .glb's animation: the pose at any time, before the start on a straight course.
import * as THREE from "three";

/** From n (north, east, down) to the page's world (x north, y up, z east), in place. */
export const toWorld = (v) => v.set(v.x, -v.z, v.y);

export class Track {
  constructor(clip, node) {
    const of = (path) => clip.tracks.find((track) => track.name === `${node.name}.${path}`);
    this.positions = of("position").createInterpolant();
    this.rotations = of("quaternion").createInterpolant();
    const dt = Math.min(1, clip.duration);
    this.velocity = new THREE.Vector3(...this.positions.evaluate(dt));
    this.velocity.sub(new THREE.Vector3(...this.positions.evaluate(0))).divideScalar(dt);
  }

  /** Position and quaternion in n from the origin at a time since the start. */
  at(time, position, quaternion) {
    position.fromArray(this.positions.evaluate(Math.max(0, time)));
    if (time < 0) position.addScaledVector(this.velocity, time);
    quaternion.fromArray(this.rotations.evaluate(Math.max(0, time)));
  }
}
