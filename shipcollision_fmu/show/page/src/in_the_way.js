// What ships hide from an eye: in plan, where it is found at once, and by rays, which take long. `ships` are {node, info},
// posed as they lie.
import * as THREE from "three";

/** Whether a place in the world is within a ship in plan, or beside it. */
export function isWithin(ships, place) {
  return isWithinAnother(ships, null, place);
}

/** Whether a place in the world is within a ship other than `node` in plan, or beside it. */
export function isWithinAnother(ships, node, place) {
  return ships.some((ship) => {
    if (ship.node === node) return false;
    const { x, y } = ship.node.worldToLocal(place.clone());
    return Math.abs(x) < 0.55 * ship.info.L_oa && Math.abs(y) < 0.5 * ship.info.B + 4;
  });
}

/** Whether another ship takes the view of a point: not close to the point, for ships may touch there. */
export function isAnotherInTheWay(ships, node, point, eye) {
  return Array.from({ length: 30 }, (_, i) => eye.clone().lerp(point, i / 40)).some((place) => isWithinAnother(ships, node, place));
}

/** How many of some places of an impact a hull or what stands on it hides from an eye; what is `close` [m] to a place touches there. */
export function countHidden(ships, eye, places, close) {
  const solids = [];
  for (const ship of ships) {
    if (isFarFrom(ship, places[0])) continue;
    ship.node.traverse((mesh) => {
      if (mesh.isMesh && mesh.material.isMeshStandardMaterial && mesh.userData.scratch === undefined) solids.push(mesh);
    });
  }
  return places.filter((place) => {
    const way = place.clone().sub(eye);
    const ray = new THREE.Raycaster(eye, way.clone().normalize(), 0, Math.max(0, way.length() - close));
    return ray.intersectObjects(solids, false).length > 0;
  }).length;
}

function isFarFrom({ node, info }, point) {
  return node.getWorldPosition(new THREE.Vector3()).distanceTo(point) > 2 * info.L_oa + 200;
}
