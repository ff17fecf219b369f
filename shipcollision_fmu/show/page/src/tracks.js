// The ships' tracks. A track has `at(time, position, quaternion)`, which sets the pose in n, from the origin, at a time
// since the start; before the start a ship is on a straight course. A motion has `trackOf(node)` and `pose(time)`, which
// puts the nodes of the scene where they are at a time.
import * as THREE from "three";

/** From n (north, east, down) to the page's world (x north, y up, z east), in place. */
export const toWorld = (v) => v.set(v.x, -v.z, v.y);

/** A ship's track in the .glb's animation. */
export class ClipTrack {
  constructor(clip, node) {
    const of = (path) => clip.tracks.find((track) => track.name === `${node.name}.${path}`);
    this.positions = of("position").createInterpolant();
    this.rotations = of("quaternion").createInterpolant();
    const dt = Math.min(1, clip.duration);
    this.velocity = new THREE.Vector3(...this.positions.evaluate(dt));
    this.velocity.sub(new THREE.Vector3(...this.positions.evaluate(0))).divideScalar(dt);
  }

  at(time, position, quaternion) {
    position.fromArray(this.positions.evaluate(Math.max(0, time)));
    if (time < 0) position.addScaledVector(this.velocity, time);
    quaternion.fromArray(this.rotations.evaluate(Math.max(0, time)));
  }
}

/** The motion of a run that is over: the .glb's animation, whose time is set, not run. */
export function playClip(gltf) {
  const clip = gltf.animations[0];
  const mixer = new THREE.AnimationMixer(gltf.scene);
  const action = mixer.clipAction(clip);
  action.play();
  action.paused = true;
  return {
    trackOf: (node) => new ClipTrack(clip, node),
    pose(time) {
      action.time = Math.min(Math.max(time, 0), clip.duration);
      mixer.update(0);
    },
  };
}
