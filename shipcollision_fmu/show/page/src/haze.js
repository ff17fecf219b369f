// How far one sees. Shaders that finish their colours per corner share these uniforms.

/** `uHaze`: sight over the sea [m]; haze on what stands in it begins at `uNear` and hides everything at `uFar` [m]. */
export const HAZE = { uHaze: { value: 9000 }, uNear: { value: 4000 }, uFar: { value: 22000 } };

export function setHaze(sight) {
  HAZE.uHaze.value = sight;
  HAZE.uNear.value = 0.45 * sight;
  HAZE.uFar.value = 2.5 * sight;
}
