// The replay page: reads what is embedded, builds the page, and offers `window.replay` to tests and to pages around it.
import "./style.css";
import { Clock } from "./clock.js";
import { makeControls } from "./controls.js";
import { readData, readGlb } from "./data.js";
import { element, toggleDialog } from "./dom.js";
import { makeComparison } from "./compare_table.js";
import { makeGhosts } from "./ghosts.js";
import { makeEvents } from "./events.js";
import { clockTime } from "./format.js";
import { SKIES } from "./daylight.js";
import { listenToKeys, makeHelp } from "./keys.js";
import { makeLanguageSwitch } from "./language_switch.js";
import { makePlots } from "./plots.js";
import { readKind, readTitle } from "./readable.js";
import { makeStageTools } from "./stage_tools.js";
import "./texts_replay.js";
import { inWords, language, LANGUAGES, say, setLanguage } from "./texts.js";
import { makeTrackPlot } from "./track_plot.js";
import { lineColour, onTheme, startTheme, toggleTheme } from "./theme.js";
import { drawsInSoftware, makeViewer } from "./viewer.js";

const SLACK = 1e-6;

/** What the address asks for: #t=12.5&camera=impact&theme=dark&plain=yes&sky=dusk&slow=no&bare&play; plain=no insists on the full picture */
function asked() {
  return new URLSearchParams(location.hash.slice(1));
}

function makeTitle(data) {
  const ships = data.ships.map((ship) => {
    const dot = element("i");
    const paint = () => (dot.style.background = lineColour(ship.colour));
    onTheme(paint);
    paint();
    const size = `${readKind(ship.model, ship.kind)}, ${Math.round(ship.L_oa)} m`;
    return element("li", {}, dot, element("b", { text: ship.name }), element("span", { text: size }));
  });
  return element("header", { class: "title" }, makeLanguageSwitch(), element("h1", { text: readTitle(data.name), title: data.name }),
    element("p", { text: data.description }),
    ...(data.is_native ? [inWords(element("p"), { text: "native_run" })] : []),
    element("ul", {}, ...ships));
}

async function start() {
  const data = readData();
  const hash = asked();
  startTheme(hash.get("theme") ?? undefined);
  if (hash.get("lang") in LANGUAGES) setLanguage(hash.get("lang"), false);
  else document.documentElement.lang = language();
  const digits = data.end - data.start < 600 ? 2 : 1;
  const clock = new Clock(data.start, Math.max(data.end, data.other?.end ?? data.end), data.events.map((event) => event.time));
  const canvas = inWords(element("canvas", { id: "picture", tabindex: "0", role: "img" }), { "aria-label": "replay_picture" });
  const stage = element("main", { class: "stage" }, canvas, makeTitle(data));
  document.body.append(stage);
  document.body.classList.toggle("bare", hash.has("bare"));

  const plain = hash.has("plain") ? hash.get("plain") !== "no" : drawsInSoftware();
  const viewer = await makeViewer(canvas, data, await readGlb(), !plain);
  const ghosts = data.other ? await makeGhosts(await readGlb("other-glb"), data.other, data.origin) : null;
  if (ghosts) viewer.add(ghosts.node, (time) => ghosts.move(time - data.other.start));
  const stageTools = makeStageTools(stage, canvas, data.name, clock, {
    fullScreen: (isFull) => controls.showFullScreen(isFull),
    recording: (isOn) => controls.showRecording(isOn),
  });
  const go = (time) => (clock.pause(), clock.seek(time));
  const help = makeHelp();
  const actions = {
    next: () => go((data.events.find((event) => event.time > clock.time + SLACK) ?? { time: clock.end }).time),
    previous: () => go((data.events.findLast((event) => event.time < clock.time - SLACK) ?? { time: clock.start }).time),
    panel: () => document.body.classList.toggle("wide"),
    help: () => toggleDialog(help),
    theme: toggleTheme,
    fullScreen: stageTools.fullScreen,
    record: stageTools.record,
    camera: () => controls.nextCamera(),
    plain: () => controls.togglePlain(),
    sky: () => controls.nextSky(),
    slow: () => controls.setSlow(!clock.isSlow),
  };
  const controls = makeControls(data, clock, viewer, digits, actions);
  const jump = (event) => (go(event.time), controls.chooseCamera("impact"));
  const section = (words, ...inside) => inWords(element("section", {}, inWords(element("h2"), { text: words }), ...inside), { "aria-label": words });
  const tracks = {
    ships: viewer.ships.map(({ info, track }) => ({ name: info.name, colour: info.colour, length: info.L_oa, track, outline: data.outlines[info.name], end: data.end })),
    events: data.events.map(({ time, point }) => ({ time, point: point.map((x, i) => x - data.origin[i]) })),
    obstacles: data.obstacles, start: data.start,
  };
  if (ghosts) {
    tracks.ships.push(...data.other.ships.map(({ name, colour, L_oa }) => ({
      name, colour, length: L_oa, track: ghosts.trackOf(name), outline: data.other.outlines[name], end: data.other.end, isOther: true })));
  }
  const panel = inWords(element("aside", { class: "panel" },
    section("collisions", element("div", { class: "events" }, makeEvents(data, clock, digits, jump))),
    ...(data.other ? [section("comparison", ...makeComparison(data, data.other))] : []),
    section("track_plot", makeTrackPlot(tracks, clock)),
    section("curves", makePlots(data, clock)),
    element("footer", { text: `shipcollision-fmu ${data.version}` })), { "aria-label": "panel" });
  stage.append(controls.node, stageTools.node);
  document.body.append(panel, help);
  listenToKeys(clock, actions);

  const alive = element("div", { class: "sr-only", role: "status" });
  document.body.append(alive);
  clock.watch(({ time, playing }) => {
    viewer.setPlaying(playing);
    viewer.show(time);
    if (!playing) alive.textContent = clockTime(time, digits);
  });

  function obey() {
    const wishes = asked();
    if (wishes.has("plain")) controls.setPlain(wishes.get("plain") !== "no");
    if (SKIES.some(([value]) => value === wishes.get("sky"))) controls.chooseSky(wishes.get("sky"));
    if (wishes.has("slow")) controls.setSlow(wishes.get("slow") !== "no");
    if (wishes.has("t")) clock.seek(Number(wishes.get("t")));
    const camera = wishes.get("camera");
    if (viewer.cameras.choices.some(([value]) => value === camera)) controls.chooseCamera(camera);
    if (wishes.has("play")) clock.play();
  }
  controls.setPlain(plain);
  controls.chooseCamera("all"); // once more, beside card and bar, which stand now
  obey();
  window.addEventListener("hashchange", obey);

  viewer.draw();
  window.replay = {
    data,
    get time() {
      return clock.time;
    },
    seek: (time) => clock.seek(time),
    play: () => clock.play(),
    pause: () => clock.pause(),
    camera: (mode) => controls.chooseCamera(mode),
    language: setLanguage,
    record: stageTools.record,
    showOther(isShown) {
      if (ghosts) ghosts.node.visible = isShown;
    },
    plain: (isPlain) => controls.setPlain(isPlain),
    sky: (name) => controls.chooseSky(name),
    slow: (isSlow) => controls.setSlow(isSlow),
    get rate() {
      return clock.rate;
    },
    /** Draws now and says what is in the picture. */
    drawn() {
      viewer.draw();
      const points = data.scratches.flatMap((scratch) => scratch.times).filter((time) => time <= clock.time + SLACK);
      return {
        time: clock.time, poses: viewer.poses(), eye: viewer.eye(), scratchPoints: points.length,
        scratchTriangles: viewer.shown.triangles, effects: viewer.shown.effects, dents: viewer.shown.dents,
        others: ghosts?.positions(), hidden: viewer.cameras.hidden(clock.time),
        sparks: viewer.shown.sparks, lights: viewer.shown.lights, made: viewer.made(),
      };
    },
    project: (point) => viewer.project(point),
  };
  document.body.dataset.ready = "true";
}

start().catch((error) => {
  const message = document.createElement("p");
  message.className = "failure";
  message.textContent = say("no_webgl", { message: error.message.replace(/\.$/, "") });
  document.body.append(message);
  document.body.dataset.ready = "failed";
  throw error;
});
