// How the puffs and pieces of each kind of effect move: a function of the time since it began and of each one's random numbers.

/** What all have: the ship's b (forward, starboard, down), numbers, and the colour of what glows. */
export const MOTION_GLSL = /* glsl */ `
  attribute vec4 aSeed;
  uniform float uAge, uDuration, uSize, uHeight, uDeck; // uHeight, uDeck: of the point above the water, of the deck above the point
  uniform vec3 uOut, uLit, uDrift; // uDrift: of the air past the ship, in b [m/s]
  const vec3 UP = vec3(0.0, 0.0, -1.0);
  vec3 onSphere(vec2 s) {
    float z = 2.0 * s.x - 1.0, a = 6.2831853 * s.y;
    return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(a), sin(a)), z);
  }
  vec3 heat(float a) {
    vec3 hot = mix(vec3(1.5, 0.98, 0.46), vec3(1.05, 0.36, 0.05), smoothstep(0.0, 0.3, a));
    return mix(mix(hot, vec3(0.36, 0.05, 0.012), smoothstep(0.3, 0.62, a)), vec3(0.05, 0.045, 0.042), smoothstep(0.55, 0.9, a));
  }
`;

/**
 * Each sets: place (in b, from the effect's point), radius [m], vColour (colour, opacity), vGlow (1: light, 0: paint), vWorn (how
 * much of a puff the air has eaten away); radius 0 hides it. Debris sets `velocity`, too: pieces are drawn out along their way.
 */
export const MOTION = {
  explosion: /* glsl */ `
    float life = 1.0 + 1.6 * aSeed.y;
    float a = (uAge - 0.18 * aSeed.x) / life;
    vec3 direction = normalize(onSphere(aSeed.zw) + 0.8 * uOut + 0.5 * UP);
    float push = 1.0 - exp(-3.5 * a);
    place = direction * uSize * (0.3 + 2.2 * aSeed.x) * push + UP * (uSize * 1.6 * a * a + 0.5 * uDeck * push);
    radius = uSize * (0.35 + 0.95 * sqrt(max(a, 0.0))) * (0.5 + 0.7 * aSeed.z);
    vColour = vec4(heat(0.04 + 0.96 * a + 0.32 * aSeed.x * aSeed.z), 0.85 * (1.0 - a) * smoothstep(0.0, 0.03, a));
    vGlow = 0.55 * (1.0 - smoothstep(0.05, 0.4, a)); // it covers more than it adds: else all would melt into one yellow
    vWorn = 0.5 * a;
    if (a <= 0.0 || a >= 1.0) radius = 0.0;`,
  debris: /* glsl */ `
    float age = uAge - 0.12 * aSeed.x;
    vec3 direction = normalize(1.1 * onSphere(aSeed.zw) + 0.9 * uOut + 0.9 * UP);
    float fast = uSize * (1.0 + 2.6 * aSeed.y * aSeed.y), drag = 1.0 / (1.0 + 0.22 * age);
    velocity = direction * fast * drag * drag - UP * 9.81 * age;
    place = direction * fast * age * drag - UP * 4.905 * age * age;
    radius = uSize * (0.01 + 0.024 * aSeed.x * aSeed.x);
    float cool = smoothstep(0.2, 2.4, age + 0.5 * aSeed.x);
    vColour = vec4(mix(vec3(2.0, 0.7, 0.15), uLit * 0.1, cool), 1.0);
    vGlow = 0.7 * (1.0 - cool);
    if (age <= 0.0 || dot(place, UP) < -uHeight) radius = 0.0;`,
  smoke: /* glsl */ `
    float life = 9.0 + 6.0 * aSeed.y;
    float begins = pow(aSeed.x, 1.35); // much at once
    float turn = floor((uAge - begins * life) / life);
    float birth = (turn + begins) * life;
    float age = uAge - birth, a = age / life;
    float wild = fract(aSeed.z + turn * 0.618);
    vec3 around = onSphere(vec2(wild, aSeed.w));
    float off = 0.25 + 0.75 * aSeed.w * aSeed.w; // most of it near the axis
    float fire = 1.0 - smoothstep(0.55, 0.85, birth / (0.5 * uDuration)); // below
    vec3 along = normalize(cross(uOut, UP) + 1e-4);
    place = along * uSize * 0.8 * (2.0 * wild - 1.0) * exp(-2.0 * a) - 0.15 * uSize * uOut + UP * (uDeck + uSize * (0.1 + 0.9 * fire * aSeed.z))
          + uSize * UP * 8.5 * pow(a, 0.8) + uDrift * (age - 1.5 + 1.5 * exp(-age / 1.5))
          + uSize * off * (0.25 + 2.6 * a) * around
          + uSize * a * (0.9 * vec3(sin(5.0 * a + 0.35 * birth), cos(4.0 * a + 0.3 * birth), 0.0) + 0.6 * vec3(sin(9.0 * a - 5.0 * aSeed.w), cos(11.0 * a + 6.0 * wild), 0.0));
    radius = uSize * (0.5 + 2.9 * a) * (0.6 + 0.7 * aSeed.z);
    float grey = mix(0.016, 0.34, smoothstep(0.05, 0.95, a)) * (0.55 + 0.9 * wild);
    vec3 lit = grey * uLit * (0.85 - 0.3 * around.z) + fire * vec3(0.62, 0.17, 0.03) * (0.5 * exp(-11.0 * a));
    vColour = vec4(lit, 0.9 * exp(-1.6 * a) * (1.0 - a) * (1.2 - off) * smoothstep(0.0, 0.05, a));
    vGlow = 0.0;
    vWorn = 0.75 * a;
    if (birth < 0.0 || birth > uDuration) radius = 0.0;`,
  dust: /* glsl */ `
    float life = 1.0 + 0.8 * aSeed.y;
    float a = (uAge - 0.5 * aSeed.x * uDuration) / life;
    vec3 direction = normalize(onSphere(aSeed.zw) * vec3(1.0, 1.0, 0.6) + 0.9 * uOut);
    place = direction * uSize * (0.4 + 1.6 * aSeed.y) * (1.0 - exp(-3.0 * a)) + UP * uSize * 0.5 * a;
    radius = uSize * (0.25 + 1.0 * sqrt(max(a, 0.0))) * (0.5 + 0.6 * aSeed.z);
    vColour = vec4(uLit * vec3(0.50, 0.42, 0.36) * (0.6 + 0.6 * aSeed.w), 0.42 * (1.0 - a) * smoothstep(0.0, 0.06, a));
    vGlow = 0.0;
    vWorn = 0.5 * a;
    if (a <= 0.0 || a >= 1.0) radius = 0.0;`,
  splash: /* glsl */ `
    float life = 1.5 + 0.9 * aSeed.y;
    float age = uAge - 0.6 * aSeed.x * uDuration, a = age / life;
    vec3 along = normalize(cross(uOut, UP) + 1e-4);
    vec3 from = UP * -uHeight + uOut * uSize * 0.12 + along * uSize * (aSeed.z - 0.5) * 2.2;
    velocity = UP * (4.0 + 1.5 * uSize * aSeed.y) + uOut * uSize * (0.15 + 0.6 * aSeed.w) + along * uSize * (aSeed.z - 0.5) * 0.8;
    place = from + velocity * age * (1.0 - 0.18 * a) - UP * 4.905 * age * age * 0.85;
    radius = (0.35 + 0.16 * uSize * (0.4 + aSeed.x)) * (0.35 + 1.1 * a);
    vColour = vec4(uLit * 0.95, 0.6 * (1.0 - a) * smoothstep(0.0, 0.05, a));
    vGlow = 0.0;
    vWorn = 0.4 * a;
    if (a <= 0.0 || a >= 1.0 || dot(place, UP) < -uHeight - 0.5) radius = 0.0;`,
};
