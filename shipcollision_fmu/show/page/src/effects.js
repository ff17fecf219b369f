// Explosion, debris, fire, smoke, dust and splash. Every particle's place is a function of the time since the effect began and of its
// own random numbers, which follow from the effect's seed: the slider scrubs both ways, and every page shows the same.
// All in the ship's b (forward, starboard, down), so that effects move with the ship. Colours are finished at the corners, and
// shapes are read from textures, so that a picture costs little without a graphics card.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { MOTION, MOTION_GLSL } from "./effect_motions.js";
import { FINISH_GLSL } from "./finish.js";
import { countFlames, FLAME_FRAGMENT, FLAME_VERTEX } from "./flames.js";
import { findPuffs, findTurbulence } from "./puffs.js";
import { randomNumbers } from "./random.js";

const COUNT = { explosion: 64, debris: 130, smoke: 130, dust: 56, splash: 120 }; // at an intensity of 0.46, that of 100 MJ
const PLAIN = 0.55; // of flames and puffs that glow or smoke long, in the plain picture
const LINGER = { explosion: 3, debris: 9, fire: 2, smoke: 16, dust: 1.4, splash: 1.7 }; // after the last particle is sent out [s]

const NEARER = { explosion: 1.6, dust: 1.6, smoke: 0.8 };
const LIFT = 0.4; // of the deck's height above the water
const DRIFTS = ["fire", "smoke"]; // with the wind past the ship

const vertexShader = (motion) => /* glsl */ `
  ${MOTION_GLSL}
  ${FINISH_GLSL}
  uniform float uNearer; // [size]
  varying vec2 vCorner;
  varying vec4 vColour; // colour, opacity
  varying float vGlow, vSeed, vUp, vWorn; // vUp: of the corner, upright in the picture
  varying float vHeight; // above the water, over the depth in which a puff begins to show
  void main() {
    vec3 place = vec3(0.0), velocity = vec3(0.0);
    float radius = 0.0;
    vWorn = 0.0;
    vCorner = position.xy;
    vSeed = aSeed.x + 3.0 * aSeed.y;
    ${motion}
    vColour.rgb = finish(vColour.rgb);
    vec4 view = modelViewMatrix * vec4(place, 1.0);
    // It bursts out of the plating: drawn nearer to the eye by what a bow or a bulwark beside it takes up.
    float nearer = 1.0 - min(uNearer * uSize / length(view.xyz), 0.5);
    view.xyz *= nearer;
    float spin = 6.2831853 * aSeed.w + (aSeed.z - 0.5) * 0.4 * uAge;
    vec2 corner = mat2(cos(spin), sin(spin), -sin(spin), cos(spin)) * position.xy * radius;
    #ifdef PIECES // drawn out along their way while they glow, tumbling later
      vec2 way = (modelViewMatrix * vec4(velocity, 0.0)).xy;
      corner = mix(corner * (0.5 + abs(sin(7.0 * uAge + 40.0 * aSeed.z))), mat2(way, vec2(-way.y, way.x) / (length(way) + 1.0)) * position.xy * vec2(0.03, 0.8 * radius), min(1.0, 1.5 * vGlow));
    #endif
    vUp = corner.y / max(radius, 1e-3);
    vHeight = ((modelMatrix * vec4(place, 1.0)).y + corner.y) / (0.35 * radius + 0.4);
    view.xy += corner * nearer;
    gl_Position = radius > 0.0 ? projectionMatrix * view : vec4(2.0, 2.0, 2.0, 1.0);
  }`;

const PUFF = /* glsl */ `
  uniform sampler2D uPuff;
  varying vec2 vCorner;
  varying vec4 vColour;
  varying float vGlow, vSeed, vUp, vWorn, vHeight;
  void main() {
    vec2 puff = texture2D(uPuff, 0.5 * (0.5 + 0.5 * vCorner) + 0.5 * vec2(step(0.5, fract(vSeed)), step(0.5, fract(7.0 * vSeed)))).rg;
    float dense = smoothstep(0.5 * vWorn, 1.0, puff.r); // thin air is eaten away first, in wisps
    float opacity = vColour.a * dense * clamp(vHeight, 0.0, 1.0); // soft at the water
    vec3 shade = vec3(0.92 + 0.16 * vUp + 0.5 * (puff.g - 0.5)); // billows are lit from above
    vec3 colour = vColour.rgb * mix(shade, vec3(1.0, 0.45 + 0.55 * dense, 0.3 + 0.7 * dense), vGlow); // redder at the rim
    gl_FragColor = vec4(colour * opacity, opacity * (1.0 - vGlow)); // premultiplied
  }`;

const PIECE = /* glsl */ `
  varying vec2 vCorner;
  varying vec4 vColour;
  varying float vGlow;
  void main() {
    if (abs(vCorner.x) * 1.3 + abs(vCorner.y) > 0.95) discard;
    gl_FragColor = vec4(vColour.rgb, 1.0 - vGlow);
  }`;

const quad = new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]);

/** Where an effect bursts out, in b: between deck and water, above a contact point that lies lower. */
export const burstOf = ({ kind, point: [x, y, z] }, { height }) => [x, y, kind === "splash" ? z : Math.min(z, -LIFT * height)];

function makeEffect(effect, info) {
  const { kind } = effect, isFire = kind === "fire";
  const point = burstOf(effect, info);
  const [flames, embers] = countFlames(effect.intensity);
  const count = isFire ? flames + embers : Math.max(8, Math.round(COUNT[kind] * Math.min(1, 1.47 * Math.sqrt(effect.intensity))));
  const geometry = new THREE.InstancedBufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(quad, 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const seeds = Float32Array.from({ length: 4 * count }, randomNumbers(effect.seed + 1));
  geometry.setAttribute("aSeed", new THREE.InstancedBufferAttribute(seeds, 4));
  const most = [count, isFire ? Math.round(PLAIN * flames) : kind === "smoke" ? Math.round(PLAIN * count) : count]; // full, plain
  const material = new THREE.ShaderMaterial({
    uniforms: {
      uPuff: { value: findPuffs() },
      uNoise: { value: findTurbulence() },
      uLit: LIGHT.uLit,
      uDrift: { value: new THREE.Vector3() },
      uAge: { value: 0 },
      uNearer: { value: NEARER[kind] ?? 0 },
      uDuration: { value: effect.duration },
      uSize: { value: effect.size },
      uHeight: { value: -point[2] },
      uDeck: { value: Math.max(0, info.height + point[2]) },
      uFlames: { value: flames },
      uOut: { value: new THREE.Vector3(...effect.outwards) },
    },
    defines: kind === "debris" ? { PIECES: "" } : {},
    vertexShader: isFire ? FLAME_VERTEX : vertexShader(MOTION[kind]),
    fragmentShader: isFire ? FLAME_FRAGMENT : kind === "debris" ? PIECE : PUFF,
    toneMapped: false,
    depthWrite: false,
    transparent: true,
    blending: THREE.CustomBlending,
    blendSrc: THREE.OneFactor,
    blendDst: THREE.OneMinusSrcAlphaFactor,
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.position.fromArray(point);
  mesh.renderOrder = { splash: 1, dust: 1, smoke: 1, explosion: 1.8, fire: 2, debris: 3 }[kind];
  return { mesh, material, most };
}

const BEFORE = 2; // [s] over which a ship's speed is taken

/** Velocity of the air past a ship, in its b [m/s]: `wind` in n less the ship's own, as of the seconds before. */
function findDrift({ node, track }, wind, sinceStart, drift) {
  const [now, before, turn] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Quaternion()];
  track.at(sinceStart - BEFORE, before, turn);
  track.at(sinceStart, now, turn);
  drift.set(wind[0], wind[1], 0).sub(now.sub(before).divideScalar(BEFORE).setZ(0));
  return drift.applyQuaternion(node.quaternion.clone().invert());
}

/** Adds all effects to their ships, [{node, info, track}]; `show(time)` says how many are at work, `remove()` takes them away. */
export function addEffects(effects, ships, start = 0) {
  const made = effects.map((effect) => {
    const ship = ships.find(({ info }) => info.name === effect.ship);
    const one = makeEffect(effect, ship.info);
    ship.node.add(one.mesh);
    return { effect, ship, ...one };
  });
  return {
    show(time, isPlain = false, wind = [0, 0]) {
      let active = 0;
      for (const { effect, ship, mesh, material, most } of made) {
        mesh.geometry.instanceCount = most[Number(isPlain)];
        const age = time - effect.time;
        mesh.visible = age > 0 && age < effect.duration + LINGER[effect.kind];
        material.uniforms.uAge.value = age;
        if (mesh.visible && DRIFTS.includes(effect.kind)) findDrift(ship, wind, time - start, material.uniforms.uDrift.value);
        active += mesh.visible;
      }
      return active;
    },
    remove() {
      for (const { ship, mesh, material } of made) {
        ship.node.remove(mesh);
        for (const one of [mesh.geometry, material]) one.dispose();
      }
    },
  };
}
