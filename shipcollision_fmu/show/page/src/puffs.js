// Textures of what burns and smokes, made once for all effects: four puffs, and noise that repeats without a seam.
import * as THREE from "three";
import { randomNumbers } from "./random.js";

const PUFF = 128; // pixels of each of four
const NOISE = 128, CELLS = [8, 16]; // pixels of the noise, and waves across it: broad ones in red, fine ones in green

const ease = (x) => x * x * (3 - 2 * x);
const step = (from, to, x) => ease(Math.min(1, Math.max(0, (x - from) / (to - from))));

/** Smooth noise in [0, 1] that repeats after `cells` in each direction. */
function makeNoise(cells, random) {
  const lattice = Array.from({ length: cells * cells }, random);
  const at = (k, l) => lattice[cells * (((l % cells) + cells) % cells) + (((k % cells) + cells) % cells)];
  return (x, y) => {
    const [i, j] = [Math.floor(x), Math.floor(y)], [u, v] = [ease(x - i), ease(y - j)];
    return (at(i, j) * (1 - u) + at(i + 1, j) * u) * (1 - v) + (at(i, j + 1) * (1 - u) + at(i + 1, j + 1) * u) * v;
  };
}

function makeTexture(data, size, more) {
  const texture = new THREE.DataTexture(data, size, size, THREE.RGFormat);
  return Object.assign(texture, { magFilter: THREE.LinearFilter, minFilter: THREE.LinearMipmapLinearFilter, generateMipmaps: true, needsUpdate: true, ...more });
}

/** Four puffs, two by two: how dense they are (red), to nothing at the rim, and how much of their surface faces up (green). */
function makePuffs() {
  const noise = makeNoise(64, randomNumbers(11));
  const billows = (x, y) => 0.55 * noise(2.2 * x, 2.2 * y) + 0.3 * noise(4.9 * x, 4.9 * y + 20) + 0.15 * noise(10.7 * x + 7, 10.7 * y);
  const data = new Uint8Array(8 * PUFF * PUFF);
  for (let i = 0; i < 4 * PUFF * PUFF; i++) {
    const [column, row] = [i % (2 * PUFF), Math.floor(i / (2 * PUFF))];
    const [x, y] = [column, row].map((k) => (2 * ((k % PUFF) + 0.5)) / PUFF - 1);
    const which = 11 * Math.floor(column / PUFF) + 29 * Math.floor(row / PUFF);
    const [n, above] = [billows(x + which, y), billows(x + which, y + 0.12)];
    const r = Math.hypot(x, y);
    data[2 * i] = 255 * step(1.05, 0.05, r + 0.8 * (n - 0.5)) * step(0.97, 0.45, r);
    data[2 * i + 1] = 255 * Math.min(1, Math.max(0, 0.5 + 2.6 * (n - above)));
  }
  return makeTexture(data, 2 * PUFF, {});
}

function makeTurbulence() {
  const [broad, fine] = CELLS.map((cells) => [cells, makeNoise(cells, randomNumbers(cells))]);
  const data = Uint8Array.from({ length: 2 * NOISE * NOISE }, (_, i) => {
    const [cells, noise] = i % 2 ? fine : broad, pixel = Math.floor(i / 2);
    return 255 * noise((cells * (pixel % NOISE)) / NOISE, (cells * Math.floor(pixel / NOISE)) / NOISE);
  });
  return makeTexture(data, NOISE, { wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping });
}

let puffs = null, turbulence = null;

/** The four puffs. */
export const findPuffs = () => (puffs ??= makePuffs());
/** Noise without a seam. */
export const findTurbulence = () => (turbulence ??= makeTurbulence());
