// The keyboard, and the card that lists it.
import { element } from "./dom.js";

const KEYS = [
  ["Space", "play, pause"],
  ["\u2190 \u2192", "one second back, on; with Shift a tenth"],
  ["Home End", "start, end"],
  ["N P", "next, previous collision"],
  ["C", "next camera"],
  ["S", "plain sea"],
  ["T", "light, dark"],
  ["V", "curves and collisions"],
  ["?", "this card"],
];

export function makeHelp() {
  const rows = KEYS.flatMap(([keys, what]) => [
    element("dt", {}, ...keys.split(" ").map((key) => element("kbd", { text: key }))),
    element("dd", { text: what }),
  ]);
  const close = element("button", { type: "button", text: "Close", onclick: () => card.close() });
  const card = element("dialog", { class: "card" }, element("h2", { text: "Keys" }), element("dl", {}, ...rows),
    element("p", { text: "Drag to turn the camera, wheel to zoom, right button to move. Click a curve to go to its time; drag across it to zoom, double-click to see all again." }), close);
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
    t: actions.theme,
    v: actions.panel,
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
