// The instructor's page: the chart of all ships, taking over, failures, wind and current, marks, time, end.
import { element } from "../dom.js";
import { clockTime, number } from "../format.js";
import { inWords, onLanguage, say, TEXTS } from "../texts.js";
import { makeArmed } from "./armed.js";
import { Chart } from "./chart.js";
import { commandWords, Conning, threeDigits } from "./conning.js";
import { inBothUnits, makeEnvironment } from "./environment.js";
import { makeLivePage } from "./live_page.js";
import { instruments, KNOT, toDegrees } from "./navigation.js";
import { makeSwitches, textButton } from "./page_tools.js";

const NUMBERS = 200; // between two readings [ms]
const LINES = 60; // of the log book

export async function startInstructor() {
  const page = makeLivePage("instructor", { hello: (hello) => greet(hello), event: (event) => note(event) });
  const { session, ask, time } = page;
  let conned = null; // the ship whose controls are shown
  const conning = new Conning((fields) => ask("order", { ship: conned, ...fields }), (on) => ask("horn", { ship: conned, on }));
  const conningHead = element("h2", {});
  const conningPlace = element("section", { class: "conn-place", hidden: true }, conningHead, conning.node);
  const centre = inWords(element("select", { id: "centre", onchange: () => centreOn(centre.value || null) }), { "aria-label": "chart" });
  const stage = element("main", { class: "stage" },
    page.top, element("div", { class: "stage-tools" }, centre));
  const title = inWords(element("h1", {}), { text: "instructor_title" });
  const ships = makeShips(ask, (name) => conn(name));
  const marks = makeMarks(ask);
  const armed = makeArmed(ask, page.messages.tell);
  const environment = makeEnvironment(ask, page.messages.tell, () => session.hello.environment_limits);
  const book = element("ol", { class: "book", id: "book" });
  let sure = null;
  const end = textButton("end_run", () => {
    if (sure) return clearTimeout(sure), ask("end");
    end.textContent = say("end_sure");
    end.classList.add("sure");
    sure = setTimeout(() => ((sure = null), (end.textContent = say("end_run")), end.classList.remove("sure")), 4000);
  }, { id: "end", class: "end" });
  document.body.append(stage, element("aside", { class: "side" }, element("header", { class: "command-bar" }, element("div", {}, title), time.node),
    ships.node, conningPlace, environment.node, armed.node, marks.node,
    element("section", {}, inWords(element("h2", {}), { text: "log_book" }), book), end, makeSwitches(page.help.toggle)), page.help.card);
  onLanguage(() => (document.title = say("instructor_title")));
  let chart = null;
  let next = 0;

  function greet(hello) {
    marks.show(hello.marks ?? []);
    book.replaceChildren();
    for (const event of hello.events ?? []) write(event);
    ships.greet(hello);
    armed.greet(hello);
    if (chart === null) {
      chart = new Chart(hello, session.histories, null);
      stage.prepend(chart.node);
      centre.append(inWords(element("option", { value: "" }), { text: "centre_all" }),
        ...hello.ships.map(({ name }) => inWords(element("option", { value: name }), { text: "follow" }, { ship: name })));
    }
    document.body.dataset.ready = "true";
  }

  function centreOn(name) {
    chart.own = name;
    chart.fit();
    chart.draw();
  }

  async function conn(name) {
    conning.setLimits(session.infoOf(name));
    if (name !== conned) conning.reset(session.state.ships[name], session.state.step_count);
    conned = name;
    conningPlace.hidden = false;
    conningHead.textContent = name;
    if (session.state.command[name] !== session.hello.client) await ask("command", { ship: name, take: true });
  }

  /** A line of the log; a new mark is listed, and those are not that are later than where the run has gone back to. */
  function note(event) {
    if (event.kind === "mark") marks.add(event);
    if (event.kind === "back") marks.keep(event.time);
    if (event.kind === "armed") armed.show(event.armed);
    write(event);
  }

  function write(event) {
    const text = describeEvent(event);
    if (text === null) return;
    book.prepend(element("li", {}, element("time", { text: clockTime(event.time, 0) }), ` ${text}`));
    while (book.children.length > LINES) book.lastChild.remove();
  }

  function frame(now) {
    requestAnimationFrame(frame);
    const state = session.present(now);
    if (!state || !session.hello || now < next) return;
    next = now + NUMBERS;
    chart.show(state, session.dangers);
    ships.show(session.state, session.hello.client);
    environment.show(session.state.environment);
    time.show(session.state);
    if (conned !== null) conning.show(session.state.ships[conned], session.state.command[conned] === session.hello.client, session.state.step_count);
  }

  page.listen(conning, () => conned !== null, () => chart);
  requestAnimationFrame(frame);
  page.offer({ order: (fields) => session.connection.ask("order", fields) });
}

/** The ships: who is in command, course and speed, taking over, failures. */
function makeShips(ask, conn) {
  const list = element("div", { class: "ship-cards" });
  const cards = new Map();
  return {
    node: element("section", {}, inWords(element("h2", {}), { text: "ships" }), list),
    greet(hello) {
      for (const info of hello.ships) {
        if (cards.has(info.name)) continue;
        const dot = element("i");
        dot.style.background = info.colour;
        const figures = element("p", { class: "figures" });
        const said = element("p", { class: "said" });
        const take = textButton("conn", () => conn(info.name), { "data-conn": info.name });
        const fails = ["rudder", "blackout"].map((what) => textButton(`fail_${what}`,
          () => ask("fail", { ship: info.name, what, on: buttonOf(what).getAttribute("aria-pressed") !== "true" }),
          { "data-fail": what, "aria-pressed": "false" }));
        const buttonOf = (what) => fails.find((button) => button.dataset.fail === what);
        const size = `${info.model}, ${info.kind}, ${Math.round(info.L_oa)} m`;
        const tools = element("div", { class: "row three", hidden: !info.limits }, take, ...fails);
        const node = element("article", { "data-ship": info.name }, element("h3", {}, dot, info.name), element("p", { class: "said", text: size }), figures, said, tools);
        cards.set(info.name, { info, node, figures, said, fails, take });
        list.append(node);
      }
    },
    show(state, client) {
      for (const [name, { info, figures, said, fails, take }] of cards) {
        const ship = state.ships[name];
        const { heading, sog } = instruments(ship);
        figures.textContent = `${threeDigits(toDegrees(heading))}°  ${number(sog / KNOT, 1)} ${say("knots")}`;
        const holder = state.command[name];
        said.textContent = commandWords(info, holder, client);
        take.setAttribute("aria-pressed", String(holder === client));
        for (const button of fails) button.setAttribute("aria-pressed", String(ship.failures.includes(button.dataset.fail)));
      }
    },
  };
}

/** A line for an event of the server; null for what is no news. */
function describeEvent({ kind, message, ...event }) {
  if (kind === "log") return message;
  if (kind === "armed") return null; // they have a list of their own
  if (kind === "command") return say(event.client === null ? "log_command_none" : "log_command", event);
  if (kind === "failure") return say(event.on ? "log_failure_on" : "log_failure_off", { ship: event.ship, what: say(`fail_${event.what}`) });
  if (kind === "horn") return event.on ? say("log_horn", event) : null;
  if (kind === "pause") return say(event.paused ? "log_pause" : "log_go_on");
  if (kind === "mark") return event.note ? `${say("log_mark", event)}: ${event.note}` : say("log_mark", event);
  if (kind === "environment") {
    const { wind, current } = event;
    return say("log_environment", { wind: inBothUnits(wind.speed), from: threeDigits(wind.from_deg), current: inBothUnits(Math.hypot(...current)) });
  }
  const key = `log_${kind.replace(" ", "_")}`;
  return key in TEXTS ? say(key, { ...event, energy: number((event.energy ?? 0) / 1e6, 1) }) : kind;
}

function makeMarks(ask) {
  const name = inWords(element("input", { type: "text", id: "mark-name", maxlength: 40 }), { "aria-label": "mark_name", placeholder: "mark_name" });
  const note = inWords(element("input", { type: "text", id: "mark-note", maxlength: 200 }), { "aria-label": "mark_note", placeholder: "mark_note" });
  const list = element("ul", { class: "mark-list" });
  const none = inWords(element("p", { class: "none" }), { text: "no_marks" });
  const set = async () => {
    const answer = await ask("mark", { name: name.value.trim() || String(list.children.length + 1), note: note.value.trim() });
    if (answer) name.value = note.value = "";
  };
  for (const input of [name, note]) {
    input.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key === "Enter") set();
    });
  }
  return {
    node: element("section", {}, inWords(element("h2", {}), { text: "marks" }), list, none, element("div", { class: "row wide-first" }, name, textButton("set_mark", set, { id: "set-mark" })),
      element("div", { class: "row" }, note)),
    add({ name: called, time, note: said }) {
      this.show([...this.known.filter((mark) => mark.name !== called), { name: called, time, note: said }]);
    },
    keep(latest) {
      this.show(this.known.filter((mark) => mark.time <= latest));
    },
    /** `known`: [{name, time, note}]. */
    show(known) {
      this.known = known;
      none.hidden = known.length > 0;
      list.replaceChildren(...known.map((mark) => {
        const back = textButton("go_back", () => ask("back", { name: mark.name }), { "data-mark": mark.name });
        const said = mark.note ? [element("p", { class: "note", text: mark.note })] : [];
        return element("li", {}, inWords(back, { text: "go_back" }, { name: mark.name, time: clockTime(mark.time, 0) }), ...said);
      }));
    },
  };
}
