// What both live pages have: language, theme, messages of refusals, time and rate, alarm limits.
import { element, icon } from "../dom.js";
import { clockTime, number } from "../format.js";
import { inWords, language, LANGUAGES, onLanguage, say, setLanguage } from "../texts.js";
import { toggleTheme } from "../theme.js";
import { toggleFullScreen } from "./live_keys.js";
import { MILE } from "./navigation.js";

const FULL_SCREEN = "M3 3h5v2H5v3H3zM12 3h5v5h-2V5h-3zM3 12h2v3h3v2H3zM15 12h2v5h-5v-2h3z";
export const RATES = [0.25, 0.5, 1, 2, 5, 10, 20];

/** A button with a text that follows the language. */
export const textButton = (key, onclick, more = {}) => inWords(element("button", { type: "button", onclick, ...more }), { text: key });

/** An <input type="number"> with a label above it. */
export function labelled(key, attributes) {
  const input = element("input", { type: "number", inputmode: "decimal", ...attributes });
  input.addEventListener("keydown", (event) => event.stopPropagation());
  return { input, node: element("label", {}, inWords(element("span", {}), { text: key }), input) };
}

/** Messages that go away by themselves; `tell(text)`. */
export function makeMessages() {
  const node = element("div", { class: "messages", role: "status", "aria-live": "polite" });
  return {
    node,
    tell(text) {
      const line = element("p", { text });
      node.replaceChildren(line);
      setTimeout(() => line.remove(), 8000);
    },
  };
}

export function makeSwitches(openHelp, ...more) {
  const chosen = inWords(element("select", { id: "language" }, ...Object.entries(LANGUAGES).map(([value, text]) => element("option", { value, text }))), { "aria-label": "language" });
  chosen.addEventListener("change", () => setLanguage(chosen.value));
  onLanguage(() => (chosen.value = language()));
  return element("div", { class: "switches" }, chosen, ...more,
    inWords(element("button", { type: "button", class: "small", onclick: toggleFullScreen }, icon(FULL_SCREEN)), { "aria-label": "full_screen", title: "full_screen" }),
    inWords(element("button", { type: "button", class: "small", text: "\u25d0", onclick: toggleTheme }), { "aria-label": "theme", title: "theme" }),
    inWords(element("button", { type: "button", class: "small", text: "?", onclick: openHelp }), { "aria-label": "help", title: "help" }));
}

/** Simulated time, rate, pause and step. `ask(type, fields)` asks the server; `isPaused()` is the latest that is known. */
export function makeTimeTools(ask, isPaused) {
  const clock = element("span", { class: "value", id: "time-now" });
  const real = element("small", {});
  const rate = inWords(element("select", { id: "rate", onchange: () => ask("rate", { rate: Number(rate.value) }) },
    ...RATES.map((value) => element("option", { value, text: `${value < 1 ? `1/${1 / value}` : value}\u00d7` }))), { "aria-label": "rate" });
  /** Also a rate that is not in the list, such as 4 of the command line. */
  const chooseRate = (value) => {
    if (![...rate.options].some((option) => Number(option.value) === value)) {
      const later = [...rate.options].find((option) => Number(option.value) > value);
      rate.add(element("option", { value, text: `${number(value, value < 10 ? 2 : 1).replace(/\.?0+$/, "")}\u00d7` }), later ?? null);
    }
    rate.value = String(value);
  };
  const pause = element("button", { type: "button", id: "pause", onclick: () => ask("pause", { paused: !isPaused() }) });
  const step = textButton("step", () => ask("step"), { id: "step", hidden: true });
  return {
    node: inWords(element("div", { class: "time-tools" }, element("p", {}, clock, real), rate, pause, step), { "aria-label": "time" }),
    toggle: () => pause.click(),
    /** Whether this page may set the pace. */
    setAllowed(isAllowed) {
      rate.disabled = pause.disabled = step.disabled = !isAllowed;
    },
    show(state) {
      clock.textContent = clockTime(state.time, 1);
      real.textContent = state.paused ? say("paused") : Math.abs(state.real_rate / state.rate - 1) > 0.05 ? say("really", { rate: number(state.real_rate, 1) }) : "";
      if (document.activeElement !== rate) chooseRate(state.rate);
      pause.textContent = say(state.paused ? "go_on" : "pause");
      pause.setAttribute("aria-pressed", String(state.paused));
      step.hidden = !state.paused;
    },
  };
}

/** What is said at the end: why, where the run is, and where the debriefing is as long as the server answers. */
export function describeEnd({ ended, token, isServed }) {
  const said = element("div", {}, inWords(element("p", {}), { text: "ended" }));
  if (ended.error) said.append(element("p", { text: ended.error }));
  const command = element("code", { text: `shipcollision show ${quote(ended.folder ?? "")}` });
  if (ended.folder) said.append(element("p", { class: "where" }, inWords(element("span", {}), { text: "stored_in" }, { folder: ended.folder }), " ", command));
  if (!isServed) said.append(inWords(element("p", { class: "where" }), { text: "server_gone" }));
  if (!ended.replay || !isServed) return [said];
  const href = `${ended.replay}?token=${encodeURIComponent(token)}`;
  return [said, inWords(element("a", { href, id: "debriefing" }), { text: "debriefing" })];
}

/** A name as a shell takes it. */
const quote = (name) => (/^[\w@%+=:,./-]+$/.test(name) ? name : `'${name.replaceAll("'", `'"'"'`)}'`);

/** Limits of the CPA alarm, kept in `session.limits` in m and s. */
export function makeLimits(session) {
  const cpa = labelled("cpa_limit", { min: 0, max: 10, step: 0.05, value: session.limits.cpa / MILE, id: "cpa-limit" });
  const tcpa = labelled("tcpa_limit", { min: 0, max: 60, step: 1, value: session.limits.tcpa / 60, id: "tcpa-limit" });
  const read = () => {
    if (cpa.input.validity.valid && cpa.input.value !== "") session.limits.cpa = Number(cpa.input.value) * MILE;
    if (tcpa.input.validity.valid && tcpa.input.value !== "") session.limits.tcpa = Number(tcpa.input.value) * 60;
  };
  for (const { input } of [cpa, tcpa]) input.addEventListener("input", read);
  return element("section", { class: "limits" }, inWords(element("h2", {}), { text: "limits" }), element("div", { class: "row two" }, cpa.node, tcpa.node));
}
