// Ships and whatever stands beside them, for the plain picture: two meshes each. What is above the water is sorted by how
// thick it is: parts thinner than half a pixel, such as railings far away, are left out, and do not flicker either. What is
// below is sorted by its depth: only what the ship lifts out of the water is drawn.
import * as THREE from "three";
import { findFloods } from "./paint.js";
import { makePaint } from "./plain_paint.js";
import { collectTriangles, findThickness, joinTriangles } from "./triangles.js";

const THIN = 0.4; // of a pixel: parts that are thinner are not drawn
const DEEP = 1.5; // [m] below the water, where waves and foam hide everything

/** A mesh of triangles sorted by a key, falling; `show(least)` draws those whose key is at least that. */
function makeSorted(triangles, keys, material) {
  const order = triangles.map((_, i) => i).sort((a, b) => keys[b] - keys[a] || a - b);
  const sorted = order.map((i) => keys[i]);
  const mesh = new THREE.Mesh(joinTriangles(order.map((i) => triangles[i])), material);
  return {
    mesh,
    show(least) {
      const end = sorted.findIndex((key) => key < least);
      mesh.geometry.setDrawRange(0, end < 0 ? Infinity : 3 * end);
    },
  };
}

/** How far a ship is lifted out of the water at most [m]: by heave, roll and pitch. */
function liftOf(node, { L_oa, B }) {
  const { x, y, z, w } = node.quaternion;
  const [pitch, roll] = [2 * (x * z - w * y), 2 * (y * z + w * x)].map(Math.abs); // sines, of R_nb's last row
  return Math.max(0, -node.position.z) + 0.5 * (L_oa * pitch + B * roll);
}

function makePlainShip(meshes, owner, info, material) {
  const triangles = collectTriangles(meshes, owner);
  const depth = triangles.map(({ corners }) => (info ? Math.min(corners[2], corners[5], corners[8]) : -Infinity)); // of the highest corner
  const [above, below] = [false, true].map((isBelow) => triangles.map((_, i) => i).filter((i) => depth[i] > DEEP === isBelow));
  const of = (chosen) => chosen.map((i) => triangles[i]);
  const upper = makeSorted(of(above), findThickness(of(above)), material);
  const lower = makeSorted(of(below), below.map((i) => -depth[i]), material);
  const middle = new THREE.Vector3();
  return {
    meshes: [upper.mesh, lower.mesh],
    update(camera, pixels) {
      if (!info) return;
      const distance = Math.max(1, camera.position.distanceTo(owner.getWorldPosition(middle)) - 0.5 * info.L_oa);
      upper.show((THIN * 2 * Math.tan((camera.fov * Math.PI) / 360) * distance) / pixels);
      lower.show(-DEEP - liftOf(owner, info));
    },
  };
}

/**
 * The plain ships in place of the meshes under `root`: {setPlain(isPlain), update(camera, pixels)}, `pixels` the picture's
 * height. `ships`: [{node, info}]; what belongs to none, such as a quay, is drawn whole.
 */
export function makePlainShips(root, ships) {
  const replaced = [];
  let plain = null;

  function ownerOf(mesh) {
    let node = mesh;
    while (node && !ships.some((ship) => ship.node === node)) node = node.parent;
    return node ?? root;
  }

  function make() {
    root.updateMatrixWorld(true);
    const byOwner = new Map();
    root.traverse((mesh) => {
      if (!mesh.isMesh || !mesh.material.isMeshStandardMaterial || mesh.userData.scratch !== undefined) return;
      replaced.push(mesh);
      const owner = ownerOf(mesh);
      byOwner.set(owner, [...(byOwner.get(owner) ?? []), mesh]);
    });
    return [...byOwner].map(([owner, meshes]) => {
      const made = makePlainShip(meshes, owner, ships.find(({ node }) => node === owner)?.info, makePaint(0, {}, findFloods(meshes)));
      owner.add(...made.meshes);
      return made;
    });
  }

  return {
    setPlain(isPlain) {
      if (isPlain) plain ??= make();
      for (const mesh of replaced) mesh.visible = !isPlain;
      for (const { meshes } of plain ?? []) for (const mesh of meshes) mesh.visible = isPlain;
    },
    update(camera, pixels) {
      for (const one of plain ?? []) one.update(camera, pixels);
    },
  };
}
