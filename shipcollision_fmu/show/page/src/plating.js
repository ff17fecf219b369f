// The outside of a hull in the full picture: plates between welds, dished between frames, rust below scuppers, scuffs of
// quays and fenders, salt above the water and wear of the boot topping. Coordinates are those of the ship, in metres.

/** Sets `diffuseColor`; needs side, high (above the water), cloudy, seen, uTop (height of the deck), noise and hash. */
export const PLATING = /* glsl */ `
  if (uPlated > 0.5) {
    vec3 coat = diffuseColor.rgb;
    float grey = dot(coat, vec3(0.3, 0.5, 0.2));
    float blur = fwidth(flat_.x) + fwidth(flat_.y);
    // Coats of different years: whole strakes and blocks of plates have faded more or less.
    float faded = noise(vec2(side * 0.035 + 3.0, high * 0.16)) - 0.5;
    coat = mix(coat, vec3(grey), 0.16 + 0.22 * faded) * (1.0 + 0.24 * faded);
    // Frames 0.8 m apart under plates that have sunk in between: seen in light along the side.
    float frames = cos(side * 7.854) * smoothstep(0.5, 0.12, blur);
    coat *= 1.0 + 0.035 * frames * smoothstep(0.3, 0.7, noise(flat_ * vec2(0.07, 0.4) + 9.0));
    // Scuppers, and what has run out of them.
    float cell = floor(side / 7.0), lot = hash(vec2(cell, 3.0)), below = uTop - high;
    float off = abs(side - (cell + 0.2 + 0.6 * lot) * 7.0 + 0.10 * (noise(vec2(high * 1.3, cell)) - 0.5));
    float wide = 0.07 + 0.035 * max(below, 0.0);
    float run = smoothstep(wide + blur, 0.3 * wide, off) * step(0.25, below) * exp(-below / (0.8 + 3.2 * hash(vec2(cell, 8.0))));
    run *= 0.5 + 0.5 * noise(vec2(side * 9.0, high * 0.6));
    coat = mix(coat, vec3(0.17, 0.082, 0.04), 0.75 * run * step(0.3, lot));
    // Rubbed along quays: long level marks, down to the primer here and there.
    float level = noise(vec2(side * 0.10, high * 3.4)) * noise(vec2(side * 0.028 + 11.0, high * 1.1 + 5.0));
    float band = smoothstep(0.0, 1.5, high) * smoothstep(0.95 * uTop, 0.45 * uTop, high);
    float scuffs = smoothstep(0.40, 0.62, level) * band;
    coat = mix(coat, vec3(grey * 0.55 + 0.05), 0.45 * scuffs);
    coat = mix(coat, vec3(0.20, 0.085, 0.055), 0.35 * smoothstep(0.62, 0.72, level) * band);
    // Salt dries above the waterline; weed and wear are at it: on low ships in narrower bands.
    float up = high / clamp(uTop / 8.0, 0.25, 1.0);
    float uneven = noise(vec2(side * 0.35, high * 0.8)) * 0.7 + 0.3 * noise(vec2(side * 1.9, high * 0.5));
    float salt = smoothstep(3.2, 0.7, up) * smoothstep(0.25, 0.9, up) * uneven;
    coat = mix(coat, vec3(0.40, 0.41, 0.39), 0.30 * salt);
    float worn = smoothstep(0.56, 0.74, noise(vec2(side * 0.8, high * 4.0) + 2.0) * 0.6 + 0.4 * uneven) * smoothstep(1.4, 0.4, abs(up - 0.3));
    coat = mix(coat, vec3(0.16, 0.07, 0.05), 0.55 * worn);
    float weed = smoothstep(0.55, 0.0, up - 0.35 * uneven);
    coat = mix(coat, vec3(0.035, 0.045, 0.025), 0.40 * weed);
    diffuseColor.rgb = coat;
  }`;
