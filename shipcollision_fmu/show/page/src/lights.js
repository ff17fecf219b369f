// Navigation lights: glowing points at the places that the .glb names, bright inside their sector and dark outside, and
// below each what the waves mirror of it.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { slopeGlsl } from "./plain_sea.js";
import { WATER } from "./ripples.js";

const quad = new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]);

// Half the width of a glow in the picture [rad]: a light dazzles less the farther it is, down to a point that can still be seen.
const SMALLEST = 0.0048, GLARE = 0.0085, FAR = 260; // [rad], [rad], [m]
const TILT = 0.22; // slope of the water beyond which hardly any wave mirrors a light
const SURFACE = 0.3; // [m] over the water: swell would hide it
const DEEPER = 0.012; // of its distance by which what lies on the water is drawn nearer

/** Whether the eye is in a light's sector, from 0 to 1. */
const SEEN_GLSL = /* glsl */ `
  uniform float uLamps;
  uniform vec2 uSector; // start and arc [rad] clockwise from ahead
  float findSeen() {
    vec3 eye = (inverse(modelMatrix) * vec4(cameraPosition, 1.0)).xyz; // from the light, in the ship's b
    float bearing = mod(atan(eye.y, eye.x) - uSector.x, 6.2831853);
    float seen = smoothstep(-0.03, 0.03, bearing) * smoothstep(uSector.y + 0.03, uSector.y - 0.03, bearing);
    return uSector.y > 6.2 ? 1.0 : seen;
  }
`;

const GLOW_VERTEX = /* glsl */ `
  const float SMALLEST = ${SMALLEST.toFixed(4)}, GLARE = ${GLARE.toFixed(4)}, FAR = ${FAR.toFixed(1)};
  varying vec2 vCorner;
  varying float vLight;
  ${SEEN_GLSL}
  void main() {
    vCorner = position.xy;
    float seen = findSeen();
    vec3 light = (modelMatrix * vec4(0.0, 0.0, 0.0, 1.0)).xyz;
    float distance_ = distance(light, cameraPosition);
    float radius = max(0.5, (SMALLEST + GLARE / (1.0 + distance_ / FAR)) * distance_);
    vLight = uLamps * mix(0.04, 1.0, seen);
    vec4 view = viewMatrix * vec4(light, 1.0);
    view.xy += position.xy * radius * (0.5 + 0.5 * seen);
    view.z += 1.5; // before the mast that bears it
    gl_Position = vLight < 0.004 ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * view;
  }`;

const GLOW_FRAGMENT = /* glsl */ `
  uniform vec3 uColour;
  varying vec2 vCorner;
  varying float vLight;
  void main() {
    float r = length(vCorner);
    if (r > 1.0) discard;
    float glow = 3.0 * exp(-15.0 * r * r) + 0.32 * exp(-4.0 * r * r) * (1.0 - r);
    gl_FragColor = vec4(mix(uColour, vec3(1.0), 0.8 * exp(-60.0 * r * r)) * glow * vLight, 1.0);
    #include <colorspace_fragment>
  }`;

// The stretch of water that may mirror a light: along the way from the eye to the light as far as a wave can be steep
// enough, and to both sides. What lies within mirrors it where the small waves, those of the sea, happen to have the slope.
const MIRROR_VERTEX = /* glsl */ `
  uniform float uOpen;
  varying vec3 vPlace;
  varying vec3 vLamp;
  varying vec2 vShine; // how bright the light is in a slope that mirrors it, and how few slopes near it do so
  ${SEEN_GLSL}
  void main() {
    vLamp = (modelMatrix * vec4(0.0, 0.0, 0.0, 1.0)).xyz;
    vec2 way = vLamp.xz - cameraPosition.xz;
    float length_ = max(length(way), 1.0), eye = max(cameraPosition.y, 0.5), lamp = max(vLamp.y, 0.5);
    vec2 along = way / length_;
    float middle = length_ * eye / (eye + lamp);
    float first = min(middle, eye / tan(min(lamp / length_ + ${(2 * TILT).toFixed(3)}, 1.5)));
    float last = max(middle, length_ - lamp / tan(min(eye / length_ + ${(2 * TILT).toFixed(3)}, 1.5)));
    float at = position.y < 0.0 ? max(first, 1.0) : last;
    float near = length(vec2(at, eye)), far = length(vec2(length_ - at, lamp));
    float width = max(${TILT.toFixed(3)} * (eye / near + lamp / far) * near * far / (near + far), 0.002 * near);
    vec2 p = cameraPosition.xz + along * at + vec2(-along.y, along.x) * position.x * width;
    vPlace = vec3(p.x, ${SURFACE.toFixed(1)}, p.y);
    float rough = mix(0.05, 0.145, 1.0 - exp(-near / 900.0)); // slopes that are too small to be seen from here
    float spread = rough * rough * 0.5 + 0.0009, light = uLamps * uOpen * findSeen();
    vec3 toEye = normalize(cameraPosition - vPlace), toLamp = normalize(vLamp - vPlace);
    float mirror = 0.10 + 0.90 * pow(1.0 - max(dot(toEye, normalize(toEye + toLamp)), 0.0), 3.0);
    vShine = vec2(0.22 * light * mirror * sqrt(0.004 / spread) / (1.0 + far / 120.0), 0.125 / spread);
    vec4 view = viewMatrix * vec4(vPlace, 1.0), nearer = projectionMatrix * vec4(view.xyz * ${(1 - DEEPER).toFixed(3)}, 1.0);
    gl_Position = projectionMatrix * view;
    gl_Position.z = nearer.z / nearer.w * gl_Position.w;
    if (light < 0.004) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;

const MIRROR_FRAGMENT = /* glsl */ `
  uniform sampler2D uRipples;
  uniform vec3 uColour;
  uniform float uTime;
  varying vec3 vPlace;
  varying vec3 vLamp;
  varying vec2 vShine;
  void main() {
    vec3 toEye = cameraPosition - vPlace, toLamp = vLamp - vPlace;
    vec3 middle = toEye * inversesqrt(dot(toEye, toEye)) + toLamp * inversesqrt(dot(toLamp, toLamp));
    vec2 off = middle.xz / middle.y + ${slopeGlsl("vPlace.xz", "uTime")};
    float glint = max(0.0, 1.0 - dot(off, off) * vShine.y); // Gauss's bell is a power of a parabola here
    glint *= glint;
    gl_FragColor = vec4(uColour * min(vShine.x * glint * glint, 0.3), 1.0);
    #include <colorspace_fragment>
  }`;

/** Whether the hull of another ship takes the way of a light over its mirror image on the water to the eye. */
function isHidden(ships, light, camera) {
  const eye = camera.position, lamp = light.getWorldPosition(new THREE.Vector3());
  const share = eye.y / Math.max(eye.y + lamp.y, 0.1);
  return ships.some((ship) => {
    if (ship.getObjectById(light.id)) return false;
    const { L_oa, B } = ship.userData;
    const a = ship.worldToLocal(eye.clone()), b = ship.worldToLocal(lamp.clone());
    for (let i = 1; i < 40; i++) {
      const t = i / 40, height = t < share ? eye.y * (1 - t / share) : (lamp.y * (t - share)) / (1 - share);
      if (Math.abs(a.x + t * (b.x - a.x)) < 0.47 * L_oa && Math.abs(a.y + t * (b.y - a.y)) < 0.47 * B && height < 0.4 * B) return true;
    }
    return false;
  });
}

/** Gives every light of the scene its glow and its mirror image; returns what shows them, and their number. */
export function addLights(root) {
  const found = [], ships = [], meshes = [];
  root.traverse((node) => {
    if (node.userData.ship !== undefined) ships.push(node);
    if (typeof node.userData.light === "string") found.push(node);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(quad, 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  for (const node of found) {
    const { colour, start, arc } = node.userData;
    const common = {
      uLamps: LIGHT.uLamps, uColour: { value: new THREE.Color(colour) }, uSector: { value: new THREE.Vector2(start, arc).multiplyScalar(Math.PI / 180) },
    };
    const add = (uniforms, vertexShader, fragmentShader) => {
      const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
        uniforms, vertexShader, fragmentShader, side: THREE.DoubleSide, transparent: true, depthWrite: false, blending: THREE.AdditiveBlending,
      }));
      mesh.frustumCulled = false;
      mesh.renderOrder = 11; // over the plain sea and the plain sky, which are drawn last of what hides
      node.add(mesh);
      meshes.push(mesh);
      return mesh;
    };
    add(common, GLOW_VERTEX, GLOW_FRAGMENT);
    const uOpen = { value: 1 };
    add({ ...common, ...WATER, uOpen }, MIRROR_VERTEX, MIRROR_FRAGMENT)
      .onBeforeRender = (_, __, camera) => (uOpen.value = isHidden(ships, node, camera) ? 0 : 1);
  }
  return {
    count: found.length,
    update() {
      for (const mesh of meshes) mesh.visible = LIGHT.uLamps.value > 0; // by day there is nothing to draw
    },
  };
}
