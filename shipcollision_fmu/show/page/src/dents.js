// Dents: the opening in the side that is struck, and the crushed bow. Both are for the eye, as show/scene/dents.py says:
// ships do not crush in the model. They grow from the time of the contact on, and go when time goes back.
//
// An opening is a patch on the hull in one colour pass: rings around its middle, laid onto the hull by rays. What is seen
// through it is worked out per pixel from the ray of sight: decks, frames and a wall in the dark. Bent plates stand around it.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { crush, grownAt } from "./dent_shapes.js";
import { FIRE, FIRE_GLSL } from "./fire_light.js";
import { FINISH_GLSL } from "./finish.js";
import { randomNumbers } from "./random.js";

const RAYS = 40; // around an opening
const RINGS = [0.25, 0.5, 0.7, 0.85, 1, 1.15, 1.35, 1.6]; // of its half-width; the plating is scraped to the last

const VERTEX = /* glsl */ `
  attribute vec3 aLocal; // forward, up, outwards from the middle [m]
  attribute float aRing; // distance from the middle, 1 at the torn edge
  uniform mat4 uInverse; // from b to forward, up, outwards
  varying vec3 vLocal, vSight;
  varying float vRing;
  void main() {
    vLocal = aLocal;
    vRing = aRing;
    vec3 eye = (uInverse * (inverse(modelMatrix) * vec4(cameraPosition, 1.0))).xyz;
    vSight = aLocal - eye;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

const FRAGMENT = /* glsl */ `
  uniform float uGrown, uDepth, uGlow;
  uniform vec3 uAbove, uBeam;
  varying vec3 vLocal, vSight;
  varying float vRing;
  ${FINISH_GLSL}
  float hash(vec2 p) { return fract(sin(dot(p, vec2(41.3, 289.1))) * 17431.7); }
  void main() {
    vec3 light = (0.55 * uAbove + 0.3 * uBeam) / 3.14159265 + 0.012;
    float edge = vRing - uGrown;
    if (edge > 0.0) {
      // Bare steel at the torn edge, primer beside it, soot farther out and above.
      float rough = hash(floor(vLocal.xy * 3.0)), streak = hash(vec2(floor(vLocal.x * 2.3), 3.0));
      float bare = smoothstep(0.13, 0.04, edge * (0.7 + 0.6 * rough)), worn = smoothstep(0.32, 0.06, edge * (0.7 + 0.6 * streak));
      float soot = 0.85 * smoothstep(0.6, 0.1, edge * (vLocal.y > 0.0 ? 0.75 + 0.4 * streak : 1.5));
      float alpha = max(max(bare, 0.95 * worn), soot) * step(0.01, uGrown);
      vec3 steel = mix(mix(vec3(0.022, 0.02, 0.02), vec3(0.17, 0.075, 0.045), 0.7 * worn), vec3(0.50, 0.49, 0.47) * (0.75 + 0.35 * rough), bare);
      gl_FragColor = vec4(finish(steel * light), alpha);
      return;
    }
    // Into the ship: the nearest of a deck, a frame, and the wall at the back.
    vec3 d = normalize(vSight);
    float back = (-uDepth - vLocal.z) / min(d.z, -0.05);
    float floorAt = 2.7 * (d.y < 0.0 ? floor(vLocal.y / 2.7) : ceil(vLocal.y / 2.7));
    float deck = abs(d.y) > 1e-3 ? (floorAt - vLocal.y) / d.y : 1e6;
    float frameAt = 3.4 * (d.x < 0.0 ? floor(vLocal.x / 3.4) : ceil(vLocal.x / 3.4));
    float frame = abs(d.x) > 1e-3 ? (frameAt - vLocal.x) / d.x : 1e6;
    float way = min(back, min(deck, frame));
    vec3 at = vLocal + way * d;
    float inside = max(0.0, -at.z);
    float shade = way == deck ? (d.y < 0.0 ? 0.16 : 0.07) : way == frame ? 0.11 : 0.05;
    vec3 colour = vec3(0.85, 0.8, 0.76) * shade * light * exp(-inside / (0.14 * uDepth + 0.8));
    // Torn edges of decks and frames stand in the opening.
    float plate = min(abs(vLocal.y - 2.7 * floor(vLocal.y / 2.7 + 0.5)), 1.6 * abs(vLocal.x - 3.4 * floor(vLocal.x / 3.4 + 0.5)));
    colour = mix(colour, vec3(0.20, 0.17, 0.155) * light, smoothstep(0.13, 0.06, plate) * 0.8);
    colour += uGlow * vec3(0.9, 0.22, 0.03) * exp(-abs(inside - 2.0) / 2.0) * (way == deck && d.y < 0.0 ? 0.9 : 0.35) * exp(-0.08 * dot(vLocal.xy, vLocal.xy) / (1.0 + 0.1 * uDepth));
    colour *= 0.25 + 0.5 * smoothstep(0.0, 0.12, -edge); // the plating shades its edge
    gl_FragColor = vec4(finish(colour), 1.0);
  }`;

const PLATE_VERTEX = /* glsl */ `
  uniform vec3 uSun, uAbove, uBelow, uBeam;
  attribute vec3 aTint;
  varying vec3 vColour;
  ${FINISH_GLSL}
  ${FIRE_GLSL}
  void main() {
    vec3 place = (modelMatrix * vec4(position, 1.0)).xyz;
    vec3 up = normalize(mat3(modelMatrix) * normal);
    vec3 eye = cameraPosition - place;
    if (dot(up, eye) < 0.0) up = -up; // plates have two sides
    vec3 light = uBeam * max(dot(up, uSun), 0.0) + mix(uBelow, uAbove, 0.5 + 0.5 * up.y) + 0.4 * fireLight(place, up);
    vColour = finish(aTint * (light / 3.14159265 + 0.01));
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;
const PLATE_FRAGMENT = "varying vec3 vColour; void main() { gl_FragColor = vec4(vColour, 1.0); }";

// One material for all openings, and one for all plates: dents that take the place of smaller ones compile nothing anew.
const OPENING = new THREE.ShaderMaterial({
  uniforms: { uAbove: LIGHT.uAbove, uBeam: LIGHT.uBeam, uInverse: { value: new THREE.Matrix4() }, uGrown: { value: 0 }, uGlow: { value: 0 }, uDepth: { value: 0 } },
  vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, depthWrite: false, side: THREE.DoubleSide, toneMapped: false,
  polygonOffset: true, polygonOffsetFactor: -3, polygonOffsetUnits: -3,
});
const PLATES = new THREE.ShaderMaterial({
  uniforms: { ...LIGHT, ...FIRE }, vertexShader: PLATE_VERTEX, fragmentShader: PLATE_FRAGMENT, side: THREE.DoubleSide, toneMapped: false,
});

/** Triangles of a ship's hull within a distance of a place, in b: three corners each. */
function collectPlating(node, middle, reach) {
  const found = [], corners = [0, 1, 2].map(() => new THREE.Vector3());
  node.children.filter(({ name }) => name.startsWith("hull")).forEach((hull) => hull.traverse((mesh) => {
    if (!mesh.isMesh) return;
    const { index, attributes } = mesh.geometry;
    for (let i = 0; i < index.count; i += 3) {
      corners.forEach((corner, k) => corner.fromBufferAttribute(attributes.position, index.getX(i + k)));
      if (new THREE.Box3().setFromPoints(corners).distanceToPoint(middle) < reach) found.push(corners.map((corner) => corner.clone()));
    }
  }));
  return found;
}

/** Places on the hull along rays from the middle of an opening, by ring; the last that was found where a ray misses. */
function layRings(dent, { node, info }, frame, middle, random) {
  const plating = collectPlating(node, middle, 2.5 * dent.half_width + 1);
  const inwards = frame.outwards.clone().negate(), ray = new THREE.Ray(), hit = new THREE.Vector3();
  const find = (along, up) => {
    const from = middle.clone().addScaledVector(frame.forward, along).addScaledVector(frame.up, up).addScaledVector(frame.outwards, 0.3 * info.B);
    ray.set(from, inwards);
    let nearest = null;
    for (const [p, q, r] of plating) {
      if (ray.intersectTriangle(p, q, r, true, hit) && !(hit.distanceTo(from) >= nearest?.distanceTo(from))) nearest = hit.clone();
    }
    return nearest && nearest.distanceTo(from) < 0.7 * info.B ? nearest : null;
  };
  const centre = find(0, 0) ?? middle.clone();
  const rays = Array.from({ length: RAYS }, (_, i) => {
    const angle = (2 * Math.PI * i) / RAYS;
    const jag = 0.8 + 0.35 * random() + (i % 2 ? 0.12 : -0.08);
    const across = dent.half_width * (0.72 + 0.34 * Math.sin(angle)) * jag; // a bow is broader above
    const upright = 1.15 * dent.half_width * jag;
    let last = centre;
    return RINGS.map((ring) => (last = find(ring * across * Math.cos(angle), ring * upright * Math.sin(angle)) ?? last));
  });
  return { centre, rays };
}

function makeOpening(dent, ship) {
  const { node, info } = ship;
  const outwards = new THREE.Vector3(...dent.outwards).setZ(0).normalize();
  const up = new THREE.Vector3(0, 0, -1), forward = new THREE.Vector3().crossVectors(up, outwards);
  const frame = { forward, up, outwards };
  const random = randomNumbers(Math.round(1000 * Math.abs(dent.point[0])) + 7);
  const middle = new THREE.Vector3(...dent.point);
  middle.z = Math.min(Math.max(middle.z, -info.height + 0.75 * dent.half_width), -0.35 * info.height); // the part that opens above the water
  const { centre, rays } = layRings(dent, ship, frame, middle, random);

  const toFrame = new THREE.Matrix4().makeBasis(forward, up, outwards).setPosition(centre).invert();
  const places = [], locals = [], rings = [], index = [];
  const add = (place, ring) => {
    places.push(...place.clone().addScaledVector(outwards, 0.05).toArray());
    locals.push(...place.clone().applyMatrix4(toFrame).toArray());
    rings.push(ring);
  };
  add(centre, 0);
  for (const ray of rays) ray.forEach((place, k) => add(place, RINGS[k]));
  const n = RINGS.length, at = (i, k) => (k < 0 ? 0 : 1 + n * (i % RAYS) + k);
  for (let i = 0; i < RAYS; i++) {
    for (let k = 0; k < n; k++) {
      index.push(at(i, k - 1), at(i, k), at(i + 1, k));
      if (k) index.push(at(i, k - 1), at(i + 1, k), at(i + 1, k - 1));
    }
  }
  const geometry = new THREE.BufferGeometry().setIndex(index);
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("aLocal", new THREE.Float32BufferAttribute(locals, 3));
  geometry.setAttribute("aRing", new THREE.Float32BufferAttribute(rings, 1));
  const values = { uInverse: toFrame, uGrown: 0, uGlow: 0, uDepth: Math.min(Math.max(3, dent.depth), 0.6 * info.B) };
  const patch = new THREE.Mesh(geometry, OPENING);
  patch.onBeforeRender = () => {
    for (const [name, value] of Object.entries(values)) OPENING.uniforms[name].value = value;
    OPENING.uniformsNeedUpdate = true;
  };
  patch.renderOrder = 0.5; // before fire and smoke
  const plates = makePlates(dent, rays, centre, frame, random);
  for (const mesh of [patch, plates.mesh]) {
    mesh.frustumCulled = false;
    mesh.userData.scratch = true; // nothing that hides a place of impact
    node.add(mesh);
  }
  let shown = -1;
  return {
    grow(share, glow) {
      patch.visible = plates.mesh.visible = share > 0;
      values.uGlow = glow;
      if (share === shown) return;
      shown = share;
      values.uGrown = share;
      if (share > 0) plates.bend(share);
    },
    remove() {
      node.remove(patch, plates.mesh);
      for (const mesh of [patch, plates.mesh]) mesh.geometry.dispose();
    },
  };
}

const CORNERS = [0, 1, 3, 0, 3, 2, 2, 3, 4]; // of a plate: its root (0, 1), its fold (2, 3) and its tip (4)

/** Plates around an opening, folded out and in, from primer at the root to bare steel at the tip. */
function makePlates(dent, rays, centre, { outwards }, random) {
  const geometry = new THREE.BufferGeometry(), n = CORNERS.length;
  const positions = new Float32Array(RAYS * 3 * n), tints = new Float32Array(RAYS * 3 * n);
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setAttribute("aTint", new THREE.BufferAttribute(tints, 3));
  const bends = rays.map(() => ({ out: random(), length: 0.2 + 0.34 * random(), tint: random() }));
  bends.forEach(({ tint }, i) => {
    const root = [0.15, 0.08, 0.055], fold = tint > 0.4 ? [0.40, 0.37, 0.34] : [0.16, 0.12, 0.10], tip = tint > 0.4 ? [0.62, 0.60, 0.57] : [0.26, 0.24, 0.22];
    const all = [root, root, fold, fold, tip];
    tints.set(CORNERS.flatMap((corner) => all[corner]), 3 * n * i);
  });
  /** A place on a ray at a distance in half-widths. */
  const along = (ray, distance) => {
    const k = RINGS.findIndex((ring) => ring >= distance), to = RINGS[k], from = k ? RINGS[k - 1] : 0;
    return (k ? rays[ray][k - 1] : centre).clone().lerp(rays[ray][k], (distance - from) / (to - from));
  };
  return {
    mesh: new THREE.Mesh(geometry, PLATES),
    bend(share) {
      bends.forEach(({ out, length }, i) => {
        const size = dent.half_width * length * share, isOut = out > 0.35;
        const roots = [along(i, share), along((i + 1) % RAYS, share)];
        const folds = roots.map((root, side) => root.clone().lerp(roots[1 - side], 0.14).lerp(centre, (isOut ? 0.28 : 0.14) * length * share)
          .addScaledVector(outwards, size * (isOut ? 0.3 + 0.35 * out : -0.5)));
        const tip = folds[0].clone().lerp(folds[1], 0.25 + 0.5 * out).lerp(centre, (isOut ? -0.5 * out : 0.2) * length * share)
          .addScaledVector(outwards, size * (isOut ? 0.1 + 0.4 * out : -0.5));
        roots.forEach((place) => place.addScaledVector(outwards, 0.06));
        const all = [...roots, ...folds, tip];
        positions.set(CORNERS.flatMap((corner) => all[corner].toArray()), 3 * n * i);
      });
      geometry.attributes.position.needsUpdate = true;
      geometry.computeVertexNormals();
    },
  };
}

const BARE = [0.48, 0.41, 0.37]; // what is left of the colour where paint is worn off and soot lies

/** A bow whose corners move as it is crushed; `node` has the meshes that are seen, of either picture. */
class CrushedBow {
  constructor(dent, { node }) {
    Object.assign(this, { dent, node, moved: new Map() }); // mesh -> what has moved
  }

  /** Corners of a mesh ahead of where the crush begins: as they were, and by how much they change. */
  prepare(mesh) {
    const { position, normal } = mesh.geometry.attributes;
    const corners = [], kept = normal.clone();
    for (let i = 0; i < position.count; i++) {
      const from = [position.getX(i), position.getY(i), position.getZ(i)];
      const { place, worn } = crush(from, this.dent);
      if (worn) corners.push({ i, worn, from, by: place.map((to, k) => to - from[k]) });
    }
    const known = { position, normal, paint: corners.length ? mesh.geometry.attributes.aPaint ?? this.colour(mesh) : null, corners, share: 0 };
    for (const { i, from, by } of corners) position.setXYZ(i, ...from.map((x, k) => x + by[k]));
    if (corners.length) mesh.geometry.computeVertexNormals();
    for (const corner of corners) {
      const [was, is] = [kept, normal].map((normals) => [0, 1, 2].map((k) => normals.getComponent(corner.i, k)));
      Object.assign(corner, { was, turned: is.map((x, k) => x - was[k]) });
      if (known.paint) corner.paint = [0, 1, 2].map((k) => known.paint.getComponent(corner.i, k));
    }
    normal.copy(kept);
    normal.needsUpdate = true;
    this.moved.set(mesh, known);
    return known;
  }

  /** Colours at the corners, for the full picture: the material of this bow alone has them, from its first crush on. */
  colour(mesh) {
    if (mesh.geometry.attributes.color) return mesh.geometry.attributes.color;
    if (!mesh.material.isMeshStandardMaterial || mesh.material.name === "windows") return null;
    const { position } = mesh.geometry.attributes;
    mesh.geometry.setAttribute("color", new THREE.Float32BufferAttribute(new Float32Array(3 * position.count).fill(1), 3));
    const { onBeforeCompile } = mesh.material;
    mesh.material = Object.assign(mesh.material.clone(), { vertexColors: true, onBeforeCompile });
    return mesh.geometry.attributes.color;
  }

  grow(share) {
    const meshes = [];
    this.node.traverseVisible((mesh) => mesh.isMesh && mesh.geometry.attributes.normal && mesh.userData.scratch !== true && meshes.push(mesh));
    for (const mesh of share ? meshes : this.moved.keys()) { // back to what they were: all
      if (share === (this.moved.get(mesh)?.share ?? 0)) continue;
      const known = this.moved.get(mesh) ?? this.prepare(mesh);
      const { position, normal, paint, corners } = known;
      known.share = share;
      for (const { i, worn, from, by, was, turned, paint: before } of corners) {
        position.setXYZ(i, ...from.map((x, k) => x + share * by[k]));
        normal.setXYZ(i, ...was.map((x, k) => x + share * turned[k]));
        if (before) before.forEach((colour, k) => paint.setComponent(i, k, colour * (1 - share * worn * (1 - BARE[k]))));
      }
      for (const changed of corners.length ? [position, normal, paint] : []) if (changed) changed.needsUpdate = true;
    }
  }

  remove() {
    this.grow(0);
  }
}

/** How bright a fire is within a dent at a time: from 0 to 1. */
function glowAt(dent, fires, now) {
  const shares = fires.filter(({ kind, ship, point }) => kind === "fire" && ship === dent.ship && Math.abs(point[0] - dent.point[0]) < 3 * dent.half_width)
    .map(({ time, duration }) => Math.min(1, (now - time) / 0.5, (time + duration + 4 - now) / 6));
  return Math.max(0, ...shares);
}

/** Adds dents to ships, [{node, info}]; `show(time, fires)` lets them grow, and glow where effects burn; `remove()` takes them away. */
export function addDents(dents, ships) {
  const made = dents.map((dent) => {
    const ship = ships.find(({ info }) => info.name === dent.ship);
    return { dent, one: dent.kind === "bow" ? new CrushedBow(dent, ship) : makeOpening(dent, ship) };
  });
  return {
    /** At a time of the run [s]; how far each has grown, 0 to 1. */
    show: (time, fires) => made.map(({ dent, one }) => {
      const share = grownAt(dent, time);
      one.grow(share, glowAt(dent, fires, time));
      return share;
    }),
    remove: () => made.forEach(({ one }) => one.remove()),
  };
}
