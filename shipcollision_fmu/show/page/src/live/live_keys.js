// The keyboard of a bridge, and the card that lists it.
import { element, toggleDialog } from "../dom.js";
import { inWords } from "../texts.js";

/** Keys, and the text that says what they do. */
export const CARD = [
  ["\u2190 \u2192", "key_rudder"], ["Home End", "key_hard"], ["M", "key_midships"], ["\u2191 \u2193", "key_telegraph"], ["Backspace", "key_stop"],
  ["A", "key_autopilot"], [", .", "key_heading"], ["H", "key_horn"], ["Enter", "key_acknowledge"], ["C", "key_camera"], ["Q E", "key_look"], ["B", "key_binoculars"],
  ["V", "key_chart"], ["N", "key_orientation"], ["+ \u2212", "key_range"], ["P", "key_pause"], ["S", "key_plain"], ["D", "key_sky"], ["F", "key_full"], ["T", "key_theme"], ["?", "key_help"],
];

export function makeLiveHelp() {
  const rows = CARD.flatMap(([keys, what]) => [
    element("dt", {}, ...keys.split(" ").map((key) => element("kbd", { text: key }))), inWords(element("dd", {}), { text: what })]);
  const card = element("dialog", { class: "card" }, inWords(element("h2", {}), { text: "help" }), element("dl", {}, ...rows),
    inWords(element("p", {}), { text: "looking" }), inWords(element("button", { type: "button", onclick: () => card.close() }), { text: "close" }));
  return { card, toggle: () => toggleDialog(card) };
}

/** The whole screen, and back. */
export function toggleFullScreen() {
  document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen?.();
}

/** Calls the actions of a page for keys; those of fields, of lists and of a focused button's Space and Enter are left alone. */
export function listenToBridgeKeys(actions) {
  const does = {
    ArrowLeft: ({ shiftKey }) => actions.turn(shiftKey ? -1 : -5),
    ArrowRight: ({ shiftKey }) => actions.turn(shiftKey ? 1 : 5),
    Home: () => actions.rudder(-Infinity),
    End: () => actions.rudder(Infinity),
    m: () => actions.rudder(0),
    ArrowUp: ({ repeat }) => repeat || actions.telegraph(1),
    ArrowDown: ({ repeat }) => repeat || actions.telegraph(-1),
    Backspace: () => actions.stop(),
    a: () => actions.autopilot(),
    ",": () => actions.heading(-1), ".": () => actions.heading(1),
    "<": () => actions.heading(-10), ">": () => actions.heading(10), ";": () => actions.heading(-10), ":": () => actions.heading(10),
    h: ({ repeat }) => repeat || actions.horn(true),
    Enter: () => actions.acknowledge(),
    c: () => actions.camera?.(null),
    q: () => actions.look?.(-15), e: () => actions.look?.(15),
    b: () => actions.binoculars?.(),
    v: () => actions.chart?.(),
    n: () => actions.orientation(),
    "+": () => actions.range(1), "-": () => actions.range(-1), "=": () => actions.range(1),
    p: () => actions.pause(),
    s: () => actions.plain?.(),
    d: () => actions.sky?.(),
    f: toggleFullScreen,
    t: () => actions.theme(),
    "?": () => actions.help(),
  };
  for (let i = 0; i < 6; i++) does[String(i + 1)] = () => actions.camera?.(i);
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const { tagName } = event.target;
    if (tagName === "SELECT" || tagName === "INPUT") return;
    if (tagName === "BUTTON" && (event.key === " " || event.key === "Enter")) return;
    const action = does[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
  window.addEventListener("keyup", ({ key }) => key.toLowerCase() === "h" && actions.horn(false));
  window.addEventListener("blur", () => actions.horn(false));
}
