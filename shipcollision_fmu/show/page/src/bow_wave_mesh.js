// The bow wave as it stands in the picture: water raised on both sides of the stem, opaque down to the sea, so that no hull
// shows below its crest, and white where it breaks. The foam on it stays where the water is: it streams aft along the ship.
import * as THREE from "three";
import { findEntrance, findRidge, heightOf, measureBowWave, opacityOf, pointOn, traceSide, whitenessOf } from "./bow_wave.js";
import { ON_SEA, ON_SEA_HEAD, ON_SEA_UNIFORMS } from "./on_sea.js";

/** Sections: from the stem, in distances of the crest from it; and across: from the ridge, in its widths. */
const ALONG = [-0.7, -0.45, -0.2, 0, 0.25, 0.5, 0.75, 1, 1.4, 1.9, 2.5, 3.2, 4, 5, 6.2, 7.6, 9.2, 11, 13, 15.5, 18];
const ACROSS = [-2.4, -1.4, -0.7, -0.25, 0.1, 0.5, 0.9, 1.4, 2.1];
const INSIDE = 0.35; // so far inside the plating the sheet begins [m]
const SUNK = 0.1; // and so far under the sea it ends [m]

/** `outline`: {x, port, starboard} as waterline.js has it; `flow`: velocity of midship in b: ahead, to starboard [m/s], turn [rad/s]. */
export function makeBowWave({ x, port, starboard }, draught) {
  const sides = [[starboard, 1], [port, -1]].map(([half, sign]) => {
    const side = traceSide(x, half);
    return [side, sign, findEntrance(side)];
  });
  const rows = ALONG.length, columns = ACROSS.length + 1, each = rows * columns;
  const places = new Float32Array(2 * each * 3), looks = new Float32Array(2 * each * 2);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setAttribute("aLook", new THREE.BufferAttribute(looks, 2)); // how white, how opaque
  const index = [];
  for (const first of [0, each]) {
    for (let i = 0; i + 1 < rows; i++) {
      for (let k = 0; k + 1 < columns; k++) {
        const a = first + i * columns + k, b = a + columns;
        index.push(a, b, a + 1, a + 1, b, b + 1);
      }
    }
  }
  geometry.setIndex(index);
  const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
    ...ON_SEA, uniforms: ON_SEA_UNIFORMS,
    vertexShader: /* glsl */ `
      attribute vec2 aLook;
      varying vec2 vLook, vPlace;
      varying vec3 vBody;
      ${ON_SEA_HEAD}
      void main() {
        vLook = aLook;
        vBody = waterAt(position.xz, position.y);
        vPlace = position.xz;
        gl_Position = onSea(position.xz, position.y);
      }`,
    fragmentShader: /* glsl */ `
      uniform sampler2D uRipples;
      varying vec2 vLook, vPlace;
      varying vec3 vWhite, vGreen, vBody;
      void main() {
        float net = 0.55 * texture2D(uRipples, vPlace / 5.0).b + 0.45 * texture2D(uRipples, vPlace.yx / 17.0).b;
        float white = smoothstep(0.25, 0.85, 1.5 * vLook.x - 0.5 + net);
        float ruffled = texture2D(uRipples, vPlace / 11.0).r - 0.5;
        vec3 colour = mix(mix(vBody, vGreen, 0.3 * vLook.x) * (1.0 + 0.9 * ruffled), vWhite * (0.72 + 0.36 * net), white);
        gl_FragColor = vLook.y * vec4(colour, 1.0);
      }`,
  }));
  mesh.frustumCulled = false;
  mesh.renderOrder = -4;

  /** `pose`: of midship in the page's world [x, z], and cosine and sine of the heading. */
  function update([px, pz, c, s], [ahead, sway, turn]) {
    let highest = 0;
    sides.forEach(([side, sign, entrance], j) => {
      const atBow = sway + turn * side[0].along;
      const drift = Math.atan2(sign * atBow, Math.max(ahead, 0.5)); // towards this side
      const wave = measureBowWave(ahead, draught, entrance + drift);
      highest = Math.max(highest, wave.height);
      const end = 0.45 * side.at(-1).s;
      ALONG.forEach((share, i) => {
        const from = share * wave.crest, length = Math.min(from, end);
        const { point, normal } = pointOn(side, Math.max(length, 0), 0.5 + 0.4 * wave.crest);
        const ridge = findRidge(wave, from), ending = i + 1 === rows || from > end ? 0 : 1;
        const along = point[0] - Math.min(length, 0); // before the stem
        [-INSIDE, ...ACROSS.map((k) => Math.max(-INSIDE, ridge.distance + k * ridge.width))].forEach((out, k) => {
          const height = ending * heightOf(wave, from, Math.max(out, 0));
          const at = j * each + i * columns + k;
          const [a, b] = [along + out * normal[0], sign * (point[1] + out * normal[1])];
          places.set([px + c * a - s * b, k + 1 === columns ? -SUNK : height - 0.02, pz + s * a + c * b], 3 * at);
          looks.set([whitenessOf(wave, from, out), opacityOf(height)], 2 * at);
        });
      });
    });
    mesh.visible = highest > 0.05;
    geometry.attributes.position.needsUpdate = true;
    geometry.attributes.aLook.needsUpdate = true;
  }

  return { mesh, update };
}
