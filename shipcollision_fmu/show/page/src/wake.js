// What a ship does to the water, drawn into foam.js's texture: the waves that Kelvin found behind a ship on her real
// track, the churned water behind her stern, and bow wave, foam and shade along her waterline. All are functions of the
// track up to the time that is shown.
import * as THREE from "three";
import { makeBowWave } from "./bow_wave_mesh.js";
import { ON_SEA, ON_SEA_HEAD, ON_SEA_PIXEL, ON_SEA_UNIFORMS } from "./on_sea.js";
import { WATER } from "./ripples.js";
import { toWorld } from "./tracks.js";
import { findWaterline } from "./waterline.js";

const SECTIONS = 72;
const SECONDS = 260; // how old the oldest wake is

const ADDING = {
  blending: THREE.CustomBlending, blendSrc: THREE.OneFactor, blendDst: THREE.OneFactor, blendSrcAlpha: THREE.OneFactor, blendDstAlpha: THREE.OneFactor,
  depthTest: false, depthWrite: false, side: THREE.DoubleSide, transparent: true,
};
const TO_FIELD = "gl_Position = vec4((place - uCover.xy) / uCover.z, 0.0, 1.0);";

/** A strip along the track: Kelvin's waves and the wake of the stern. */
export function makeWake({ track, info }, cover) {
  const places = new Float32Array(SECTIONS * 2 * 3), water = new Float32Array(SECTIONS * 2 * 4);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setAttribute("aWater", new THREE.BufferAttribute(water, 4)); // from the bow [m], across [m], age [s], speed [m/s]
  const index = [];
  for (let i = 0; i + 1 < SECTIONS; i++) index.push(2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3);
  geometry.setIndex(index);
  const size = { value: new THREE.Vector2(info.L_oa, info.B) };
  const vertexShader = (head, toPlace) => /* glsl */ `
      attribute vec4 aWater;
      uniform vec4 uCover;
      varying vec4 vWater;
      ${head}
      void main() {
        vWater = aWater;
        vec2 place = position.xz;
        ${toPlace}
      }`;
  const fragmentShader = (hasWaves, head, colour) => /* glsl */ `
      uniform vec4 uCover;
      uniform vec2 uSize;
      varying vec4 vWater;
      ${head}
      void main() {
        float x = max(vWater.x, 0.1), y = abs(vWater.y), age = vWater.z, speed = vWater.w;
        float L = uSize.x, B = uSize.y;
        float old = age / ${SECONDS.toFixed(1)};
        float height = 0.0;
        ${hasWaves ? /* glsl */ `
        // Kelvin (1887): of all waves that keep pace with the ship, those in phase at x, y have tan(theta) = t.
        float k = 9.81 / max(speed * speed, 1.0), edge = 8.0 * y * y / (x * x);
        if (edge < 1.0 && speed > 0.8) {
          float root = sqrt(1.0 - edge);
          float inside = smoothstep(1.0, 0.80, edge);
          float amplitude = 0.075 * speed * speed / 9.81 * min(1.0, B / 12.0) * inversesqrt(1.0 + k * x * 0.25);
          amplitude *= smoothstep(0.8, 3.0, speed) * (1.0 - old) * inside * smoothstep(0.0, 0.12 * L, x);
          float t1 = x * (1.0 + root) / (4.0 * max(y, 0.5)), t2 = x * (1.0 - root) / (4.0 * max(y, 0.5));
          float length1 = 6.2832 / (k * (1.0 + t1 * t1));
          float drawn = smoothstep(3.0 * uCover.w, 7.0 * uCover.w, length1) * smoothstep(0.08 * B, 0.4 * B, length1);
          height += amplitude * (0.9 + 0.9 * smoothstep(0.45, 0.95, edge)) * drawn * cos(k * sqrt(1.0 + t1 * t1) * (x - y * t1));
          height += amplitude * 0.55 * cos(k * sqrt(1.0 + t2 * t2) * (x - y * t2));
        }` : ""}
        // Foam of the breaking bow wave, thrown aside, and of the water behind the stern.
        float arm = 0.5 * B * (1.0 - exp(-x / (0.10 * L))) + 0.17 * x;
        float thick = 1.2 + 0.10 * B * min(1.0, x / (0.5 * L)) + 0.015 * x;
        float bow = exp(-pow((y - arm) / thick, 2.0)) * exp(-x / (0.55 * L)) * smoothstep(2.0, 8.0, speed) * smoothstep(0.0, 0.04 * L, x);
        float behind = x - 0.96 * L;
        float wide = 0.40 * B + 0.6 * sqrt(max(behind, 0.0)) + 0.004 * max(behind, 0.0);
        float across = y / wide;
        float stern = smoothstep(1.0, 0.55, across) * (0.62 + 0.5 * smoothstep(0.35, 0.85, across)) * smoothstep(0.0, 6.0, behind);
        float fresh = exp(-max(behind, 0.0) / max(speed, 0.5) / 38.0);
        float strength = smoothstep(0.5, 7.0, speed) * (1.0 - old);
        float foam = 0.80 * bow + 0.92 * stern * strength * fresh;
        float churned = stern * strength * exp(-max(behind, 0.0) / max(speed, 0.5) / 110.0);
        height *= 1.0 - 0.8 * stern * strength;
        gl_FragColor = ${colour};
      }`;
  const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
    ...ADDING, uniforms: { uCover: cover, uSize: size },
    vertexShader: vertexShader("", TO_FIELD), fragmentShader: fragmentShader(true, "", "vec4(foam, height, 0.0, churned)"),
  }));
  const plain = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
    ...ON_SEA, uniforms: { ...ON_SEA_UNIFORMS, uSize: size },
    vertexShader: vertexShader(ON_SEA_HEAD, "gl_Position = onSea(place, 0.0);"), fragmentShader: fragmentShader(false, `uniform sampler2D uRipples;${ON_SEA_PIXEL}`, "paintFoam(foam, churned, 0.0)"),
  }));
  plain.renderOrder = -5;
  mesh.frustumCulled = plain.frustumCulled = false;
  const middle = new THREE.Vector3(), before = new THREE.Vector3(), side = new THREE.Vector3(), ahead = new THREE.Vector3(), q = new THREE.Quaternion();

  /** How far from the track foam reaches: thrown aside from the bow at first, then behind the stern. */
  function widthOfFoam(distance) {
    const { L_oa: L, B } = info, behind = Math.max(0, distance - 0.96 * L);
    const share = Math.min(1, Math.max(0, distance / L - 1.6));
    return (1 - share) * (0.2 * Math.min(distance, 1.6 * L) + 0.75 * B) + share * 1.05 * (0.4 * B + 0.6 * Math.sqrt(behind) + 0.004 * behind);
  }

  function section(i, distance, age, speed, isPlain) {
    const half = isPlain ? widthOfFoam(distance) : Math.min(0.37 * distance + 0.7 * info.B, 460); // Kelvin's waves are wider
    for (const [j, across] of [-half, half].entries()) {
      const k = 2 * i + j;
      places.set([middle.x + across * side.x, 0, middle.z + across * side.z], 3 * k);
      water.set([distance, across, age, speed], 4 * k);
    }
  }

  return {
    mesh,
    plain,
    update(time, isPlain) {
      let distance = 0.5 * info.L_oa;
      const last = new THREE.Vector3();
      for (let i = 1; i < SECTIONS; i++) {
        const age = SECONDS * ((i - 1) / (SECTIONS - 2)) ** 1.6;
        track.at(time - age, middle, q);
        ahead.set(1, 0, 0).applyQuaternion(q);
        toWorld(ahead).setY(0).normalize();
        toWorld(middle).setY(0);
        track.at(time - age - 0.5, before, q);
        toWorld(before).setY(0);
        side.subVectors(middle, before);
        const speed = side.length() / 0.5;
        if (speed < 0.4 || side.dot(ahead) < 0) side.copy(ahead); // where she is pushed aside or astern, no wake of her own
        side.set(-side.z, 0, side.x).normalize();
        if (i > 1) distance += middle.distanceTo(last);
        last.copy(middle);
        section(i, distance, age, speed, isPlain);
        if (i === 1) {
          middle.addScaledVector(ahead, 0.5 * info.L_oa);
          section(0, 0, 0, speed, isPlain);
        }
      }
      geometry.attributes.position.needsUpdate = true;
      geometry.attributes.aWater.needsUpdate = true;
    },
  };
}

const OFFSETS = [-1, 0, 0.12, 0.3, 0.6, 1]; // of the reach of the foam beside a hull

/** A band around the waterline: bow wave, foam and shade, from how fast the plating moves against the water. */
export function makeHullFoam(ship, cover) {
  const { track, info } = ship;
  const { x, port, starboard } = findWaterline(ship);
  const loop = [...x.map((at, i) => [at, starboard[i]]), ...x.map((at, i) => [at, -port[i]]).reverse()];
  const reach = Math.min(13, Math.max(2, 0.32 * info.B));
  const places = [], normals = [], outs = [], index = [];
  loop.forEach(([px, py], i) => {
    const [ax, ay] = loop[(i + loop.length - 1) % loop.length], [bx, by] = loop[(i + 1) % loop.length];
    const length = Math.hypot(bx - ax, by - ay) || 1;
    const nx = (ay - by) / length, ny = (bx - ax) / length; // outwards, for the loop runs forward on starboard
    for (const out of OFFSETS) {
      places.push(px + nx * out * reach, py + ny * out * reach, 0);
      normals.push(nx, ny, 0);
      outs.push(out);
    }
    const n = OFFSETS.length, next = ((i + 1) % loop.length) * n;
    for (let k = 0; k + 1 < n; k++) index.push(i * n + k, next + k, i * n + k + 1, i * n + k + 1, next + k, next + k + 1);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  geometry.setAttribute("aOut", new THREE.Float32BufferAttribute(outs, 1));
  geometry.setIndex(index);
  const pose = new THREE.Vector4(), flow = new THREE.Vector3();
  const uniforms = {
    uPose: { value: pose }, uFlow: { value: flow }, uEnds: { value: new THREE.Vector2(x[0], x.at(-1)) }, uReach: { value: reach }, uRipples: WATER.uRipples,
  };
  const vertexShader = (head, toPlace) => /* glsl */ `
      attribute float aOut;
      uniform vec4 uCover, uPose;
      uniform vec3 uFlow;
      uniform vec2 uEnds;
      varying vec4 vHull; // out, speed of the plating against the water, speed, share of the length from the bow
      varying vec2 vPlace;
      ${head}
      void main() {
        vec2 p = position.xy;
        vec2 place = uPose.xy + uPose.zw * p.x + vec2(-uPose.w, uPose.z) * p.y;
        vec2 velocity = vec2(uFlow.x - uFlow.z * p.y, uFlow.y + uFlow.z * p.x);
        vHull = vec4(aOut, dot(velocity, normal.xy), length(velocity), (uEnds.y - p.x) / (uEnds.y - uEnds.x));
        vPlace = place;
        ${toPlace}
      }`;
  const fragmentShader = (head, colour) => /* glsl */ `
      uniform float uReach;
      uniform sampler2D uRipples;
      varying vec4 vHull;
      varying vec2 vPlace;
      ${head}
      void main() {
        float out_ = max(vHull.x, 0.0), push = vHull.y, speed = vHull.z, from = vHull.w;
        // The edge of the foam is ragged: patches of the water that the ship passes keep it longer than others.
        float patches = 0.6 * texture2D(uRipples, vPlace / 37.0).b + 0.4 * texture2D(uRipples, vPlace.yx / 13.0).b;
        float ragged = max(0.0, out_ * (1.0 + 2.6 * (patches - 0.5)) + 0.25 * (patches - 0.5) * smoothstep(0.0, 0.2, out_));
        float near = (1.0 - out_) * (1.0 - out_), thin = exp(-4.5 * ragged) * smoothstep(1.0, 0.55, out_);
        float height = 0.45 * push * abs(push) / 19.62 * exp(-2.5 * out_) * (1.0 - out_);
        float foam = 1.1 * smoothstep(0.4, 3.2, push) * exp(-2.4 * ragged) * smoothstep(1.0, 0.6, out_);
        foam += 0.55 * smoothstep(1.0, 8.0, speed) * exp(-2.2 * from) * exp(-2.0 * ragged) * smoothstep(1.0, 0.5, out_);
        foam += 0.55 * smoothstep(0.3, 6.0, speed) * thin;
        foam += 0.14 * exp(-1.3 * uReach * out_); // the swell laps at the plating
        gl_FragColor = ${colour};
      }`;
  const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
    ...ADDING, uniforms: { ...uniforms, uCover: cover },
    vertexShader: vertexShader("", TO_FIELD), fragmentShader: fragmentShader("", "vec4(foam, clamp(height, -0.8, 1.6), vHull.x < 0.0 ? 1.0 : near, 0.35 * foam)"),
  }));
  const plain = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
    ...ON_SEA, uniforms: { ...uniforms, ...ON_SEA_UNIFORMS },
    vertexShader: vertexShader(ON_SEA_HEAD, "gl_Position = onSea(place, 0.0);"), fragmentShader: fragmentShader(ON_SEA_PIXEL, "step(0.0, vHull.x) * paintFoam(foam, 0.35 * foam, near)"),
  }));
  plain.renderOrder = -4;
  const bowWave = makeBowWave({ x, port, starboard }, info.T);
  mesh.frustumCulled = plain.frustumCulled = false;
  const now = new THREE.Vector3(), before = new THREE.Vector3(), q = new THREE.Quaternion(), ahead = new THREE.Vector3();
  const bearing = (quaternion) => {
    ahead.set(1, 0, 0).applyQuaternion(quaternion);
    return Math.atan2(ahead.y, ahead.x);
  };
  return {
    mesh,
    plain,
    raised: bowWave.mesh,
    update(time) {
      track.at(time - 0.25, before, q);
      const was = bearing(q);
      track.at(time, now, q);
      const heading = bearing(q), c = Math.cos(heading), s = Math.sin(heading);
      const north = (now.x - before.x) / 0.25, east = (now.y - before.y) / 0.25;
      const turned = Math.atan2(Math.sin(heading - was), Math.cos(heading - was));
      flow.set(north * c + east * s, east * c - north * s, turned / 0.25);
      toWorld(now);
      pose.set(now.x, now.z, c, s);
      bowWave.update(pose.toArray(), flow.toArray());
    },
  };
}
