// Foam and ships' waves, drawn from above into a texture around what the camera looks at, which the sea reads. Red is
// foam, green the height of the water [m], blue the shade beside hulls, alpha water that has been churned up.
import * as THREE from "three";
import { makeHullFoam } from "./hull_foam.js";
import { makeWake } from "./wake.js";
import { findWaterline } from "./waterline.js";

export const FIELD_GLSL = /* glsl */ `
  uniform sampler2D uField;
  uniform vec4 uCover; // middle x, z, half the width [m], and the size of a texel [m]
  vec4 fieldAt(vec2 p) {
    vec2 q = (p - uCover.xy) / uCover.z;
    float inside = smoothstep(1.0, 0.9, max(abs(q.x), abs(q.y)));
    return inside * textureLod(uField, 0.5 + 0.5 * q, 0.0);
  }
  vec2 fieldSlope(vec2 p, vec4 here) {
    return vec2(fieldAt(p + vec2(uCover.w, 0.0)).g - here.g, fieldAt(p + vec2(0.0, uCover.w)).g - here.g) / uCover.w;
  }
`;

const SIZE = 1536; // texels in each direction
const LEAST = 420, MOST = 4500; // half the width of the texture [m]

/**
 * `ships`: [{node, info, track}]; returns the uniforms for the sea, what draws the texture, and the nodes that stand in the
 * picture itself: bow waves, and the foam of the plain picture.
 */
export function makeFoam(ships, renderer) {
  const target = new THREE.WebGLRenderTarget(SIZE, SIZE, { type: THREE.HalfFloatType, depthBuffer: false });
  const cover = { value: new THREE.Vector4(0, 0, 1000, 2) };
  const parts = ships.flatMap((ship) => {
    const outline = findWaterline(ship);
    return [makeWake(ship, { aft: outline.x[0], fore: outline.x.at(-1) }, cover), makeHullFoam(ship, outline, cover)];
  });
  let isPlain = false;
  const scene = new THREE.Scene().add(...parts.map(({ mesh }) => mesh));
  const camera = new THREE.Camera();
  for (const { plain } of parts) plain.visible = false;
  const black = new THREE.Color(0, 0, 0);
  return {
    nodes: [...parts.flatMap(({ raised }) => raised ?? []), ...parts.map(({ plain }) => plain)],
    uniforms: { uField: { value: target.texture }, uCover: cover },
    /** Plain: foam lies on the sea by itself, and there is no texture. */
    setPlain(wanted) {
      isPlain = wanted;
      for (const { plain } of parts) plain.visible = wanted;
    },
    /** At a time since the start, around a point in the page's world seen from a distance [m]. */
    draw(time, middle, distance) {
      const half = Math.min(MOST, Math.max(LEAST, 2.4 * distance));
      const texel = (2 * half) / SIZE;
      cover.value.set(Math.round(middle.x / texel) * texel, Math.round(middle.z / texel) * texel, half, texel);
      for (const part of parts) part.update(time, isPlain);
      if (isPlain) return;
      const before = renderer.getClearColor(new THREE.Color()), alpha = renderer.getClearAlpha();
      renderer.setRenderTarget(target);
      renderer.setClearColor(black, 0);
      renderer.clear();
      renderer.render(scene, camera);
      renderer.setRenderTarget(null);
      renderer.setClearColor(before, alpha);
    },
  };
}
