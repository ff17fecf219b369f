// Triangles of several meshes as one list, and a list as one mesh: few draw calls for the plain picture.
import * as THREE from "three";
import { isPlated, isWall } from "./paint.js";

/** What light a paint has of its own at the first of some corners: see plain_paint.js. */
function kindOf({ material, geometry }, [corner]) {
  if (material.name === "windows") return geometry.attributes.aLit?.getX(corner) ?? 1;
  return isWall(material) ? 2 : isPlated(material) ? 3 : 0;
}

/** Colour of a surface that does not mirror anything: metal is darker without what it mirrors. */
function paintOf({ material }) {
  const { r, g, b } = material.color;
  return [r, g, b].map((value) => value * (1 - 0.5 * material.metalness));
}

const turnOver = (nine) => [...nine.slice(0, 3), ...nine.slice(6), ...nine.slice(3, 6)];

/**
 * Triangles in the frame of the meshes' owner: {corners: 9 numbers, normals: 9, paint: colour and kind,
 * shades: share of the light at each corner, last: when its last corner is drawn [s], if it has times, ids: of its corners}. Surfaces seen from both sides come twice.
 */
export function collectTriangles(meshes, owner) {
  const found = [], place = new THREE.Vector3();
  const inverse = owner.matrixWorld.clone().invert();
  let used = 0; // ids of corners
  for (const mesh of meshes) {
    const toOwner = mesh.parent === owner ? new THREE.Matrix4().compose(mesh.position, mesh.quaternion, new THREE.Vector3(1, 1, 1))
      : inverse.clone().multiply(mesh.matrixWorld);
    const { index, attributes } = mesh.geometry;
    const colour = paintOf(mesh);
    const turned = new THREE.Matrix3().getNormalMatrix(toOwner);
    for (let i = 0; i < index.count; i += 3) {
      const at = [0, 1, 2].map((k) => index.getX(i + k));
      const paint = [...colour, kindOf(mesh, at)];
      const corners = at.flatMap((k) => place.fromBufferAttribute(attributes.position, k).applyMatrix4(toOwner).toArray());
      const normals = at.flatMap((k) => place.fromBufferAttribute(attributes.normal, k).applyNormalMatrix(turned).toArray());
      const shades = at.map((k) => attributes.color?.getX(k) ?? 1);
      const last = attributes._time ? Math.max(...at.map((k) => attributes._time.getX(k))) : undefined;
      const ids = at.map((k) => used + 2 * k);
      found.push({ corners, normals, paint, shades, last, ids });
      if (mesh.material.side !== THREE.DoubleSide) continue;
      const [first, second, third] = ids.map((id) => id + 1);
      found.push({ corners: turnOver(corners), normals: turnOver(normals).map((x) => -x), paint, shades: [shades[0], shades[2], shades[1]], last, ids: [first, third, second] });
    }
    used += 2 * attributes.position.count;
  }
  return found;
}

/** A geometry of triangles in their order; corners with the same id are shared. */
export function joinTriangles(triangles) {
  const known = new Map(), places = [], normals = [], paints = [], index = [];
  for (const triangle of triangles) {
    for (let k = 0; k < 9; k += 3) {
      const id = triangle.ids[k / 3];
      if (!known.has(id)) {
        known.set(id, known.size);
        places.push(...triangle.corners.slice(k, k + 3));
        normals.push(...triangle.normals.slice(k, k + 3));
        const [r, g, b, kind] = triangle.paint, shade = triangle.shades[k / 3];
        paints.push(r * shade, g * shade, b * shade, kind);
      }
      index.push(known.get(id));
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  geometry.setAttribute("aPaint", new THREE.Float32BufferAttribute(paints, 4));
  return geometry.setIndex(index);
}

/** Least height of a triangle [m]: twice its area over its longest side. */
function widthOf(corners) {
  const [a, b, c] = [0, 3, 6].map((k) => new THREE.Vector3(...corners.slice(k, k + 3)));
  const longest = Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a));
  return longest > 0 ? b.clone().sub(a).cross(c.clone().sub(a)).length() / longest : 0;
}

/** Thickness [m] of the part that each triangle belongs to: the width of its widest triangle. A part's triangles share corners and paint. */
export function findThickness(triangles) {
  const parent = triangles.map((_, i) => i), at = new Map();
  const rootOf = (i) => {
    while (parent[i] !== i) i = parent[i] = parent[parent[i]];
    return i;
  };
  triangles.forEach(({ corners, paint }, i) => {
    for (let k = 0; k < 9; k += 3) {
      const key = [...corners.slice(k, k + 3), ...paint].map((x) => Math.round(100 * x)).join();
      if (at.has(key)) parent[rootOf(i)] = rootOf(at.get(key));
      else at.set(key, i);
    }
  });
  const widest = new Map();
  triangles.forEach(({ corners }, i) => widest.set(rootOf(i), Math.max(widest.get(rootOf(i)) ?? 0, widthOf(corners))));
  return triangles.map((_, i) => widest.get(rootOf(i)));
}
