// Curves over time, one under the other, with one cursor and one line at the present time. A click goes there; dragging
// zooms all of them, a double click shows the whole again.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { element } from "./dom.js";
import { compass, degrees, number } from "./format.js";
import { isDark, lineColour, onTheme } from "./theme.js";

const HEIGHT = 108;
const same = (x) => x;
/** A number on an axis: as short as it goes, without groups, which look like decimals elsewhere. */
const mark = (value) => String(Number(value.toPrecision(6))).replace("-", "\u2212");

// Title, unit, what of the scene it shows, factor or function to that unit, digits, least range of the axis, and how a
// value is shown where that is not the value itself: a curve of the heading goes on beyond 360, its numbers do not.
const PLOTS = [
  { title: "Speed", unit: "m/s", quantities: ["speed"], to: same, digits: 2, range: 0.2 },
  { title: "Surge", unit: "m/s", quantities: ["surge"], to: same, digits: 2, range: 0.2 },
  { title: "Yaw rate", unit: "°/s", quantities: ["yaw_rate"], to: degrees, digits: 3, range: 0.02 },
  { title: "Roll", unit: "°", quantities: ["roll"], to: degrees, digits: 2, range: 0.2 },
  { title: "Heading", unit: "°", quantities: ["heading"], to: degrees, digits: 1, range: 1, shown: compass },
  { title: "Energy", unit: "MJ", quantities: ["kinetic", "dissipated"], to: (x) => x / 1e6, digits: 1, range: 0.01 },
  { title: "Impulse", unit: "MN s", quantities: ["normal", "tangential"], to: (x) => x / 1e6, digits: 2, range: 0.001 },
  { title: "Clearance", unit: "m", quantities: ["clearance"], to: same, digits: 2, range: 0.5 },
];
const COMMON = { dissipated: "#e07b00", normal: "#c65d07", tangential: "#8a7a00", clearance: "#3d7f6a" };
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

function makePlot(plot, data, clock, colourOf, cursor) {
  const { times } = data.signals;
  const curves = plot.quantities.flatMap((quantity) => data.signals.curves.filter((curve) => curve.quantity === quantity));
  const lines = curves.map((curve) => ({
    label: curve.ship ?? curve.quantity,
    values: Float64Array.from(curve.values, plot.to),
    colour: () => lineColour(curve.ship === null ? COMMON[curve.quantity] : colourOf(curve.ship)),
    dash: DASHES[curve.quantity],
  }));
  const chips = lines.map((line) => {
    const value = element("b");
    const dot = element("i");
    return { line, value, dot, node: element("span", { class: "chip" }, dot, element("span", { text: line.label }), value) };
  });
  const now = element("div", { class: "now" });
  const place = element("div", { class: "curves" });
  const node = element(
    "figure",
    { class: "plot" },
    element("figcaption", {}, element("h3", { text: plot.title }), element("span", { class: "unit", text: plot.unit }), ...chips.map((chip) => chip.node)),
    place,
  );

  const ink = () => (isDark() ? "#9fb0bd" : "#5a6b78");
  const rule = () => (isDark() ? "rgba(255,255,255,0.07)" : "rgba(20,40,60,0.09)");
  const axis = { stroke: ink, grid: { stroke: rule, width: 1 }, ticks: { show: false }, font: "11px system-ui, sans-serif", values: (_, marks) => marks.map(mark) };
  const shown = (value, digits) => (plot.shown ? plot.shown(value, digits) : value);
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
          range: (_, low, high) => {
            const middle = (low + high) / 2;
            const half = Math.max((high - low) * 0.58, plot.range / 2);
            return [middle - half, middle + half];
          },
        },
      },
      axes: [
        { ...axis, size: 20, gap: 2 },
        { ...axis, size: 46, gap: 4, space: 26, values: (_, marks) => marks.map((value) => mark(shown(value, 6))) },
      ],
      series: [{}, ...lines.map((line) => ({ stroke: line.colour, width: 1.6, dash: line.dash, points: { show: false } }))],
    },
    [times, ...lines.map((line) => line.values)],
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
      for (const { line, value } of chips) value.textContent = number(shown(valueAt(times, line.values, time), plot.digits), plot.digits);
    },
    paint() {
      for (const { line, dot } of chips) dot.style.background = line.colour();
      chart.redraw(false);
    },
    resize() {
      if (place.clientWidth > 0 && place.clientWidth !== chart.width) chart.setSize({ width: place.clientWidth, height: HEIGHT });
    },
    onZoom: (listener) => (chart.hooks.setScale ??= []).push(listener),
  };
}

/** All plots as a node, which follow the clock. */
export function makePlots(data, clock) {
  const colourOf = (name) => data.ships.find((ship) => ship.name === name).colour;
  const cursor = uPlot.sync("run");
  const shown = PLOTS.filter((plot) => data.signals.curves.some((curve) => plot.quantities.includes(curve.quantity)));
  const plots = shown.map((plot) => makePlot(plot, data, clock, colourOf, cursor));
  const node = element("div", { class: "plots" }, ...plots.map((plot) => plot.node));
  const showNow = () => plots.forEach((plot) => plot.show(clock.time));
  new ResizeObserver(() => {
    for (const plot of plots) plot.resize();
    showNow();
  }).observe(node);
  for (const plot of plots) plot.onZoom(() => queueMicrotask(showNow));
  const paint = () => plots.forEach((plot) => plot.paint());
  onTheme(paint);
  paint();
  let waiting = false;
  clock.watch(() => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      showNow();
    });
  });
  return node;
}
