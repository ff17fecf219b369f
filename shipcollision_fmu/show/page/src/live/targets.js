// The other ships, as a radar's table has them: bearing, range, CPA, TCPA, course and speed.
import { element } from "../dom.js";
import { clockTime, number } from "../format.js";
import { inWords, TEXTS } from "../texts.js";
import { closestApproach } from "./cpa.js";
import { bearing, instruments, KNOT, MILE, moving, toDegrees } from "./navigation.js";
import { threeDigits } from "./conning.js";

const COLUMNS = ["target", "bearing", "range", null, null, "cog", "sog"];
const HEADS = { 3: "CPA", 4: "TCPA" };
const UNITS = { 1: "°", 2: "miles", 3: "miles", 4: "min:s", 5: "°", 6: "knots" };

export function makeTargets() {
  const body = element("tbody", {});
  const none = inWords(element("p", { class: "none" }), { text: "no_targets" });
  const head = COLUMNS.map((key, i) => {
    const name = element("span", { text: HEADS[i] ?? "" });
    const unit = element("small", { text: UNITS[i] ?? "" });
    if (key) inWords(name, { text: key });
    if (UNITS[i] in TEXTS) inWords(unit, { text: UNITS[i] });
    return element("th", { scope: "col", class: i ? "number" : "" }, name, unit);
  });
  const table = element("table", {}, element("thead", {}, element("tr", {}, ...head)), body);
  const node = element("section", { class: "targets" }, inWords(element("h2", {}), { text: "targets" }), table, none);
  const rows = new Map();
  return {
    node,
    show(state, own, dangers) {
      const names = Object.keys(state.ships).filter((name) => name !== own);
      none.hidden = names.length > 0;
      table.hidden = names.length === 0;
      for (const name of names) {
        if (!rows.has(name)) {
          const cells = COLUMNS.map((_, i) => element("td", { class: i ? "number" : "" }));
          rows.set(name, { cells, row: element("tr", { "data-ship": name }, ...cells) });
          body.append(rows.get(name).row);
        }
        const { cells, row } = rows.get(name);
        const [mine, ship] = [state.ships[own], state.ships[name]];
        const seen = bearing(mine, ship);
        const { cpa, tcpa } = closestApproach(moving(mine), moving(ship));
        const { cog, sog } = instruments(ship);
        const texts = [
          name, threeDigits(toDegrees(seen.bearing)), miles(seen.range), miles(cpa), clockTime(tcpa, 0),
          cog === null ? "\u2013" : threeDigits(toDegrees(cog)), number(sog / KNOT, 1),
        ];
        texts.forEach((text, i) => cells[i].textContent !== text && (cells[i].textContent = text));
        row.classList.toggle("danger", dangers.has(name));
      }
    },
  };
}

/** A distance [m] in nautical miles, with as many digits as a radar shows. */
export const miles = (metres) => number(metres / MILE, metres < MILE ? 3 : 2);
