// The sea: a plane at the design waterline, with waves in its light only, so that the hulls meet it in a clean line.
// Waves are a function of the run's time, so that scrubbing back brings the same sea again.
import * as THREE from "three";
import { HAZE, SKY_GLSL, SUN_UNIFORM } from "./sky.js";

const RADIUS = 30000;

export function makeSea() {
  const material = new THREE.ShaderMaterial({
    uniforms: { uTime: { value: 0 }, uSun: SUN_UNIFORM },
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
      // Long-crested waves of many lengths, each a train of exp(sin): flat troughs, sharper crests.
      vec2 slopes(vec2 p, float distance_) {
        vec2 slope = vec2(0.0);
        float length_ = 88.0, steepness = 0.052, turn = 0.4;
        for (int i = 0; i < 15; i++) {
          if (distance_ > 240.0 * length_) break; // faded to nothing, as are all shorter ones
          float k = 6.2831853 / length_;
          vec2 direction = vec2(cos(turn), sin(turn));
          float phase = k * dot(direction, p) + sqrt(9.81 * k) * uTime + float(i) * 1.7;
          float crest = exp(sin(phase) - 1.0);
          float fade = exp(-distance_ / (length_ * 50.0));
          slope += direction * crest * cos(phase) * steepness * fade;
          p += direction * crest * cos(phase) * length_ * 0.018;
          length_ *= 0.76;
          steepness *= 1.03;
          turn += 1.27 + 0.61 * sin(float(i) * 2.3);
        }
        return slope;
      }
      void main() {
        vec3 away = vWorld - cameraPosition;
        float distance_ = length(away);
        vec3 view = away / distance_;
        vec2 slope = slopes(vWorld.xz, distance_);
        vec3 normal = normalize(vec3(-slope.x, 1.0, -slope.y));
        float facing = max(dot(-view, normal), 0.0);
        float fresnel = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
        fresnel = mix(fresnel, min(fresnel, 0.55), exp(-distance_ / 4000.0));
        vec3 mirrored = reflect(view, normal);
        mirrored.y = abs(mirrored.y) + 0.02;
        mirrored = normalize(mirrored);
        vec3 deep = mix(vec3(0.008, 0.055, 0.085), vec3(0.02, 0.13, 0.16), clamp(0.4 + 2.0 * (slope.x + slope.y), 0.0, 1.0));
        vec3 colour = mix(deep, skyColour(mirrored), fresnel);
        float glint = pow(max(dot(mirrored, uSun), 0.0), 260.0);
        colour += vec3(1.0, 0.9, 0.75) * glint * 1.1;
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
