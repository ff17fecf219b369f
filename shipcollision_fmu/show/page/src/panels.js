// Flat rectangular pieces of a ship's parts: windows, and the faces of containers. Each corner gets its place on its piece,
// so that a shader can draw frames, doors and corrugation there; and each piece a number, so that no two look the same.

export const BRIDGE = 1.6; // [m] longer panes are those of a bridge

/** A number from 0 to 1 of a place [m], the same for places within a decimetre. */
export function hashOf(x, y, z) {
  let state = 17;
  for (const value of [x, y, z]) state = Math.imul(state ^ Math.round(10 * value), 0x9e3779b1) ^ (state >>> 15);
  state = Math.imul(state ^ (state >>> 13), 0x85ebca6b);
  return ((state ^ (state >>> 16)) >>> 0) / 4294967296;
}

/** How brightly a window is lit at night, 0 to 1, by its number and length [m]: cabins as it happens, a bridge hardly. */
export function litOf(number, length) {
  if (length > BRIDGE) return 0.10;
  return number < 0.42 ? 0.03 : 0.35 + 0.65 * ((number * 7.31) % 1);
}

/** The pieces of `count` corners, each a list of corners: triangles (three of `index` each) that share corners hang together. */
export function findPieces(index, count) {
  const parent = Array.from({ length: count }, (_, i) => i), pieces = new Map();
  const rootOf = (i) => {
    while (parent[i] !== i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (let i = 0; i < index.length; i += 3) for (const k of [1, 2]) parent[rootOf(index[i + k])] = rootOf(index[i]);
  for (let i = 0; i < count; i++) {
    const root = rootOf(i);
    if (!pieces.has(root)) pieces.set(root, []);
    pieces.get(root).push(i);
  }
  return [...pieces.values()];
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/**
 * Of the corners of plane pieces, places and normals three numbers each: `panel` (along, up, length, height) [m], from the
 * lower corner at the left as seen from outside, and `number`, 0 to 1, of the piece. On level pieces up is to port.
 */
export function measurePanels(index, places, normals) {
  const count = places.length / 3, panel = new Float32Array(4 * count), number = new Float32Array(count);
  const at = (list, i) => [list[3 * i], list[3 * i + 1], list[3 * i + 2]];
  for (const piece of findPieces(index, count)) {
    const n = at(normals, piece[0]), isLevel = Math.abs(n[2]) > 0.7, level = Math.hypot(n[0], n[1]);
    const along = isLevel ? [1, 0, 0] : [n[1] / level, -n[0] / level, 0];
    const up = isLevel ? [0, -1, 0] : [0, 0, -1];
    const corners = piece.map((i) => [along, up].map((axis) => dot(at(places, i), axis)));
    const [low, high] = [Math.min, Math.max].map((of) => [0, 1].map((k) => of(...corners.map((corner) => corner[k]))));
    const middle = [0, 1, 2].map((k) => piece.reduce((sum, i) => sum + places[3 * i + k], 0) / piece.length);
    piece.forEach((i, k) => {
      panel.set([corners[k][0] - low[0], corners[k][1] - low[1], high[0] - low[0], high[1] - low[1]], 4 * i);
      number[i] = hashOf(...middle);
    });
  }
  return { panel, number };
}
