// The bridge: what is seen from the ship, instruments, steering and engine, chart, other ships, alarms.
import { element } from "../dom.js";
import { SKIES } from "../daylight.js";
import { inWords, onLanguage, say } from "../texts.js";
import { drawsInSoftware, makeViewer } from "../viewer.js";
import { Chart } from "./chart.js";
import { commandWords, Conning } from "./conning.js";
import { DentList } from "./dent_list.js";
import { effectsOf, ignitionOf } from "./effects_live.js";
import { makeInstruments } from "./instruments.js";
import { LiveCameras, MODES } from "./live_cameras.js";
import { makeLivePage } from "./live_page.js";
import { followHistories } from "./motion.js";
import { makeLimits, makeSwitches, textButton } from "./page_tools.js";
import { makeScratchMarks } from "./scratch_marks.js";
import { makeTargets } from "./targets.js";

const NUMBERS = 150; // between two readings of the instruments [ms]
const CHART = 250; // between two pictures of the chart [ms]
const SETTLED = 0.1; // [s] after which a collision's energy tells how strong its effects are
const DENTED = 0.4; // [s] after which its dents are made, which takes a moment: the alarm comes first

/** Velocity of the air, north and east [m/s], from a wind as a state has it. */
const airOf = ({ speed, from_deg }) => [Math.cos, Math.sin].map((part) => -speed * part((from_deg * Math.PI) / 180));

export async function startBridge() {
  const page = makeLivePage("bridge", { hello: () => greet(), back: ({ time: now }) => forgetEffects(now), touches: ({ touches }) => scratches?.add(touches) });
  const { session, ask, messages, time } = page;
  const onShip = (type, fields) => ask(type, { ship: session.own, ...fields });
  const conning = new Conning((fields) => onShip("order", fields), (on) => onShip("horn", { on }));
  const instruments = makeInstruments();
  const targets = makeTargets();
  const canvas = inWords(element("canvas", { id: "picture", tabindex: "0" }), { "aria-label": "picture" });
  const title = element("h1", {});
  const said = inWords(element("p", { id: "command-said" }), { text: "connecting" });
  const command = element("button", { type: "button", id: "command", onclick: () => onShip("command", { take: !isInCommand() }) });
  const camera = inWords(element("select", { id: "camera", onchange: () => chooseCamera(camera.value) },
    ...MODES.map((mode) => inWords(element("option", { value: mode }), { text: `camera_${mode}` }))), { "aria-label": "camera" });
  const sky = inWords(element("select", { id: "sky", onchange: () => viewer?.setSky(sky.value) },
    ...SKIES.map(([value]) => inWords(element("option", { value }), { text: `sky_${value}` }))), { "aria-label": "sky" });
  const binoculars = inWords(element("button", { type: "button", id: "binoculars", text: "7\u00d7", "aria-pressed": "false", onclick: () => toggleBinoculars() }), { "aria-label": "binoculars", title: "binoculars" });
  const plain = inWords(element("button", { type: "button", class: "small", id: "plain", text: "\u2248", "aria-pressed": "false", onclick: () => togglePlain() }), { "aria-label": "plain", title: "plain" });
  const swap = inWords(textButton("chart", () => swapChart(), { id: "chart-large", "aria-pressed": "false" }), { title: "chart_large" });
  const stage = element("main", { class: "stage" }, canvas,
    page.top, element("div", { class: "stage-tools" }, camera, sky, binoculars, swap));
  const chartPlace = element("div", { class: "chart-place" });
  const isNarrow = matchMedia("(max-width: 1200px)");
  document.body.append(stage,
    element("aside", { class: "side" },
      element("header", { class: "command-bar" }, element("div", {}, title, said), command),
      time.node, instruments.node, conning.node, chartPlace, targets.node, makeLimits(session), makeSwitches(page.help.toggle, plain)), page.help.card);

  let viewer = null;
  let chart = null;
  let scratches = null;
  let shown = null;
  const effects = new Map(); // collision -> {made, remove}: its effects, and what takes them away
  const dents = new DentList((made) => viewer.addDents(made));
  const unlit = new Set(); // collisions that this page has seen before they set something on fire
  const numbers = { next: 0, chart: 0 };

  const isInCommand = () => session.state?.command[session.own] === session.hello?.client;
  const isChartLarge = () => document.body.classList.contains("chart-large");

  function greet() {
    const info = session.infoOf(session.own);
    document.title = say("bridge_title", { ship: session.own });
    conning.setLimits(info);
    scratches?.restore(session.touches); // what was scratched while the connection was lost
    time.setAllowed(session.hello.sets_pace !== false);
    if (chart === null) {
      chart = new Chart(session.hello, session.histories, session.own);
      placeChart();
      isNarrow.addEventListener("change", placeChart);
      makePicture();
    }
    firstState().then((state) => state.command[session.own] == null && info.limits && onShip("command", { take: true }));
  }

  async function firstState() {
    while (session.snapshots.newest === null) await new Promise((resolve) => setTimeout(resolve, 20));
    return session.snapshots.newest.state;
  }

  async function makePicture() {
    try {
      const [answer] = await Promise.all([fetch(session.address("/scene.glb")), firstState()]);
      if (!answer.ok) throw new Error(`/scene.glb: ${answer.status}`);
      session.present(performance.now());
      const ships = session.hello.ships;
      const data = { start: 0, end: Infinity, origin: [0, 0, 0], events: [], effects: [], scratches: [], ships };
      const isPlain = drawsInSoftware();
      const followed = followHistories(session.histories);
      const made = await makeViewer(canvas, data, await answer.arrayBuffer(), !isPlain, (gltf) => {
        data.origin = gltf.scene.userData.origin;
        return followed(gltf);
      }, LiveCameras);
      made.cameras.own = made.ships.findIndex(({ info }) => info.name === session.own);
      scratches = makeScratchMarks(made.ships);
      scratches.add(session.touches);
      viewer = made;
      if (isPlain) togglePlain();
      chooseCamera(session.infoOf(session.own).bridge ? "bridge" : "chase");
    } catch (error) {
      messages.tell(say("no_picture", { message: error.message }));
    }
    document.body.dataset.ready = "true";
  }

  function chooseCamera(mode) {
    camera.value = mode;
    viewer?.chooseCamera(mode);
    showBinoculars();
  }

  function toggleBinoculars() {
    viewer?.cameras.toggleBinoculars();
    showBinoculars();
  }

  function showBinoculars() {
    const isOn = viewer?.cameras.hasBinoculars ?? false;
    binoculars.setAttribute("aria-pressed", String(isOn));
    document.body.classList.toggle("binoculars", isOn);
  }

  function togglePlain() {
    const isPlain = document.body.classList.toggle("plain");
    plain.setAttribute("aria-pressed", String(isPlain));
    viewer?.setPlain(isPlain);
  }

  function nextSky() {
    sky.selectedIndex = (sky.selectedIndex + 1) % sky.options.length;
    viewer?.setSky(sky.value);
  }

  function swapChart() {
    const isLarge = document.body.classList.toggle("chart-large");
    swap.setAttribute("aria-pressed", String(isLarge));
    if (chart) placeChart();
  }

  /** In a corner of the picture, in its place, or on a narrow screen below the controls. */
  function placeChart() {
    isNarrow.matches && !isChartLarge() ? chartPlace.append(chart.node) : canvas.after(chart.node);
    chart.draw();
  }

  function addNewEffects(state) {
    for (const collision of state.contact.collisions) {
      const { id, time: start, energy, ship_a, ship_b } = collision;
      const key = `${id} ${start}`;
      const infos = viewer.ships.map(({ info }) => info).filter(({ name }) => name === ship_a || name === ship_b);
      const ignition = ignitionOf(infos);
      if (state.time >= start + SETTLED) addOnce(`${key} hit`, () => effectsOf(collision, infos, start, energy, false));
      if (state.time >= start + DENTED) dents.meet(key, collision, infos);
      // What burnt already when this page first saw it began to burn at most a few seconds after the collision did.
      if (energy < ignition) unlit.add(key);
      else addOnce(`${key} fire`, () => effectsOf(collision, infos, unlit.has(key) ? state.time : start, ignition, true));
    }
  }

  function addOnce(key, make) {
    if (effects.has(key)) return;
    const made = make();
    effects.set(key, { made, remove: viewer.addEffects(made) });
  }

  /** Time has gone back: all effects go, and come again where their collisions have happened; so do later scratches. */
  function forgetEffects(now) {
    scratches?.forget(now);
    for (const { remove } of effects.values()) remove();
    effects.clear();
    dents.clear();
    unlit.clear();
  }

  function showCommand() {
    const client = session.state.command[session.own];
    title.textContent = session.own;
    said.textContent = commandWords(session.infoOf(session.own), client, session.hello.client);
    command.hidden = !session.infoOf(session.own).limits;
    command.textContent = say(isInCommand() ? "release_command" : "take_command");
    command.setAttribute("aria-pressed", String(isInCommand()));
  }

  function frame(now) {
    requestAnimationFrame(frame);
    const state = session.present(now);
    if (!state || !session.hello) return;
    shown = state;
    if (viewer) viewer.setWind(airOf(state.environment.wind));
    if (viewer) addNewEffects(state); // behind the chart, too: a fire begins when it does
    if (viewer && !isChartLarge()) {
      viewer.setPlaying(!session.state.paused); // a plain picture may have fewer pixels while the ships move
      viewer.showNow(state.time);
    }
    if (now >= numbers.next) {
      numbers.next = now + NUMBERS;
      const own = state.ships[session.own];
      instruments.show(own, state.environment.current);
      conning.show(session.state.ships[session.own], isInCommand(), session.state.step_count);
      targets.show(state, session.own, session.dangers);
      time.show(session.state);
      showCommand();
    }
    if (chart && now >= numbers.chart) {
      numbers.chart = now + CHART;
      chart.show(state, session.dangers);
    }
  }

  page.listen(conning, () => true, () => chart, {
    camera: (index) => chooseCamera(MODES[index ?? (MODES.indexOf(camera.value) + 1) % MODES.length]),
    look: (degrees) => viewer?.cameras.isAboard && viewer.cameras.turn((degrees * Math.PI) / 180, 0),
    binoculars: toggleBinoculars,
    chart: swapChart,
    plain: togglePlain,
    sky: nextSky,
  });
  onLanguage(() => shown && session.hello && (showCommand(), (document.title = say("bridge_title", { ship: session.own })), page.alarmBar.show()));
  requestAnimationFrame(frame);

  page.offer({
    /** Contacts as they came into the page: [{id, time, wall}], wall [ms] when the frame was made that shows one. */
    get contacts() {
      return session.contacts.filter(({ wall }) => wall);
    },
    /** Effects of collisions so far, those that are over as well: [{kind, ship, point, time}] and more. */
    get effects() {
      return [...effects.values()].flatMap(({ made }) => made);
    },
    /** Dents of collisions so far: [{kind, ship, point, time, energy, depth, half_width}]. */
    get dents() {
      return dents.dents;
    },
    order: (fields) => session.connection.ask("order", { ship: session.own, ...fields }),
    camera: chooseCamera,
    /** Draws now and says what is in the picture. */
    drawn() {
      shown = session.present(performance.now()) ?? shown;
      viewer.show(shown.time);
      viewer.draw();
      const { camera: eye, mode, zoom } = viewer.cameras;
      return { time: shown.time, poses: viewer.poses(), effects: viewer.shown.effects, frames: viewer.shown.frames, mode, zoom, scratches: scratches.places, eye: eye.position.toArray(), fov: eye.fov };
    },
    project: (point) => viewer.project(point),
  });
}
