// How far one sees. Shaders that finish their colours per corner share these uniforms.

/** `uHaze`: sight over the sea [m]; haze on what stands in it begins at `uNear` and hides everything at `uFar` [m]. */
export const HAZE = { uHaze: { value: 9000 }, uNear: { value: 4000 }, uFar: { value: 22000 } };

/** `clearAt(far)`: how little haze lies between the eye and the water, 1 near it and 0 at the horizon, where sea and sky are one. */
export const HAZE_GLSL = /* glsl */ `
  uniform float uHaze;
  float clearAt(float far) { return exp(-pow(far / (0.3 * uHaze), 1.5)); }
`;

export function setHaze(sight) {
  HAZE.uHaze.value = sight;
  HAZE.uNear.value = 0.45 * sight;
  HAZE.uFar.value = 2.5 * sight;
}
