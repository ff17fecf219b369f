// The paint of the plain picture: light and haze at the corners of a surface, nothing but a colour per pixel.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { FIRE, FIRE_GLSL } from "./fire_light.js";
import { FINISH_GLSL } from "./finish.js";
import { HAZE } from "./haze.js";

const vertexShader = /* glsl */ `
  attribute vec4 aPaint; // colour, and whether lamps shine out of it
  uniform vec3 uSun, uBeam, uAbove, uBelow, uHorizon;
  uniform float uLamps, uNear, uFar, uOwnLight;
  varying vec3 vColour;
  ${FINISH_GLSL}
  ${FIRE_GLSL}
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    vec3 up = normalize(mat3(modelMatrix) * normal);
    vec3 light = uBeam * max(dot(up, uSun), 0.0) + mix(uBelow, uAbove, 0.5 + 0.5 * up.y) + fireLight(world.xyz, up);
    vec3 colour = aPaint.rgb * (light / 3.14159265 + uOwnLight) + aPaint.a * uLamps * vec3(0.55, 0.407, 0.209);
    vec4 view = viewMatrix * world;
    vColour = finish(mix(colour, uHorizon, smoothstep(uNear, uFar, -view.z)));
    gl_Position = projectionMatrix * view;
  }`;

const fragmentShader = /* glsl */ `
  varying vec3 vColour;
  void main() { gl_FragColor = vec4(vColour, 1.0); }`;

/** The material for what joinTriangles makes; `glow`: share of their colour that things give off by themselves. */
export const makePaint = (glow = 0, more = {}) => new THREE.ShaderMaterial({
  uniforms: { ...LIGHT, ...HAZE, ...FIRE, uOwnLight: { value: glow } }, vertexShader, fragmentShader, toneMapped: false, ...more,
});
