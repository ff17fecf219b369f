// Day, dusk and night: where the sun or the moon stands and the colour of everything that follows from it. All shaders
// share these uniforms, so that one call changes the whole picture. Colours are linear.
import * as THREE from "three";

/**
 * Of each hour: `turn` of the sun from behind the shoulder of whoever looks first, and its `height` [rad]; `zenith`,
 * `horizon` and `glow` of the sky; `disc`: radiance of sun or moon; `deep` and `scatter` of the water; `foam`; `cloud`
 * lit and `shade`; strength and colour of the lights on ships: `sun`, `above`, `below`, `fill`;
 * `stars` and `lamps` (ships' lights) from 0 to 1.
 */
const HOURS = {
  day: {
    turn: 1.15, height: 0.52, zenith: [0.075, 0.21, 0.5], horizon: [0.56, 0.69, 0.82], glow: [1.0, 0.9, 0.74], spread: 8,
    disc: [1.0, 0.94, 0.82], shine: 5.0, deep: [0.006, 0.036, 0.058], scatter: [0.012, 0.095, 0.10], foam: [0.80, 0.86, 0.89],
    cloud: [1.0, 0.98, 0.95], shade: [0.55, 0.62, 0.70], cover: 0.5,
    sun: [1.0, 0.93, 0.82], power: 3.1, above: [0.72, 0.83, 0.95], below: [0.22, 0.33, 0.38], fill: 1.8, stars: 0, lamps: 0,
  },
  dusk: {
    turn: 2.62, height: 0.085, zenith: [0.045, 0.085, 0.22], horizon: [0.34, 0.27, 0.33], glow: [1.15, 0.42, 0.12], spread: 3.2,
    disc: [1.0, 0.55, 0.22], shine: 5.0, deep: [0.006, 0.018, 0.034], scatter: [0.02, 0.05, 0.05], foam: [0.42, 0.37, 0.40],
    cloud: [1.0, 0.46, 0.26], shade: [0.15, 0.13, 0.20], cover: 0.56,
    sun: [1.0, 0.58, 0.30], power: 2.6, above: [0.50, 0.47, 0.62], below: [0.30, 0.20, 0.18], fill: 1.25, stars: 0.12, lamps: 0.45,
  },
  night: {
    turn: -2.86, height: 0.16, zenith: [0.011, 0.019, 0.036], horizon: [0.062, 0.084, 0.116], glow: [0.12, 0.138, 0.158], spread: 9,
    disc: [0.85, 0.90, 0.98], shine: 0.55, deep: [0.003, 0.0075, 0.012], scatter: [0.004, 0.011, 0.014], foam: [0.115, 0.145, 0.185],
    cloud: [0.11, 0.13, 0.16], shade: [0.018, 0.026, 0.04], cover: 0.36,
    sun: [0.72, 0.83, 1.0], power: 0.88, above: [0.49, 0.58, 0.76], below: [0.30, 0.34, 0.42], fill: 1.3, stars: 1, lamps: 1,
  },
};

/** What can be chosen: [value, label]. */
export const SKIES = [["day", "Day"], ["dusk", "Dusk"], ["night", "Night"]];

const colour = () => ({ value: new THREE.Color() });

/** Uniforms that sky, sea, wakes and effects share. */
export const LIGHT = {
  uSun: { value: new THREE.Vector3(0, 1, 0) }, uZenith: colour(), uHorizon: colour(), uGlow: colour(), uSpread: { value: 1 },
  uDisc: colour(), uShine: { value: 1 }, uDeep: colour(), uScatter: colour(), uFoam: colour(), uCloud: colour(), uShade: colour(),
  uClouds: { value: 0.5 }, uStars: { value: 0 }, uLamps: { value: 0 }, uLit: colour(), uBeam: colour(), uAbove: colour(), uBelow: colour(),
};

/** Sets all uniforms for an hour, seen first from the bearing `from` [rad] in the page's world; returns the hour. */
export function setHour(name, from) {
  const hour = HOURS[name];
  const azimuth = from + hour.turn;
  LIGHT.uSun.value.set(Math.cos(azimuth) * Math.cos(hour.height), Math.sin(hour.height), Math.sin(azimuth) * Math.cos(hour.height));
  for (const key of ["zenith", "horizon", "glow", "disc", "deep", "scatter", "foam", "cloud", "shade"]) {
    LIGHT[`u${key[0].toUpperCase()}${key.slice(1)}`].value.setRGB(...hour[key]);
  }
  LIGHT.uBeam.value.setRGB(...hour.sun).multiplyScalar(hour.power);
  LIGHT.uAbove.value.setRGB(...hour.above).multiplyScalar(hour.fill);
  LIGHT.uBelow.value.setRGB(...hour.below).multiplyScalar(hour.fill);
  LIGHT.uSpread.value = hour.spread;
  LIGHT.uShine.value = hour.shine;
  LIGHT.uClouds.value = hour.cover;
  LIGHT.uStars.value = hour.stars;
  LIGHT.uLamps.value = hour.lamps;
  LIGHT.uLit.value.setRGB(...hour.foam).multiplyScalar(1.1); // of smoke, spray and dust
  return hour;
}
