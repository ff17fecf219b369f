// Sky, sun and haze. The sky is a function of direction alone, written once and shared with the sea, which mirrors it.
import * as THREE from "three";

export const HAZE = new THREE.Color(0.60, 0.71, 0.81);

/** Where the sun stands, as seen from anywhere; set once, when it is known from where the ships are looked at first. */
export const SUN = new THREE.Vector3(-0.62, 0.42, -0.5).normalize();
export const SUN_UNIFORM = { value: SUN };

export const SKY_GLSL = /* glsl */ `
  uniform vec3 uSun;
  const vec3 HAZE = vec3(${HAZE.toArray().map((x) => x.toFixed(6)).join(", ")});
  vec3 skyColour(vec3 direction) {
    float height = max(direction.y, 0.0);
    float towards = max(dot(direction, uSun), 0.0);
    vec3 zenith = vec3(0.07, 0.22, 0.52);
    vec3 colour = mix(HAZE, zenith, 1.0 - exp(-4.0 * height));
    return mix(colour, vec3(1.0, 0.84, 0.64), 0.4 * pow(towards, 6.0) * exp(-2.0 * height));
  }
`;

/** A dome that stays around the camera, and the lights that go with it. */
export function makeSky() {
  const dome = new THREE.Mesh(
    new THREE.SphereGeometry(1, 32, 24),
    new THREE.ShaderMaterial({
      side: THREE.BackSide,
      uniforms: { uSun: SUN_UNIFORM },
      depthWrite: false,
      depthTest: false,
      vertexShader: /* glsl */ `
        varying vec3 vDirection;
        void main() {
          vDirection = position;
          vec4 place = projectionMatrix * mat4(mat3(modelViewMatrix)) * vec4(position, 1.0);
          gl_Position = place.xyww;
        }`,
      fragmentShader: /* glsl */ `
        varying vec3 vDirection;
        ${SKY_GLSL}
        float hash(vec2 p) { return fract(sin(dot(p, vec2(127.1, 311.7))) * 43758.5453); }
        float noise(vec2 p) {
          vec2 i = floor(p), f = fract(p);
          f = f * f * (3.0 - 2.0 * f);
          return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
        }
        void main() {
          vec3 d = normalize(vDirection);
          vec3 colour = skyColour(d);
          if (d.y > 0.02) {
            vec2 p = d.xz / (d.y + 0.12) * 1.6;
            float cloud = 0.55 * noise(p) + 0.3 * noise(2.3 * p + 7.0) + 0.15 * noise(5.1 * p + 3.0);
            cloud = smoothstep(0.52, 0.85, cloud) * smoothstep(0.02, 0.22, d.y);
            colour = mix(colour, vec3(0.95, 0.96, 0.97), 0.55 * cloud);
          }
          float towards = max(dot(d, uSun), 0.0);
          colour += vec3(1.0, 0.93, 0.8) * (smoothstep(0.9994, 0.9998, towards) * 6.0 + 0.35 * pow(towards, 400.0));
          gl_FragColor = vec4(colour, 1.0);
          #include <tonemapping_fragment>
          #include <colorspace_fragment>
        }`,
    }),
  );
  dome.frustumCulled = false;
  dome.renderOrder = -10;

  const sun = new THREE.DirectionalLight(0xfff0da, 3.0);
  const ambient = new THREE.HemisphereLight(0xcfe0f2, 0x50707f, 1.9);
  return { dome, sun, ambient };
}
