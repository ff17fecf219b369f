// The ships of another run in the picture: as outlines, on the same clock.
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { playClip, toWorld } from "./tracks.js";

const SHARP = 35; // [deg] edges between faces that differ by more are drawn
const FAINT = 0.16; // opacity of the faces

/**
 * The ships of the run in a .glb as outlines: {node, move(time), positions(), trackOf(name)}, time in s since the run's start.
 * `origin` [m] in n is that of the picture; positions of trackOf are from it.
 */
export async function makeGhosts(glb, data, origin) {
  const gltf = await new GLTFLoader().parseAsync(glb, "");
  const offset = data.origin.map((x, i) => x - origin[i]);
  const motion = playClip(gltf);
  const nodes = new Map();
  const solid = [], others = [];
  gltf.scene.traverse((node) => {
    if (node.userData.ship !== undefined) nodes.set(node.userData.ship, node);
    if (node.userData.obstacle !== undefined || node.userData.scratch !== undefined || node.userData.light !== undefined) others.push(node);
    else if (node.isMesh) solid.push(node);
  });
  for (const node of others) node.removeFromParent();
  for (const [name, ship] of nodes) {
    const { colour } = data.ships.find((known) => known.name === name);
    const light = new THREE.Color(colour).lerp(new THREE.Color("white"), 0.55);
    const face = new THREE.MeshBasicMaterial({ color: light, transparent: true, opacity: FAINT, depthWrite: false });
    const edge = new THREE.LineBasicMaterial({ color: light });
    for (const mesh of solid.filter((one) => isBelow(one, ship))) {
      mesh.material = face;
      mesh.castShadow = mesh.receiveShadow = false;
      mesh.add(new THREE.LineSegments(new THREE.EdgesGeometry(mesh.geometry, SHARP), edge));
    }
  }
  gltf.scene.position.copy(toWorld(new THREE.Vector3(...offset)));
  return {
    node: gltf.scene,
    move: (time) => motion.pose(time),
    /** Position in n [m] of each ship as it is drawn. */
    positions() {
      return Object.fromEntries([...nodes].map(([name, node]) => {
        const { x, y, z } = node.getWorldPosition(new THREE.Vector3());
        return [name, [x, z, -y].map((value, i) => value + origin[i])];
      }));
    },
    trackOf(name) {
      const track = motion.trackOf(nodes.get(name));
      return {
        at(time, position, quaternion) {
          track.at(time, position, quaternion);
          position.add(new THREE.Vector3(...offset));
        },
      };
    },
  };
}

function isBelow(node, ancestor) {
  for (let one = node; one; one = one.parent) if (one === ancestor) return true;
  return false;
}
