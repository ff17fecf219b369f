// The WebSocket to the server: messages in, requests with answers out. It connects again by itself.

const SILENCE = 6; // looks without a message between them, after which it is lost: open, or not open yet
const LOOK = 500; // between two looks [ms]; looks are counted, as a page that is busy itself hears nothing meanwhile
const WAITS = [300, 600, 1200, 2500]; // before the next try [ms]
const ANSWER = 5000; // longest wait for an answer [ms]
const READ = 500; // and for messages that have come meanwhile to be read

export class Connection {
  /** `hear(type, message)` is called for every message, and with "open", "lost", and after finish() "gone". */
  constructor(role, token, hear) {
    Object.assign(this, { hear, number: 0, asked: new Map(), tries: 0, isOpen: false, isOver: false });
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    this.address = `${scheme}//${location.host}/ws?token=${encodeURIComponent(token)}&role=${role}`;
    this.connect();
    setInterval(() => this.socket !== null && ++this.silent > SILENCE && this.drop(), LOOK);
  }

  connect() {
    const socket = new WebSocket(this.address);
    Object.assign(this, { socket, silent: 0 });
    socket.onopen = () => {
      Object.assign(this, { tries: 0, isOpen: true, silent: 0 });
      this.hear("open", {});
    };
    socket.onmessage = ({ data }) => {
      this.silent = 0;
      const message = JSON.parse(data);
      if (message.type === "ok" || (message.type === "error" && message.id !== undefined)) this.answer(message);
      else this.hear(message.type, message);
    };
    socket.onclose = () => this.drop();
  }

  /** The connection is gone: all that was asked fails, and the next try is set. */
  drop() {
    const { socket } = this;
    socket.onclose = socket.onmessage = null;
    socket.close();
    Object.assign(this, { socket: null, isOpen: false });
    for (const { reject } of this.asked.values()) reject(new Error("the connection was lost"));
    this.asked.clear();
    if (this.isOver) return this.hear("gone", {});
    this.hear("lost", {});
    setTimeout(() => this.connect(), WAITS[Math.min(this.tries++, WAITS.length - 1)]);
  }

  answer({ type, id, message, ...more }) {
    const asked = this.asked.get(id);
    this.asked.delete(id);
    if (!asked) return;
    clearTimeout(asked.patience);
    type === "ok" ? asked.resolve(more) : asked.reject(new Error(message));
  }

  /** Sends a request; a promise of the answer, which fails with the server's words. */
  ask(type, fields = {}) {
    return new Promise((resolve, reject) => {
      if (!this.isOpen) return reject(new Error("there is no connection"));
      const id = ++this.number;
      // A page that is busy finds clock and answer waiting together: what has come is read first.
      const fail = () => this.answer({ type: "error", id, message: "the server did not answer" });
      const patience = setTimeout(() => setTimeout(fail, READ), ANSWER);
      this.asked.set(id, { resolve, reject, patience });
      this.socket.send(JSON.stringify({ ...fields, type, id }));
    });
  }

  /** The run is over: no more tries. */
  finish() {
    this.isOver = true;
  }
}
