// Tone mapping and encoding for shaders that finish their colours per corner, not per pixel: the plain picture. Three.js
// does both per pixel, which takes a processor several times as long as everything else of a simple surface.

/** `finish(colour)`: from linear light to what is written into the picture; Khronos's neutral tone mapping, then sRGB. */
export const FINISH_GLSL = /* glsl */ `
  vec3 finish(vec3 colour) {
    float least = min(colour.r, min(colour.g, colour.b));
    colour -= least < 0.08 ? least - 6.25 * least * least : 0.04;
    float peak = max(colour.r, max(colour.g, colour.b));
    if (peak >= 0.76) {
      float lower = 1.0 - 0.0576 / (peak - 0.52);
      colour = mix(vec3(lower), colour * (lower / peak), 1.0 / (0.15 * (peak - lower) + 1.0));
    }
    colour = max(colour, 0.0);
    return mix(12.92 * colour, 1.055 * pow(colour, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, colour));
  }
`;
