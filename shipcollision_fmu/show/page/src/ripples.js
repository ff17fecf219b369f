// Small waves as one texture that repeats: slopes, height and a lace of foam. Summed here from waves of random phase,
// which fit the tile, so that nothing is read from a file. The sea lays it over itself several times.
import * as THREE from "three";
import { randomNumbers } from "./random.js";

const SIZE = 256;
export const STEEPEST = 3.5; // slopes are kept up to this many times their root mean square

/** Sum of waves over the tile: slopes [sx, sz] and height, each Float32Array of SIZE x SIZE, of no unit. */
function sumWaves(random, count, shortest, longest, falloff, isDirected) {
  const height = new Float32Array(SIZE * SIZE), sx = new Float32Array(SIZE * SIZE), sz = new Float32Array(SIZE * SIZE);
  const [cu, su, cv, sv] = Array.from({ length: 4 }, () => new Float32Array(SIZE));
  for (let i = 0; i < count; i++) {
    const k = longest * (shortest / longest) ** ((i + random()) / count);
    const angle = isDirected ? 0.35 + 1.1 * (random() + random() + random() - 1.5) : 2 * Math.PI * random();
    const kx = Math.round(k * Math.cos(angle)), kz = Math.round(k * Math.sin(angle));
    const size = Math.hypot(kx, kz);
    const phase = 2 * Math.PI * random();
    if (!size) continue;
    const amplitude = size ** -falloff;
    for (let n = 0; n < SIZE; n++) {
      const a = (2 * Math.PI * kx * n) / SIZE + phase, b = (2 * Math.PI * kz * n) / SIZE;
      cu[n] = amplitude * Math.cos(a);
      su[n] = amplitude * Math.sin(a);
      cv[n] = Math.cos(b);
      sv[n] = Math.sin(b);
    }
    for (let z = 0, at = 0; z < SIZE; z++) {
      for (let x = 0; x < SIZE; x++, at++) {
        const cosine = cu[x] * cv[z] - su[x] * sv[z], sine = su[x] * cv[z] + cu[x] * sv[z];
        height[at] += cosine;
        sx[at] -= kx * sine;
        sz[at] -= kz * sine;
      }
    }
  }
  return { height, sx, sz };
}

const rms = (values) => Math.sqrt(values.reduce((sum, value) => sum + value * value, 0) / values.length);
const byte = (value) => Math.max(0, Math.min(255, Math.round(255 * value)));

/** The texture: red and green slopes over STEEPEST rms, blue height, alpha lace; 0.5 is zero. */
export function makeRipples() {
  const random = randomNumbers(7);
  const { height, sx, sz } = sumWaves(random, 44, 34, 2, 1.75, true);
  const lace = sumWaves(random, 26, 26, 5, 0.6, false).height;
  const steep = STEEPEST * Math.SQRT1_2 * Math.hypot(rms(sx), rms(sz)), high = 3 * rms(height), wide = rms(lace);
  const data = new Uint8Array(4 * SIZE * SIZE);
  for (let i = 0; i < SIZE * SIZE; i++) {
    data[4 * i] = byte(0.5 + (0.5 * sx[i]) / steep);
    data[4 * i + 1] = byte(0.5 + (0.5 * sz[i]) / steep);
    data[4 * i + 2] = byte(0.5 + (0.5 * height[i]) / high);
    data[4 * i + 3] = byte(Math.exp(-((1.1 * lace[i] / wide) ** 2))); // thin ridges where the sum is near zero
  }
  const texture = new THREE.DataTexture(data, SIZE, SIZE);
  Object.assign(texture, {
    wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, magFilter: THREE.LinearFilter,
    minFilter: THREE.LinearMipmapLinearFilter, generateMipmaps: true, anisotropy: 8, needsUpdate: true,
  });
  return texture;
}

/** Uniforms of all that looks like water: the time of the run [s] and the small waves. */
export const WATER = { uTime: { value: 0 }, uRipples: { value: null } };

export const RIPPLES_GLSL = /* glsl */ `
  uniform sampler2D uRipples;
  // Slopes with a root mean square of 1, and height from -1 to 1.
  vec3 ripple(vec2 p) { return (texture2D(uRipples, p).xyz - 0.5) * vec3(${(2 * STEEPEST).toFixed(2)} * vec2(0.7071), 2.0); }
  float lace(vec2 p) { return texture2D(uRipples, p).a; }
`;
