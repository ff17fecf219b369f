// Sky, clouds, stars, sun or moon, and the lights that go with them. Gradient and clouds are drawn once per hour into a
// texture of the upper half of all directions; dome and sea read it.
import * as THREE from "three";
import { LIGHT, setHour } from "./daylight.js";
import { FINISH_GLSL } from "./finish.js";
import { makePlainSky } from "./plain_sky.js";
import { randomNumbers } from "./random.js";

/** Where the sun or the moon stands, as seen from anywhere. */
export const SUN = LIGHT.uSun.value;

const STARS = 1400;

/** Reads the sky: across are bearings, up the square root of the direction's height. */
export const SKY_GLSL = /* glsl */ `
  uniform sampler2D uSky;
  uniform vec3 uSun;
  vec3 skyAt(vec3 d, float lod) {
    vec2 uv = vec2(atan(d.z, d.x) * 0.15915494 + 0.5, sqrt(clamp(d.y, 0.0, 1.0)));
    return textureLod(uSky, uv, lod).rgb;
  }
`;

const VERTEX = /* glsl */ `
  varying vec2 vUv;
  void main() { vUv = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }`;

/** Paints the sky in linear light, or for the plain picture in finished colours. */
const bakeGlsl = (isFinished) => /* glsl */ `
  varying vec2 vUv;
  ${isFinished ? FINISH_GLSL : ""}
  uniform vec3 uSun, uZenith, uHorizon, uGlow, uCloud, uShade;
  uniform float uSpread, uClouds;
  float hash(vec2 p) { p = fract(p * vec2(0.1031, 0.1030)); p += dot(p, p.yx + 33.33); return fract((p.x + p.y) * p.x); }
  float noise(vec2 p) {
    vec2 i = floor(p), f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
  }
  float heap(vec2 p, int octaves) {
    float sum = 0.0, share = 0.5;
    for (int i = 0; i < 7; i++) {
      if (i >= octaves) break;
      sum += share * noise(p);
      p = mat2(1.616, 1.212, -1.212, 1.616) * p + 3.7;
      share *= 0.5;
    }
    return sum;
  }
  float cloudAt(vec2 p, int octaves) {
    float body = heap(p, octaves) + 0.22 * (noise(0.31 * p + 11.0) - 0.5);
    return smoothstep(1.0 - uClouds, 1.0 - uClouds + 0.22, body);
  }
  void main() {
    float angle = (vUv.x - 0.5) * 6.2831853, high = vUv.y * vUv.y, flat_ = sqrt(max(0.0, 1.0 - high * high));
    vec3 d = vec3(flat_ * cos(angle), high, flat_ * sin(angle));
    float towards = max(dot(d, uSun), 0.0);
    float bearing = 0.5 + 0.5 * dot(normalize(d.xz + 1e-5), normalize(uSun.xz));
    vec3 sky = mix(uHorizon, uZenith, 1.0 - exp(-3.6 * high));
    sky = mix(sky, uGlow, 0.80 * pow(towards, uSpread) * exp(-5.0 * high));
    sky += uGlow * (0.30 * pow(towards, 60.0) + 0.16 * pow(bearing, 3.0) * exp(-16.0 * high));
    vec2 p = d.xz / (d.y + 0.09) * 0.85;
    vec2 sunwards = normalize(uSun.xz) * 0.16;
    float cloud = cloudAt(p, 7);
    float veil = smoothstep(0.45, 0.9, heap(vec2(0.35, 1.5) * (mat2(0.8, 0.6, -0.6, 0.8) * d.xz) / (d.y + 0.25) * 2.0, 5)) * 0.4;
    float lit = clamp(0.75 + 1.1 * (cloud - cloudAt(p + sunwards, 5)) - 0.35 * cloud, 0.0, 1.0);
    vec3 white = mix(uShade, uCloud, lit) + uCloud * 0.5 * pow(towards, 12.0) * (1.0 - 0.6 * cloud);
    float far = smoothstep(0.0, 0.16, high);
    sky = mix(sky, mix(sky, uCloud, 0.55), veil * far);
    sky = mix(sky, mix(sky, white, 0.35 + 0.6 * far), cloud * smoothstep(0.012, 0.08, high));
    gl_FragColor = vec4(${isFinished ? "finish(sky)" : "sky"}, 1.0);
  }`;

function makeDome(uniforms) {
  const dome = new THREE.Mesh(
    new THREE.SphereGeometry(1, 48, 32),
    new THREE.ShaderMaterial({
      side: THREE.BackSide,
      uniforms,
      depthWrite: false,
      depthTest: false,
      vertexShader: /* glsl */ `
        varying vec3 vDirection;
        void main() {
          vDirection = position;
          vec4 place = projectionMatrix * mat4(mat3(modelViewMatrix)) * vec4(position, 1.0);
          gl_Position = place.xyww;
        }`,
      fragmentShader: /* glsl */ `
        varying vec3 vDirection;
        uniform vec3 uDisc;
        uniform float uShine;
        ${SKY_GLSL}
        void main() {
          vec3 d = normalize(vDirection);
          vec3 colour = skyAt(d, 0.0);
          float towards = dot(d, uSun);
          colour += uDisc * uShine * (1.6 * smoothstep(0.999935, 0.999955, towards) + 0.05 * pow(max(towards, 0.0), 1800.0));
          gl_FragColor = vec4(colour, 1.0);
          #include <tonemapping_fragment>
          #include <colorspace_fragment>
        }`,
    }),
  );
  dome.frustumCulled = false;
  dome.renderOrder = -10;
  return dome;
}

/** Stars as points, thinned out towards the horizon, of the brightnesses that stars have. */
function makeStars() {
  const random = randomNumbers(41);
  const places = [], light = [];
  while (places.length < 3 * STARS) {
    const y = random(), angle = 2 * Math.PI * random(), flat = Math.sqrt(1 - y * y);
    places.push(flat * Math.cos(angle), y, flat * Math.sin(angle));
    light.push(Math.min(1, 0.22 / Math.sqrt(random() + 0.01)) * Math.min(1, 0.15 + 4 * y));
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("aLight", new THREE.Float32BufferAttribute(light, 1));
  const uRatio = { value: 1 }; // of the picture's pixels to the screen's: with few of them stars would be slabs
  const stars = new THREE.Points(geometry, new THREE.ShaderMaterial({
    uniforms: { ...LIGHT, uRatio },
    depthWrite: false,
    transparent: true,
    blending: THREE.AdditiveBlending,
    vertexShader: /* glsl */ `
      attribute float aLight;
      uniform float uStars, uRatio;
      varying float vLight;
      void main() {
        vLight = aLight * uStars * min(1.0, 0.4 + 0.6 * uRatio);
        vec4 place = projectionMatrix * mat4(mat3(viewMatrix)) * vec4(position, 1.0);
        gl_Position = place.xyww;
        gl_PointSize = max(1.3, (1.6 + 2.2 * aLight) * uRatio);
      }`,
    fragmentShader: /* glsl */ `
      varying float vLight;
      void main() {
        float r = length(gl_PointCoord - 0.5);
        gl_FragColor = vec4(vec3(0.9, 0.95, 1.0) * vLight * smoothstep(0.5, 0.2, r), 1.0);
      }`,
  }));
  stars.frustumCulled = false;
  stars.onBeforeRender = (renderer) => (uRatio.value = renderer.getPixelRatio());
  stars.renderOrder = -9;
  return stars;
}

/** The sky around everything, and its lights; `setSky(name, from, isPlain)` makes it day, dusk or night. */
export function makeSky(renderer) {
  const bake = new THREE.WebGLRenderTarget(2048, 512, {
    type: THREE.HalfFloatType, generateMipmaps: true, minFilter: THREE.LinearMipmapLinearFilter, wrapS: THREE.RepeatWrapping, depthBuffer: false,
  });
  const finished = new THREE.WebGLRenderTarget(1024, 256, { depthBuffer: false }); // which a processor reads fastest
  const uniforms = { ...LIGHT, uSky: { value: bake.texture } };
  const [painter, finisher] = [false, true].map((isFinished) => new THREE.ShaderMaterial({
    uniforms: LIGHT, vertexShader: VERTEX, fragmentShader: bakeGlsl(isFinished), depthTest: false, depthWrite: false,
  }));
  const page = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), painter);
  page.frustumCulled = false;
  const easel = new THREE.Scene().add(page);
  const dome = makeDome(uniforms), plain = makePlainSky(finished.texture);
  const stars = makeStars();
  const sun = new THREE.DirectionalLight(0xffffff, 1);
  const ambient = new THREE.HemisphereLight(0xffffff, 0x000000, 1);
  return {
    nodes: [dome, ...plain, stars, sun, sun.target, ambient],
    sun,
    uniforms, // of whoever mirrors the sky
    setSky(name, from, isPlain) {
      const hour = setHour(name, from);
      sun.color.setRGB(...hour.sun);
      sun.intensity = hour.power;
      ambient.color.setRGB(...hour.above);
      ambient.groundColor.setRGB(...hour.below);
      ambient.intensity = hour.fill;
      stars.visible = hour.stars > 0;
      dome.visible = !isPlain;
      for (const node of plain) node.visible = isPlain;
      page.material = isPlain ? finisher : painter;
      renderer.setRenderTarget(isPlain ? finished : bake);
      renderer.render(easel, new THREE.Camera());
      renderer.setRenderTarget(null);
      return hour;
    },
  };
}
