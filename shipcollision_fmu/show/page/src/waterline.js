// Where a ship's hull meets the water, read off its meshes: what foam, shade and waves on the sea follow.
import * as THREE from "three";
import { crossWater, traceOutline } from "./outline.js";

/** Half breadths to port and starboard over stations from stern to bow, in the ship's b: {x, port, starboard} [m]. */
export function findWaterline({ node, info }) {
  const crossings = [];
  const toShip = new THREE.Matrix4(), corner = new THREE.Vector3();
  node.updateWorldMatrix(true, true);
  const inverse = node.matrixWorld.clone().invert();
  node.traverse((mesh) => {
    if (!mesh.isMesh || !mesh.geometry.index || mesh.userData.scratch !== undefined) return;
    toShip.multiplyMatrices(inverse, mesh.matrixWorld);
    const { index, attributes } = mesh.geometry;
    const at = (i) => corner.fromBufferAttribute(attributes.position, index.getX(i)).applyMatrix4(toShip).toArray();
    for (let i = 0; i < index.count; i += 3) crossWater([at(i), at(i + 1), at(i + 2)], crossings);
  });
  if (crossings.length < 4) { // nothing crosses the water: the main dimensions stand in
    crossings.push(...[-1, 1].flatMap((j) => [-1, 1].map((i) => [0.48 * i * info.L_oa, 0.5 * j * info.B])));
  }
  return traceOutline(crossings);
}
