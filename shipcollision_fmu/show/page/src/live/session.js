// A page's view of the simulation that runs: the connection, the newest states, tracks, alarms and what is heard.
import { clockTime, number } from "../format.js";
import { say } from "../texts.js";
import { Alarms } from "./alarms.js";
import { Connection } from "./connection.js";
import { closestApproach, isTooClose } from "./cpa.js";
import { History } from "./history.js";
import { bearing, MILE, moving } from "./navigation.js";
import { Snapshots } from "./snapshots.js";
import { Sound } from "./sound.js";
import { miles } from "./targets.js";

const keyOf = ({ id, time }) => `${id} ${time}`;
const MOST_TOUCHES = 500; // the latest ones, as live/session/touch_log.py keeps them
const JUST = 10; // a collision is news for so long [s]
const KEPT = 0.98; // of the rate that is set: a machine that does so much keeps up

export class Session {
  /** `role` is "bridge" or "instructor"; `hear(type, message)` is called after this object is up to date. */
  constructor(role, hear) {
    const query = new URLSearchParams(location.search);
    Object.assign(this, {
      role, hear, token: query.get("token") ?? "", wantedShip: query.get("ship"), hello: null, state: null, time: -Infinity, ended: null,
      snapshots: new Snapshots(), histories: {}, alarms: new Alarms(), sound: new Sound(), dangers: new Set(),
      limits: { cpa: 0.3 * MILE, tcpa: 360 }, contacts: [], known: new Set(), old: new Set(), unknownShip: null, isServed: true, touches: [],
    });
    this.connection = new Connection(role, this.token, (type, message) => this.listen(type, message));
    setInterval(() => this.sounds(), 250);
  }

  /** An address on the server, with the token. */
  address(path) {
    return `${path}?token=${encodeURIComponent(this.token)}`;
  }

  infoOf(name) {
    return this.hello.ships.find((ship) => ship.name === name);
  }

  listen(type, message) {
    if (type === "hello") this.greet(message);
    else if (type === "touches") this.touches = [...this.touches, ...message.touches].slice(-MOST_TOUCHES);
    else if (type === "state") this.take(message);
    else if (type === "event" && message.kind === "collision begins") this.meet({ ...message, time: message.start });
    else if (type === "event" && message.kind === "back") this.goBack(message.time);
    else if (type === "lost") this.lose();
    else if (type === "gone") Object.assign(this, { isServed: false });
    else if (type === "end") this.end(message);
    this.hear(type, message);
  }

  /** The connection is lost: what is known of the other ships gets older from now on. */
  lose() {
    for (const name of this.dangers) this.alarms.clear(`cpa ${name}`);
    this.dangers.clear();
    this.alarms.set("lost", true, "warning", () => say("alarm_lost"));
  }

  end(message) {
    Object.assign(this, { ended: message });
    this.alarms.clearAll();
    this.dangers.clear();
    this.connection.finish();
  }

  greet(hello) {
    this.alarms.clear("lost");
    this.hello = hello;
    this.touches = [...hello.touches];
    const isKnown = hello.ships.some(({ name }) => name === this.wantedShip);
    this.own ??= isKnown ? this.wantedShip : hello.own;
    this.unknownShip = isKnown ? null : this.wantedShip;
    this.snapshots = new Snapshots();
    for (const { name } of hello.ships) this.histories[name] ??= new History();
  }

  take(state) {
    const isFirst = this.state === null;
    const isBack = state.time < this.time; // unheard: while the connection was lost, perhaps
    if (isBack) this.goBack(state.time);
    if (isFirst || isBack) this.learn(state.contact.collisions);
    this.snapshots.push(state, performance.now());
    Object.assign(this, { state, time: state.time });
    if (!this.ended) this.watch(state);
  }

  /** Collisions that are no news, unless ships still touch; all others are. */
  learn(collisions) {
    this.old = new Set(collisions.map(keyOf));
    this.known = new Set(this.old);
  }

  /** The run has gone back to a time [s]: what was later has not happened. The next state may be later than the last one was. */
  goBack(time) {
    if (this.state === null) return;
    this.time = time;
    this.learn(this.state.contact.collisions.filter((collision) => collision.time <= time));
    this.alarms.clearAll();
    this.touches = this.touches.filter((touch) => touch.time <= time);
    this.snapshots = new Snapshots();
    for (const history of Object.values(this.histories)) history.goBack(time);
    this.hear("back", { time });
  }

  /** The state that is to be shown now; the tracks then end with it. */
  present(wall) {
    const state = this.snapshots.at(wall);
    if (state) for (const [name, ship] of Object.entries(state.ships)) this.histories[name]?.push(state.time, ship.eta, ship.nu);
    return state;
  }

  /** A collision begins: the server says so at once, and the next state has it. */
  meet(collision) {
    if (this.known.has(keyOf(collision))) return;
    this.known.add(keyOf(collision));
    this.alarms.set("contact", true, "alarm", () => say("alarm_contact", { a: collision.ship_a, b: collision.ship_b }));
    const contact = { ...collision, wall: null };
    this.contacts.push(contact);
    requestAnimationFrame(() => (contact.wall = Date.now()));
    this.sounds();
  }

  /** Raises the alarms of a state. */
  watch(state) {
    const { alarms } = this;
    const last = state.contact.collisions.at(-1);
    const isNews = last !== undefined && (state.contact.points > 0 || (!this.old.has(keyOf(last)) && state.time - last.time < JUST));
    for (const collision of state.contact.collisions) this.meet(collision);
    // A collision may have been told of before there is a state with it.
    if (last !== undefined) alarms.set("contact", isNews, "alarm", () => say("alarm_contact", { a: last.ship_a, b: last.ship_b }));
    alarms.set("slow", !state.paused && !state.paced && state.real_rate < KEPT * state.rate, "caution", () => say("alarm_slow", { rate: number(state.real_rate, 2) }));
    const failing = this.role === "bridge" ? [this.own] : [];
    for (const what of ["blackout", "rudder"]) {
      alarms.set(what, failing.some((name) => state.ships[name].failures.includes(what)), "alarm", () => say(`alarm_${what}`));
    }
    if (this.role !== "bridge") return;
    const own = moving(state.ships[this.own]);
    for (const name of Object.keys(state.ships)) {
      if (name === this.own) continue;
      const other = moving(state.ships[name]);
      const isDanger = isTooClose(own, other, this.limits);
      isDanger ? this.dangers.add(name) : this.dangers.delete(name);
      const { cpa, tcpa } = closestApproach(own, other);
      alarms.set(`cpa ${name}`, isDanger, "alarm", () => say("alarm_cpa", { ship: name, cpa: `${miles(cpa)} ${say("miles")}`, tcpa: clockTime(tcpa, 0) }), () => say("alarm_cpa_over", { ship: name }));
    }
  }

  acknowledge() {
    this.alarms.acknowledge();
    this.sounds();
  }

  sounds() {
    this.sound.alarm(this.alarms.sounding);
    if (!this.state || !this.hello) return;
    const { ships } = this.state;
    const here = ships[this.own];
    this.sound.blow(Object.keys(ships).filter((name) => ships[name].horn && this.connection.isOpen)
      .map((name) => ({ name, length: this.infoOf(name).L_oa, distance: here ? bearing(here, ships[name]).range : 0 })));
  }
}
