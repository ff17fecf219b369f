// Tracks in plan, north up, with the ships' outlines at the time of the clock.
import * as THREE from "three";
import { element } from "./dom.js";
import { follow } from "./follow.js";
import { makeSvg } from "./live/svg.js";
import "./texts_replay.js";
import { inWords } from "./texts.js";
import { lineColour, onTheme } from "./theme.js";

const GAP = 400; // [ms], see follow.js
const SAMPLES = 300; // of a track over the run
const LEFT = 44, BOTTOM = 18, PAD = 10; // around the plan [pixels]
const LEAST = 190, MOST = 340; // height of the plot [pixels]
const STEPS = [1, 2, 5];

/** North and east from the origin [m] and heading [rad] of a ship, `time` [s] after the start. */
function poseAt(track, time) {
  const position = new THREE.Vector3(), q = new THREE.Quaternion();
  track.at(time, position, q);
  return { north: position.x, east: position.y, yaw: Math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)) };
}

/** The smallest of 1, 2, 5, 10 ... that is at least a number. */
export function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * (STEPS.find((step) => step * power >= least * (1 - 1e-9)) ?? 10);
}

/** Corners [east, north] of the plan that holds all points, with room for half a ship around. */
function boundsOf(points, margin) {
  const [east, north] = [points.map(([, e]) => e), points.map(([n]) => n)];
  return { west: Math.min(...east) - margin, east: Math.max(...east) + margin, south: Math.min(...north) - margin, north: Math.max(...north) + margin };
}

/** The plot of ships [{name, colour, track, outline, length, isOther, end}], collisions [{time, point}] and obstacles. */
export function makeTrackPlot({ ships, events, obstacles, start }, clock) {
  const samples = ships.map(({ track, end }) => Array.from({ length: SAMPLES + 1 }, (_, i) => {
    const { north, east } = poseAt(track, ((end - start) * i) / SAMPLES);
    return [north, east];
  }));
  const bounds = boundsOf([...samples.flat(), ...events.map(({ point }) => point)], 0.55 * Math.max(...ships.map(({ length }) => length)));
  const svg = inWords(makeSvg("svg", { role: "img" }), { "aria-label": "track_plot_label" });
  const moving = makeSvg("svg", { class: "moving", "aria-hidden": "true" }); // a picture of its own: the plan below is drawn once
  const chips = ships.filter(({ isOther }) => !isOther).map((ship) => ({ ship, dot: element("i") }));
  const node = element("figure", { class: "track" },
    element("figcaption", {}, element("span", { class: "unit", text: "m" }),
      ...chips.map(({ ship, dot }) => element("span", { class: "chip" }, dot, element("span", { text: ship.name })))), element("div", { class: "plan" }, svg, moving));
  const letter = inWords(makeSvg("text", { "text-anchor": "middle" }), { text: "north_short" });
  let lines = [], hulls = [], marks = [];

  function draw() {
    const width = svg.clientWidth;
    if (!width) return;
    const [across, up] = [bounds.east - bounds.west, bounds.north - bounds.south];
    const room = width - LEFT - PAD;
    const height = Math.round(Math.min(MOST, Math.max(LEAST, (room * up) / across + PAD + BOTTOM)));
    const scale = Math.min(room / across, (height - PAD - BOTTOM) / up);
    const x = (east) => LEFT + room / 2 + scale * (east - (bounds.east + bounds.west) / 2);
    const y = (north) => PAD + (height - PAD - BOTTOM) / 2 - scale * (north - (bounds.north + bounds.south) / 2);
    const at = ([north, east]) => `${x(east).toFixed(1)} ${y(north).toFixed(1)}`;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    moving.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.style.height = moving.style.height = `${height}px`;
    svg.replaceChildren(...grid(width, height, scale, x, y));
    for (const obstacle of obstacles) svg.append(makeSvg("path", { class: "obstacle", d: `M${obstacle.map(at).join("L")}Z` }));
    lines = ships.map(({ isOther }, i) => makeSvg("path", { class: isOther ? "way other" : "way", d: `M${samples[i].map(at).join("L")}` }));
    marks = events.map(({ point }) => makeSvg("path", { class: "contact", d: "M-5-5 5 5M-5 5 5-5", transform: `translate(${x(point[1])} ${y(point[0])})` }));
    hulls = ships.map(({ outline, isOther }) => makeSvg("path", { class: isOther ? "hull other" : "hull",
      d: `M${outline.map(([ahead, starboard]) => `${(scale * starboard).toFixed(2)} ${(-scale * ahead).toFixed(2)}`).join("L")}Z` }));
    svg.append(...lines);
    moving.replaceChildren(...hulls, ...marks);
    const show = () => ships.forEach(({ track }, i) => {
      const { north, east, yaw } = poseAt(track, clock.time - start);
      hulls[i].setAttribute("transform", `translate(${x(east).toFixed(2)} ${y(north).toFixed(2)}) rotate(${((yaw * 180) / Math.PI).toFixed(2)})`);
    });
    paint();
    showNow = () => (show(), marks.forEach((mark, i) => mark.classList.toggle("past", events[i].time <= clock.time)));
    showNow();
  }

  function grid(width, height, scale, x, y) {
    const step = roundStep(56 / scale);
    const [left, right, top, bottom] = [LEFT, width - PAD, PAD, height - BOTTOM];
    const made = [];
    const label = (value) => String(Math.round(value)).replace("-", "\u2212");
    const first = (low) => Math.ceil(low / step) * step;
    const [west, south] = [(left - x(0)) / scale, (y(0) - bottom) / scale];
    for (let east = first(west); x(east) <= right; east += step) {
      made.push(makeSvg("path", { class: "rule", d: `M${x(east).toFixed(1)} ${top}V${bottom}` }), Object.assign(makeSvg("text", { x: x(east), y: height - 5, "text-anchor": "middle" }), { textContent: label(east) }));
    }
    for (let north = first(south); y(north) >= top; north += step) {
      made.push(makeSvg("path", { class: "rule", d: `M${left} ${y(north).toFixed(1)}H${right}` }), Object.assign(makeSvg("text", { x: left - 6, y: y(north) + 4, "text-anchor": "end" }), { textContent: label(north) }));
    }
    const arrow = makeSvg("path", { class: "north", d: `M${right - 12} ${top + 34}V${top + 4}m-4 7 4-8 4 8` });
    letter.setAttribute("x", right - 12);
    letter.setAttribute("y", top + 47);
    return [...made, arrow, letter];
  }

  function paint() {
    for (const { ship, dot } of chips) dot.style.setProperty("--dot", lineColour(ship.colour));
    ships.forEach(({ colour }, i) => {
      lines[i]?.setAttribute("stroke", lineColour(colour));
      hulls[i]?.setAttribute("stroke", lineColour(colour));
      hulls[i]?.setAttribute("fill", lineColour(colour));
    });
  }

  let showNow = () => {};
  new ResizeObserver(draw).observe(node);
  onTheme(paint);
  follow(clock, () => showNow(), GAP);
  return node;
}
