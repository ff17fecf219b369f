// Flames: tongues that stand along the opening, each on an upright square in which noise rises and eats away the tip; and
// embers, which fly up out of them. What a pixel shows is a function of time and of the flame's own random numbers.

const ROOTS = 5; // places along the opening from which tongues rise

/** How many squares a fire of an intensity (0 to 1) has: [flames, embers]. */
export const countFlames = (intensity) => [Math.round(12 + 16 * intensity), Math.round(50 * intensity)];

export const FLAME_VERTEX = /* glsl */ `
  attribute vec4 aSeed;
  uniform float uAge, uDuration, uSize, uDeck, uFlames; // uDeck: height of the deck above the effect's point [m]
  uniform vec3 uOut, uDrift; // uDrift: of the air past the ship, in b [m/s]
  varying vec3 vFlame; // across (-1 to 1), from root (0) to tip (1), and time in lengths of the flame
  varying vec4 vKind; // two numbers of its own, heat, 1 for an ember
  const vec3 UP = vec3(0.0, 0.0, -1.0);
  void main() {
    float number = float(gl_InstanceID);
    float root = mod(number, ${ROOTS}.0), strength = 0.55 + 0.45 * sin(2.4 * root + 11.0 * uOut.x + 1.0);
    vec3 along = normalize(cross(uOut, UP) + 1e-4);
    float across = (root + 0.5) / ${(ROOTS / 2).toFixed(1)} - 1.0 + 0.5 * (aSeed.x - 0.5);
    float grown = smoothstep(0.0, 0.9, uAge - 0.25 * strength) * (1.0 - smoothstep(0.55, 1.0, uAge / uDuration));
    float isEmber = step(uFlames, number);
    // Those in the opening are low and stand in front; those at the edge of the deck are high and a little inboard.
    float inside = step(aSeed.y, 0.22);
    vec3 foot = along * 0.95 * uSize * across + uOut * uSize * mix(-0.1 - 0.4 * aSeed.z, 0.04, inside)
              + UP * (uDeck - mix(0.2, (0.2 + 0.6 * aSeed.w) * uDeck, inside));
    float flicker = 0.85 + 0.16 * sin(5.3 * uAge + 40.0 * aSeed.x) + 0.13 * sin(8.7 * uAge + 23.0 * aSeed.z);
    float high = uSize * mix(1.0 + 1.8 * aSeed.w, 0.45 + 0.25 * aSeed.z, inside) * (0.5 + 0.6 * strength) * (1.0 - 0.35 * across * across) * flicker * grown;
    float wide = 0.3 * uSize * (0.7 + 0.7 * aSeed.z) * (0.4 + 0.6 * grown) * mix(1.0, 0.4, inside) + 0.14 * high;
    float speed = 2.6 * sqrt(uSize); // at which flames rise [m/s]
    vec3 tip = foot + UP * high + uDrift * high / (1.6 * speed);
    vFlame = vec3(position.x, 0.5 + 0.5 * position.y, uAge * speed / (1.5 * uSize));
    vKind = vec4(7.0 * aSeed.x + root, 5.0 * aSeed.w, mix(0.85, 1.1, aSeed.z), isEmber);
    if (isEmber > 0.5) {
      float life = 1.6 + 2.2 * aSeed.y, a = fract(uAge / life + aSeed.x), born = uAge - a * life;
      vec3 wave = vec3(sin(7.0 * a + 20.0 * aSeed.z), cos(6.0 * a + 14.0 * aSeed.w), 0.0);
      vec3 at = along * 0.8 * uSize * (2.0 * aSeed.z - 1.0) + UP * (uDeck + uSize * (0.5 + 4.2 * a * (0.5 + aSeed.w)))
              + 0.5 * uSize * a * wave + uDrift * a * life * 0.8;
      foot = at;
      tip = at + UP * 0.05 * uSize + 0.02 * uSize * wave;
      wide = born > 0.3 && born < 0.9 * uDuration ? 0.012 * uSize * (0.6 + aSeed.y) : 0.0;
      vKind.z = 1.0 - a;
    }
    vec4 low = modelViewMatrix * vec4(foot, 1.0), top = modelViewMatrix * vec4(tip, 1.0);
    vec2 axis = top.xy - low.xy + vec2(0.0, 1e-3);
    vec4 view = mix(low, top, vFlame.y);
    view.xy += normalize(vec2(axis.y, -axis.x)) * vFlame.x * wide;
    // It stands before what a bow or a bulwark beside it takes up.
    view.xyz *= 1.0 - min(0.9 * uSize / length(view.xyz), 0.5);
    gl_Position = wide > 0.0 && (high > 0.0 || isEmber > 0.5) ? projectionMatrix * view : vec4(2.0, 2.0, 2.0, 1.0);
  }`;

/** Colours are those of the picture: a flame is as bright by day as by night. */
export const FLAME_FRAGMENT = /* glsl */ `
  uniform sampler2D uNoise;
  varying vec3 vFlame;
  varying vec4 vKind;
  vec3 glowAt(float heat) {
    vec3 colour = mix(vec3(0.50, 0.07, 0.01), vec3(0.98, 0.36, 0.03), smoothstep(0.0, 0.34, heat));
    colour = mix(colour, vec3(1.0, 0.72, 0.18), smoothstep(0.3, 0.62, heat));
    return mix(colour, vec3(1.0, 0.95, 0.70), smoothstep(0.6, 0.95, heat));
  }
  void main() {
    float x = vFlame.x, y = vFlame.y;
    if (vKind.w > 0.5) {
      float ember = vKind.z * (1.0 - abs(x));
      gl_FragColor = vec4(vec3(1.0, 0.55, 0.15) * ember, 0.3 * ember);
      return;
    }
    vec2 rising = vec2(0.16 * x, 0.2 * y) + vKind.xy;
    float broad = texture2D(uNoise, rising * 0.8 - vec2(0.0, 0.15 * vFlame.z)).r;
    float fine = texture2D(uNoise, rising * 1.3 + vec2(0.1 * broad, -0.3 * vFlame.z)).g;
    float finest = texture2D(uNoise, rising * 3.4 + vec2(0.16 * fine, -0.62 * vFlame.z)).g;
    float torn = 0.5 * broad + 0.32 * fine + 0.18 * finest;
    float bent = x + (broad - 0.5) * 1.9 * y + (fine - 0.5) * 1.1 * y + (finest - 0.5) * 0.5;
    float body = 1.0 - abs(bent) / (0.8 * (1.0 - 0.62 * y) * smoothstep(-0.12, 0.16, y) + 0.02);
    float heat = vKind.z * (0.95 * body + 0.36) - y * (3.1 * torn - 0.55) + 0.55 * (finest - 0.5) + 0.4 * (fine - 0.5);
    float opacity = smoothstep(0.02, 0.42, heat) * smoothstep(0.0, 0.1, y) * smoothstep(1.0, 0.75, abs(x)) * smoothstep(1.0, 0.85, y);
    gl_FragColor = vec4(glowAt(heat * (0.95 - 0.5 * y)) * opacity, 0.72 * opacity); // premultiplied: it covers, and shines a little
  }`;
