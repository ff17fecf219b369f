/* Search in a site that is opened from a file: there, browsers refuse the worker in which the theme searches.
 *
 * A hidden frame runs the worker's script instead. The theme's plugin `offline` stores the index as a script, and its
 * search looks for the name IFrameWorker. From a server this file does nothing. */

(() => {
  if (location.protocol !== "file:") return;

  class FrameWorker extends EventTarget {
    constructor(url) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      document.body.append(frame);
      this.inside = frame.contentWindow;
      window.addEventListener("message", ({ source, data }) => {
        if (source === this.inside) this.dispatchEvent(new MessageEvent("message", { data }));
      });
      const script = JSON.stringify(new URL(url, location).href);
      this.ready = new Promise((resolve) => {
        this.inside.resolveReady = resolve;
        frame.contentDocument.open();
        frame.contentDocument.write(
          `<script>
            self.postMessage = (data) => parent.postMessage(data, "*");
            self.importScripts = (...urls) => urls.reduce((before, url) => before.then(() => new Promise((done) => {
              const script = document.createElement("script");
              script.src = url;
              script.onload = done;
              document.body.append(script);
            })), Promise.resolve());
          <\/script>
          <body><script src=${script}><\/script><script>self.resolveReady()<\/script></body>`,
        );
        frame.contentDocument.close();
      });
    }

    postMessage(data) {
      this.ready.then(() => this.inside.dispatchEvent(new MessageEvent("message", { data })));
    }

    terminate() {
      this.inside.frameElement.remove();
    }
  }

  window.IFrameWorker = window.Worker = FrameWorker;
})();
