// Navigation lights: glowing points at the places that the .glb names, bright inside their sector and dark outside, and
// below each its streak on the water.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";

const quad = new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]);

// Half the width of a glow in the picture [rad]: a light dazzles less the farther it is, down to a point that can still be seen.
const SMALLEST = 0.0034, GLARE = 0.0085, FAR = 260; // [rad], [rad], [m]

const VERTEX = /* glsl */ `
  const float SMALLEST = ${SMALLEST.toFixed(4)}, GLARE = ${GLARE.toFixed(4)}, FAR = ${FAR.toFixed(1)};
  uniform float uLamps, uMirror, uOpen;
  uniform vec2 uSector; // start and arc [rad] clockwise from ahead
  varying vec2 vCorner;
  varying float vLight;
  void main() {
    vCorner = position.xy;
    vec3 eye = (inverse(modelMatrix) * vec4(cameraPosition, 1.0)).xyz; // from the light, in the ship's b
    float bearing = mod(atan(eye.y, eye.x) - uSector.x, 6.2831853);
    float seen = smoothstep(-0.03, 0.03, bearing) * smoothstep(uSector.y + 0.03, uSector.y - 0.03, bearing);
    if (uSector.y > 6.2) seen = 1.0;
    vec3 light = (modelMatrix * vec4(0.0, 0.0, 0.0, 1.0)).xyz;
    vec3 away = light - cameraPosition;
    float distance_ = length(away);
    float radius = max(0.5, (SMALLEST + GLARE / (1.0 + distance_ / FAR)) * distance_);
    vLight = uLamps * mix(0.04, 1.0, seen);
    vec3 place;
    if (uMirror > 0.5) {
      // On the water where the light would be mirrored, drawn out towards the eye by the waves.
      float share = cameraPosition.y / max(cameraPosition.y + light.y, 0.1);
      vec3 at = vec3(mix(cameraPosition.xz, light.xz, share), 0.0).xzy;
      vec2 along = normalize(away.xz);
      float reach = length(at.xz - light.xz) * 0.45 + radius;
      at.xz += along * position.y * reach;
      float width = radius * clamp(distance(at, cameraPosition) / distance_, 0.1, 1.0); // as broad in the picture as the light
      at.xz += vec2(-along.y, along.x) * position.x * width * 1.1;
      at.y = 0.35;
      place = at;
      vLight *= uOpen * 0.5 * smoothstep(0.1, 0.9, seen) * (0.3 + 0.7 * smoothstep(20.0, 150.0, distance_)); // waves scatter near ones
      gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
    } else {
      vec4 view = viewMatrix * vec4(light, 1.0);
      view.xy += position.xy * radius * (0.5 + 0.5 * seen);
      view.z += 1.5; // before the mast that bears it
      gl_Position = projectionMatrix * view;
    }
    if (vLight < 0.004) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;

const FRAGMENT = /* glsl */ `
  uniform vec3 uColour;
  uniform float uMirror, uTime;
  varying vec2 vCorner;
  varying float vLight;
  void main() {
    float r = length(vCorner), glow;
    if (uMirror > 0.5) {
      float waves = 0.5 + 0.5 * sin(24.0 * vCorner.y + 3.0 * sin(5.0 * vCorner.y + 1.3 * uTime) + 2.1 * uTime);
      glow = 0.55 * smoothstep(1.0, 0.0, abs(vCorner.x)) * smoothstep(1.0, 0.1, abs(vCorner.y)) * (0.25 + 0.75 * waves);
    } else {
      glow = 2.4 * exp(-16.0 * r * r) + 0.30 * exp(-4.0 * r * r) * (1.0 - r);
    }
    if (r > 1.0 && uMirror < 0.5) discard;
    vec3 colour = mix(uColour, vec3(1.0), uMirror > 0.5 ? 0.0 : 0.8 * exp(-60.0 * r * r));
    gl_FragColor = vec4(colour * glow * vLight, 1.0);
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

/** Gives every light of the scene its glow and its streak; returns what keeps their waves moving, and their number. */
export function addLights(root) {
  const time = { value: 0 };
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
    for (const mirror of [0, 1]) {
      const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
        uniforms: {
          uLamps: LIGHT.uLamps, uTime: time, uOpen: { value: 1 }, uMirror: { value: mirror }, uColour: { value: new THREE.Color(colour) },
          uSector: { value: new THREE.Vector2(start, arc).multiplyScalar(Math.PI / 180) },
        },
        vertexShader: VERTEX, fragmentShader: FRAGMENT, side: THREE.DoubleSide,
        transparent: true, depthWrite: false, blending: THREE.AdditiveBlending,
      }));
      mesh.frustumCulled = false;
      mesh.renderOrder = 5;
      if (mirror) mesh.onBeforeRender = (_, __, camera) => (mesh.material.uniforms.uOpen.value = isHidden(ships, node, camera) ? 0 : 1);
      node.add(mesh);
      meshes.push(mesh);
    }
  }
  return {
    count: found.length,
    update(now) {
      time.value = now;
      for (const mesh of meshes) mesh.visible = LIGHT.uLamps.value > 0; // by day there is nothing to draw
    },
  };
}
