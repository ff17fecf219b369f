// The sea: a few long waves that move its surface, small ones that turn its light, foam and ships' waves from foam.js,
// and what it mirrors. Waves are for the eye: they are low beside hulls, which keep their true place, and are functions
// of the run's time, so that scrubbing back brings the same sea again.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { FIELD_GLSL } from "./foam.js";
import { HAZE, HAZE_GLSL } from "./haze.js";
import { makePlainSea } from "./plain_sea.js";
import { makeRipples, RIPPLES_GLSL, WATER } from "./ripples.js";
import { SKY_GLSL } from "./sky.js";
import { SUN_SHADOW } from "./sun_shadow.js";
import { breakingHeight, coverageOf } from "./whitecaps.js";

const RADIUS = 60000; // [m]
const FINE = [150, 176], COARSE = [56, 96]; // rings and sectors of the full and of the plain sea
/** Long waves: length [m], amplitude [m], bearing [rad]. Those of 60 to 100 m are the swell: low, and seen as broad light and dark. */
const SWELL = [[103, 0.5, 0.15], [67, 0.4, -0.32], [41, 0.18, 0.85], [27, 0.09, -0.95]];

const FADES = 10; // waves of a tenth of a layer's tile, where most of its slope is, are seen by halves where a pixel is as long
const BREAKS = 0.5; // share of the slopes by which the mirror image of a hull is broken up
const MIRRORED = 0.7; // least share of a hull's image in the colour of the water, seen flat: there it hides the sky from all waves
const NEVER = 1e3; // standard deviations
const GREY = new THREE.Color(0.2, 0.2, 0.2); // of a hull in the water's colour
const SHADED = 0.62; // light of the water in the shadow of a ship by day
const MOONLESS = 0.95; // and by night, when most of its light is the sky's
const CROSSES = 0.75; // share of the moon's road that waves carry across a ship's shadow
const CALM_NIGHT = 0.0025; // variance by which slopes too small for any layer widen the road of the moon

/** Rings around the camera, close together near it; triangles go around, sector by sector, so many times. */
function makeRings([rings, sectors], turns = 1) {
  const places = [0, 0, 0], index = [];
  for (let i = 0; i < rings; i++) {
    const radius = 1.5 * (RADIUS / 1.5) ** ((i / (rings - 1)) ** 0.9);
    for (let j = 0; j < sectors; j++) {
      const angle = (2 * Math.PI * (j + 0.5 * (i % 2))) / sectors;
      places.push(radius * Math.cos(angle), 0, radius * Math.sin(angle));
    }
  }
  const at = (i, j) => 1 + i * sectors + (j % sectors);
  for (let j = 0; j < turns * sectors; j++) {
    index.push(0, at(0, j + 1), at(0, j));
    for (let i = 0; i + 1 < rings; i++) index.push(at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setIndex(index);
  return geometry;
}

const shipsGlsl = (count) => /* glsl */ `
  const int SHIPS = ${count};
  uniform vec4 uPlaces[SHIPS];
  uniform vec3 uSizes[SHIPS];
  uniform vec3 uColours[SHIPS];
`;

const swellGlsl = SWELL.map(([length, amplitude, bearing]) => {
  const k = (2 * Math.PI) / length;
  const numbers = [Math.cos(bearing), Math.sin(bearing), k, Math.sqrt(9.81 * k), amplitude, length].map((x) => x.toFixed(6));
  return `add(p, far, vec2(${numbers[0]}, ${numbers[1]}), ${numbers.slice(2).join(", ")}, moved, slope);`;
}).join("\n");

const vertexShader = (count) => /* glsl */ `
  uniform float uTime;
  ${shipsGlsl(count)}
  varying vec3 vWorld;
  varying vec3 vSwell; // slopes, height
  ${SUN_SHADOW.vertexHead}
  void add(vec2 p, float far, vec2 along, float k, float omega, float amplitude, float length_, inout vec3 moved, inout vec2 slope) {
    float phase = k * dot(along, p) - omega * uTime;
    float a = amplitude * exp(-far / (30.0 * length_));
    moved.y += a * cos(phase);
    moved.xz -= along * (0.8 * a * sin(phase));
    slope -= along * (k * a * sin(phase));
  }
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    vec2 p = world.xz, slope = vec2(0.0);
    float far = distance(world.xyz, cameraPosition);
    vec3 moved = vec3(0.0);
    ${swellGlsl}
    float calm = 1.0;
    for (int i = 0; i < SHIPS; i++) {
      vec2 ahead = uPlaces[i].zw;
      vec2 o = abs(mat2(ahead.x, -ahead.y, ahead.y, ahead.x) * (p - uPlaces[i].xy)) - uSizes[i].xy;
      float reach = min(60.0, 3.0 * uSizes[i].z + 6.0);
      calm = min(calm, smoothstep(-2.0, reach, length(max(o, 0.0))));
    }
    calm = 0.12 + 0.88 * calm;
    world.xyz += moved * calm;
    vWorld = world.xyz;
    vSwell = vec3(slope * (0.4 + 0.6 * calm), moved.y * calm);
    ${SUN_SHADOW.vertex("world")}
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;

const fragmentShader = (count) => /* glsl */ `
  precision highp float;
  uniform float uTime, uShine, uBreaking, uLamps;
  uniform vec3 uDeep, uScatter, uFoam, uDisc, uZenith, uHorizon, uGlow;
  varying vec3 vWorld;
  varying vec3 vSwell;
  ${HAZE_GLSL}
  ${SKY_GLSL}
  ${RIPPLES_GLSL}
  ${FIELD_GLSL}
  ${shipsGlsl(count)}
  ${SUN_SHADOW.pixelHead}
  // Share of the waves of a layer that a pixel of so many metres can show; the rest is roughness.
  float shown(float pixel, float tile) { float waves = ${FADES.toFixed(1)} * pixel / tile; return 1.0 / (1.0 + waves * waves); }
  // The plan of what is mirrored, in half lengths and half breadths: a x + b y < c, from shoulder to stem and at the quarter.
  const vec3 EDGES[3] = vec3[3](vec3(1.143, 1.0, 1.571), vec3(4.0, 1.0, 4.0), vec3(-0.833, 1.0, 1.583));
  // How much of a ship, taken for such a prism, a mirrored ray meets, and its colour.
  vec4 mirroredShip(vec3 from, vec3 direction) {
    float nearest = 1e9;
    vec4 found = vec4(0.0);
    for (int i = 0; i < SHIPS; i++) {
      vec2 ahead = uPlaces[i].zw;
      mat2 toShip = mat2(ahead.x, -ahead.y, ahead.y, ahead.x);
      vec2 o = toShip * (from.xz - uPlaces[i].xy), d = toShip * direction.xz;
      vec3 size = uSizes[i];
      vec3 origin = vec3(o, from.y) / size, ray = (vec3(d, direction.y) + 1e-6) / size; // never 0
      vec3 low = (vec3(-1.0, -1.0, 0.0) - origin) / ray, high = (1.0 - origin) / ray;
      vec3 enter = min(low, high), leave = max(low, high);
      float t = max(max(enter.x, enter.y), enter.z), end = min(min(leave.x, leave.y), leave.z);
      for (int k = 0; k < 6; k++) {
        vec3 edge = EDGES[k / 2] * vec3(1.0, k % 2 == 0 ? 1.0 : -1.0, 1.0);
        float towards = dot(edge.xy, ray.xy), to = (edge.z - dot(edge.xy, origin.xy)) / towards;
        if (towards < 0.0) t = max(t, to);
        else end = min(end, to);
      }
      if (t < end && end > 0.0 && t < nearest) {
        nearest = t;
        vec3 at = origin + t * ray; // fainter towards stem and top, where there is more than a prism, and from afar, where waves scatter it
        found = vec4(uColours[i], 0.95 * smoothstep(1.0, 0.8, at.x) * smoothstep(-1.02, -0.95, at.x) * smoothstep(1.1, 0.6, at.z) * exp(-t / (16.0 * size.z)));
      }
    }
    return found;
  }
  void main() {
    vec3 away = vWorld - cameraPosition;
    float distance_ = length(away);
    vec3 view = away / distance_;
    vec2 p = vWorld.xz;
    vec2 drift = vec2(0.94, 0.34) * uTime;
    vec2 across = fwidth(p);
    float pixel = length(across); // [m] of the sea, as long as it is
    vec4 seen = vec4(shown(pixel, 5.3), shown(pixel, 23.0), shown(pixel, 89.0), shown(pixel, 410.0));
    vec4 steep = vec4(0.045, 0.052, 0.047, 0.022); // root mean square of each layer
    vec3 finest = ripple((mat2(0.6, -0.8, 0.8, 0.6) * p - 0.8 * drift) / 5.3);
    finest.xy = mat2(0.6, 0.8, -0.8, 0.6) * finest.xy;
    vec3 fine = ripple((p - 1.9 * drift) / 23.0);
    vec3 middle = ripple((mat2(0.8, 0.6, -0.6, 0.8) * p - 4.1 * drift) / 89.0);
    middle.xy = mat2(0.8, -0.6, 0.6, 0.8) * middle.xy;
    vec3 broad = ripple((p - 7.0 * drift) / 410.0);
    vec4 drawn = steep * seen;
    vec2 slope = vSwell.xy + drawn.x * finest.xy + drawn.y * fine.xy + drawn.z * middle.xy + drawn.w * broad.xy;
    float height = vSwell.z + 0.18 * middle.z;
    float gusts = clamp(1.0 + 0.5 * broad.z, 0.6, 1.35); // wind is not the same everywhere
    slope *= gusts;
    vec4 field = fieldAt(p);
    slope += fieldSlope(p, field);
    // Slopes that are too small to be seen from here, as the root of their mean square.
    float rough = sqrt(0.0025 + gusts * gusts * dot(steep * steep, 1.0 - seen * seen));
    // Waves hide the slopes that face away: the nearer a slope comes to that, the more its visible part leans to the eye.
    vec2 level = view.xz / max(dot(view.xz, view.xz), 1e-4);
    float bare = dot(slope, view.xz) - view.y, leaning = 0.5 * (bare + sqrt(bare * bare + rough * rough));
    slope += (leaning - bare) * level;
    vec3 normal = normalize(vec3(-slope.x, 1.0, -slope.y));
    float facing = max(dot(-view, normal), 0.02);
    float fresnel = 0.02 + 0.98 * pow(1.0 - facing, 5.0 * exp(-2.7 * rough)) / (1.0 + 22.7 * rough * sqrt(rough));
    vec3 mirrored = reflect(view, normal);
    mirrored.y = abs(mirrored.y) + 0.6 * rough;
    mirrored = normalize(mirrored);
    vec3 reflection = skyAt(mirrored, 4.3 + 8.0 * rough);
    // Of a hull as much is seen as stays together: the mean of many waves, broken up by those that can be seen.
    vec2 calmer = ${BREAKS.toFixed(2)} * slope;
    vec3 towards = reflect(view, normalize(vec3(-calmer.x, 1.0, -calmer.y)));
    vec4 ship = mirroredShip(vWorld, vec3(towards.x, max(towards.y, 0.02), towards.z));
    reflection = mix(reflection, ship.rgb * uFoam, ship.a);
    float sunlit = sunAt();
    float crest = clamp(0.32 + 0.55 * height + field.g * 0.5, 0.0, 1.3);
    float through = pow(max(dot(view, normalize(vec3(uSun.x, 0.0, uSun.z))), 0.0), 3.0); // light through the crests
    vec3 deep = uDeep + uScatter * (0.32 * crest + 0.9 * crest * crest * through + 0.35 * (1.0 - facing) * max(height, 0.0));
    deep += uScatter * 1.6 * field.a;
    vec3 colour = mix(mix(deep, reflection, fresnel), ship.rgb * uFoam, ${MIRRORED.toFixed(2)} * ship.a * (1.0 - facing) * (1.0 - facing));
    // Sun or moon in the slopes that are seen and in those that are not (Beckmann's distribution of slopes).
    vec3 middle_ = normalize(uSun - view);
    vec2 off = -middle_.xz / middle_.y - slope;
    float spread = rough * rough * 0.5 + 0.0009 + ${CALM_NIGHT.toFixed(4)} * uLamps;
    float glitter = exp(-dot(off, off) / (2.0 * spread)) / (6.2832 * spread);
    float grazing = 0.02 + 0.98 * pow(1.0 - max(dot(-view, middle_), 0.0), 5.0);
    colour += uDisc * uShine * min(0.03 * glitter * grazing / max(middle_.y * 4.0 * facing, 0.25), 2.4) * mix(sunlit, 1.0, ${CROSSES.toFixed(2)} * uLamps) * smoothstep(-0.02, 0.06, uSun.y);
    colour *= (1.0 - 0.7 * field.b) * mix(mix(${SHADED.toFixed(2)}, ${MOONLESS.toFixed(2)}, uLamps), 1.0, sunlit);
    // Foam breaks up into a lace as it fades.
    float net = 0.40 * lace(p / 12.0 + 0.02 * slope) + 0.25 * lace(p.yx / 4.3 + 0.37) + 0.20 * lace(p / 37.0) + 0.15 * lace(p.yx / 131.0);
    float foam = field.r;
    foam = smoothstep(0.0, 0.75, foam - 0.55 + 0.7 * net) * min(1.0, 1.8 * foam);
    // Crests break where they are highest, in standard deviations of a sum of two layers with a third of 1 each.
    float high = ${(3 / Math.hypot(0.6, 0.4)).toFixed(3)} * (0.6 * middle.z + 0.4 * fine.z) * gusts;
    foam = max(foam, seen.y * smoothstep(uBreaking, uBreaking + 0.4, high + net - 0.4) * (0.3 + 0.8 * net)); // ragged, as foam is
    colour = mix(colour, uFoam * (0.66 + 0.3 * clamp(dot(normal, uSun), 0.0, 1.0) + 0.25 * net), clamp(foam, 0.0, 0.94));
    vec3 horizon = skyAt(normalize(vec3(view.x, 0.01, view.z)), 2.0);
    colour = mix(colour, horizon, 1.0 - clearAt(distance_));
    gl_FragColor = vec4(colour, 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
  }`;

/** Bearings that a camera sees [rad]: where they begin, and how far they reach; all where it looks down. */
function seenBearings(camera) {
  const corners = [[-1, -1], [1, -1], [-1, 1], [1, 1]].map(([x, y]) => new THREE.Vector3(x, y, 0.5).unproject(camera).sub(camera.position).normalize());
  if (corners.some(({ y }) => Math.abs(y) > 0.8)) return { start: 0, reach: 2 * Math.PI };
  const middle = corners.reduce((sum, corner) => sum.add(corner), new THREE.Vector3());
  const bearing = Math.atan2(middle.z, middle.x);
  const turns = corners.map(({ x, z }) => Math.abs(Math.atan2(z * Math.cos(bearing) - x * Math.sin(bearing), x * Math.cos(bearing) + z * Math.sin(bearing))));
  const half = Math.max(...turns);
  return { start: bearing - half, reach: 2 * half };
}

/** Draws the sectors of rings within some bearings, and one more on both sides. */
function showBearings(geometry, [rings, sectors], { start, reach }) {
  const each = (2 * Math.PI) / sectors, corners = 3 + 6 * (rings - 1);
  const first = ((Math.floor(start / each) - 1) % sectors + sectors) % sectors;
  geometry.setDrawRange(first * corners, Math.min(sectors, Math.ceil(reach / each) + 3) * corners);
}

/**
 * `ships`: of each, half length, half breadth and height of the deck above the waterline [m], and its colour; `sky`:
 * its uniforms; `field`: the uniforms of foam and ships' waves.
 */
export function makeSea(ships, sky, field) {
  const places = ships.map(() => new THREE.Vector4()); // x, z, and where ahead is in them
  const uniforms = {
    ...LIGHT, ...sky, ...field, ...WATER, ...HAZE,
    uPlaces: { value: places }, uBreaking: { value: NEVER },
    uSizes: { value: ships.map(({ halfLength, halfBreadth, height }) => new THREE.Vector3(halfLength, halfBreadth, height)) },
    uColours: { value: ships.map(({ colour }) => new THREE.Color(colour).lerp(GREY, 0.3).multiplyScalar(0.4)) },
  };
  const ripples = (WATER.uRipples.value = makeRipples());
  const material = new THREE.ShaderMaterial({ ...SUN_SHADOW.material, uniforms: { ...SUN_SHADOW.uniforms, ...uniforms }, vertexShader: vertexShader(ships.length), fragmentShader: fragmentShader(ships.length) });
  const plain = makePlainSea(uniforms);
  const fine = makeRings(FINE), coarse = makeRings(COARSE, 2);
  const mesh = new THREE.Mesh(fine, material);
  mesh.renderOrder = -5;
  mesh.frustumCulled = false;
  mesh.receiveShadow = true;
  return {
    mesh,
    setPlain(isPlain) {
      mesh.material = isPlain ? plain : material;
      mesh.geometry = isPlain ? coarse : fine;
      mesh.renderOrder = isPlain ? 5 : -5; // what ships hide is not drawn
      ripples.anisotropy = isPlain ? 1 : 8; // which costs a processor most of its time, and mixing two sizes half of the rest
      ripples.minFilter = isPlain ? THREE.LinearMipmapNearestFilter : THREE.LinearMipmapLinearFilter;
      ripples.needsUpdate = true;
    },
    /** Speed of the wind [m/s]: from a fresh breeze on, crests break. */
    setWind(speed) {
      uniforms.uBreaking.value = Math.min(NEVER, breakingHeight(coverageOf(speed)));
    },
    /** `poses`: of each ship, where midship is and where ahead is, in the page's world. */
    update(time, camera, poses) {
      poses.forEach(({ position, ahead }, i) => {
        const length = Math.hypot(ahead.x, ahead.z) || 1;
        places[i].set(position.x, position.z, ahead.x / length, ahead.z / length);
      });
      uniforms.uTime.value = time;
      mesh.position.set(camera.position.x, 0, camera.position.z);
      if (mesh.geometry === coarse) showBearings(coarse, COARSE, seenBearings(camera));
    },
  };
}
