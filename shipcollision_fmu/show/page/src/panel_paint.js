// Containers and windows of the full picture, drawn on their pieces (panels.js): posts, corrugation and doors; frames, panes
// set back in them, curtains, and at night some lamps behind them.
import * as THREE from "three";
import { BRIDGE, litOf, measurePanels } from "./panels.js";

export const PANEL_VERTEX = /* glsl */ `
  attribute vec4 aPanel;
  attribute float aNumber, aLit;
  varying vec4 vPanel;
  varying float vNumber, vLit;`;

export const PANEL_SET = "vPanel = aPanel; vNumber = aNumber; vLit = aLit;";

export const PANEL_FRAGMENT = /* glsl */ `
  varying vec4 vPanel;
  varying float vNumber, vLit;`;

/** `steel`: the colour of a container; its long sides are corrugated, its ends have doors. */
export const CONTAINER = /* glsl */ `
  vec2 fromEdge = min(vPanel.xy, vPanel.zw - vPanel.xy);
  float nearEdge = min(fromEdge.x, fromEdge.y);
  float footprint = max(fwidth(vPanel.x), fwidth(vPanel.y)) + 1e-4; // of a pixel [m]
  bool isSide = vPanel.z > 5.0;
  // Boxes of one line differ in age and dirt: faded, darker, more or less grey.
  vec3 steel = diffuseColor.rgb;
  float age = fract(vNumber * 13.7);
  steel = mix(steel, vec3(dot(steel, vec3(0.3, 0.5, 0.2))) * 1.1, 0.05 + 0.30 * age) * (0.74 + 0.36 * fract(vNumber * 5.3));
  float within = smoothstep(0.10, 0.14, nearEdge); // posts and rails are smooth
  float fine = smoothstep(0.55, 0.15, footprint / 0.30);
  float wave = abs(bNormal.z) > 0.7 ? 0.4 * sin(vPanel.x * 20.9) : isSide ? sin(vPanel.x * 20.9) : 0.0;
  steel *= 1.0 - within * (0.07 - 0.19 * wave * fine);
  if (!isSide && abs(bNormal.z) < 0.7) {
    float across = abs(vPanel.x - 0.5 * vPanel.z);
    float bars = max(smoothstep(0.045 + footprint, 0.02, abs(across - 0.35)), smoothstep(0.045 + footprint, 0.02, abs(across - 0.85)));
    float gaskets = smoothstep(0.03 + footprint, 0.01, min(across, abs(nearEdge - 0.12)));
    steel = mix(steel, vec3(0.30, 0.30, 0.29), 0.6 * bars * within);
    steel *= 1.0 - 0.55 * gaskets / (1.0 + 6.0 * footprint);
  } else if (isSide && fract(vNumber * 3.1) > 0.45) {
    // The line's name in white blocks on the upper half.
    vec2 text = (vPanel.xy - vec2((0.28 + 0.3 * fract(vNumber * 9.7)) * vPanel.z, 0.52 * vPanel.w)) / vec2(0.62, 0.62);
    float letter = step(0.0, text.x) * step(text.x, 5.0) * step(0.0, text.y) * step(text.y, 1.0) * step(fract(text.x), 0.74);
    float cut = step(0.35, hash(floor(vec2(text.x * 3.0, text.y * 3.0)) + 31.0 * vNumber));
    steel = mix(steel, vec3(0.62, 0.61, 0.58), 0.75 * letter * mix(0.6, cut, smoothstep(0.3, 0.1, footprint)));
  }
  float casting = step(fromEdge.x, 0.19) * step(fromEdge.y, 0.14);
  steel = mix(steel, vec3(0.06), 0.7 * casting * smoothstep(0.4, 0.1, footprint));
  // Rust runs down from the upper rail, and dirt lies along the lower one.
  float run = noise(vec2(vPanel.x * 2.3 + 40.0 * vNumber, vPanel.y * 0.25));
  steel = mix(steel, vec3(0.16, 0.075, 0.035), smoothstep(0.62, 0.90, run) * (0.15 + 0.45 * age));
  steel *= 0.86 + 0.14 * smoothstep(0.0, 0.6, vPanel.y);
  diffuseColor.rgb = steel;`;

/** Colour, roughness and what shines out of a window; `glass` is what of a place is pane. */
export const PANE = /* glsl */ `
  vec2 fromFrame = min(vPanel.xy, vPanel.zw - vPanel.xy);
  float soft = max(fwidth(vPanel.x), fwidth(vPanel.y)) + 1e-4;
  float glass = smoothstep(0.05 - 0.7 * soft, 0.05 + 0.3 * soft, min(fromFrame.x, fromFrame.y));
  float drop = vPanel.w - vPanel.y; // below the upper edge
  bool isBridge = vPanel.z > ${BRIDGE.toFixed(1)};
  float curtain = isBridge ? 0.0 : step(0.55, fract(vNumber * 5.9)) * step(abs(vPanel.x / vPanel.z - 0.5), 0.5) * smoothstep(0.18, 0.22, abs(vPanel.x / vPanel.z - 0.5));
  vec3 inner = mix(vec3(0.012, 0.016, 0.020), vec3(0.20, 0.185, 0.16) * (0.7 + 0.3 * sin(vPanel.x * 60.0)), 0.6 * curtain);
  inner *= smoothstep(0.02, 0.22, drop); // the frame's own shadow: panes are set back
  diffuseColor.rgb = mix(vec3(0.13, 0.135, 0.14), inner, glass);`;

/** Light from within: from lamps at the ceiling, with curtains before it. */
export const PANE_GLOW = /* glsl */ `
  #include <emissivemap_fragment>
  totalEmissiveRadiance *= glass * vLit * (0.55 + 0.55 * vPanel.y / vPanel.w) * (1.0 - 0.45 * curtain) * mix(vec3(1.0), vec3(0.80, 1.0, 1.45), step(0.80, fract(vNumber * 11.3)));`;

/** Gives a geometry what the shaders above need to know of its pieces. */
export function addPanels(geometry) {
  const { index, attributes: { position, normal } } = geometry;
  const { panel, number } = measurePanels(index.array, position.array, normal.array);
  const lit = number.map((value, i) => litOf(value, panel[4 * i + 2]));
  for (const [name, values, size] of [["aPanel", panel, 4], ["aNumber", number, 1], ["aLit", lit, 1]]) {
    geometry.setAttribute(name, new THREE.BufferAttribute(values, size));
  }
}
