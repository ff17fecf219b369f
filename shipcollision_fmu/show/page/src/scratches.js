// Scratches come as ribbons in the .glb, each vertex with the time at which it is drawn. Here a stretch that has begun
// is drawn up to the present time.

const SHADER_TIME = { value: 0 };

function growing(material) {
  const made = material.clone();
  made.onBeforeCompile = (shader) => {
    shader.uniforms.uTime = SHADER_TIME;
    shader.vertexShader = `attribute float _time;\nvarying float vDrawnAt;\n${shader.vertexShader}`.replace(
      "#include <begin_vertex>",
      "#include <begin_vertex>\nvDrawnAt = _time;",
    );
    shader.fragmentShader = `uniform float uTime;\nvarying float vDrawnAt;\n${shader.fragmentShader}`.replace(
      "#include <clipping_planes_fragment>",
      "#include <clipping_planes_fragment>\nif (vDrawnAt > uTime) discard;",
    );
  };
  made.polygonOffset = true;
  made.polygonOffsetFactor = -2;
  made.polygonOffsetUnits = -2;
  return made;
}

/** Makes the ribbons under `root` grow. Returns what shows them at a time since the start, and counts the triangles. */
export function growScratches(root) {
  const stretches = [];
  let material;
  root.traverse((node) => {
    if (node.userData.scratch === undefined || !node.isMesh) return;
    material ??= growing(node.material);
    node.material = material;
    const { index, attributes } = node.geometry;
    const times = Float32Array.from({ length: index.count / 3 }, (_, i) =>
      Math.max(...[0, 1, 2].map((k) => attributes._time.getX(index.getX(3 * i + k)))),
    ).sort();
    stretches.push({ node, times });
  });
  return (sinceStart) => {
    SHADER_TIME.value = sinceStart + 1e-4; // times are in single precision
    let triangles = 0;
    for (const { node, times } of stretches) {
      node.visible = node.scale.x > 0.5; // a scale of 0 is drawn as nothing, at a cost
      if (node.visible) triangles += times.filter((time) => time <= SHADER_TIME.value).length;
    }
    return triangles;
  };
}
