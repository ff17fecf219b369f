// The sea: a plane at the design waterline, with waves in its light only, so that the hulls meet it in a clean line.
// Waves are a function of the run's time, so that scrubbing back brings the same sea again.
import * as THREE from "three";
import { HAZE, SKY_GLSL } from "./sky.js";

const RADIUS = 30000;

export function makeSea() {
  const material = new THREE.ShaderMaterial({
    uniforms: { uTime: { value: 0 } },
    vertexShader: /* glsl */ `
      varying vec3 vWorld;
      void main() {
        vec4 world = modelMatrix * vec4(position, 1.0);
        vWorld = world.xyz;
        gl_Position = projectionMatrix * viewMatrix * world;
      }`,
    fragmentShader: /* glsl */ `
      uniform float uTime;
      varying vec3 vWorld;
      ${SKY_GLSL}
      float hash(vec2 p) {
        p = fract(p * vec2(0.1031, 0.1030));
        p += dot(p, p.yx + 33.33);
        return fract((p.x + p.y) * p.x);
      }
      // Value noise and its slopes.
      vec3 noised(vec2 x) {
        vec2 i = floor(x), f = fract(x);
        vec2 u = f * f * (3.0 - 2.0 * f), du = 6.0 * f * (1.0 - f);
        float a = hash(i), b = hash(i + vec2(1, 0)), c = hash(i + vec2(0, 1)), d = hash(i + vec2(1, 1));
        float k = a - b - c + d;
        return vec3(a + (b - a) * u.x + (c - a) * u.y + k * u.x * u.y, du * (vec2(b - a, c - a) + k * u.yx));
      }
      void swell(vec2 p, vec2 direction, float length, float steepness, float distance_, inout vec2 slope) {
        float k = 6.2831853 / length;
        float phase = k * dot(direction, p) - sqrt(9.81 * k) * uTime;
        slope += direction * steepness * cos(phase) * exp(-distance_ / (length * 55.0));
      }
      void main() {
        vec3 away = vWorld - cameraPosition;
        float distance_ = length(away);
        vec3 view = away / distance_;
        vec2 p = vWorld.xz;
        vec2 slope = vec2(0.0);
        swell(p, vec2(0.80, 0.60), 61.0, 0.040, distance_, slope);
        swell(p, vec2(0.98, 0.20), 37.0, 0.040, distance_, slope);
        swell(p, vec2(0.45, 0.89), 23.0, 0.035, distance_, slope);
        swell(p, vec2(0.92, -0.39), 13.0, 0.030, distance_, slope);
        vec2 drift = vec2(0.8, 0.6) * uTime;
        slope += 0.30 * noised(p / 9.0 - drift * 0.22).yz * exp(-distance_ / 900.0);
        slope += 0.22 * noised(p / 3.7 + vec2(5.0, 1.0) - drift * 0.5).yz * exp(-distance_ / 380.0);
        slope += 0.14 * noised(p / 1.4 - drift.yx * 0.9).yz * exp(-distance_ / 140.0);
        vec3 normal = normalize(vec3(-slope.x, 1.0, -slope.y));
        float facing = max(dot(-view, normal), 0.0);
        float fresnel = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
        fresnel = mix(fresnel, min(fresnel, 0.55), exp(-distance_ / 4000.0));
        vec3 mirrored = reflect(view, normal);
        mirrored.y = abs(mirrored.y) + 0.02;
        mirrored = normalize(mirrored);
        vec3 deep = mix(vec3(0.008, 0.055, 0.085), vec3(0.02, 0.13, 0.16), clamp(0.5 + 1.6 * (slope.x + slope.y), 0.0, 1.0));
        vec3 colour = mix(deep, skyColour(mirrored), fresnel);
        float glint = pow(max(dot(mirrored, SUN), 0.0), 220.0);
        colour += vec3(1.0, 0.9, 0.75) * glint * 1.6;
        colour = mix(colour, HAZE, 1.0 - exp(-pow(distance_ / 9000.0, 1.4)));
        gl_FragColor = vec4(colour, 1.0);
        #include <tonemapping_fragment>
        #include <colorspace_fragment>
      }`,
  });
  const plain = new THREE.MeshBasicMaterial({ color: new THREE.Color(0.05, 0.16, 0.22) });
  const mesh = new THREE.Mesh(new THREE.CircleGeometry(RADIUS, 96).rotateX(-Math.PI / 2), material);
  mesh.renderOrder = -5;
  mesh.frustumCulled = false;
  return {
    mesh,
    setPlain(isPlain) {
      mesh.material = isPlain ? plain : material;
    },
    update(time, camera) {
      material.uniforms.uTime.value = time;
      mesh.position.set(camera.position.x, 0, camera.position.z);
    },
    haze: HAZE,
  };
}
