// The instruments of a ship: heading, rate of turn, speeds, shaft and rudder, as numbers.
import { element } from "../dom.js";
import { number } from "../format.js";
import { inWords, say } from "../texts.js";
import { rudderShort, threeDigits } from "./conning.js";
import { instruments, KNOT, toDegrees } from "./navigation.js";

const TILES = ["heading_short", "rot", "sog", "cog", "log", "rpm", "rudder"];
const UNITS = { heading_short: "°", rot: "per_minute", sog: "knots", cog: "°", log: "knots", rpm: "rpm_unit", rudder: "°" };

/** A heading [deg] with one decimal, 000.0 to 359.9. */
export function compassText(degrees) {
  const tenths = (Math.round(degrees * 10) % 3600 + 3600) % 3600;
  return (tenths / 10).toFixed(1).padStart(5, "0");
}

export function makeInstruments() {
  const tiles = Object.fromEntries(TILES.map((key) => {
    const value = element("span", { class: "value", id: `show-${key}` }); // no <output>: it would be read out again and again
    const small = element("small", {});
    const unit = element("span", { class: "unit" });
    if (UNITS[key] === "°") unit.textContent = "°";
    else inWords(unit, { text: UNITS[key] });
    const node = element("div", { class: `tile ${key}` }, inWords(element("h3", {}), { text: key }), element("p", {}, value, unit), small);
    if (key === "log") inWords(node, { title: "through_water" });
    return [key, { value, small, node }];
  }));
  const node = inWords(element("section", { class: "instruments" }, ...TILES.map((key) => tiles[key].node)), { "aria-label": "instruments" });
  return {
    node,
    show(ship, current) {
      const { heading, rot, sog, cog, log } = instruments(ship, current);
      const perMinute = toDegrees(rot) * 60;
      const set = (key, text, small = "") => {
        if (tiles[key].value.textContent !== text) tiles[key].value.textContent = text;
        if (tiles[key].small.textContent !== small) tiles[key].small.textContent = small;
      };
      set("heading_short", compassText(toDegrees(heading)), ship.heading_order === null ? "" : `${say("autopilot_short")} ${threeDigits(toDegrees(ship.heading_order))}°`);
      set("rot", number(Math.abs(perMinute), 1), Math.abs(perMinute) < 0.05 ? "" : perMinute < 0 ? "\u25c0" : "\u25b6");
      set("sog", number(sog / KNOT, 1), `${number(sog, 1)} m/s`);
      set("cog", cog === null ? "\u2013" : compassText(toDegrees(cog)));
      set("log", number(log / KNOT, 1));
      set("rpm", number(ship.rev_per_s * 60, 0), `\u2192 ${number(ship.rev_order * 60, 0)}`);
      set("rudder", rudderShort(toDegrees(ship.rudder)).replace("°", ""), `\u2192 ${rudderShort(toDegrees(ship.rudder_order))}`);
      tiles.rudder.node.dataset.side = toDegrees(ship.rudder) < -0.5 ? "port" : toDegrees(ship.rudder) > 0.5 ? "starboard" : "";
    },
  };
}
