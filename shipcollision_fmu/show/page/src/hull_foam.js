// Foam and shade along a ship's waterline, from how fast her plating moves against the water; and her bow wave.
import * as THREE from "three";
import { makeBowWave } from "./bow_wave_mesh.js";
import { ADDING, TO_FIELD } from "./field.js";
import { ON_SEA, ON_SEA_HEAD, ON_SEA_PIXEL, ON_SEA_UNIFORMS } from "./on_sea.js";
import { makePlainMirror } from "./plain_mirror.js";
import { WATER } from "./ripples.js";
import { toWorld } from "./tracks.js";

const OFFSETS = [-1, 0, 0.12, 0.3, 0.6, 1]; // of the reach of the foam beside a hull

/** A band around the waterline: bow wave, foam and shade, from how fast the plating moves against the water. */
export function makeHullFoam({ track, info }, { x, port, starboard }, cover) {
  const loop = [...x.map((at, i) => [at, starboard[i]]), ...x.map((at, i) => [at, -port[i]]).reverse()];
  const reach = Math.min(13, Math.max(2, 0.32 * info.B));
  const places = [], normals = [], outs = [], index = [], outwards = [];
  loop.forEach(([px, py], i) => {
    const [ax, ay] = loop[(i + loop.length - 1) % loop.length], [bx, by] = loop[(i + 1) % loop.length];
    const length = Math.hypot(bx - ax, by - ay) || 1;
    const nx = (ay - by) / length, ny = (bx - ax) / length; // outwards, for the loop runs forward on starboard
    outwards.push([nx, ny]);
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
        foam += 0.4 * smoothstep(0.3, 6.0, speed) * thin;
        gl_FragColor = ${colour};
      }`;
  const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
    ...ADDING, uniforms: { ...uniforms, uCover: cover },
    vertexShader: vertexShader("", TO_FIELD), fragmentShader: fragmentShader("", "vec4(foam, clamp(height, -0.8, 1.6), vHull.x < 0.0 ? 1.0 : near, 0.35 * foam)"),
  }));
  const foam = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
    ...ON_SEA, uniforms: { ...uniforms, ...ON_SEA_UNIFORMS },
    vertexShader: vertexShader(ON_SEA_HEAD, "gl_Position = onSea(place, 0.0);"), fragmentShader: fragmentShader(ON_SEA_PIXEL, "step(0.0, vHull.x) * paintFoam(foam, 0.35 * foam, near)"),
  }));
  foam.renderOrder = -4;
  const plain = new THREE.Group().add(makePlainMirror(loop, outwards, info, uniforms.uPose), foam);
  const bowWave = makeBowWave({ x, port, starboard }, info.T);
  mesh.frustumCulled = foam.frustumCulled = false;
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
