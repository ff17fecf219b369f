// Full screen and video of the picture, with a line that says what came of them.
import { element } from "./dom.js";
import { recordableKind, Recorder, save } from "./recorder.js";
import "./texts_replay.js";
import { say } from "./texts.js";

const READABLE = 8000; // a message stays for so long [ms]

/** What a file may be called: letters, digits and a few marks. */
const fileName = (name) => `${name.replace(/[^\p{L}\p{N}._-]+/gu, "_") || "run"}.webm`;

/** `node` for the messages, `fullScreen()` and `record()`; `shown` has listeners for buttons: {fullScreen, recording}. */
export function makeStageTools(stage, canvas, name, clock, shown) {
  const node = element("p", { class: "notice", role: "status", hidden: true });
  let patience;

  function tell(text) {
    node.textContent = text;
    node.hidden = false;
    clearTimeout(patience);
    patience = setTimeout(() => (node.hidden = true), READABLE);
  }

  function fullScreen() {
    if (document.fullscreenElement) return document.exitFullscreen();
    if (!document.fullscreenEnabled) return tell(say("no_full_screen"));
    return stage.requestFullscreen().catch((error) => tell(`${say("no_full_screen")} ${error.message}`));
  }
  document.addEventListener("fullscreenchange", () => shown.fullScreen(document.fullscreenElement === stage));

  const recorder = new Recorder(canvas, (isRecording) => shown.recording(isRecording));

  /** Starts a video from the present time, or ends it; it ends by itself with the run. */
  async function record() {
    if (recorder.isRecording) return recorder.stop();
    if (recordableKind() === null) return tell(say("no_video"));
    try {
      const video = recorder.start();
      clock.play();
      tell(say("recording"));
      const blob = await video;
      save(blob, fileName(name));
      tell(say("recorded", { name: fileName(name), size: (blob.size / 1e6).toFixed(1) }));
    } catch (error) {
      tell(`${say("no_video")} ${error.message}`);
    }
  }
  clock.watch(({ playing, time, end }) => {
    if (recorder.isRecording && !playing && time >= end) recorder.stop();
  });

  return { node, fullScreen, record };
}
