// The light of a fire: on hulls and on what stands on them, as a halo around it, and as a streak on the water. By day it is faint.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { burstOf } from "./effects.js";
import { findTurbulence } from "./puffs.js";

/** Uniforms of the strongest fire: its place in the page's world, and its light at REACH, by colour. */
export const FIRE = { uFireAt: { value: new THREE.Vector3() }, uFireLight: { value: new THREE.Color(0, 0, 0) } };
const REACH = 14; // [m]
const BRIGHT = 6; // of a fire at full strength, in units of what lights a hull by day
const COLOUR = [1.0, 0.42, 0.10];
const WAVE = [26, 9]; // of the noise that breaks the streak on the water, across and along [m]

/** `fireLight(place, normal)` in the page's world: what a fire adds to the light on a surface. */
export const FIRE_GLSL = /* glsl */ `
  uniform vec3 uFireAt, uFireLight;
  vec3 fireLight(vec3 place, vec3 normal) {
    vec3 way = uFireAt - place;
    float far = dot(way, way);
    return uFireLight * (0.35 + 0.65 * max(dot(normal, way) * inversesqrt(far + 1.0), 0.0)) / (1.0 + far / ${(REACH * REACH).toFixed(1)});
  }
`;

const VERTEX = /* glsl */ `
  uniform vec3 uFireAt;
  uniform float uSize, uOnWater;
  varying vec2 vCorner;
  varying vec3 vWater; // across and away from the fire in waves, and from its foot (0) to where it is lost (1)
  const vec2 WAVE = vec2(${WAVE.map((x) => x.toFixed(1)).join(", ")});
  void main() {
    vCorner = position.xy;
    vWater = vec3(0.0);
    vec3 at = uFireAt;
    if (uOnWater > 0.5) {
      // From below the fire towards the eye, drawn out by the waves.
      vec2 way = cameraPosition.xz - at.xz;
      float far = length(way);
      way /= max(far, 1.0);
      float reach = min(0.6 * far, 9.0 * uSize);
      float along = 0.5 + 0.5 * position.y; // 0 at the fire's foot
      vec2 place = vec2(position.x * uSize * (1.2 + 0.4 * along), along * reach - 0.2 * uSize);
      at.xz += way * place.y + vec2(-way.y, way.x) * place.x;
      at.y = 0.5;
      vWater = vec3(place.x / WAVE.x, place.y / WAVE.y, along);
      gl_Position = projectionMatrix * viewMatrix * vec4(at, 1.0);
    } else {
      vec4 view = viewMatrix * vec4(at, 1.0);
      view.xy += position.xy * 4.5 * uSize;
      view.xyz *= 1.0 - min(1.5 * uSize / length(view.xyz), 0.5);
      gl_Position = projectionMatrix * view;
    }
  }`;
const FRAGMENT = /* glsl */ `
  uniform vec3 uFireLight;
  uniform float uOnWater, uTime, uDark;
  uniform sampler2D uNoise;
  varying vec2 vCorner;
  varying vec3 vWater;
  void main() {
    float r = length(vCorner), glow;
    if (uOnWater > 0.5) {
      // Whole beside the ship, and broken by the waves the more the farther away.
      float waves = 0.6 * texture2D(uNoise, vWater.xy - vec2(0.0, 0.11 * uTime)).r + 0.4 * texture2D(uNoise, 1.7 * vWater.xy + vec2(0.07 * uTime, 0.0)).g;
      float broken = smoothstep(0.34 + 0.16 * vWater.z, 0.5 + 0.2 * vWater.z, waves + 0.12 * (1.0 - abs(vCorner.x)));
      float away = pow(1.0 - vWater.z, 1.5) * smoothstep(0.0, 0.03, vWater.z);
      glow = smoothstep(1.0, 0.2, abs(vCorner.x)) * away * mix(0.35 + 0.65 * broken, broken, smoothstep(0.0, 0.35, vWater.z)) * mix(0.3, 1.5, uDark);
    } else {
      float edge = max(0.0, 1.0 - r);
      glow = edge * edge * edge * mix(0.08, 0.5, uDark);
    }
    gl_FragColor = vec4(uFireLight * glow * 0.3, 1.0);
  }`;

const quad = new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]);

/** How bright an effect burns at a time [s], 0 to 1 and more: a fire flickers, an explosion flashes. */
export function brightnessAt({ kind, time, duration }, now) {
  const age = now - time;
  if (age <= 0) return 0;
  if (kind === "explosion") return 5 * Math.min(1, age / 0.06) * Math.exp(-2.6 * age);
  if (kind !== "fire" || age > duration + 2) return 0;
  const flicker = 0.86 + 0.1 * Math.sin(11 * now) + 0.08 * Math.sin(17.3 * now + 1);
  return flicker * Math.min(1, age) * Math.min(1, (duration + 2 - age) / 4);
}

/** Adds the light to the world; `show(time, effects, ships)` lights what burns most, [{kind, ship, point, size ...}]. */
export function addFireLight(world) {
  const lamp = new THREE.PointLight(0xffffff, 0, 160, 2);
  const shared = { ...FIRE, uSize: { value: 1 }, uTime: { value: 0 }, uDark: { value: 0 }, uNoise: { value: findTurbulence() } };
  const geometry = new THREE.BufferGeometry().setIndex([0, 1, 2, 0, 2, 3]);
  geometry.setAttribute("position", new THREE.BufferAttribute(quad, 3));
  const glows = [0, 1].map((onWater) => {
    const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
      uniforms: { ...shared, uOnWater: { value: onWater } }, vertexShader: VERTEX, fragmentShader: FRAGMENT, side: THREE.DoubleSide,
      transparent: true, depthWrite: false, blending: THREE.AdditiveBlending, toneMapped: false,
    }));
    mesh.frustumCulled = false;
    mesh.renderOrder = onWater ? 0.6 : 2.5;
    return mesh;
  });
  world.add(lamp, ...glows);
  return {
    show(time, effects, ships) {
      let most = 0, at = null;
      for (const effect of effects) {
        const brightness = brightnessAt(effect, time) * Math.sqrt(effect.intensity);
        if (brightness > most) [most, at] = [brightness, effect];
      }
      for (const mesh of glows) mesh.visible = most > 0.01;
      FIRE.uFireLight.value.setRGB(0, 0, 0);
      lamp.intensity = 0;
      if (!at) return;
      const { node, info } = ships.find((ship) => ship.info.name === at.ship);
      const place = new THREE.Vector3(...burstOf(at, info)).addScaledVector(new THREE.Vector3(...at.outwards), 0.5 * at.size);
      node.localToWorld(place);
      place.y += 0.6 * at.size;
      FIRE.uFireAt.value.copy(place);
      FIRE.uFireLight.value.setRGB(...COLOUR).multiplyScalar(BRIGHT * most);
      lamp.position.copy(place);
      lamp.color.setRGB(...COLOUR);
      lamp.intensity = BRIGHT * most * REACH * REACH;
      shared.uSize.value = at.size;
      shared.uTime.value = time;
      shared.uDark.value = LIGHT.uLamps.value;
    },
  };
}
