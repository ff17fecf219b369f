// The bar below the picture: play, the time slider with a mark per collision, speed, camera, switches.
import { SKIES } from "./daylight.js";
import { element, icon } from "./dom.js";
import { mayWait } from "./follow.js";
import { clockTime } from "./format.js";
import "./texts_replay.js";
import { inWords, onLanguage, say } from "./texts.js";
import { toggleTheme } from "./theme.js";

const PLAY = "M6 3.5v13l11-6.5z";
const PAUSE = "M5.5 4h3.2v12H5.5zM11.3 4h3.2v12h-3.2z";
const BACK = "M5 4h2v12H5zM16 4v12L8 10z";
const FORWARD = "M13 4h2v12h-2zM4 4l8 6-8 6z";
const WAVES = "M2 7c2-2 4-2 5.3 0s3.4 2 5.3 0 3.4-2 5.4 0v2c-2-2-3.500-2-5.400 0s-4 2-5.300 0-3.300-2-5.300 0zM2 12c2-2 4-2 5.3 0s3.4 2 5.3 0 3.4-2 5.4 0v2c-2-2-3.500-2-5.400 0s-4 2-5.300 0-3.300-2-5.300 0z";
const SLOW = "M10 3a7.500 7.500 0 1 0 7.500 7.500H16A6 6 0 1 1 10 4.500zM9.200 6.500h1.600v4l2.700 1.600-.8 1.300-3.500-2.100zM12 3.300l1.500.6-.5 1.400-1.500-.6zm3.300 2.200 1 1.200-1.200 1-1-1.200z";
const MOON = "M12.500 2.500a8 8 0 1 0 5 11.500 6.500 6.500 0 0 1-5-11.500z";
const PANEL = "M2.500 3.500h15v13h-15zM12 5v10h4V5z";
const FULL = "M3 3h5v2H5v3H3zM12 3h5v5h-2V5h-3zM3 12h2v3h3v2H3zM15 12h2v5h-5v-2h3z";
const RECORD = "M10 3a7 7 0 1 0 0 14 7 7 0 0 0 0-14zm0 2a5 5 0 1 1 0 10 5 5 0 0 1 0-10zm0 2.200a2.800 2.800 0 1 0 0 5.600 2.800 2.800 0 0 0 0-5.600z";
const STOP = "M4.500 4.500h11v11h-11z";
const HELP = "M10 2a8 8 0 1 0 0 16 8 8 0 0 0 0-16zm-.9 11.500h1.800v1.800H9.100zM10 4.800c2 0 3.300 1.200 3.300 2.800 0 2.400-2.400 2.500-2.400 4.600H9.100c0-3 2.300-3.100 2.300-4.500 0-.7-.5-1.200-1.400-1.200s-1.500.5-1.500 1.400H6.700c0-1.900 1.400-3.100 3.300-3.100z";

const GAP = 200; // [ms], see follow.js
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50];

export const PLAYBACK = 45; // a run longer than this many seconds starts at a speed that shows it in about that time

function startSpeed(duration) {
  return SPEEDS.find((speed) => speed >= 1 && duration / speed <= PLAYBACK) ?? SPEEDS.at(-1);
}

/** A button with an icon; its name follows the language, and its hint has the key as well. */
function button(words, key, path, onclick, more = {}) {
  const made = element("button", { type: "button", class: "icon", onclick, ...more }, icon(path));
  onLanguage(() => name(made, words, key));
  return made;
}

function name(made, words, key) {
  made.setAttribute("aria-label", say(words));
  made.title = key ? `${say(words)} (${key === "space" ? say("key_space") : key})` : say(words);
}

const CAMERAS = { all: "camera_all", impact: "camera_impact", free: "camera_free" };

/** The name of a camera in the present language; that of a newer one as it comes. */
function nameCamera(data, value, text) {
  if (value.startsWith("ship-")) return say("follow_ship", { ship: data.ships[Number(value.slice(5))].name });
  return value in CAMERAS ? say(CAMERAS[value]) : text;
}

export function makeControls(data, clock, viewer, digits, actions) {
  const play = button("play", "space", PLAY, () => clock.toggle(), { id: "play" });
  const slider = element("input", {
    type: "range", id: "time", min: clock.start, max: clock.end, step: "any",
    oninput: () => clock.seek(Number(slider.value)),
  });
  const share = (time) => (time - clock.start) / (clock.end - clock.start);
  const marks = element(
    "div",
    { class: "marks" },
    ...data.events.map((event) => {
      const mark = element("i");
      mark.style.left = `${(100 * share(event.time)).toFixed(3)}%`;
      return mark;
    }),
  );
  const shown = element("output", { id: "now" });
  const total = element("span", { class: "total", text: `/ ${clockTime(clock.end, digits)}` });
  const speed = inWords(element("select", { onchange: () => clock.setSpeed(Number(speed.value)) },
    ...SPEEDS.map((value) => element("option", { value, text: `${value}\u00d7` }))), { "aria-label": "speed_of_play", title: "speed_of_play" });
  const camera = element("select", { id: "camera", onchange: () => viewer.chooseCamera(camera.value) },
    ...viewer.cameras.choices.map(([value, text]) => {
      const option = element("option", { value });
      onLanguage(() => (option.textContent = nameCamera(data, value, text)));
      return option;
    }));
  onLanguage(() => name(camera, "camera", "C"));
  const sky = element("select", { id: "sky", onchange: () => viewer.setSky(sky.value) },
    ...SKIES.map(([value]) => inWords(element("option", { value }), { text: `sky_${value}` })));
  onLanguage(() => name(sky, "sky", "D"));
  const plain = button("plain", "S", WAVES, () => setPlain(plain.getAttribute("aria-pressed") !== "true"), { id: "plain", "aria-pressed": "false" });

  const slow = button("slow_motion", "M", SLOW, () => setSlow(!clock.isSlow), { id: "slow", "aria-pressed": "true" });
  const rate = inWords(element("span", { class: "rate" }), { title: "rate_of_play" });

  function setSlow(isSlow) {
    slow.setAttribute("aria-pressed", String(isSlow));
    clock.setSlow(isSlow);
  }

  function setPlain(isPlain) {
    plain.setAttribute("aria-pressed", String(isPlain));
    document.body.classList.toggle("plain", isPlain);
    viewer.setPlain(isPlain);
  }

  const full = button("full_screen", "F", FULL, actions.fullScreen, { id: "full-screen", "aria-pressed": "false" });
  const record = button("record", "R", RECORD, actions.record, { id: "record" });
  let isRecording = false;
  onLanguage(() => name(record, isRecording ? "stop_recording" : "record", "R"));
  let isPlaying = null;
  onLanguage(() => (name(play, isPlaying ? "pause" : "play", "space"), slider.setAttribute("aria-label", say("time"))));
  clock.setSpeed(startSpeed(clock.end - clock.start));
  let last = -Infinity;
  clock.watch(({ time, playing, speed: current }) => {
    if (playing === isPlaying && mayWait(clock, last, GAP)) return;
    last = performance.now();
    slider.value = time;
    slider.style.setProperty("--share", `${100 * share(time)}%`);
    shown.textContent = clockTime(time, digits);
    speed.value = String(current);
    slider.setAttribute("aria-valuetext", clockTime(time, digits));
    rate.textContent = clock.rate < 0.99 * current ? `${clock.rate.toFixed(2)}\u00d7` : "";
    if (isPlaying !== playing) {
      isPlaying = playing;
      name(play, playing ? "pause" : "play", "space");
      play.replaceChildren(icon(playing ? PAUSE : PLAY));
    }
  });

  const node = element(
    "div",
    { class: "bar" },
    element("div", { class: "transport" },
      button("previous_collision", "P", BACK, actions.previous), play, button("next_collision", "N", FORWARD, actions.next)),
    element("div", { class: "timeline" }, slider, marks),
    element("div", { class: "clock" }, shown, total, rate),
    element("div", { class: "choices" }, speed, camera, sky, slow, plain,
      button("theme", "T", MOON, toggleTheme, { id: "theme" }),
      button("panel", "V", PANEL, actions.panel), full, record, button("help", "?", HELP, actions.help)),
  );
  return {
    node,
    setPlain,
    setSlow,
    togglePlain: () => plain.click(),
    nextCamera() {
      camera.selectedIndex = (camera.selectedIndex + 1) % camera.options.length;
      viewer.chooseCamera(camera.value);
    },
    nextSky() {
      sky.selectedIndex = (sky.selectedIndex + 1) % sky.options.length;
      viewer.setSky(sky.value);
    },
    showFullScreen: (isFull) => full.setAttribute("aria-pressed", String(isFull)),
    showRecording(isOn) {
      isRecording = isOn;
      record.classList.toggle("on", isOn);
      record.replaceChildren(icon(isOn ? STOP : RECORD));
      name(record, isOn ? "stop_recording" : "record", "R");
    },
    chooseSky(name) {
      sky.value = name;
      viewer.setSky(name);
    },
    chooseCamera(mode) {
      camera.value = mode;
      viewer.chooseCamera(mode);
    },
  };
}
