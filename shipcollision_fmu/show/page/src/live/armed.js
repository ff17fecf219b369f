// The instructor's failures that begin by themselves: at a run time, or once another ship is near.
import { element } from "../dom.js";
import { clockTime } from "../format.js";
import { inWords, onLanguage, say } from "../texts.js";
import { MILE } from "./navigation.js";
import { textButton } from "./page_tools.js";
import { parseRange, parseTime } from "./typed.js";
import { miles } from "./targets.js";

const AT = ""; // of the condition: a time, not a ship

/** `ask(type, fields)` asks the server, `tell(text)` says what cannot be. */
export function makeArmed(ask, tell) {
  const select = (id, key, ...options) => inWords(element("select", { id }, ...options), { "aria-label": key, title: key });
  const ship = select("arm-ship", "target");
  const what = select("arm-what", "failure", ...["rudder", "blackout"].map((value) => inWords(element("option", { value }), { text: `fail_${value}` })));
  const when = select("arm-when", "condition");
  const value = inWords(element("input", { type: "text", id: "arm-value", autocomplete: "off", maxlength: 20 }), { "aria-label": "arm_value" });
  value.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key === "Enter") arm();
  });
  const list = element("ul", { class: "mark-list" });
  const none = inWords(element("p", { class: "none" }), { text: "none_armed" });
  let names = [];
  let known = [];

  const conditions = () => {
    const chosen = when.value;
    const others = names.filter((name) => name !== ship.value);
    when.replaceChildren(element("option", { value: AT, text: say("arm_at") }), ...others.map((of) => element("option", { value: of, text: say("arm_near", { ship: of }) })));
    when.value = others.includes(chosen) ? chosen : AT;
    value.placeholder = when.value === AT ? "12:30" : "0.5";
  };
  for (const chosen of [ship, when]) chosen.addEventListener("change", conditions);

  async function arm() {
    const of = when.value;
    const given = of === AT ? parseTime(value.value) : parseRange(value.value);
    if (given === null) return tell(say(of === AT ? "no_time" : "no_range", { text: value.value }));
    const condition = of === AT ? { at: given } : { of, within: given };
    if (await ask("arm", { ship: ship.value, what: what.value, ...condition })) value.value = "";
  }

  const describe = ({ ship: name, what: failing, at, of, within }) => {
    const failure = say(`fail_${failing}`);
    if (of === null) return say("armed_at", { ship: name, what: failure, time: clockTime(at, 0) });
    return say("armed_near", { ship: name, what: failure, of, range: `${miles(within)} ${say("miles")}` });
  };
  const draw = () => {
    none.hidden = known.length > 0;
    list.replaceChildren(...known.map((one) => element("li", { class: "row wide-first", "data-armed": `${one.ship} ${one.what}` }, element("span", { text: describe(one) }),
      element("button", { type: "button", text: say("disarm"), onclick: () => ask("disarm", { ship: one.ship, what: one.what }) }))));
  };
  onLanguage(() => (conditions(), draw()));
  return {
    node: element("section", {}, inWords(element("h2", {}), { text: "armed" }), list, none,
      element("div", { class: "row two" }, ship, what), element("div", { class: "row arm-row" }, when, value, textButton("arm", arm, { id: "arm" }))),
    greet(hello) {
      names = hello.ships.map(({ name }) => name);
      const chosen = ship.value;
      const steerable = hello.ships.filter(({ limits }) => limits).map(({ name }) => name);
      ship.replaceChildren(...steerable.map((name) => element("option", { value: name, text: name })));
      if (steerable.includes(chosen)) ship.value = chosen;
      conditions();
      this.show(hello.armed ?? []);
    },
    /** All that are armed: [{ship, what, at, of, within}]. */
    show(armed) {
      known = armed;
      draw();
    },
  };
}
