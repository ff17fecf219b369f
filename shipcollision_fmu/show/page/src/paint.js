// What makes paint look like paint: plates that differ a little, weather, shade below decks and flare, the sky in what is
// smooth, and at night lamps on the house. The plain picture takes what a corner can have of it, the full one all.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { addPanels, CONTAINER, PANE, PANE_GLOW, PANEL_FRAGMENT, PANEL_SET, PANEL_VERTEX } from "./panel_paint.js";
import { PLATING } from "./plating.js";
import { SKY_GLSL } from "./sky.js";

const TIER = 2.75; // [m] height of a tier of a house on ships broader than 9 m
const HOUSES = ["house", "grey"];
const WALLS = ["house", "grey", "trim", "funnel", "lifeboat", "mast"]; // lamps along the decks shine on these
const PLATED = ["topsides", "naval", "stripe", "boot-top", "antifouling"];

export const isWall = ({ name }) => WALLS.includes(name);
export const isPlated = ({ name }) => PLATED.some((paint) => name.startsWith(paint));

/** Floodlights on the house, before and abaft it, and the light of lamps along its decks: irradiance over pi. */
export const LAMPS_GLSL = /* glsl */ `
  uniform vec4 uFloods[2]; // place in b, and how far they reach [m]
  const vec3 WARM = vec3(1.0, 0.72, 0.38);
  float floodsAt(vec3 p, vec3 n) {
    float sum = 0.0;
    for (int i = 0; i < 2; i++) {
      vec3 to = uFloods[i].xyz - p;
      float far = length(to), reach = far / uFloods[i].w;
      float beam = smoothstep(-1.0, 4.0, i == 0 ? -to.x : to.x);
      sum += beam * max(dot(n, to) / far, 0.0) / (1.0 + reach * reach);
    }
    return sum;
  }
`;

/** In the dark the eye sees less of a colour, of paint as of the moon's blue light. */
export const DIM_GLSL = /* glsl */ `
  const vec3 UNBLUED = vec3(1.12, 1.0, 0.87);
  vec3 whiten(vec3 light) { return light * mix(vec3(1.0), UNBLUED, uLamps); }
  vec3 dim(vec3 colour) { return mix(colour, vec3(dot(colour, vec3(0.2126, 0.7152, 0.0722))), 0.35 * uLamps); }
`;

/** Share of the light from all around that a surface has: less below, where decks and flare are over it. */
export const SHADE_GLSL = /* glsl */ `
  float shadeOf(vec3 n, float height, float isPlate) { return (0.68 + 0.32 * smoothstep(0.55, -0.15, n.z)) * mix(1.0, 0.80 + 0.20 * smoothstep(-0.5, 5.0, height), isPlate); }
`;

/** uFloods of a ship: two lamps at the top of its house, [x, y, z, reach]; they reach nowhere on a ship without one. */
export function findFloods(meshes) {
  const box = new THREE.Box3();
  for (const mesh of meshes) {
    if (!HOUSES.includes(mesh.material.name)) continue;
    mesh.geometry.computeBoundingBox();
    if (mesh.parent?.name !== "hull") box.union(mesh.geometry.boundingBox);
  }
  if (box.isEmpty()) return { value: [new THREE.Vector4(0, 0, 0, 0.01), new THREE.Vector4(0, 0, 0, 0.01)] };
  const { min, max } = box, height = max.z - min.z, z = min.z + 0.25 * height;
  const reach = Math.max(4, 1.1 * height);
  return { value: [new THREE.Vector4(max.x + 0.5, 0, z, reach), new THREE.Vector4(min.x - 0.5, 0, z, reach)] };
}

const VERTEX = /* glsl */ `
  varying vec3 vB, vBNormal;
  #if defined(CONTAINER) || defined(PANE)
  ${PANEL_VERTEX}
  #endif
  #include <common>`;

const FRAGMENT = /* glsl */ `
  varying vec3 vB, vBNormal;
  #if defined(CONTAINER) || defined(PANE)
  ${PANEL_FRAGMENT}
  #endif
  uniform float uLamps, uUnit, uWall, uPlated, uTop;
  uniform vec3 uDeep, uScatter;
  ${SKY_GLSL}
  ${LAMPS_GLSL}
  ${SHADE_GLSL}
  ${DIM_GLSL}
  float hash(vec2 p) { p = fract(p * vec2(0.1031, 0.1030)); p += dot(p, p.yx + 33.33); return fract((p.x + p.y) * p.x); }
  float noise(vec2 p) {
    vec2 i = floor(p), f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
  }
  #include <common>`;

const WEATHER = /* glsl */ `
  #include <color_fragment>
  vec3 bNormal = normalize(vBNormal);
  float side = abs(bNormal.y) > abs(bNormal.x) ? vB.x : vB.y; // along the plating
  float high = -vB.z;
  vec2 flat_ = abs(bNormal.z) > 0.7 ? vB.xy : vec2(side, high);
  float seen = 1.0 - smoothstep(0.1, 0.6, fwidth(flat_.x) + fwidth(flat_.y));
  float cloudy = noise(flat_ * vec2(0.10, 0.22) + 7.0) - 0.5;
  float streaks = noise(flat_ * vec2(3.1, 0.10)) * noise(flat_ * vec2(0.31, 0.07) + 3.0);
  vec2 plate = flat_ / vec2(9.0, 2.4);
  plate.x += 0.5 * mod(floor(plate.y), 2.0);
  float tint = hash(floor(plate) + 17.0) - 0.5;
  vec2 edge = abs(fract(plate) - 0.5) * vec2(9.0, 2.4);
  float seam = max(smoothstep(0.06, 0.0, 4.5 - edge.x), smoothstep(0.05, 0.0, 1.2 - edge.y));
  diffuseColor.rgb *= 1.0 + mix(0.05, 0.10, uPlated) * cloudy + uPlated * (0.10 * tint - 0.16 * seen * seam);
  float rust = (0.25 + 0.75 * uPlated) * smoothstep(0.42, 0.80, streaks) * 0.26;
  diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.13, 0.065, 0.035), rust * seen);
  ${PLATING}
  #ifdef CONTAINER
  ${CONTAINER}
  #endif
  #ifdef PANE
  ${PANE}
  #endif
  float wet = uPlated * smoothstep(1.3, 0.2, (high + 0.5 * cloudy) * clamp(8.0 / uTop, 1.0, 4.0));
  diffuseColor.rgb = dim(diffuseColor.rgb) * (1.0 - 0.25 * wet);`;

const ROUGH = /* glsl */ `
  #include <roughnessmap_fragment>
  roughnessFactor = clamp(roughnessFactor + 0.25 * cloudy - 0.25 * wet, 0.12, 1.0);
  #ifdef PANE
  roughnessFactor = mix(0.6, 0.05, glass);
  #endif`;

const METAL = /* glsl */ `
  #include <metalnessmap_fragment>
  #ifdef PANE
  metalnessFactor = 0.0; // what a pane mirrors is added with the lights
  #endif`;

const GLOW = /* glsl */ `
  #ifdef PANE
  ${PANE_GLOW}
  #endif`;

const LIGHTS = /* glsl */ `
  #include <lights_fragment_end>
  float tier = fract((high - uTop) / (${TIER} * uUnit));
  float shade = shadeOf(bNormal, high, uPlated);
  reflectedLight.indirectDiffuse = whiten(reflectedLight.indirectDiffuse) * shade;
  reflectedLight.directDiffuse = whiten(reflectedLight.directDiffuse);
  vec3 out_ = inverseTransformDirection(reflect(-geometryViewDir, normal), viewMatrix);
  vec3 mirrored = out_.y > 0.0 ? skyAt(out_, 3.5 + 4.5 * roughnessFactor) : mix(skyAt(vec3(out_.x, 0.02, out_.z), 5.0), uDeep + uScatter, 0.75);
  float gloss = 1.0 - roughnessFactor;
  float edge_ = pow(1.0 - max(dot(normal, geometryViewDir), 0.0), 5.0);
  #ifdef PANE
  reflectedLight.indirectSpecular += mirrored * mix(0.02, 0.06 + 0.85 * edge_, glass);
  #else
  reflectedLight.indirectSpecular += mirrored * shade * (0.03 + 0.55 * edge_ * gloss) * (0.35 + gloss);
  #endif
  if (uLamps > 0.0) {
    float along = (fract(side / 7.0) - 0.5) * 7.0, below = abs(bNormal.z) < 0.7 ? 1.0 : 0.3;
    float lamp = uWall * below * (0.13 + 0.13 * exp(-0.12 * along * along) * smoothstep(0.0, 1.0, tier));
    reflectedLight.directDiffuse += diffuseColor.rgb * WARM * uLamps * (lamp + 0.55 * floodsAt(vB, bNormal));
  }`;

/**
 * Gives the materials of a ship, one copy for each ship, their paint; `top`: height of its deck [m]; `skyUniforms`: those of
 * whoever mirrors the sky.
 */
export function paintShip(node, unit, top, skyUniforms) {
  const meshes = [], copies = new Map();
  node.traverse((mesh) => mesh.isMesh && mesh.material.isMeshStandardMaterial && mesh.userData.scratch === undefined && mesh.material.name !== "scratch" && meshes.push(mesh));
  const uFloods = findFloods(meshes);
  for (const mesh of meshes) {
    if (!copies.has(mesh.material)) copies.set(mesh.material, weather(mesh.material.clone(), { uFloods, uUnit: { value: unit }, uTop: { value: top }, ...skyUniforms }));
    mesh.material = copies.get(mesh.material);
    if ("CONTAINER" in mesh.material.defines || "PANE" in mesh.material.defines) addPanels(mesh.geometry);
  }
  return uFloods;
}

function weather(material, uniforms) {
  const own = { uWall: { value: isWall(material) ? 1 : 0 }, uPlated: { value: isPlated(material) ? 1 : 0 } };
  if (material.name.startsWith("container")) material.defines.CONTAINER = "";
  if (material.name === "windows") material.defines.PANE = "";
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, { ...LIGHT, ...uniforms, ...own });
    shader.vertexShader = shader.vertexShader.replace("#include <common>", VERTEX)
      .replace("#include <begin_vertex>", `#include <begin_vertex>\n  vB = position;\n  vBNormal = normal;\n  #if defined(CONTAINER) || defined(PANE)\n  ${PANEL_SET}\n  #endif`);
    shader.fragmentShader = shader.fragmentShader.replace("#include <common>", FRAGMENT)
      .replace("#include <color_fragment>", WEATHER)
      .replace("#include <roughnessmap_fragment>", ROUGH)
      .replace("#include <metalnessmap_fragment>", METAL)
      .replace("#include <emissivemap_fragment>", GLOW)
      .replace("#include <lights_fragment_end>", LIGHTS);
  };
  return material;
}
