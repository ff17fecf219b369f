// Where a hull meets the water, read off its meshes: what foam and shade on the sea follow.
import * as THREE from "three";

const STATIONS = 36;

/** Half breadths to port and starboard over stations from stern to bow, in the ship's b: {x, port, starboard} [m]. */
export function findWaterline({ node, info }) {
  const crossings = [];
  const toShip = new THREE.Matrix4(), corners = [0, 1, 2].map(() => new THREE.Vector3());
  node.updateWorldMatrix(true, true);
  const inverse = node.matrixWorld.clone().invert();
  node.traverse((mesh) => {
    if (!mesh.isMesh || !mesh.geometry.index || mesh.userData.scratch !== undefined) return;
    toShip.multiplyMatrices(inverse, mesh.matrixWorld);
    const { index, attributes } = mesh.geometry;
    for (let i = 0; i < index.count; i += 3) {
      corners.forEach((corner, k) => corner.fromBufferAttribute(attributes.position, index.getX(i + k)).applyMatrix4(toShip));
      for (let k = 0; k < 3; k++) { // two edges of a triangle cross the water, or none: a piece of the waterline
        const a = corners[k], b = corners[(k + 1) % 3];
        if (a.z < 0 !== b.z < 0) crossings.push(a.clone().lerp(b, a.z / (a.z - b.z)));
      }
    }
  });
  if (crossings.length < 4) { // nothing crosses the water: the main dimensions stand in
    crossings.push(...[-1, 1].flatMap((j) => [-1, 1].map((i) => new THREE.Vector3(0.48 * i * info.L_oa, 0.5 * j * info.B, 0))));
  }
  const aft = Math.min(...crossings.map(({ x }) => x)), fore = Math.max(...crossings.map(({ x }) => x));
  const x = Array.from({ length: STATIONS }, (_, i) => aft + ((fore - aft) * (1 - Math.cos((Math.PI * i) / (STATIONS - 1)))) / 2);
  return { x, port: x.map((at) => reach(crossings, at, -1)), starboard: x.map((at) => reach(crossings, at, 1)) };
}

/** How far the crossings reach to a side at a station: of the pieces of the waterline there, the outermost. */
function reach(crossings, at, side) {
  let widest = 0;
  for (let i = 0; i < crossings.length; i += 2) {
    const [a, b] = crossings[i].x < crossings[i + 1].x ? [crossings[i], crossings[i + 1]] : [crossings[i + 1], crossings[i]];
    if (at < a.x - 1e-3 || at > b.x + 1e-3) continue;
    const isAcross = b.x - a.x < 1e-6, share = isAcross ? 0 : Math.min(1, Math.max(0, (at - a.x) / (b.x - a.x)));
    widest = Math.max(widest, side * (a.y + share * (b.y - a.y)), isAcross ? side * b.y : 0);
  }
  return widest;
}
