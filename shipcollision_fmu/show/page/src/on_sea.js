// What lies on the sea in the picture itself: white over green over the water, coloured at its corners.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { FINISH_GLSL } from "./finish.js";
import { HAZE, HAZE_GLSL } from "./haze.js";
import { WATER } from "./ripples.js";

export const ON_SEA = {
  blending: THREE.CustomBlending, blendSrc: THREE.OneFactor, blendDst: THREE.OneMinusSrcAlphaFactor,
  transparent: true, depthWrite: false, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1, toneMapped: false,
};
export const ON_SEA_UNIFORMS = { ...WATER, ...HAZE, uFoam: LIGHT.uFoam, uDeep: LIGHT.uDeep, uScatter: LIGHT.uScatter, uHorizon: LIGHT.uHorizon, uSun: LIGHT.uSun };
/** `onSea(place, y)`: where a corner is in the picture; sets the colours of foam and of churned water there. `waterAt`: of smooth water. */
export const ON_SEA_HEAD = /* glsl */ `
  uniform vec3 uFoam, uDeep, uScatter, uHorizon, uSun;
  varying vec2 vWaves;
  varying vec3 vWhite, vGreen;
  ${FINISH_GLSL}
  ${HAZE_GLSL}
  vec4 onSea(vec2 place, float y) {
    vWaves = place / 13.0;
    float clear = clearAt(distance(vec3(place.x, y, place.y), cameraPosition));
    vWhite = finish(mix(uHorizon, uFoam * (0.82 + 0.3 * uSun.y), clear));
    vGreen = finish(mix(uHorizon, uDeep + 2.2 * uScatter, clear));
    return projectionMatrix * viewMatrix * vec4(place.x, y, place.y, 1.0);
  }
  vec3 waterAt(vec2 place, float y) {
    vec3 away = vec3(place.x, y, place.y) - cameraPosition;
    float far = length(away), mirrored = 0.02 + 0.32 * pow(1.0 - abs(away.y) / far, 5.0);
    return finish(mix(uHorizon, mix(uDeep + 0.42 * uScatter, uHorizon, mirrored), clearAt(far)));
  }
`;
/** `paintFoam(foam, churned, shade)`: colour and opacity of a pixel. */
export const ON_SEA_PIXEL = /* glsl */ `
  varying vec2 vWaves;
  varying vec3 vWhite, vGreen;
  vec4 paintFoam(float foam, float churned, float shade) {
    vec2 net = texture2D(uRipples, vWaves).ba; // it breaks up into a lace as it fades
    float white = clamp(1.7 * foam * (0.18 + 0.5 * net.x + 0.58 * net.y) - 0.1, 0.0, 0.94);
    float green = 0.5 * churned * (1.0 - white), dark = 0.3 * shade * (1.0 - white);
    return vec4(white * vWhite + green * vGreen, white + green + dark);
  }
`;
