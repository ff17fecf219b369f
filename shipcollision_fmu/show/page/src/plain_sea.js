// The sea of the plain picture. Light, mirror and haze are worked out at the corners of the mesh, for three slopes of the
// water; a pixel reads two layers of small waves, and finds its colour between the three by its own slope.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { FINISH_GLSL } from "./finish.js";
import { HAZE_GLSL } from "./haze.js";
import { STEEPEST, WATER } from "./ripples.js";

const STEEP = 0.11; // slope towards the eye at which colours are worked out, up and down
const SLOPES = { fine: 0.09, middle: 0.042 }; // root mean square of each layer
const TILES = { fine: 23, middle: 151 }; // [m]

const DRIFT = "vec2(0.94, 0.34)"; // [m/s]
const [FINE, MIDDLE] = [SLOPES.fine, SLOPES.middle].map((slope) => (slope * STEEPEST * Math.SQRT2).toFixed(4));

/** Slope of the water at a place [m] and time [s], both GLSL, in a shader that has uRipples. */
export const slopeGlsl = (p, time) => `(${FINE} * (texture2D(uRipples, (${p} - 1.9 * ${DRIFT} * ${time}) / ${TILES.fine.toFixed(1)}).xy - 0.5)
  + ${MIDDLE} * (texture2D(uRipples, (${p}.yx - 3.0 * ${DRIFT} * ${time}) / ${TILES.middle.toFixed(1)}).yx - 0.5))`;

const vertexShader = /* glsl */ `
  uniform float uTime, uShine, uSpread;
  uniform vec3 uSun, uDeep, uScatter, uDisc, uZenith, uHorizon, uGlow, uCloud;
  varying vec4 vRipples; // where to read the layers
  varying vec2 vTowards, vGlint; // bearing of the view; slope that mirrors the sun
  varying vec2 vShine; // how bright the sun is in that slope, and how few slopes near it do so
  varying vec3 vLevel, vLinear, vSquare; // colour over slope towards the eye
  ${FINISH_GLSL}
  ${HAZE_GLSL}
  vec3 skyTowards(vec3 d) {
    float high = clamp(d.y, 0.0, 1.0), sunwards = max(dot(d, uSun), 0.0);
    float bearing = 0.5 + 0.5 * dot(normalize(d.xz + 1e-5), normalize(uSun.xz));
    vec3 sky = mix(uHorizon, uZenith, 1.0 - exp(-3.6 * high));
    sky = mix(sky, uGlow, 0.80 * pow(sunwards, uSpread) * exp(-5.0 * high));
    sky += uGlow * (0.30 * pow(sunwards, 60.0) + 0.16 * pow(bearing, 3.0) * exp(-16.0 * high));
    return mix(sky, uCloud, 0.22 * smoothstep(0.05, 0.3, high)); // as many clouds as there are at an average
  }
  vec3 waterOf(vec3 view, float slope, float rough, vec3 deep) {
    vec2 along = normalize(view.xz + 1e-5);
    vec3 normal = normalize(vec3(-slope * along.x, 1.0, -slope * along.y));
    float facing = max(dot(-view, normal), 0.02);
    float fresnel = 0.02 + 0.98 * pow(1.0 - facing, 5.0 * exp(-2.7 * rough)) / (1.0 + 22.7 * rough * sqrt(rough));
    vec3 mirrored = reflect(view, normal);
    mirrored.y = abs(mirrored.y) + 0.6 * rough;
    return mix(deep, skyTowards(normalize(mirrored)), fresnel);
  }
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    vec2 p = world.xz, drift = ${DRIFT} * uTime;
    vRipples = vec4((p - 1.9 * drift) / ${TILES.fine.toFixed(1)}, (p.yx - 3.0 * drift) / ${TILES.middle.toFixed(1)});
    vec3 away = world.xyz - cameraPosition;
    float far = length(away);
    vec3 view = away / far;
    vTowards = normalize(view.xz + 1e-5);
    float rough = mix(0.05, 0.145, 1.0 - exp(-far / 900.0)); // slopes that are too small to be seen from here
    float clear = clearAt(far);
    vec3 horizon = skyTowards(normalize(vec3(view.x, 0.01, view.z)));
    vec3 deep = uDeep + 0.42 * uScatter;
    vec3 level = finish(mix(horizon, waterOf(view, 0.0, rough, deep), clear));
    vec3 up = finish(mix(horizon, waterOf(view, ${STEEP}, rough, deep), clear));
    vec3 down = finish(mix(horizon, waterOf(view, -${STEEP}, rough, deep), clear));
    vLevel = level;
    vLinear = (up - down) / ${(2 * STEEP).toFixed(2)};
    vSquare = (up + down - 2.0 * level) / ${(2 * STEEP * STEEP).toFixed(4)};
    // Sun or moon in the slopes that mirror it (Beckmann's distribution, whose bell is a power of a parabola here).
    vec3 middle = normalize(uSun - view);
    float spread = 0.5 * rough * rough + 0.0009;
    float grazing = 0.02 + 0.98 * pow(1.0 - max(dot(-view, middle), 0.0), 5.0);
    vGlint = -middle.xz / middle.y;
    float bright = min(0.03 * grazing / (6.2832 * spread * max(4.0 * middle.y * max(-view.y, 0.02), 0.25)), 2.4);
    vShine = vec2(sqrt(bright * uShine * max(uDisc.r, uDisc.b)) * smoothstep(-0.02, 0.06, uSun.y) * clear, 0.125 / spread);
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;

const fragmentShader = /* glsl */ `
  uniform sampler2D uRipples;
  uniform vec3 uDisc;
  varying vec4 vRipples;
  varying vec2 vTowards, vGlint, vShine;
  varying vec3 vLevel, vLinear, vSquare;
  void main() {
    // A view along the water would read them too coarsely: the larger waves alone would be left, as stains.
    vec2 fine = texture2D(uRipples, vRipples.xy, -1.0).xy - 0.5;
    vec2 middle = texture2D(uRipples, vRipples.zw, -0.5).yx - 0.5;
    vec2 slope = ${FINE} * fine + ${MIDDLE} * middle;
    float towards = clamp(dot(slope, vTowards), ${(-1.5 * STEEP).toFixed(3)}, ${(1.5 * STEEP).toFixed(3)});
    vec3 colour = vLevel + towards * (vLinear + towards * vSquare);
    vec2 off = vGlint - slope;
    float glint = max(0.0, 1.0 - dot(off, off) * vShine.y);
    colour = mix(colour, uDisc, min(1.0, vShine.x * glint * glint));
    gl_FragColor = vec4(colour, 1.0);
  }`;

/** Material of the plain sea; `uniforms` are those of the full one, `uHaze` among them. */
export function makePlainSea(uniforms) {
  return new THREE.ShaderMaterial({ uniforms: { ...LIGHT, ...WATER, ...uniforms }, vertexShader, fragmentShader, toneMapped: false });
}
