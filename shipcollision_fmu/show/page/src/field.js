// How parts of the water are drawn into foam.js's texture: added up, seen from above.
import * as THREE from "three";

export const ADDING = {
  blending: THREE.CustomBlending, blendSrc: THREE.OneFactor, blendDst: THREE.OneFactor, blendSrcAlpha: THREE.OneFactor, blendDstAlpha: THREE.OneFactor,
  depthTest: false, depthWrite: false, side: THREE.DoubleSide, transparent: true,
};
/** Where `place`, in plan, is in the texture. */
export const TO_FIELD = "gl_Position = vec4((place - uCover.xy) / uCover.z, 0.0, 1.0);";
