// The mirror image of a hull on the plain sea: from her waterline towards the eye, as far as still water would mirror her
// deck. The full sea mirrors hulls by itself.
import * as THREE from "three";
import { ON_SEA, ON_SEA_HEAD, ON_SEA_UNIFORMS } from "./on_sea.js";

const STRONGEST = 0.78; // opacity at the plating
const LIT = 0.36; // of the hull's colour, in the water
const FARTHEST = 18; // heights of the deck from which anything is mirrored: waves scatter the rest

/** `loop`: waterline [x, y] in b [m], `outwards`: its normals; `height` of the deck over the water [m]; `uPose`: hull_foam.js's. */
export function makePlainMirror(loop, outwards, { height, hull }, uPose) {
  const places = [], normals = [], shares = [], index = [];
  loop.forEach(([x, y], i) => {
    for (const share of [0, 1]) {
      places.push(x, y, 0);
      normals.push(...outwards[i], 0);
      shares.push(share);
    }
    const next = (i + 1) % loop.length;
    index.push(2 * i, 2 * next, 2 * i + 1, 2 * i + 1, 2 * next, 2 * next + 1);
  });
  const geometry = new THREE.BufferGeometry().setIndex(index);
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  geometry.setAttribute("aShare", new THREE.Float32BufferAttribute(shares, 1));
  const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
    ...ON_SEA,
    uniforms: { ...ON_SEA_UNIFORMS, uPose, uHeight: { value: height }, uHull: { value: new THREE.Color(hull).multiplyScalar(LIT) } },
    vertexShader: /* glsl */ `
      attribute float aShare;
      uniform vec4 uPose;
      uniform float uHeight;
      uniform vec3 uHull;
      varying vec3 vHull;
      varying vec2 vLook; // share of the way to the image of the deck, opacity
      ${ON_SEA_HEAD}
      void main() {
        mat2 toWorld = mat2(uPose.zw, vec2(-uPose.w, uPose.z));
        vec2 place = uPose.xy + toWorld * position.xy, toEye = cameraPosition.xz - place;
        float far = max(length(toEye), 1.0), reach = min(far * uHeight / (uHeight + cameraPosition.y), ${FARTHEST.toFixed(1)} * uHeight);
        toEye /= far;
        place += toEye * (reach * aShare);
        vHull = finish(mix(uHorizon, uHull * uFoam, clearAt(far)));
        vLook = vec2(aShare, ${STRONGEST.toFixed(2)} * smoothstep(-0.05, 0.3, dot(toWorld * normal.xy, toEye)));
        gl_Position = onSea(place, 0.0);
      }`,
    fragmentShader: /* glsl */ `
      uniform sampler2D uRipples;
      varying vec2 vWaves, vLook;
      varying vec3 vHull;
      void main() {
        float left = 1.0 - vLook.x, broken = 0.6 + 0.8 * texture2D(uRipples, vWaves).b;
        float opacity = vLook.y * min(1.0, left * (0.6 + 0.6 * left) * broken * 1.3);
        gl_FragColor = vec4(opacity * vHull, opacity);
      }`,
  }));
  mesh.renderOrder = -4.5; // under the foam
  mesh.frustumCulled = false;
  return mesh;
}
