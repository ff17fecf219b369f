// The chart: own ship in the middle, north up or head up, range rings, tracks, speed vectors and points of closest approach.
import { element } from "../dom.js";
import { number } from "../format.js";
import { isDark, onTheme } from "../theme.js";
import { inWords, say } from "../texts.js";
import { closestApproach } from "./cpa.js";
import { KNOT, MILE, moving, velocityOverGround } from "./navigation.js";

const RANGES = [0.125, 0.25, 0.5, 0.75, 1.5, 3, 6, 12, 24]; // [NM], as radars have them
const RINGS = { 0.125: 5, 0.25: 5, 0.5: 5, 0.75: 3, 1.5: 6, 3: 6, 6: 6, 12: 6, 24: 6 };
const VECTOR = 6; // minutes of the speed vectors at long ranges; shorter where they would leave the chart
const TOOLS = 40; // height of the buttons below a small chart [pixels]
const SMALL = 18; // a ship shorter than this [pixels] is drawn as a symbol

// IEC 62288: own ship and its vector in the foreground colour, others green in the dark, dangerous ones red.
const COLOURS = {
  light: { sea: "#dfe9ee", land: "#e3d3a1", ring: "#9fb3c0", ink: "#14222e", soft: "#5a6b78", target: "#0b6a4a", danger: "#c8102e", track: "#7d95a5" },
  dark: { sea: "#07131c", land: "#3a3520", ring: "#24404f", ink: "#dbe7ee", soft: "#8fa5b3", target: "#5fd39b", danger: "#ff5a5f", track: "#47687c" },
};

export class Chart {
  /** `hello` of the server, `histories` of the ships; `own` is the ship in the middle, null for the middle of all. */
  constructor(hello, histories, own) {
    Object.assign(this, { hello, histories, own, isHeadUp: false, range: 4, state: null, dangers: new Set() });
    this.canvas = inWords(element("canvas", { class: "chart-canvas", role: "img" }), { "aria-label": "chart" });
    this.shownRange = element("output", { class: "chart-range" });
    this.shownVector = element("span", { class: "chart-vector" });
    const button = (key, text, onclick, more = {}) => inWords(element("button", { type: "button", class: "small", text, onclick, ...more }), { "aria-label": key, title: key });
    this.orientation = element("button", { type: "button", class: "small", onclick: () => this.toggleOrientation() });
    const label = () => (this.orientation.textContent = say(this.isHeadUp ? "head_up" : "north_up"));
    this.relabel = label;
    inWords(this.orientation, {});
    this.node = element("section", { class: "chart" }, this.canvas,
      element("div", { class: "chart-top" }, this.shownRange, this.shownVector),
      element("div", { class: "chart-tools" }, this.orientation,
        button("range_in", "\u2212", () => this.zoom(-1), { "data-key": "range-in" }), button("range_out", "+", () => this.zoom(1))));
    this.canvas.addEventListener("wheel", (event) => (event.preventDefault(), this.zoom(Math.sign(event.deltaY))), { passive: false });
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    onTheme(() => this.draw());
    this.fitFirst = true;
  }

  toggleOrientation() {
    this.isHeadUp = !this.isHeadUp;
    this.draw();
  }

  zoom(by) {
    this.range = Math.min(RANGES.length - 1, Math.max(0, this.range + by));
    this.draw();
  }

  /** Shows a state; `dangers` are the names of the ships with an alarm. */
  show(state, dangers) {
    Object.assign(this, { state, dangers });
    if (this.fitFirst) this.fit();
    this.draw();
  }

  /** The smallest range that has all ships. */
  fit() {
    this.fitFirst = false;
    const [north, east] = this.middle();
    const far = Math.max(...Object.values(this.state.ships).map(({ eta }) => Math.hypot(eta[0] - north, eta[1] - east)));
    const found = RANGES.findIndex((range) => range * MILE > 1.15 * far);
    this.range = found < 0 ? RANGES.length - 1 : Math.max(1, found);
  }

  middle() {
    const { ships } = this.state;
    if (this.own !== null) return ships[this.own].eta;
    const places = Object.values(ships).map(({ eta }) => eta);
    return [0, 1].map((k) => (Math.min(...places.map((eta) => eta[k])) + Math.max(...places.map((eta) => eta[k]))) / 2);
  }

  draw() {
    const { canvas, state } = this;
    const { clientWidth: width, clientHeight: height } = canvas;
    if (!state || !width || !height) return;
    const scale = Math.min(2, window.devicePixelRatio);
    if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
      canvas.width = Math.round(width * scale);
      canvas.height = Math.round(height * scale);
    }
    const range = RANGES[this.range];
    const isLarge = width > 500;
    const middle = [width / 2, isLarge ? height / 2 : (height - TOOLS) / 2];
    const radius = Math.min(...middle) - (isLarge ? 60 : 24); // room for alarms, for degrees
    const perMetre = radius / (range * MILE);
    const turn = this.isHeadUp && this.own !== null ? -state.ships[this.own].eta[5] : 0;
    const [north0, east0] = this.middle();
    const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
    const place = ([north, east]) => {
      const [x, y] = [(east - east0) * perMetre, -(north - north0) * perMetre];
      return [middle[0] + x * cos - y * sin, middle[1] + x * sin + y * cos];
    };
    const pen = canvas.getContext("2d");
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    const colours = COLOURS[isDark() ? "dark" : "light"];
    const minutes = this.vectorMinutes(range);
    const view = { pen, colours, place, perMetre, turn, minutes, middle, radius };
    pen.fillStyle = colours.sea;
    pen.fillRect(0, 0, width, height);
    for (const obstacle of this.hello.obstacles ?? []) this.drawObstacle(view, obstacle);
    this.drawRings(view, range);
    const others = Object.keys(state.ships).filter((name) => name !== this.own);
    for (const name of Object.keys(state.ships)) this.drawTrack(view, name);
    for (const name of others) this.drawApproach(view, name);
    for (const name of others) this.drawShip(view, name);
    if (this.own !== null) this.drawShip(view, this.own);
    this.shownRange.textContent = `${range} ${say("miles")} / ${number(range / RINGS[range], range < 1 ? 3 : 2).replace(/0+$/, "").replace(/\.$/, "")}`;
    this.shownVector.textContent = say("vectors", { minutes });
    this.relabel();
    this.orientation.hidden = this.own === null;
  }

  /** Minutes of a vector, so that one of 12 kn is at most about half the range. */
  vectorMinutes(range) {
    return [VECTOR, 3, 1, 0.5].find((minutes) => 12 * KNOT * 60 * minutes <= 0.9 * range * MILE) ?? 0.25;
  }

  drawRings({ pen, colours, middle: [x0, y0], radius, turn }, range) {
    const rings = RINGS[range];
    pen.strokeStyle = colours.ring;
    pen.fillStyle = colours.soft;
    pen.lineWidth = 1;
    for (let i = 1; i <= rings; i++) {
      pen.beginPath();
      pen.arc(x0, y0, (radius * i) / rings, 0, 2 * Math.PI);
      pen.stroke();
    }
    pen.font = "11px system-ui, sans-serif";
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    for (let degrees = 0; degrees < 360; degrees += 10) {
      const angle = (degrees * Math.PI) / 180 + turn;
      const [x, y] = [Math.sin(angle), -Math.cos(angle)];
      const long = degrees % 30 === 0;
      pen.beginPath();
      pen.moveTo(x0 + radius * x, y0 + radius * y);
      pen.lineTo(x0 + (radius - (long ? 8 : 4)) * x, y0 + (radius - (long ? 8 : 4)) * y);
      pen.stroke();
      if (long) pen.fillText(degrees === 0 ? "N" : String(degrees).padStart(3, "0"), x0 + (radius + 12) * x, y0 + (radius + 11) * y);
    }
  }

  /** An obstacle: `outline` [[north, east], ...] in n [m], and its name. */
  drawObstacle({ pen, colours, place }, { name, outline }) {
    if (!outline) return;
    const points = outline.map(place);
    pen.fillStyle = colours.land;
    pen.strokeStyle = colours.soft;
    pen.lineWidth = 1.2;
    pen.beginPath();
    for (const point of points) pen.lineTo(...point);
    pen.closePath();
    pen.fill();
    pen.stroke();
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = colours.soft;
    pen.fillText(name, points[0][0] + 6, points[0][1] - 6);
  }

  drawTrack({ pen, colours, place }, name) {
    const { places } = this.histories[name];
    const every = Math.max(1, Math.ceil(places.length / 400));
    pen.strokeStyle = colours.track;
    pen.lineWidth = 1.2;
    pen.setLineDash([2, 3]);
    pen.beginPath();
    for (let i = 0; i < places.length; i += every) pen.lineTo(...place(places[i].eta));
    pen.lineTo(...place(this.state.ships[name].eta));
    pen.stroke();
    pen.setLineDash([]);
  }

  colourOf(name, colours) {
    return name === this.own ? colours.ink : this.dangers.has(name) ? colours.danger : colours.target;
  }

  /** Where own ship and the other will be at their closest, and the line between, if that is ahead. */
  drawApproach({ pen, colours, place }, name) {
    if (this.own === null) return;
    const own = moving(this.state.ships[this.own]);
    const other = moving(this.state.ships[name]);
    const { tcpa, own: here, other: there } = closestApproach(own, other);
    if (!(tcpa > 0 && tcpa < 3600)) return;
    const colour = this.colourOf(name, colours);
    pen.strokeStyle = pen.fillStyle = colour;
    pen.lineWidth = 1;
    pen.setLineDash([5, 4]);
    pen.beginPath();
    for (const [from, to] of [[other.position, there], [own.position, here]]) {
      pen.moveTo(...place(from));
      pen.lineTo(...place(to));
    }
    pen.stroke();
    pen.setLineDash([]);
    pen.lineWidth = 2;
    pen.beginPath();
    pen.moveTo(...place(here));
    pen.lineTo(...place(there));
    pen.stroke();
    for (const [point, half] of [[here, 3], [there, 3]]) {
      const [x, y] = place(point);
      pen.fillRect(x - half, y - half, 2 * half, 2 * half);
    }
  }

  drawShip({ pen, colours, place, perMetre, turn, minutes }, name) {
    const ship = this.state.ships[name];
    const info = this.hello.ships.find((one) => one.name === name);
    const [x, y] = place(ship.eta);
    const colour = this.colourOf(name, colours);
    const velocity = velocityOverGround(ship);
    const heading = ship.eta[5] + turn;
    pen.strokeStyle = colour;
    pen.fillStyle = colour;
    pen.lineWidth = 1.6;
    // Speed vector over ground.
    const tip = place([0, 1].map((k) => ship.eta[k] + velocity[k] * 60 * minutes));
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(...tip);
    pen.stroke();
    const along = Math.atan2(tip[1] - y, tip[0] - x);
    if (Math.hypot(tip[0] - x, tip[1] - y) > 8) {
      pen.beginPath();
      for (const side of [-2.6, 0, 2.6]) pen.lineTo(...(side ? [tip[0] + 7 * Math.cos(along + side), tip[1] + 7 * Math.sin(along + side)] : tip));
      pen.stroke();
    }
    pen.save();
    pen.translate(x, y);
    pen.rotate(heading);
    const length = info.L_oa * perMetre;
    pen.beginPath();
    if (length > SMALL) {
      const [l, b] = [length / 2, ((info.B ?? info.L_oa / 6) * perMetre) / 2];
      pen.moveTo(0, -l);
      pen.quadraticCurveTo(b, -0.75 * l, b, -0.55 * l);
      pen.lineTo(b, l);
      pen.lineTo(-b, l);
      pen.lineTo(-b, -0.55 * l);
      pen.quadraticCurveTo(-b, -0.75 * l, 0, -l);
      pen.globalAlpha = 0.25;
      pen.fill();
      pen.globalAlpha = 1;
    } else if (name === this.own) {
      pen.arc(0, 0, 7, 0, 2 * Math.PI);
      pen.moveTo(3.5, 0);
      pen.arc(0, 0, 3.5, 0, 2 * Math.PI);
    } else {
      pen.moveTo(0, -10);
      pen.lineTo(6, 7);
      pen.lineTo(-6, 7);
      pen.closePath();
    }
    pen.stroke();
    pen.lineWidth = 1; // heading line
    pen.beginPath();
    pen.moveTo(0, -Math.max(length / 2, 8));
    pen.lineTo(0, -Math.max(length / 2, 8) - 26);
    pen.stroke();
    pen.restore();
    if (name !== this.own) {
      pen.font = "600 11px system-ui, sans-serif";
      pen.textAlign = "left";
      pen.fillText(name, x + Math.max(10, 0.25 * length), y + Math.max(12, 0.25 * length));
    }
  }
}
