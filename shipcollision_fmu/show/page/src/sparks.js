// Sparks where steel scrapes along steel: from every stretch of a scratch while it is drawn. Their places are functions
// of the time since and of numbers from the scratch's name, as those of all effects.
import * as THREE from "three";
import { randomNumbers } from "./random.js";

const LIFE = 1.1; // [s] of the longest
const MOST = 900; // sparks of all scratches
const LEAST = 90; // of one

/** Points of a ribbon with the times at which they are drawn, in the ribbon's own frame, thinned to `count`. */
function pointsOf(node, count) {
  const { position, _time: times } = node.geometry.attributes;
  const step = Math.max(1, Math.floor(position.count / count));
  return Array.from({ length: Math.floor(position.count / step) }, (_, i) => i * step)
    .map((i) => ({ at: [position.getX(i), position.getY(i), position.getZ(i)], time: times.getX(i) }));
}

/** Adds sparks to all scratches under `root`; returns what shows them at a time since the start, and counts them. */
export function addSparks(root) {
  const ribbons = [];
  root.traverse((node) => {
    if (node.userData.scratch !== undefined && node.isMesh && node.geometry.attributes._time) ribbons.push(node);
  });
  const time = { value: 0 };
  const each = Math.max(4, Math.floor(MOST / Math.max(1, ribbons.length)));
  const made = ribbons.map((node, number) => {
    const points = pointsOf(node, Math.ceil(each / 6));
    const perPoint = Math.max(6, Math.min(24, Math.ceil(LEAST / points.length))); // a dent of few points throws up as many
    const random = randomNumbers(number + 11);
    const place = [], birth = [], seed = [];
    for (const { at, time: drawn } of points) {
      for (let k = 0; k < perPoint; k++) {
        for (const end of [0, 1]) {
          const numbers = end ? seed.slice(-4) : [random(), random(), random(), random()];
          place.push(at[0], at[1], Math.min(at[2], -0.5 - 4 * numbers[1])); // steel that meets below the water meets above as well
          birth.push(drawn, end);
          seed.push(...numbers);
        }
      }
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(place, 3));
    geometry.setAttribute("aBirth", new THREE.Float32BufferAttribute(birth, 2));
    geometry.setAttribute("aSeed", new THREE.Float32BufferAttribute(seed, 4));
    const lines = new THREE.LineSegments(geometry, new THREE.ShaderMaterial({
      uniforms: { uTime: time }, transparent: true, depthWrite: false, blending: THREE.AdditiveBlending,
      vertexShader: /* glsl */ `
        attribute vec2 aBirth;
        attribute vec4 aSeed;
        uniform float uTime;
        varying float vHeat;
        void main() {
          float age = uTime - aBirth.x - 0.25 * aSeed.w - 0.05 * aBirth.y; // the tail is where the head was before
          float life = ${LIFE.toFixed(1)} * (0.35 + 0.65 * aSeed.z), a = age / life;
          float angle = 6.2831853 * aSeed.x;
          vec3 velocity = vec3(7.0 * cos(angle), 7.0 * sin(angle), -2.0 - 7.0 * aSeed.y) * (0.4 + 0.6 * aSeed.z);
          vec3 place = position + velocity * age * (1.0 - 0.25 * a) + vec3(0.0, 0.0, 4.9 * age * age);
          vHeat = a;
          gl_Position = age > 0.0 && a < 1.0 ? projectionMatrix * modelViewMatrix * vec4(place, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
        }`,
      fragmentShader: /* glsl */ `
        varying float vHeat;
        void main() {
          gl_FragColor = vec4(mix(vec3(1.0, 0.85, 0.5), vec3(0.9, 0.25, 0.03), vHeat) * (1.0 - vHeat), 1.0);
          #include <colorspace_fragment>
        }`,
    }));
    lines.frustumCulled = false;
    lines.renderOrder = 3;
    node.parent.add(lines);
    lines.position.copy(node.position);
    lines.quaternion.copy(node.quaternion);
    const drawn = points.map((point) => point.time);
    return { lines, first: Math.min(...drawn), last: Math.max(...drawn) };
  });
  return (sinceStart) => {
    time.value = sinceStart;
    let active = 0;
    for (const { lines, first, last } of made) {
      lines.visible = sinceStart > first && sinceStart < last + LIFE + 0.3;
      active += lines.visible;
    }
    return active;
  };
}
