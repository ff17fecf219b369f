// The ships of the picture, moved by the states of a simulation that runs.
import * as THREE from "three";

const order = new THREE.Euler();

/** Quaternion of R_nb from roll, pitch and yaw: R = Rz(yaw) Ry(pitch) Rx(roll). */
const setAttitude = (quaternion, [roll, pitch, yaw]) => quaternion.setFromEuler(order.set(roll, pitch, yaw, "ZYX"));

class HistoryTrack {
  constructor(history, origin) {
    Object.assign(this, { history, origin });
  }

  at(time, position, quaternion) {
    const eta = this.history.at(time);
    position.set(eta[0] - this.origin[0], eta[1] - this.origin[1], eta[2] - this.origin[2]);
    setAttitude(quaternion, eta.slice(3));
  }
}

/** Makes the motion of the scene (tracks.js) from `histories`: ship -> History. */
export const followHistories = (histories) => (gltf) => {
  const { origin } = gltf.scene.userData;
  const moved = [];
  return {
    trackOf(node) {
      const track = new HistoryTrack(histories[node.userData.ship], origin);
      moved.push({ node, track });
      return track;
    },
    pose(time) {
      for (const { node, track } of moved) track.at(time, node.position, node.quaternion);
    },
  };
};
