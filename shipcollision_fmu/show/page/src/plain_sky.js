// The sky of the plain picture: a dome whose corners know their place in the baked sky, so that a pixel is one look at a
// texture of finished colours, and a small disc for sun or moon. It is drawn last, where nothing stands before it.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { FINISH_GLSL } from "./finish.js";

const COLUMNS = 64, ROWS = 20;
const REACH = 0.1; // of the disc with its glow [rad]

const PLACE_GLSL = /* glsl */ `
  vec4 placeOf(vec3 direction) {
    vec4 place = projectionMatrix * mat4(mat3(viewMatrix)) * vec4(direction, 1.0);
    return place.xyww; // behind everything
  }
`;

/** From a little below the horizon up, with the texture's coordinates: bearing, and root of the height. */
function makeDome() {
  const places = [], uvs = [], index = [];
  for (let i = 0; i <= ROWS; i++) {
    const v = Math.max(0, i - 1) / (ROWS - 1), y = i ? v * v : -0.1, flat = Math.sqrt(Math.max(0, 1 - y * y));
    for (let j = 0; j <= COLUMNS; j++) {
      const angle = 2 * Math.PI * (j / COLUMNS - 0.5);
      places.push(flat * Math.cos(angle), y, flat * Math.sin(angle));
      uvs.push(j / COLUMNS, v);
    }
  }
  for (let i = 0; i < ROWS; i++) {
    for (let j = 0; j < COLUMNS; j++) {
      const at = i * (COLUMNS + 1) + j, over = at + COLUMNS + 1;
      index.push(at, at + 1, over, over, at + 1, over + 1);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("uv", new THREE.Float32BufferAttribute(uvs, 2));
  return geometry.setIndex(index);
}

/** Nodes of the plain sky; `baked`: texture of the upper half of all directions, in finished colours. */
export function makePlainSky(baked) {
  const dome = new THREE.Mesh(makeDome(), new THREE.ShaderMaterial({
    uniforms: { uBaked: { value: baked } }, side: THREE.DoubleSide, depthWrite: false, toneMapped: false,
    vertexShader: /* glsl */ `
      varying vec2 vUv;
      ${PLACE_GLSL}
      void main() { vUv = uv; gl_Position = placeOf(position); }`,
    fragmentShader: /* glsl */ `
      uniform sampler2D uBaked;
      varying vec2 vUv;
      void main() { gl_FragColor = vec4(texture2D(uBaked, vUv).rgb, 1.0); }`,
  }));
  dome.renderOrder = 10;
  const disc = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new THREE.ShaderMaterial({
    uniforms: LIGHT, transparent: true, depthWrite: false, toneMapped: false, side: THREE.DoubleSide,
    vertexShader: /* glsl */ `
      uniform vec3 uSun, uDisc;
      uniform float uShine;
      varying vec2 vCorner;
      varying vec3 vLight;
      ${FINISH_GLSL}
      ${PLACE_GLSL}
      void main() {
        vCorner = position.xy;
        vLight = finish(1.7 * uDisc * uShine);
        vec3 across = normalize(cross(uSun, vec3(0.0, 1.0, 0.0))), up = cross(across, uSun);
        gl_Position = placeOf(normalize(uSun + ${REACH} * (position.x * across + position.y * up)));
      }`,
    fragmentShader: /* glsl */ `
      uniform float uShine;
      varying vec2 vCorner;
      varying vec3 vLight;
      void main() {
        float r = length(vCorner) * ${REACH};
        float glow = max(0.0, 1.0 - r / ${REACH});
        float opacity = max(smoothstep(0.0114, 0.0095, r), min(0.5, 0.16 * uShine) * glow * glow * glow);
        gl_FragColor = vec4(vLight, opacity);
      }`,
  }));
  disc.renderOrder = -8;
  for (const node of [dome, disc]) node.frustumCulled = false;
  return [dome, disc];
}
