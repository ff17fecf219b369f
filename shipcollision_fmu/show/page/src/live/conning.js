// Steering and engine of the ship that one is in command of: wheel, telegraph, autopilot, horn.
import { element } from "../dom.js";
import { number } from "../format.js";
import { inWords, onLanguage, say } from "../texts.js";
import { makeSvg } from "./svg.js";
import { toDegrees, wholeTurn } from "./navigation.js";

const TURNS = 6; // degrees of the wheel for one degree of the rudder
const OFTEN = 100; // least time between two orders while the wheel is dragged [ms]
const USUAL_LIMIT = 35; // of the rudder [deg]

const side = (degrees) => say(degrees < 0 ? "port_value" : "starboard_value", { value: number(Math.abs(degrees), 0) });
/** A rudder angle [deg] in words: "Midships", "Port 10°". */
export const rudderWords = (degrees) => (Math.abs(degrees) < 0.5 ? say("midships") : side(degrees));
/** The same, short: "P 10°". */
export function rudderShort(degrees) {
  const value = number(Math.abs(degrees), 0);
  return value === "0" ? "0°" : say(degrees < 0 ? "port_short" : "starboard_short", { value });
}
/** A heading [deg] with three digits. */
export const threeDigits = (degrees) => String(((Math.round(degrees) % 360) + 360) % 360).padStart(3, "0");

/** Who is in command of a ship, for the client of this page; a ship that nobody can steer has other words. */
export function commandWords({ limits, recorded }, inCommand, client) {
  if (recorded) return say("follows_recording");
  if (!limits) return say("takes_no_orders");
  if (inCommand == null) return say("nobody_in_command");
  return inCommand === client ? say("in_command") : say("other_in_command", { client: inCommand });
}

/**
 * `give(fields)` sends an order for the ship, and promises the server's answer, null for a refusal; `horn(on)` its horn.
 * What is ordered is shown at once, as the hand on the wheel sees it, until the ship has it or it is refused; but the
 * autopilot is on only once the server has taken the order.
 */
export class Conning {
  constructor(give, horn) {
    Object.assign(this, { give, horn, ordered: 0, telegraph: 0, heading: 0, isOnAutopilot: false, isPilotTaken: false, limit: USUAL_LIMIT });
    Object.assign(this, { given: 0, waits: null, taken: null, steps: 0 });
    this.wheel = this.makeWheel();
    this.gauge = makeRudderGauge();
    this.levers = [4, 3, 2, 1, 0, -1, -2, -3, -4].map((position) => {
      const lever = element("button", {
        type: "button", role: "radio", "aria-checked": "false", "data-telegraph": position,
        class: `lever ${position > 0 ? "ahead" : position < 0 ? "astern" : "stop"}`, onclick: () => this.setTelegraph(position),
      });
      return inWords(lever, { text: `telegraph_${position}` });
    });
    const quick = (key, text, order) => inWords(element("button", { type: "button", text, onclick: order }), { "aria-label": key, title: key });
    this.wanted = inWords(element("input", { type: "number", min: 0, max: 360, step: 1, inputmode: "numeric", id: "course" }), { "aria-label": "course_to_steer" });
    this.wanted.addEventListener("focus", () => this.wanted.select());
    this.wanted.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key === "Enter") this.steerWanted();
    });
    this.pilot = element("button", { type: "button", id: "autopilot", "aria-pressed": "false", onclick: () => this.toggleAutopilot() });
    inWords(this.pilot, { text: "autopilot_short", "aria-label": "autopilot", title: "autopilot" });
    const change = (by) => {
      const button = element("button", { type: "button", text: `${by < 0 ? "\u2212" : "+"}${Math.abs(by)}°`, onclick: () => this.changeHeading(by) });
      return inWords(button, { "aria-label": "change_heading" }, { value: `${by < 0 ? "\u2212" : "+"}${Math.abs(by)}` });
    };
    this.whistle = inWords(element("button", { type: "button", id: "horn", class: "horn" }), { text: "horn" });
    this.whistle.addEventListener("pointerdown", (event) => (this.whistle.setPointerCapture(event.pointerId), this.blow(true)));
    for (const kind of ["pointerup", "pointercancel"]) this.whistle.addEventListener(kind, () => this.blow(false));
    this.whistle.addEventListener("keydown", (event) => (event.key === " " || event.key === "Enter") && !event.repeat && this.blow(true));
    this.whistle.addEventListener("keyup", () => this.blow(false));
    this.none = element("p", { class: "none", hidden: true });
    onLanguage(() => this.tellNone());
    this.tools = element("div", { class: "conn-tools" },
      inWords(element("div", { class: "telegraph", role: "radiogroup" }, ...this.levers), { "aria-label": "telegraph" }),
      element("div", { class: "steering" }, this.wheel, this.gauge.node,
        element("div", { class: "row three" }, quick("port_5", "\u25c0 5°", () => this.turn(-5)),
          quick("midships", "0°", () => this.setRudder(0)), quick("starboard_5", "5° \u25b6", () => this.turn(5))),
        element("div", { class: "row pilot" }, this.pilot, this.wanted,
          inWords(element("button", { type: "button", onclick: () => this.steerWanted() }), { text: "steer" })),
        element("div", { class: "row four" }, ...[-10, -1, 1, 10].map(change)), this.whistle));
    this.node = inWords(element("section", { class: "conning" }, this.tools, this.none), { "aria-label": "conning" });
  }

  makeWheel() {
    const svg = makeSvg("svg", { viewBox: "-60 -60 120 120", class: "wheel", role: "slider", tabindex: "0", "aria-valuemin": -35, "aria-valuemax": 35, id: "wheel" });
    this.turning = makeSvg("g", {});
    this.turning.append(
      makeSvg("circle", { r: 44, class: "rim" }), makeSvg("circle", { r: 12, class: "hub" }),
      ...[0, 60, 120, 180, 240, 300].map((angle) => makeSvg("path", { d: "M0 -12V-56", class: angle ? "spoke" : "spoke king", transform: `rotate(${angle})` })),
    );
    svg.append(this.turning);
    inWords(svg, { "aria-label": "wheel" });
    let last = null;
    let sum = 0;
    const angleOf = ({ clientX, clientY }) => {
      const box = svg.getBoundingClientRect();
      return toDegrees(Math.atan2(clientY - box.top - box.height / 2, clientX - box.left - box.width / 2));
    };
    svg.addEventListener("pointerdown", (event) => {
      svg.setPointerCapture(event.pointerId);
      last = angleOf(event);
      sum = TURNS * this.ordered;
      event.preventDefault();
      svg.focus();
    });
    svg.addEventListener("pointermove", (event) => {
      if (last === null) return;
      const now = angleOf(event);
      sum += ((now - last + 540) % 360) - 180;
      last = now;
      this.setRudder(Math.round(sum / TURNS));
    });
    for (const kind of ["pointerup", "pointercancel"]) svg.addEventListener(kind, () => (last = null));
    return svg;
  }

  /** The ship has changed: what is known of it, with its `limits`; null: it can be ordered nothing. */
  setLimits(info) {
    const limits = info.limits ?? null;
    this.info = info;
    this.tellNone();
    this.tools.hidden = limits === null;
    this.none.hidden = limits !== null;
    this.limit = limits?.rudder_deg ?? USUAL_LIMIT;
    this.revolutions = limits?.telegraph ?? null;
    this.wheel.setAttribute("aria-valuemin", -this.limit);
    this.wheel.setAttribute("aria-valuemax", this.limit);
    this.gauge.setLimit(this.limit);
  }

  tellNone() {
    this.none.textContent = say(this.info?.recorded ? "follows_recording" : "no_controls");
  }

  /** Another ship is to be conned, in this state: the one before gets what waits for it, the other begins with its own. */
  reset(ship, steps) {
    this.blow(false);
    if (this.timer) this.flush();
    this.waits = this.taken = null;
    this.given++; // answers to come are those of the ship before
    this.show(ship, false, steps);
  }

  /** An order, no more often than the server likes: the last one counts. */
  send(fields) {
    this.fields = { ...this.fields, ...fields };
    this.waits = Infinity; // the wheel is not turned back meanwhile
    this.given++;
    if (this.timer) return;
    const wait = Math.max(0, OFTEN - (performance.now() - (this.sent ?? -Infinity)));
    this.timer = setTimeout(() => this.flush(), wait);
  }

  async flush() {
    const { fields: order, given } = this;
    clearTimeout(this.timer);
    Object.assign(this, { timer: null, fields: {}, sent: performance.now() });
    const answer = await this.give(order);
    if (answer !== null) this.taken = answer.step_count; // the step after it has the order
    if (given !== this.given) return; // another order has been given since
    this.waits = this.taken; // after a refusal that of the order before, which the ship may not have yet
    if (answer === null) {
      this.show(this.ship, !this.node.classList.contains("idle"), this.steps);
    } else {
      this.isPilotTaken = this.isOnAutopilot;
      this.paint();
    }
  }

  setRudder(degrees) {
    this.ordered = Math.min(this.limit, Math.max(-this.limit, degrees));
    this.isOnAutopilot = this.isPilotTaken = false;
    delete this.fields?.heading_deg;
    this.send({ rudder_deg: this.ordered });
    this.paint();
  }

  turn(by) {
    this.setRudder(this.ordered + by);
  }

  setTelegraph(position) {
    this.telegraph = Math.min(4, Math.max(-4, position));
    this.send({ telegraph: this.telegraph });
    this.paint();
  }

  changeTelegraph(by) {
    this.setTelegraph((this.telegraph ?? 0) + by);
  }

  setHeading(degrees) {
    this.heading = ((degrees % 360) + 360) % 360;
    this.isOnAutopilot = true;
    delete this.fields?.rudder_deg;
    this.send({ heading_deg: this.heading });
    this.paint();
  }

  /** From the heading to steer, or from the present one, in whole degrees. */
  changeHeading(by) {
    this.setHeading((this.isOnAutopilot ? this.heading : Math.round(this.present ?? 0)) + by);
  }

  steerWanted() {
    const value = Number(this.wanted.value);
    if (this.wanted.value !== "" && Number.isFinite(value)) this.setHeading(value);
  }

  toggleAutopilot() {
    if (this.isOnAutopilot) this.setRudder(this.actual ?? 0);
    else this.setHeading(Math.round(this.present ?? 0));
  }

  blow(on) {
    if (Boolean(this.isBlowing) === on) return;
    this.isBlowing = on;
    this.whistle.classList.toggle("on", on);
    this.horn(on);
  }

  /** Shows a ship's state after that many steps; what was ordered just now stays until the ship has it. */
  show(ship, isInCommand, steps) {
    if (steps < this.steps) this.taken = null; // the run has gone back
    if (this.waits !== null && this.waits !== Infinity && (steps > this.waits || steps < this.steps)) this.waits = null;
    Object.assign(this, { ship, steps });
    this.node.classList.toggle("idle", !isInCommand);
    this.present = toDegrees(wholeTurn(ship.eta[5]));
    this.actual = Math.round(toDegrees(ship.rudder));
    if (this.waits === null) {
      this.isOnAutopilot = this.isPilotTaken = ship.heading_order !== null;
      this.ordered = Math.round(10 * toDegrees(ship.rudder_order)) / 10;
      if (this.isOnAutopilot) this.heading = Math.round(10 * toDegrees(wholeTurn(ship.heading_order))) / 10;
      this.telegraph = this.positionOf(ship.rev_order);
    }
    this.gauge.show(toDegrees(ship.rudder), this.isOnAutopilot ? toDegrees(ship.rudder_order) : this.ordered);
    this.paint();
  }

  /** The telegraph position nearest to revolutions [1/s]; null where the ship has no telegraph. */
  positionOf(revolutions) {
    if (!this.revolutions) return null;
    const errors = this.revolutions.map((value) => Math.abs(value - revolutions));
    return errors.indexOf(Math.min(...errors)) - 4;
  }

  paint() {
    this.turning.setAttribute("transform", `rotate(${(TURNS * this.ordered).toFixed(1)})`);
    this.wheel.setAttribute("aria-valuenow", Math.round(this.ordered));
    this.wheel.setAttribute("aria-valuetext", rudderWords(this.ordered));
    for (const lever of this.levers) {
      const isOn = Number(lever.dataset.telegraph) === this.telegraph;
      lever.setAttribute("aria-checked", String(isOn));
      lever.tabIndex = isOn || (this.telegraph === null && lever.classList.contains("stop")) ? 0 : -1;
    }
    this.pilot.setAttribute("aria-pressed", String(this.isPilotTaken && this.isOnAutopilot));
    if (document.activeElement !== this.wanted) {
      this.wanted.value = this.isPilotTaken && this.isOnAutopilot ? threeDigits(this.heading) : "";
      this.wanted.placeholder = threeDigits(this.present ?? 0);
    }
  }
}

/** A rudder angle indicator: red to port, green to starboard; a bug at the order, a needle at the angle. */
function makeRudderGauge() {
  const WIDTH = 220;
  const node = makeSvg("svg", { viewBox: `0 0 ${WIDTH} 40`, class: "rudder-gauge", "aria-hidden": "true" });
  const marks = makeSvg("g", {});
  const bug = makeSvg("path", { d: "M-6 8h12l-6 9z", class: "bug" });
  const needle = makeSvg("rect", { x: -2, y: 14, width: 4, height: 14, class: "needle" });
  node.append(
    makeSvg("rect", { x: 10, y: 18, width: WIDTH / 2 - 10, height: 6, class: "port" }),
    makeSvg("rect", { x: WIDTH / 2, y: 18, width: WIDTH / 2 - 10, height: 6, class: "starboard" }), marks, bug, needle);
  let limit = USUAL_LIMIT;
  const place = (degrees) => WIDTH / 2 + (Math.min(limit, Math.max(-limit, degrees)) / limit) * (WIDTH / 2 - 10);
  return {
    node,
    setLimit(most) {
      limit = most;
      marks.replaceChildren();
      for (let degrees = -30; degrees <= 30; degrees += 10) {
        if (Math.abs(degrees) > limit) continue;
        const text = makeSvg("text", { x: place(degrees), y: 38 });
        text.textContent = Math.abs(degrees);
        marks.append(text);
      }
    },
    show(angle, order) {
      needle.setAttribute("transform", `translate(${place(angle).toFixed(1)} 0)`);
      bug.setAttribute("transform", `translate(${place(order).toFixed(1)} 0)`);
    },
  };
}
