// The paint of the plain picture: light and haze at the corners of a surface, nothing but a colour per pixel.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { FIRE, FIRE_GLSL } from "./fire_light.js";
import { FINISH_GLSL } from "./finish.js";
import { HAZE } from "./haze.js";
import { DIM_GLSL, findFloods, LAMPS_GLSL, SHADE_GLSL } from "./paint.js";

const vertexShader = /* glsl */ `
  attribute vec4 aPaint; // colour, and what it is: 0 else, up to 1 windows, so much lamps shine out of them, 2 walls with lamps, 3 plating
  uniform vec3 uSun, uBeam, uAbove, uBelow, uHorizon;
  uniform float uLamps, uNear, uFar, uOwnLight;
  varying vec3 vColour;
  ${FINISH_GLSL}
  ${FIRE_GLSL}
  ${LAMPS_GLSL}
  ${SHADE_GLSL}
  ${DIM_GLSL}
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    vec3 up = normalize(mat3(modelMatrix) * normal);
    vec3 view = world.xyz - cameraPosition;
    float edge = 1.0 - abs(dot(up, view)) * inversesqrt(dot(view, view));
    vec3 around = mix(uBelow, uAbove, 0.5 + 0.5 * up.y) * shadeOf(normal, -position.z, step(2.5, aPaint.a));
    vec3 light = uBeam * max(dot(up, uSun), 0.0) + around + fireLight(world.xyz, up);
    vec3 paint = aPaint.rgb, own = vec3(0.0);
    if (uLamps > 0.0) {
      paint = dim(paint);
      light = whiten(light);
      float wall = aPaint.a == 2.0 && abs(normal.z) < 0.7 ? 0.19 : 0.0;
      own = uLamps * (aPaint.a > 0.0 && aPaint.a <= 1.0 ? aPaint.a * vec3(0.55, 0.407, 0.209) : paint * WARM * (wall + 0.55 * floodsAt(position, normal)));
    }
    vec3 colour = paint * (light / 3.14159265 + uOwnLight * (1.0 - 0.85 * uLamps)) + own + uHorizon * (0.16 * edge * edge * edge);
    vec4 seen = viewMatrix * world;
    vColour = finish(mix(colour, uHorizon, smoothstep(uNear, uFar, -seen.z)));
    gl_Position = projectionMatrix * seen;
  }`;

const fragmentShader = /* glsl */ `
  varying vec3 vColour;
  void main() { gl_FragColor = vec4(vColour, 1.0); }`;

/**
 * The material for what joinTriangles makes; `glow`: share of their colour that things give off by themselves; `uFloods`:
 * the lamps of the ship that it is for.
 */
export const makePaint = (glow = 0, more = {}, uFloods = findFloods([])) => new THREE.ShaderMaterial({
  uniforms: { ...LIGHT, ...HAZE, ...FIRE, uFloods, uOwnLight: { value: glow } }, vertexShader, fragmentShader, toneMapped: false, ...more,
});
