// The alarms as a list over the picture, with a button that acknowledges all.
import { element } from "../dom.js";
import { inWords } from "../texts.js";

export function makeAlarmBar({ alarms, sound }, acknowledge) {
  const silent = inWords(element("small", { class: "silent", hidden: true }), { text: "sound_waits" });
  const list = element("ul", { id: "alarms" });
  const spoken = element("div", { class: "sr-only", role: "alert" }); // what begins; numbers in the list run on
  const button = inWords(element("button", { type: "button", id: "acknowledge", onclick: acknowledge }), { text: "acknowledge" });
  const node = inWords(element("section", { class: "alarm-bar", hidden: true }, list, silent, button), { "aria-label": "alarms" });
  document.body.append(spoken); // not in the bar, which is hidden at times
  const shown = new Map();
  return {
    node,
    show() {
      const { sorted } = alarms;
      for (const [key, item] of shown) {
        if (alarms.list.has(key)) continue;
        item.remove();
        shown.delete(key);
      }
      for (const [place, { key, priority, state, words }] of sorted.entries()) {
        const item = shown.get(key) ?? element("li", { "data-alarm": key });
        if (!shown.has(key)) {
          shown.set(key, item);
          list.append(item);
          list.scrollLeft = 0; // on a narrow screen, where the most urgent is
          spoken.textContent = words();
        }
        const text = words();
        if (item.textContent !== text) item.textContent = text;
        item.className = `${priority} ${state}`;
        item.style.order = place; // not moved, as that would begin its flashing anew
      }
      silent.hidden = sound.isAllowed || alarms.sounding === null;
      node.hidden = sorted.length === 0;
      button.hidden = !sorted.some(({ state, priority }) => state !== "silent" && (priority !== "caution" || state === "over"));
    },
  };
}
