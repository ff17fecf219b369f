// Explosion, debris, fire, smoke, dust and splash. Every particle's place is a function of the time since the effect began and of its
// own random numbers, which follow from the effect's seed: the slider scrubs both ways, and every page shows the same.
// All in the ship's b (forward, starboard, down), so that effects move with the ship.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { FINISH_GLSL } from "./finish.js";
import { randomNumbers } from "./random.js";

const COUNT = { explosion: 64, debris: 90, fire: 84, smoke: 120, dust: 56, splash: 120 };
const LINGER = { explosion: 3, debris: 9, fire: 2, smoke: 16, dust: 1.4, splash: 1.7 }; // after the last particle is sent out [s]

const NEARER = { explosion: 2.5, fire: 1.6, dust: 1.6, smoke: 0.8 };
const LIFT = 0.4; // of the deck's height above the water
const DRIFTS = ["fire", "smoke"]; // with the wind past the ship
const STRETCH = { fire: 1.5 }; // of a puff, upright: tongues, which do not turn

const COMMON = /* glsl */ `
  attribute vec4 aSeed;
  uniform float uAge, uDuration, uSize, uHeight;
  uniform vec3 uOut, uLit, uDrift; // uDrift: of the air past the ship, in b [m/s]
  uniform float uNearer, uStretch; // [size], and of a puff upright
  varying vec2 vCorner;
  varying vec4 vColour;   // colour, opacity
  varying float vGlow;    // 1: light, 0: paint
  varying float vSeed;
  varying float vHeight;  // above the water, over the depth in which a puff begins to show
  const vec3 UP = vec3(0.0, 0.0, -1.0);
  vec3 onSphere(vec2 s) {
    float z = 2.0 * s.x - 1.0, a = 6.2831853 * s.y;
    return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(a), sin(a)), z);
  }
  vec3 heat(float a) {
    vec3 hot = mix(vec3(1.5, 0.98, 0.46), vec3(1.05, 0.36, 0.05), smoothstep(0.0, 0.3, a));
    return mix(mix(hot, vec3(0.36, 0.05, 0.012), smoothstep(0.3, 0.62, a)), vec3(0.05, 0.045, 0.042), smoothstep(0.55, 0.9, a));
  }
`;

// Each sets: place (in b, from the effect's point), radius [m], vColour, vGlow; radius 0 hides the particle.
const MOTION = {
  explosion: /* glsl */ `
    float life = 1.0 + 1.6 * aSeed.y;
    float a = (uAge - 0.18 * aSeed.x) / life;
    vec3 direction = normalize(onSphere(aSeed.zw) + 0.8 * uOut + 0.5 * UP);
    float push = 1.0 - exp(-3.5 * a);
    place = direction * uSize * (0.3 + 2.6 * aSeed.x) * push + UP * uSize * 1.2 * a * a;
    radius = uSize * (0.45 + 1.25 * sqrt(max(a, 0.0))) * (0.6 + 0.7 * aSeed.z);
    vColour = vec4(heat(0.08 + 0.92 * a + 0.15 * aSeed.x), 0.7 * (1.0 - a) * smoothstep(0.0, 0.03, a));
    vGlow = 0.9 * (1.0 - smoothstep(0.2, 0.55, a));
    if (a <= 0.0 || a >= 1.0) radius = 0.0;`,
  debris: /* glsl */ `
    float age = uAge - 0.1 * aSeed.x;
    vec3 direction = normalize(0.9 * onSphere(aSeed.zw) + 1.1 * uOut + 0.9 * UP);
    vec3 velocity = direction * uSize * (0.8 + 3.2 * aSeed.y * aSeed.y) * (1.0 / (1.0 + 0.08 * age));
    place = velocity * age - UP * 4.905 * age * age;
    radius = uSize * (0.03 + 0.07 * aSeed.x);
    float cool = smoothstep(0.0, 1.6, age);
    vColour = vec4(mix(vec3(2.0, 0.7, 0.15), vec3(0.06, 0.055, 0.05), cool), 1.0);
    vGlow = 0.7 * (1.0 - cool);
    if (age <= 0.0 || dot(place, UP) < -uHeight) radius = 0.0;`,
  fire: /* glsl */ `
    float life = 0.75 + 0.8 * aSeed.y;
    float turn = floor((uAge - aSeed.x * life) / life);
    float birth = (turn + aSeed.x) * life;
    float a = (uAge - birth) / life;
    float wild = fract(aSeed.z + turn * 0.618);
    vec3 around = onSphere(vec2(wild, aSeed.w));
    float reach = 0.7 + 0.6 * aSeed.w; // some tongues are longer
    float narrow = 1.0 - 0.8 * a;
    place = uSize * vec3(0.8 * around.xy, 0.3 * around.z) * narrow + 0.2 * uSize * uOut + UP * uSize * (0.1 + 2.3 * reach * pow(a, 0.85))
          + 0.3 * uSize * a * vec3(sin(5.0 * a + 9.0 * wild + 1.7 * uAge), cos(4.0 * a + 7.0 * aSeed.w + 1.3 * uAge), 0.0) + uDrift * 0.5 * a * a * life;
    radius = uSize * mix(0.62, 0.14, a) * (0.55 + 0.55 * aSeed.w);
    vColour = vec4(heat(0.75 * a + 0.12 * length(around.xy)), 0.5 * (1.0 - a * a) * smoothstep(0.0, 0.12, a));
    vGlow = 0.85 - 0.5 * a;
    float fade = 1.0 - smoothstep(0.6, 1.0, birth / uDuration);
    radius *= 0.35 + 0.65 * fade;
    if (birth < 0.0 || birth > uDuration) radius = 0.0;`,
  smoke: /* glsl */ `
    float life = 9.0 + 6.0 * aSeed.y;
    float turn = floor((uAge - aSeed.x * life) / life);
    float birth = (turn + aSeed.x) * life;
    float age = uAge - birth, a = age / life;
    float wild = fract(aSeed.z + turn * 0.618);
    vec3 around = onSphere(vec2(wild, aSeed.w));
    float fire = 1.0 - smoothstep(0.35, 0.5, birth / uDuration); // below
    place = 0.4 * uSize * around + 0.2 * uSize * uOut + UP * uSize * (0.5 + 0.8 * fire)
          + uSize * UP * 9.0 * pow(a, 0.75) + uDrift * (age - 1.5 + 1.5 * exp(-age / 1.5))
          + uSize * a * (1.3 * vec3(sin(5.0 * a + 12.0 * wild), cos(4.0 * a + 8.0 * aSeed.w), around.z) + 0.8 * vec3(sin(9.0 * a - 5.0 * aSeed.w), cos(11.0 * a + 6.0 * wild), 0.0));
    radius = uSize * (0.55 + 3.2 * a) * (0.6 + 0.7 * aSeed.w);
    float grey = mix(0.012, 0.30, smoothstep(0.0, 0.9, a)) * (0.6 + 0.8 * wild);
    vec3 lit = grey * uLit * (0.8 + 0.35 * around.z * -1.0) + fire * vec3(0.62, 0.17, 0.03) * (0.55 * exp(-10.0 * a));
    vColour = vec4(lit, 0.5 * pow(1.0 - a, 1.3) * smoothstep(0.0, 0.07, a));
    vGlow = 0.0;
    if (birth < 0.0 || birth > uDuration) radius = 0.0;`,
  dust: /* glsl */ `
    float life = 1.0 + 0.8 * aSeed.y;
    float a = (uAge - 0.5 * aSeed.x * uDuration) / life;
    vec3 direction = normalize(onSphere(aSeed.zw) * vec3(1.0, 1.0, 0.6) + 0.9 * uOut);
    place = direction * uSize * (0.4 + 1.6 * aSeed.y) * (1.0 - exp(-3.0 * a)) + UP * uSize * 0.5 * a;
    radius = uSize * (0.25 + 1.0 * sqrt(max(a, 0.0))) * (0.5 + 0.6 * aSeed.z);
    vColour = vec4(uLit * vec3(0.50, 0.42, 0.36) * (0.6 + 0.6 * aSeed.w), 0.42 * (1.0 - a) * smoothstep(0.0, 0.06, a));
    vGlow = 0.0;
    if (a <= 0.0 || a >= 1.0) radius = 0.0;`,
  splash: /* glsl */ `
    float life = 1.5 + 0.9 * aSeed.y;
    float age = uAge - 0.6 * aSeed.x * uDuration, a = age / life;
    vec3 along = normalize(cross(uOut, UP) + 1e-4);
    vec3 from = UP * -uHeight + uOut * uSize * 0.12 + along * uSize * (aSeed.z - 0.5) * 2.2;
    vec3 velocity = UP * (4.0 + 1.5 * uSize * aSeed.y) + uOut * uSize * (0.15 + 0.6 * aSeed.w) + along * uSize * (aSeed.z - 0.5) * 0.8;
    place = from + velocity * age * (1.0 - 0.18 * a) - UP * 4.905 * age * age * 0.85;
    radius = (0.35 + 0.16 * uSize * (0.4 + aSeed.x)) * (0.35 + 1.1 * a);
    vColour = vec4(uLit * 0.95, 0.6 * (1.0 - a) * smoothstep(0.0, 0.05, a));
    vGlow = 0.0;
    if (a <= 0.0 || a >= 1.0 || dot(place, UP) < -uHeight - 0.5) radius = 0.0;`,
};

const vertexShader = (motion) => /* glsl */ `
  ${COMMON}
  void main() {
    vec3 place = vec3(0.0);
    float radius = 0.0;
    vCorner = position.xy;
    vSeed = aSeed.x + 3.0 * aSeed.y;
    ${motion}
    vec4 view = modelViewMatrix * vec4(place, 1.0);
    float spin = uStretch > 1.0 ? 0.5 * (aSeed.z - 0.5) : 6.2831853 * aSeed.w + (aSeed.z - 0.5) * 0.4 * uAge;
    mat2 twist = mat2(cos(spin), sin(spin), -sin(spin), cos(spin));
    // It bursts out of the plating: drawn nearer to the eye by what a bow or a bulwark beside it takes up.
    float nearer = 1.0 - min(uNearer * uSize / length(view.xyz), 0.5);
    view.xyz *= nearer;
    vec2 corner = twist * (position.xy * vec2(1.0, uStretch)) * radius;
    vHeight = ((modelMatrix * vec4(place, 1.0)).y + corner.y) / (0.35 * radius + 0.4);
    view.xy += corner * nearer;
    gl_Position = radius > 0.0 ? projectionMatrix * view : vec4(2.0, 2.0, 2.0, 1.0);
  }`;

/** Colours finished per corner, shapes of puffs read from a texture: for the plain picture. */
const plainVertexShader = (motion) => vertexShader(motion).replace("void main() {", `${FINISH_GLSL}\n  void main() {`)
  .replace(/\}\s*$/, "  vColour.rgb = finish(vColour.rgb);\n  }");

const PLAIN_PUFF = /* glsl */ `
  uniform sampler2D uPuff;
  varying vec2 vCorner;
  varying vec4 vColour;
  varying float vGlow, vSeed, vHeight;
  void main() {
    float puff = texture2D(uPuff, 0.5 * (0.5 + 0.5 * vCorner) + 0.5 * vec2(step(0.5, fract(vSeed)), step(0.5, fract(7.0 * vSeed)))).r;
    float opacity = vColour.a * puff * clamp(vHeight, 0.0, 1.0); // soft at the water
    vec3 colour = vColour.rgb * mix(vec3(1.0), vec3(1.0, 0.55 + 0.45 * puff, 0.4 + 0.6 * puff), vGlow); // redder at the rim
    gl_FragColor = vec4(colour * opacity, opacity * (1.0 - vGlow)); // premultiplied
  }`;

const fragmentShader = (isSoft) => /* glsl */ `
  varying vec2 vCorner;
  varying vec4 vColour;
  varying float vGlow;
  varying float vSeed, vHeight;
  float hash(vec2 p) { return fract(sin(dot(p, vec2(41.3, 289.1))) * 17431.7); }
  float noise(vec2 p) {
    vec2 i = floor(p), f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
  }
  void main() {
    float r = length(vCorner);
    ${
      isSoft
        ? "if (r > 1.0) discard;" +
          "float n = 0.65 * noise(2.6 * vCorner + 31.0 * vSeed) + 0.35 * noise(6.1 * vCorner - 17.0 * vSeed);" +
          "float shape = smoothstep(1.0, 0.15, r + 0.75 * (n - 0.5)) * smoothstep(1.0, 0.8, r) * clamp(vHeight, 0.0, 1.0);"
        : "float shape = step(abs(vCorner.x) * 1.4 + abs(vCorner.y), 0.9);"
    }
    float opacity = vColour.a * shape;
    if (opacity < 0.004) discard;
    gl_FragColor = vec4(vColour.rgb * mix(vec3(1.0), vec3(1.0, 0.55 + 0.45 * shape, 0.4 + 0.6 * shape), vGlow), 1.0); // redder at the rim
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
    gl_FragColor = vec4(gl_FragColor.rgb * opacity, opacity * (1.0 - vGlow)); // premultiplied
  }`;

const PUFF = 64; // pixels of each of four

/** Four puffs of smoke: what the full picture works out per pixel, once for all. */
function makePuffs() {
  const random = randomNumbers(11);
  const lattice = Array.from({ length: 4096 }, random);
  const ease = (x) => x * x * (3 - 2 * x);
  const step = (from, to, x) => ease(Math.min(1, Math.max(0, (x - from) / (to - from))));
  const noise = (x, y) => {
    const [i, j, u, v] = [Math.floor(x), Math.floor(y), ease(x % 1), ease(y % 1)];
    const at = (k, l) => lattice[(64 * (j + l) + i + k) % 4096];
    return (at(0, 0) * (1 - u) + at(1, 0) * u) * (1 - v) + (at(0, 1) * (1 - u) + at(1, 1) * u) * v;
  };
  const data = Uint8Array.from({ length: 4 * PUFF * PUFF }, (_, i) => {
    const [column, row] = [i % (2 * PUFF), Math.floor(i / (2 * PUFF))];
    const [x, y] = [column, row].map((k) => (2 * ((k % PUFF) + 0.5)) / PUFF - 1);
    const which = 11 * Math.floor(column / PUFF) + 29 * Math.floor(row / PUFF);
    const n = 0.65 * noise(2.6 * (x + 1) + which, 2.6 * (y + 1)) + 0.35 * noise(6.1 * (x + 1) + which, 6.1 * (y + 1) + 20);
    const r = Math.hypot(x, y);
    return 225 * step(1, 0.15, r + 0.75 * (n - 0.5)) * step(0.97, 0.78, r);
  });
  const texture = new THREE.DataTexture(data, 2 * PUFF, 2 * PUFF, THREE.RedFormat);
  return Object.assign(texture, { magFilter: THREE.LinearFilter, minFilter: THREE.LinearFilter, needsUpdate: true });
}

let puff = null;

const quad = new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]);

/** Where an effect bursts out, in b: between deck and water, above a contact point that lies lower. */
export const burstOf = ({ kind, point: [x, y, z] }, { height }) => [x, y, kind === "splash" ? z : Math.min(z, -LIFT * height)];

function makeEffect(effect, info) {
  const point = burstOf(effect, info);
  const count = Math.max(8, Math.round(COUNT[effect.kind] * Math.sqrt(effect.intensity)));
  const random = randomNumbers(effect.seed + 1);
  const geometry = new THREE.InstancedBufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(quad, 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const seeds = Float32Array.from({ length: 4 * count }, random);
  geometry.setAttribute("aSeed", new THREE.InstancedBufferAttribute(seeds, 4));
  geometry.instanceCount = count;
  const isSoft = effect.kind !== "debris";
  const common = {
    uniforms: {
      uPuff: { value: (puff ??= makePuffs()) },
      uLit: LIGHT.uLit,
      uDrift: { value: new THREE.Vector3() },
      uStretch: { value: STRETCH[effect.kind] ?? 1 },
      uAge: { value: 0 },
      uNearer: { value: NEARER[effect.kind] ?? 0 },
      uDuration: { value: effect.duration },
      uSize: { value: effect.size },
      uHeight: { value: -point[2] },
      uOut: { value: new THREE.Vector3(...effect.outwards) },
    },
    depthWrite: false,
    transparent: true,
    blending: THREE.CustomBlending,
    blendSrc: THREE.OneFactor,
    blendDst: THREE.OneMinusSrcAlphaFactor,
  };
  const motion = MOTION[effect.kind];
  const material = new THREE.ShaderMaterial({ ...common, vertexShader: vertexShader(motion), fragmentShader: fragmentShader(isSoft) });
  const plain = isSoft ? new THREE.ShaderMaterial({ ...common, vertexShader: plainVertexShader(motion), fragmentShader: PLAIN_PUFF, toneMapped: false }) : material;
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.position.fromArray(point);
  mesh.renderOrder = { splash: 1, dust: 1, smoke: 1, fire: 2, debris: 3, explosion: 1.8 }[effect.kind];
  return { mesh, material, plain };
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
      for (const { effect, ship, mesh, material, plain } of made) {
        mesh.material = isPlain ? plain : material;
        const age = time - effect.time;
        mesh.visible = age > 0 && age < effect.duration + LINGER[effect.kind];
        material.uniforms.uAge.value = age; // the plain one has the same
        if (mesh.visible && DRIFTS.includes(effect.kind)) findDrift(ship, wind, time - start, material.uniforms.uDrift.value);
        active += mesh.visible;
      }
      return active;
    },
    remove() {
      for (const { ship, mesh, material, plain } of made) {
        ship.node.remove(mesh);
        for (const one of [mesh.geometry, material, plain]) one.dispose();
      }
    },
  };
}
