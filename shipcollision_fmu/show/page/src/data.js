// What the page is told: JSON and the .glb, both embedded by show/page/__init__.py, the latter as gzip.

const text = (id) => document.getElementById(id).textContent;

function bytes(base64) {
  const binary = atob(base64);
  const array = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) array[i] = binary.charCodeAt(i);
  return array.buffer;
}

/** The scene's JSON, with the curves as arrays of numbers over `signals.times`; `other` of a page of two runs likewise. */
export function readData() {
  const data = JSON.parse(text("scene-data"));
  for (const { signals } of [data, ...(data.other ? [data.other] : [])]) {
    const numbers = new Float32Array(bytes(signals.values));
    const { rows } = signals;
    signals.times = numbers.subarray(0, rows);
    signals.curves.forEach((curve, i) => (curve.values = numbers.subarray((i + 1) * rows, (i + 2) * rows)));
  }
  return data;
}

/** A .glb as an ArrayBuffer: that of the run, or of the other one. */
export function readGlb(id = "scene-glb") {
  const unpacked = new Blob([bytes(text(id).trim())]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(unpacked).arrayBuffer();
}
