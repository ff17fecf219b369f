// A video of the picture, which the browser makes by itself: WebM, where it can.

const KINDS = ["video/webm;codecs=vp8", "video/webm;codecs=vp9", "video/webm"]; // VP8 first: a processor keeps up with it
const RATE = 30; // [frames/s] at most
const BITS = 8e6; // [bit/s]

/** The kind of WebM that this browser records from a canvas, or null. */
export function recordableKind() {
  if (!("MediaRecorder" in globalThis) || !HTMLCanvasElement.prototype.captureStream) return null;
  return KINDS.find((kind) => MediaRecorder.isTypeSupported(kind)) ?? null;
}

/** Records a canvas; `changed(isRecording)` is called at start and stop. */
export class Recorder {
  constructor(canvas, changed) {
    Object.assign(this, { canvas, changed, media: null });
  }

  get isRecording() {
    return this.media !== null;
  }

  /** A promise of the video, as a Blob; it comes after stop(). */
  start() {
    const parts = [];
    const stream = this.canvas.captureStream(RATE);
    const media = new MediaRecorder(stream, { mimeType: recordableKind(), videoBitsPerSecond: BITS });
    this.media = media;
    const video = new Promise((resolve, reject) => {
      media.ondataavailable = ({ data }) => parts.push(data);
      media.onerror = ({ error }) => reject(error);
      media.onstop = () => {
        for (const track of stream.getTracks()) track.stop();
        resolve(new Blob(parts, { type: "video/webm" }));
      };
    });
    media.start();
    this.changed(true);
    return video;
  }

  stop() {
    this.media?.stop();
    this.media = null;
    this.changed(false);
  }
}

/** Gives a file to the user, as a download. */
export function save(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
