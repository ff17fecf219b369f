// The shadow of the sun or moon in a shader of our own, read from the same map as three.js's own materials read it: what
// stands on a ship throws its shape on the water. Where no light throws shadows, everything is lit.
import * as THREE from "three";

export const SUN_SHADOW = {
  material: { lights: true },
  uniforms: THREE.UniformsLib.lights, // which three.js fills in
  vertexHead: /* glsl */ `
    #if NUM_DIR_LIGHT_SHADOWS > 0
      uniform mat4 directionalShadowMatrix[NUM_DIR_LIGHT_SHADOWS];
      varying vec4 vDirectionalShadowCoord[NUM_DIR_LIGHT_SHADOWS];
    #endif
  `,
  /** `world`: GLSL, the corner's place in the page's world. */
  vertex: (world) => /* glsl */ `
    #if NUM_DIR_LIGHT_SHADOWS > 0
      vDirectionalShadowCoord[0] = directionalShadowMatrix[0] * ${world};
    #endif
  `,
  /** `sunAt()`: 1 where the sun is seen, 0 in shadow. */
  pixelHead: /* glsl */ `
    #include <common>
    #include <packing>
    #include <lights_pars_begin>
    #include <shadowmap_pars_fragment>
    float sunAt() {
      #if NUM_DIR_LIGHT_SHADOWS > 0
        DirectionalLightShadow sun = directionalLightShadows[0];
        return getShadow(directionalShadowMap[0], sun.shadowMapSize, sun.shadowIntensity, sun.shadowBias, 2.0 * sun.shadowRadius, vDirectionalShadowCoord[0]);
      #else
        return 1.0;
      #endif
    }
  `,
};
