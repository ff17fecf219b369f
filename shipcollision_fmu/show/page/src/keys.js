// The keyboard, and the card that lists it.
import { element } from "./dom.js";
import "./texts_replay.js";
import { inWords } from "./texts.js";

const KEYS = [
  ["Space", "key_play"],
  ["\u2190 \u2192", "key_seconds"],
  ["Home End", "key_ends"],
  ["N P", "key_collisions"],
  ["C", "key_next_camera"],
  ["S", "key_plain"],
  ["D", "key_sky"],
  ["M", "slow_motion"],
  ["T", "key_theme"],
  ["V", "key_panel"],
  ["F", "key_full"],
  ["R", "key_record"],
  ["?", "key_help"],
];

export function makeHelp() {
  const rows = KEYS.flatMap(([keys, what]) => [
    element("dt", {}, ...keys.split(" ").map((key) => element("kbd", { text: key }))),
    inWords(element("dd"), { text: what }),
  ]);
  const close = inWords(element("button", { type: "button", onclick: () => card.close() }), { text: "close" });
  const card = inWords(element("dialog", { class: "card" }, inWords(element("h2"), { text: "help" }), element("dl", {}, ...rows),
    inWords(element("p"), { text: "mouse_and_curves" }), close), { "aria-label": "help" });
  return card;
}

export function listenToKeys(clock, actions) {
  const does = {
    " ": () => clock.toggle(),
    ArrowLeft: (event) => clock.seek(clock.time - (event.shiftKey ? 0.1 : 1)),
    ArrowRight: (event) => clock.seek(clock.time + (event.shiftKey ? 0.1 : 1)),
    Home: () => clock.seek(clock.start),
    End: () => clock.seek(clock.end),
    n: actions.next,
    p: actions.previous,
    c: actions.camera,
    s: actions.plain,
    d: actions.sky,
    m: actions.slow,
    t: actions.theme,
    v: actions.panel,
    f: actions.fullScreen,
    r: actions.record,
    "?": actions.help,
  };
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const { target } = event;
    if (target.tagName === "SELECT") return;
    if (target.tagName === "BUTTON" && event.key === " ") return; // the button's own
    const action = does[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}
