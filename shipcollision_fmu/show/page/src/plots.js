// Curves over time, one under the other, with one cursor and one line at the present time. A click goes there; dragging
// zooms all of them, a double click shows the whole again.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { axisRange, isMoving } from "./axis_range.js";
import { element } from "./dom.js";
import { follow } from "./follow.js";
import { compass, degrees, number } from "./format.js";
import { KNOT } from "./live/navigation.js";
import "./texts_replay.js";
import { inWords, onLanguage, say } from "./texts.js";
import { isDark, lineColour, onTheme } from "./theme.js";

const HEIGHT = 108;
const GAP = 200; // [ms], see follow.js
const SLACK = 1e-4; // of times in single precision [s]
const same = (x) => x;
/** A number on an axis: as short as it goes, without groups, which look like decimals elsewhere. */
const mark = (value) => String(Number(value.toPrecision(6))).replace("-", "\u2212");

// Title, unit, what of the scene it shows, factor or function to that unit, digits, least range of the axis, and how a
// value is shown where that is not the value itself: a curve of the heading goes on beyond 360, its numbers do not.
// All axes but that of the heading have their zero. Speeds have a second axis, in knots.
const PLOTS = [
  { title: "speed", unit: "m/s", quantities: ["speed"], to: same, digits: 2, range: 0.2, hasZero: true, hasKnots: true },
  { title: "surge", unit: "m/s", quantities: ["surge"], to: same, digits: 2, range: 0.2, hasZero: true, hasKnots: true },
  { title: "yaw_rate", unit: "°/s", quantities: ["yaw_rate"], to: degrees, digits: 3, range: 0.02, hasZero: true },
  { title: "roll", unit: "°", quantities: ["roll"], to: degrees, digits: 2, range: 0.2, hasZero: true },
  { title: "heading", unit: "°", quantities: ["heading"], to: degrees, digits: 1, range: 1, hasZero: false, shown: compass },
  { title: "energy", unit: "MJ", quantities: ["kinetic", "dissipated"], to: (x) => x / 1e6, digits: 1, range: 0.01, hasZero: true },
  { title: "impulse", unit: "MN s", quantities: ["normal", "tangential"], to: (x) => x / 1e6, digits: 2, range: 0.001, hasZero: true },
  { title: "clearance", unit: "m", quantities: ["clearance"], to: same, digits: 2, range: 0.5, hasZero: true },
];
const COMMON = { dissipated: "#e07b00", normal: "#c65d07", tangential: "#8a7a00", clearance: "#3d7f6a" };
const OTHER_DASHES = { tangential: [2, 4] };
const DASHES = { kinetic: undefined, tangential: [5, 3] };

function valueAt(times, values, time) {
  let low = 0;
  let high = times.length - 1;
  if (time <= times[low]) return values[low];
  if (time >= times[high]) return values[high];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    times[middle] <= time ? (low = middle) : (high = middle);
  }
  const share = (time - times[low]) / (times[high] - times[low]);
  return values[low] + share * (values[high] - values[low]);
}

/** A line's value at a time, or null outside its run. */
function valueWithin({ times, values }, time) {
  if (time < times[0] - SLACK || time > times.at(-1) + SLACK) return null;
  return valueAt(times, values, time);
}

/** All times of two runs, in order. */
export const mergeTimes = (first, second) => Float64Array.from(new Set([...first, ...second])).sort();

/** The lines of a plot of a run: name, values in its unit, colour, dash. */
function linesOf(plot, data, run) {
  const colourOf = (name) => data.ships.find((ship) => ship.name === name).colour;
  return plot.quantities.flatMap((quantity) => data.signals.curves.filter((curve) => curve.quantity === quantity)).map((curve) => ({
    ship: curve.ship,
    quantity: curve.quantity,
    run,
    times: data.signals.times,
    values: Float64Array.from(curve.values, plot.to),
    colour: () => lineColour(curve.ship === null ? COMMON[curve.quantity] : colourOf(curve.ship)),
    dash: run ? OTHER_DASHES[curve.quantity] ?? [6, 4] : DASHES[curve.quantity],
  }));
}

const labelOf = ({ ship, quantity }) => (ship === null ? inWords(element("span"), { text: quantity }) : element("span", { text: ship }));

function makePlot(plot, lines, times, clock, cursor) {
  const chips = lines.map((line) => {
    const value = element("b");
    const knots = element("small", { class: "knots" });
    const dot = element("i");
    return { line, value, knots, dot, node: element("span", { class: line.run ? "chip other" : "chip" }, dot, labelOf(line), value, ...(plot.hasKnots ? [knots] : [])) };
  });
  const now = element("div", { class: "now" });
  const place = element("div", { class: "curves", role: "img" });
  onLanguage(() => place.setAttribute("aria-label", say("curve_of", { title: say(plot.title), unit: plot.unit })));
  const node = element(
    "figure",
    { class: "plot", "data-plot": plot.title },
    element("figcaption", {}, inWords(element("h3"), { text: plot.title }), element("span", { class: "unit", text: plot.unit }), ...chips.map((chip) => chip.node)),
    place,
  );

  const ink = () => (isDark() ? "#9fb0bd" : "#5a6b78");
  const rule = () => (isDark() ? "rgba(255,255,255,0.07)" : "rgba(20,40,60,0.09)");
  const axis = { stroke: ink, grid: { stroke: rule, width: 1 }, ticks: { show: false }, font: "11px system-ui, sans-serif", values: (_, marks) => marks.map(mark) };
  const shown = (value, digits) => (plot.shown && value !== null ? plot.shown(value, digits) : value);
  const chart = new uPlot(
    {
      width: 320,
      height: HEIGHT,
      padding: [6, 10, 0, 0],
      pxAlign: 0,
      legend: { show: false },
      cursor: { sync: { key: cursor.key }, drag: { x: true, y: false, dist: 6 }, points: { size: 5 }, y: false },
      scales: {
        x: { time: false },
        y: {
          range: (_, low, high) => axisRange(low, high, plot.range, plot.hasZero),
        },
        ...(plot.hasKnots ? { knots: { from: "y", range: (_, low, high) => [low / KNOT, high / KNOT] } } : {}),
      },
      axes: [
        { ...axis, size: 20, gap: 2 },
        { ...axis, size: 46, gap: 4, space: 26, values: (_, marks) => marks.map((value) => mark(shown(value, 6))) },
        ...(plot.hasKnots ? [{ ...axis, scale: "knots", side: 1, size: 30, gap: 4, space: 26, grid: { show: false } }] : []),
      ],
      series: [{}, ...lines.map((line) => ({ stroke: line.colour, width: 1.6, dash: line.dash, points: { show: false } }))],
    },
    [times, ...lines.map((line) => (line.times === times ? line.values : Array.from(times, (time) => valueWithin(line, time))))],
    place,
  );
  chart.over.append(now);
  let pressedAt = null;
  chart.over.addEventListener("mousedown", (event) => (pressedAt = event.clientX));
  chart.over.addEventListener("mouseup", (event) => {
    if (pressedAt !== null && Math.abs(event.clientX - pressedAt) < 4) {
      clock.seek(chart.posToVal(event.clientX - chart.over.getBoundingClientRect().left, "x"));
    }
    pressedAt = null;
  });

  return {
    node,
    show(time) {
      const x = chart.valToPos(time, "x");
      now.style.transform = `translateX(${x.toFixed(1)}px)`;
      now.hidden = !(x >= 0 && x <= chart.over.clientWidth);
      for (const { line, value, knots } of chips) {
        const present = valueWithin(line, time);
        value.textContent = number(shown(present, plot.digits), plot.digits);
        if (plot.hasKnots) knots.textContent = present === null ? "" : `${number(present / KNOT, 1)} ${say("knots")}`;
      }
    },
    paint() {
      for (const { line, dot } of chips) dot.style.setProperty("--dot", line.colour());
      chart.redraw(false);
    },
    resize() {
      if (place.clientWidth > 0 && place.clientWidth !== chart.width) chart.setSize({ width: place.clientWidth, height: HEIGHT });
    },
    onZoom: (listener) => (chart.hooks.setScale ??= []).push(listener),
  };
}

/** A node that says what does not change, with the values. */
function makeSteady(steady) {
  const node = element("p", { class: "none", id: "steady", hidden: steady.length === 0 });
  const valuesOf = ({ plot, lines }) => {
    const texts = lines.map(({ values, ship, quantity }) => {
      const value = number(plot.shown ? plot.shown(values[0], plot.digits) : values[0], plot.digits);
      return { value, name: ship ?? say(quantity) };
    });
    const isSame = texts.every(({ value }) => value === texts[0].value);
    return `${say(plot.title)} (${isSame ? texts[0].value : texts.map(({ name, value }) => `${name} ${value}`).join(", ")} ${plot.unit})`;
  };
  onLanguage(() => (node.textContent = say("steady", { what: steady.map(valuesOf).join(", ") })));
  return node;
}

/** All plots as a node, which follow the clock; a quantity that never changes has a line of text in place of a plot. */
export function makePlots(data, clock) {
  const cursor = uPlot.sync("run");
  const runs = data.other ? [data, data.other] : [data];
  const times = data.other ? mergeTimes(data.signals.times, data.other.signals.times) : data.signals.times;
  const all = PLOTS.map((plot) => ({ plot, lines: runs.flatMap((one, run) => linesOf(plot, one, run)) })).filter(({ lines }) => lines.length);
  const isShown = ({ plot, lines }) => lines.some(({ values }) => isMoving(values, plot.digits));
  const plots = all.filter(isShown).map(({ plot, lines }) => makePlot(plot, lines, times, clock, cursor));
  const node = element("div", { class: "plots" }, ...plots.map((plot) => plot.node), makeSteady(all.filter((one) => !isShown(one))));
  const seen = new Set(); // the browser draws what is scrolled out of sight, too: while a run plays it need not
  const watcher = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) isIntersecting ? seen.add(target) : seen.delete(target);
  });
  for (const plot of plots) watcher.observe(plot.node);
  const showNow = () => plots.filter(({ node: one }) => !clock.playing || seen.has(one)).forEach((plot) => plot.show(clock.time));
  new ResizeObserver(() => {
    for (const plot of plots) plot.resize();
    showNow();
  }).observe(node);
  for (const plot of plots) plot.onZoom(() => queueMicrotask(showNow));
  onLanguage(showNow);
  const paint = () => plots.forEach((plot) => plot.paint());
  onTheme(paint);
  paint();
  follow(clock, showNow, GAP);
  return node;
}
