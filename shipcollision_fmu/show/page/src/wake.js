// The wake: a strip of foam on the sea along where the stern has been, a function of time like everything else.
import * as THREE from "three";
import { toWorld } from "./tracks.js";

const SECTIONS = 48;
const SECONDS = 70;
const ACROSS = [-1, 0, 1];

export function makeWake(track, ship) {
  const geometry = new THREE.BufferGeometry();
  const places = new Float32Array(SECTIONS * ACROSS.length * 3);
  const foam = new Float32Array(SECTIONS * ACROSS.length * 2); // opacity, distance across
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  geometry.setAttribute("aFoam", new THREE.BufferAttribute(foam, 2));
  const index = [];
  for (let i = 0; i + 1 < SECTIONS; i++) {
    for (let j = 0; j < 2; j++) {
      const a = 3 * i + j;
      index.push(a, a + 3, a + 1, a + 1, a + 3, a + 4);
    }
  }
  geometry.setIndex(index);
  const material = new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
    vertexShader: /* glsl */ `
      attribute vec2 aFoam;
      varying vec2 vFoam;
      varying vec2 vPlace;
      void main() {
        vFoam = aFoam;
        vPlace = position.xz;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: /* glsl */ `
      varying vec2 vFoam;
      varying vec2 vPlace;
      float hash(vec2 p) {
        p = fract(p * vec2(0.1031, 0.1030));
        p += dot(p, p.yx + 33.33);
        return fract((p.x + p.y) * p.x);
      }
      float noise(vec2 p) {
        vec2 i = floor(p), f = fract(p);
        f = f * f * (3.0 - 2.0 * f);
        return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
      }
      void main() {
        float n = 0.6 * noise(vPlace / 4.0) + 0.4 * noise(vPlace / 1.5);
        float edge = smoothstep(1.0, 0.35, abs(vFoam.y));
        float opacity = vFoam.x * edge * (0.25 + 0.9 * smoothstep(0.35, 0.75, n));
        gl_FragColor = vec4(vec3(0.82, 0.90, 0.93), min(opacity, 0.8));
        #include <tonemapping_fragment>
        #include <colorspace_fragment>
      }`,
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = -4;

  const stern = new THREE.Vector3();
  const astern = new THREE.Vector3();
  const quaternion = new THREE.Quaternion();
  const before = new THREE.Vector3();
  const side = new THREE.Vector3();

  return {
    mesh,
    update(time) {
      for (let i = 0; i < SECTIONS; i++) {
        const age = SECONDS * (i / (SECTIONS - 1)) ** 1.5;
        track.at(time - age, stern, quaternion);
        astern.set(i === 0 ? -0.4 * ship.L_oa : -0.48 * ship.L_oa, 0, 0).applyQuaternion(quaternion);
        toWorld(stern.add(astern));
        track.at(time - age - 0.5, before, quaternion);
        astern.set(-0.48 * ship.L_oa, 0, 0).applyQuaternion(quaternion);
        toWorld(before.add(astern));
        side.subVectors(stern, before);
        const speed = side.length() / 0.5;
        side.set(-side.z, 0, side.x).normalize();
        const half = 0.4 * ship.B + 0.12 * age * Math.min(speed, 8);
        const opacity = Math.min(1, speed / 7) * (1 - age / SECONDS) ** 1.6 * 0.75;
        ACROSS.forEach((across, j) => {
          const k = 3 * i + j;
          places[3 * k] = stern.x + across * half * side.x;
          places[3 * k + 1] = 0.05;
          places[3 * k + 2] = stern.z + across * half * side.z;
          foam[2 * k] = opacity;
          foam[2 * k + 1] = across;
        });
      }
      geometry.attributes.position.needsUpdate = true;
      geometry.attributes.aFoam.needsUpdate = true;
    },
  };
}
