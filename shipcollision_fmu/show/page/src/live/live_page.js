// What the pages of bridge and instructor have in common: session, refusals, alarms, help, time, keys, the end.
import { element } from "../dom.js";
import { toggleTheme } from "../theme.js";
import { say } from "../texts.js";
import { makeAlarmBar } from "./alarm_bar.js";
import { listenToBridgeKeys, makeLiveHelp } from "./live_keys.js";
import { describeEnd, makeMessages, makeTimeTools } from "./page_tools.js";
import { Session } from "./session.js";

const ALARMING = ["state", "lost", "hello", "event", "end"];

/** `heard`: what a page does with messages, by their type. */
export function makeLivePage(role, heard) {
  const session = new Session(role, (type, message) => {
    heard[type]?.(message);
    if (type === "end" || type === "gone") showEnd();
    if (type === "hello" && session.unknownShip) messages.tell(say("no_such_ship", { ship: session.unknownShip, ships: message.ships.map(({ name }) => name).join(", ") }));
    if (ALARMING.includes(type)) alarmBar.show();
    document.body.classList.toggle("lost", !session.connection.isOpen && !session.ended);
  });
  const messages = makeMessages();
  const ask = (type, fields) => session.connection.ask(type, fields).catch((error) => {
    messages.tell(say("refused", { message: error.message }));
    return null;
  });
  const acknowledge = () => (session.acknowledge(), alarmBar.show());
  const alarmBar = makeAlarmBar(session, acknowledge);
  const help = makeLiveHelp();
  const time = makeTimeTools(ask, () => session.state?.paused ?? false);
  const over = element("div", { class: "over", hidden: true });

  function showEnd() {
    over.hidden = false;
    over.replaceChildren(...describeEnd(session));
  }

  return {
    session, messages, ask, alarmBar, help, time,
    top: element("div", { class: "stage-top" }, alarmBar.node, messages.node, over),
    /** Keys steer by `conning` while `isConned()`; `chart()` is the chart, once there is one; `more`: what a page adds. */
    listen(conning, isConned, chart, more = {}) {
      const steering = {
        turn: (by) => conning.turn(by),
        rudder: (degrees) => conning.setRudder(degrees),
        telegraph: (by) => conning.changeTelegraph(by),
        stop: () => conning.setTelegraph(0),
        autopilot: () => conning.toggleAutopilot(),
        heading: (by) => conning.changeHeading(by),
        horn: (on) => (conning.isBlowing !== undefined || on) && conning.blow(on),
      };
      const guarded = Object.entries(steering).map(([key, action]) => [key, (value) => isConned() && action(value)]);
      listenToBridgeKeys({
        ...Object.fromEntries(guarded), acknowledge,
        orientation: () => chart()?.toggleOrientation(),
        range: (by) => chart()?.zoom(by),
        pause: time.toggle, theme: toggleTheme, help: help.toggle, ...more,
      });
    },
    /** Offers `window.live` to tests and to pages around it, with `more` of a page. */
    offer: (more) => (window.live = Object.setPrototypeOf(more, {
      session, ask: (type, fields) => session.connection.ask(type, fields),
      get state() {
        return session.state;
      },
      get client() {
        return session.hello?.client;
      },
    })),
  };
}
