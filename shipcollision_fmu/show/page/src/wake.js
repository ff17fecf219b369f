// The wake along a ship's real track: churned water abaft the stern, foam thrown aside by the bow, and the waves that Kelvin
// found behind a ship. On the plain sea foam lies by itself; else all is drawn into foam.js's texture.
import * as THREE from "three";
import { ADDING, TO_FIELD } from "./field.js";
import { ON_SEA, ON_SEA_HEAD, ON_SEA_PIXEL, ON_SEA_UNIFORMS } from "./on_sea.js";
import { WATER } from "./ripples.js";
import { churnedAt, followTrack, MOST, OLDEST, thrownAt } from "./track_wake.js";
import { toWorld } from "./tracks.js";

const LEAST = 0.02; // foam that is weaker than this is not drawn
const WIDEST = 460; // half the breadth of the waves that are drawn [m]

/** A geometry of strips of sections, two corners each; `show(count)` draws so many sections of every strip. */
function makeStrips(strips, size) {
  const geometry = new THREE.BufferGeometry();
  const places = new Float32Array(strips * MOST * 2 * 3), water = new Float32Array(strips * MOST * 2 * size);
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setAttribute("aWater", new THREE.BufferAttribute(water, size));
  const index = []; // section by section, so that fewer of them can be drawn
  for (let i = 0; i + 1 < MOST; i++) {
    for (let k = 0; k < strips; k++) {
      const a = 2 * (k * MOST + i);
      index.push(a, a + 2, a + 1, a + 1, a + 2, a + 3);
    }
  }
  geometry.setIndex(index);
  return {
    geometry,
    /** Sets a corner, 0 or 1, of a section of a strip. */
    set(strip, section, corner, [x, z], values) {
      const at = 2 * (strip * MOST + section) + corner;
      places.set([x, 0, z], 3 * at);
      water.set(values, size * at);
    },
    show(count) {
      geometry.setDrawRange(0, Math.max(0, count - 1) * strips * 6);
      geometry.attributes.position.needsUpdate = geometry.attributes.aWater.needsUpdate = true;
    },
  };
}

const foamVertex = (head, toPlace) => /* glsl */ `
  attribute vec4 aWater; // across a strip from -1 to 1, how white, how green, 1 if the bow has thrown it
  uniform vec4 uCover;
  varying vec4 vFoam;
  varying vec2 vPlace;
  ${head}
  void main() {
    vFoam = aWater;
    vec2 place = position.xz;
    vPlace = place;
    ${toPlace}
  }`;
const foamPixel = (head, colour) => /* glsl */ `
  uniform sampler2D uRipples;
  uniform float uPatch;
  varying vec4 vFoam;
  varying vec2 vPlace;
  ${head}
  void main() {
    // Its edge is ragged, by patches of the water that lie still.
    float across = abs(vFoam.x) + 0.5 * (texture2D(uRipples, vPlace / uPatch).b - 0.5) * smoothstep(0.2, 0.8, abs(vFoam.x));
    float inside = smoothstep(1.0, 0.5, across);
    inside *= mix(0.66 + 0.34 * smoothstep(0.3, 0.8, across), inside, vFoam.w); // propellers and the hull's sides churn it
    float foam = vFoam.y * inside, churned = vFoam.z * inside;
    gl_FragColor = ${colour};
  }`;

const WAVES_VERTEX = /* glsl */ `
  attribute vec4 aWater; // from the bow [m], across [m], age [s], speed [m/s]
  uniform vec4 uCover;
  varying vec4 vWater;
  void main() {
    vWater = aWater;
    vec2 place = position.xz;
    ${TO_FIELD}
  }`;
const WAVES_PIXEL = /* glsl */ `
  uniform vec4 uCover;
  uniform vec2 uSize;
  varying vec4 vWater;
  void main() {
    float x = max(vWater.x, 0.1), y = abs(vWater.y), age = vWater.z, speed = vWater.w;
    float L = uSize.x, B = uSize.y, height = 0.0;
    // Kelvin (1887): of all waves that keep pace with the ship, those in phase at x, y have tan(theta) = t.
    float k = 9.81 / max(speed * speed, 1.0), edge = 8.0 * y * y / (x * x);
    if (edge < 1.0 && speed > 0.8) {
      float root = sqrt(1.0 - edge);
      float inside = smoothstep(1.0, 0.80, edge);
      float amplitude = 0.075 * speed * speed / 9.81 * min(1.0, B / 12.0) * inversesqrt(1.0 + k * x * 0.25);
      amplitude *= smoothstep(0.8, 3.0, speed) * (1.0 - age / ${OLDEST.toFixed(1)}) * inside * smoothstep(0.0, 0.12 * L, x);
      float t1 = x * (1.0 + root) / (4.0 * max(y, 0.5)), t2 = x * (1.0 - root) / (4.0 * max(y, 0.5));
      float length1 = 6.2832 / (k * (1.0 + t1 * t1));
      float drawn = smoothstep(3.0 * uCover.w, 7.0 * uCover.w, length1) * smoothstep(0.08 * B, 0.4 * B, length1);
      height += amplitude * (0.9 + 0.9 * smoothstep(0.45, 0.95, edge)) * drawn * cos(k * sqrt(1.0 + t1 * t1) * (x - y * t1));
      height += amplitude * 0.55 * cos(k * sqrt(1.0 + t2 * t2) * (x - y * t2));
      float behind = max(x - L, 0.0); // where the stern has churned the water, waves are low
      height *= 1.0 - 0.8 * smoothstep(1.0, 0.6, y / (0.42 * B + 0.55 * sqrt(behind))) * smoothstep(0.0, 6.0, behind);
    }
    gl_FragColor = vec4(0.0, height, 0.0, 0.0);
  }`;

/** `ends`: stations of stern and bow at the water {aft, fore} [m]. */
export function makeWake({ track, info }, ends, cover) {
  const size = { L: info.L_oa, B: info.B };
  const foam = makeStrips(5, 4), waves = makeStrips(1, 4);
  const patches = { uRipples: WATER.uRipples, uPatch: { value: 1.2 * info.B } };
  const mesh = new THREE.Group().add(
    new THREE.Mesh(foam.geometry, new THREE.ShaderMaterial({
      ...ADDING, uniforms: { ...patches, uCover: cover }, vertexShader: foamVertex("", TO_FIELD), fragmentShader: foamPixel("", "vec4(foam, 0.0, 0.0, churned)"),
    })),
    new THREE.Mesh(waves.geometry, new THREE.ShaderMaterial({
      ...ADDING, uniforms: { uCover: cover, uSize: { value: new THREE.Vector2(size.L, size.B) } }, vertexShader: WAVES_VERTEX, fragmentShader: WAVES_PIXEL,
    })),
  );
  const plain = new THREE.Mesh(foam.geometry, new THREE.ShaderMaterial({
    ...ON_SEA, uniforms: { ...ON_SEA_UNIFORMS, ...patches },
    vertexShader: foamVertex(ON_SEA_HEAD, "gl_Position = onSea(place, 0.0);"), fragmentShader: foamPixel(ON_SEA_PIXEL, "paintFoam(foam, churned, 0.0)"),
  }));
  plain.renderOrder = -5;
  for (const one of [...mesh.children, plain]) one.frustumCulled = false;
  const middle = new THREE.Vector3(), ahead = new THREE.Vector3(), q = new THREE.Quaternion();

  function poseAt(time) {
    track.at(time, middle, q);
    ahead.set(1, 0, 0).applyQuaternion(q);
    const length = Math.hypot(ahead.x, ahead.y) || 1;
    toWorld(middle);
    return [middle.x, middle.z, ahead.x / length, ahead.y / length];
  }

  const shownHalf = (half, white, green) => (white + green > LEAST ? half : 0); // a strip without breadth costs no pixels
  const beside = ([x, z], [c, s], across) => [x - s * across, z + c * across];

  function setFoam(section, i) {
    const { half: reach, white: foamy, green: churned } = churnedAt(section, size), thrown = thrownAt(section, size);
    const shown = shownHalf(reach, foamy, churned);
    for (const [corner, v] of [-1, 1].entries()) {
      foam.set(0, i, corner, beside(section.stern, section.ahead, v * shown), [v, foamy, churned, 0]);
      for (const [k, [distance, half, white, green]] of thrown.entries()) {
        for (const [j, side] of [-1, 1].entries()) {
          foam.set(1 + 2 * k + j, i, corner, beside(section.bow, section.ahead, side * (distance + v * shownHalf(half, white, green))), [v, white, green, 1]);
        }
      }
    }
  }

  /** Waves are where they would be had the ship kept the speed that she had at the section. */
  function setWaves({ bow, ahead: along, age, speed }, i, turn) {
    const x = speed * age;
    const half = Math.min(0.37 * x + 0.7 * size.B, WIDEST, 0.8 / Math.max(turn, 1e-6)); // within the turning circle
    for (const [corner, across] of [-half, half].entries()) waves.set(0, i, corner, beside(bow, along, across), [x, across, age, speed]);
  }

  return {
    mesh,
    plain,
    update(time, isPlain) {
      const sections = followTrack(poseAt, time, ends);
      sections.forEach(setFoam);
      foam.show(sections.length);
      if (isPlain) return;
      sections.forEach((section, i) => {
        const next = sections[Math.min(i + 1, sections.length - 1)], before = sections[Math.max(i - 1, 0)];
        const turned = Math.abs(before.ahead[0] * next.ahead[1] - before.ahead[1] * next.ahead[0]);
        setWaves(section, i, turned / Math.max(next.run - before.run, 1));
      });
      waves.show(sections.length);
    },
  };
}
