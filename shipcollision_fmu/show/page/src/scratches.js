// Scratches come as ribbons in the .glb, each vertex with the time at which it is drawn. Here a stretch that has begun
// is drawn up to the present time.
import * as THREE from "three";
import { LIGHT } from "./daylight.js";
import { makePaint } from "./plain_paint.js";
import { randomNumbers } from "./random.js";
import { collectTriangles, joinTriangles } from "./triangles.js";

const SHADER_TIME = { value: 0 };
const GLOW = 0.12; // share of its colour that a scratch gives off, so that it is seen in the shade
const STEEL = [[0.56, 0.55, 0.53], [0.40, 0.36, 0.32], [0.30, 0.13, 0.06], [0.07, 0.06, 0.055]]; // bare, worn, rusty, sooty
const OVER = { polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 }; // the plating

/** Colours of a ribbon's corners, 3 numbers each: bare steel, worn, rusty and sooty in turn. */
function colourOf({ attributes: { position } }) {
  const random = randomNumbers(position.count);
  return new Float32Array(Array.from({ length: position.count }, () => STEEL[Math.floor(STEEL.length * random() ** 1.5)]).flat());
}

function growing(material) {
  const made = material.clone();
  made.vertexColors = true;
  made.color.setScalar(1);
  made.emissive.setScalar(0.4 * GLOW);
  made.onBeforeCompile = (shader) => {
    shader.uniforms.uTime = SHADER_TIME;
    shader.vertexShader = `attribute float _time;\nvarying float vDrawnAt;\n${shader.vertexShader}`.replace(
      "#include <begin_vertex>",
      "#include <begin_vertex>\nvDrawnAt = _time;",
    );
    shader.uniforms.uLamps = LIGHT.uLamps;
    shader.fragmentShader = `uniform float uTime, uLamps;\nvarying float vDrawnAt;\n${shader.fragmentShader}`.replace(
      "#include <clipping_planes_fragment>",
      "#include <clipping_planes_fragment>\nif (vDrawnAt > uTime) discard;",
    ).replace(
      "#include <emissivemap_fragment>",
      "#include <emissivemap_fragment>\ntotalEmissiveRadiance *= 1.0 - 0.85 * uLamps; // else it would shine at night",
    );
  };
  return Object.assign(made, OVER);
}

/** All ribbons of a ship as one mesh, triangles in the order of their times: {mesh, times}. */
function joinRibbons(nodes, ship, material) {
  const triangles = collectTriangles(nodes, ship).sort((a, b) => a.last - b.last);
  const geometry = joinTriangles(triangles.map((triangle) => ({ ...triangle, shades: [1, 1, 1] })));
  const colours = colourOf(geometry), { aPaint } = geometry.attributes;
  for (let i = 0; i < aPaint.count; i++) aPaint.setXYZ(i, ...colours.subarray(3 * i, 3 * i + 3));
  const mesh = new THREE.Mesh(geometry, material);
  mesh.renderOrder = 1;
  ship.add(mesh);
  return { mesh, times: triangles.map(({ last }) => last) };
}

/**
 * Makes the ribbons under `root` grow: `show(sinceStart)` draws those up to a time and counts their triangles, `setPlain(isPlain)`
 * draws a ship's ribbons as one.
 */
export function growScratches(root) {
  const stretches = [];
  let material, joined = null, isPlain = false;
  root.traverse((node) => {
    if (node.userData.scratch === undefined || !node.isMesh) return;
    material ??= growing(node.material);
    node.geometry.setAttribute("color", new THREE.BufferAttribute(colourOf(node.geometry), 3));
    node.material = material;
    const { index, attributes } = node.geometry;
    const times = Float32Array.from({ length: index.count / 3 }, (_, i) =>
      Math.max(...[0, 1, 2].map((k) => attributes._time.getX(index.getX(3 * i + k)))),
    ).sort();
    stretches.push({ node, times });
  });

  function join() {
    root.updateMatrixWorld(true);
    const paint = makePaint(GLOW, OVER), byShip = new Map();
    for (const { node } of stretches) byShip.set(node.parent, [...(byShip.get(node.parent) ?? []), node]);
    return [...byShip].map(([ship, nodes]) => joinRibbons(nodes, ship, paint));
  }

  return {
    setPlain(wanted) {
      isPlain = wanted;
      if (isPlain) joined ??= join();
    },
    show(sinceStart) {
      SHADER_TIME.value = sinceStart + 1e-4; // times are in single precision
      let triangles = 0;
      for (const { node, times } of stretches) {
        const hasBegun = node.scale.x > 0.5; // a scale of 0 is drawn as nothing, at a cost
        node.visible = hasBegun && !isPlain;
        if (hasBegun) triangles += times.filter((time) => time <= SHADER_TIME.value).length;
      }
      for (const { mesh, times } of joined ?? []) {
        const drawn = times.filter((time) => time <= SHADER_TIME.value).length;
        mesh.visible = isPlain && drawn > 0;
        mesh.geometry.setDrawRange(0, 3 * drawn);
      }
      return triangles;
    },
  };
}
