// What the page is told: JSON and the .glb, both embedded by show/page/__init__.py.

const text = (id) => document.getElementById(id).textContent;

function bytes(base64) {
  const binary = atob(base64);
  const array = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) array[i] = binary.charCodeAt(i);
  return array.buffer;
}

/** The scene's JSON, with the curves as arrays of numbers over `signals.times`. */
export function readData() {
  const data = JSON.parse(text("scene-data"));
  const numbers = new Float32Array(bytes(data.signals.values));
  const rows = data.signals.rows;
  data.signals.times = numbers.subarray(0, rows);
  data.signals.curves.forEach((curve, i) => {
    curve.values = numbers.subarray((i + 1) * rows, (i + 2) * rows);
  });
  return data;
}

/** The .glb as an ArrayBuffer. */
export const readGlb = () => bytes(text("scene-glb").trim());
