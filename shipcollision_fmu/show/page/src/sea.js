// The sea: a plane at the design waterline, with waves in its light only, so that the hulls meet it in a clean line.
// Waves are a function of the run's time, so that scrubbing back brings the same sea again.
import * as THREE from "three";
import { HAZE, SKY_GLSL, SUN_UNIFORM } from "./sky.js";

const RADIUS = 60000; // [m]

/** `ships`: of each, half length, half breadth and height of the deck above the waterline [m], and its colour. */
export function makeSea(ships) {
  const vectors = (make) => ships.map(make);
  const places = vectors(() => new THREE.Vector4()); // x, z, and where ahead is in them
  const material = new THREE.ShaderMaterial({
    uniforms: {
      uTime: { value: 0 },
      uHaze: { value: 9000 },
      uSun: SUN_UNIFORM,
      uPlaces: { value: places },
      uSizes: { value: vectors(({ halfLength, halfBreadth, height }) => new THREE.Vector3(halfLength, halfBreadth, height)) },
      uColours: { value: vectors(({ colour }) => new THREE.Color(colour).multiplyScalar(0.55)) },
    },
    vertexShader: /* glsl */ `
      varying vec3 vWorld;
      void main() {
        vec4 world = modelMatrix * vec4(position, 1.0);
        vWorld = world.xyz;
        gl_Position = projectionMatrix * viewMatrix * world;
      }`,
    fragmentShader: /* glsl */ `
      uniform float uTime, uHaze;
      varying vec3 vWorld;
      const int SHIPS = ${ships.length};
      uniform vec4 uPlaces[SHIPS];
      uniform vec3 uSizes[SHIPS];
      uniform vec3 uColours[SHIPS];
      ${SKY_GLSL}
      // What a ray from the sea meets: a ship, taken for a box, or the sky.
      vec3 mirroredColour(vec3 from, vec3 direction, vec2 slope) {
        vec3 colour = skyColour(direction);
        float nearest = 1e9;
        vec3 broken = normalize(direction + vec3(-slope.x, 0.0, -slope.y)); // small waves that are not drawn break it up
        for (int i = 0; i < SHIPS; i++) {
          vec2 ahead = uPlaces[i].zw;
          mat2 toShip = mat2(ahead.x, -ahead.y, ahead.y, ahead.x);
          vec2 o = toShip * (from.xz - uPlaces[i].xy), d = toShip * broken.xz;
          vec3 origin = vec3(o, from.y), ray = vec3(d, broken.y) + 1e-6; // never 0
          vec3 low = (vec3(-uSizes[i].xy, 0.0) - origin) / ray, high = (uSizes[i] - origin) / ray;
          vec3 enter = min(low, high), leave = max(low, high);
          float t = max(max(enter.x, enter.y), enter.z), end = min(min(leave.x, leave.y), leave.z);
          if (t < end && end > 0.0 && t < nearest) {
            nearest = t;
            vec3 at = abs(origin + t * ray) / uSizes[i]; // fainter towards ends and top, where hulls are not boxes
            float share = smoothstep(1.02, 0.75, at.x) * smoothstep(1.05, 0.6, at.z);
            colour = mix(skyColour(direction), uColours[i], 0.75 * share);
          }
        }
        return colour;
      }
      // Foam and shade where the sea meets the hulls: x foam, y shade.
      vec2 alongHulls(vec2 p) {
        vec2 found = vec2(0.0);
        for (int i = 0; i < SHIPS; i++) {
          vec2 ahead = uPlaces[i].zw;
          vec2 o = abs(mat2(ahead.x, -ahead.y, ahead.y, ahead.x) * (p - uPlaces[i].xy));
          vec2 half_ = uSizes[i].xy;
          float out_ = max(o.y - half_.y * (1.0 - pow(min(o.x / half_.x, 1.0), 5.0) * 0.9), o.x - half_.x);
          found = max(found, vec2(smoothstep(3.0, 0.0, out_), smoothstep(22.0, 0.0, out_)));
        }
        return found;
      }
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
        vec3 colour = mix(deep, mirroredColour(vWorld, mirrored, slope), fresnel);
        vec2 hulls = alongHulls(vWorld.xz + 5.0 * slope);
        colour = mix(colour, deep * 0.5, 0.3 * hulls.y);
        colour = mix(colour, vec3(0.72, 0.82, 0.86), 0.45 * hulls.x * smoothstep(-0.03, 0.10, slope.x + slope.y));
        float glint = pow(max(dot(mirrored, uSun), 0.0), 260.0);
        colour += vec3(1.0, 0.9, 0.75) * glint * 1.1;
        colour = mix(colour, HAZE, 1.0 - exp(-pow(distance_ / uHaze, 1.4)));
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
    /** `poses`: of each ship, where midship is and where ahead is, in the page's world; `haze`: how far one sees [m]. */
    update(time, camera, poses, haze) {
      material.uniforms.uHaze.value = haze;
      poses.forEach(({ position, ahead }, i) => {
        const length = Math.hypot(ahead.x, ahead.z) || 1;
        places[i].set(position.x, position.z, ahead.x / length, ahead.z / length);
      });
      material.uniforms.uTime.value = time;
      mesh.position.set(camera.position.x, 0, camera.position.z);
    },
    haze: HAZE,
  };
}
