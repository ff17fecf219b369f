// Names over the ships, beside each other where they would overlap, and clear of what covers the picture.
import * as THREE from "three";
import { element } from "./dom.js";
import { moveApart } from "./move_apart.js";

const HOUSE = 34; // height of house and mast above the deck [m], at most
const ALONG = Array.from({ length: 11 }, (_, i) => 0.1 * i - 0.5); // of a ship's length, from midship
const FAR_OUT = 1.6; // of half the picture's height: what is farther above or below is not named

export function makeLabels(ships, canvas) {
  const labels = ships.map(({ info }) => {
    const dot = element("i");
    dot.style.background = info.colour;
    return element("span", { class: "label", hidden: true }, dot, info.name);
  });
  const node = element("div", { class: "labels", "aria-hidden": "true" }, ...labels);
  const point = new THREE.Vector3();
  const sizes = new Map(); // of labels [px], once they have been shown

  /** Where a ship's name belongs, [x, y] of the middle of its lower edge [px]: over what is in the picture; null if it is not to be seen. */
  function placeOf({ node: ship, info }, camera, width, height) {
    const { x, y } = ship.worldToLocal(point.copy(camera.position));
    if (Math.abs(x) < 0.5 * info.L_oa && Math.abs(y) < 0.5 * info.B) return null; // those aboard know it
    const top = info.height + Math.min(HOUSE, 0.4 * info.L_oa);
    const seen = ALONG.map((share) => ship.localToWorld(point.set(share * info.L_oa, 0, -top)).project(camera).toArray())
      .filter(([across, , depth]) => Math.abs(depth) < 1 && Math.abs(across) < 1);
    if (!seen.length || seen.every(([, up]) => Math.abs(up) > FAR_OUT)) return null;
    const xs = seen.map(([across]) => across);
    return [((Math.min(...xs) + Math.max(...xs) + 2) / 4) * width, ((1 - Math.max(...seen.map(([, up]) => up))) / 2) * height - 4];
  }

  return {
    node,
    /** `free`: the part of the picture that nothing covers, {left, top, right, bottom} [px], or null. */
    update(camera, free) {
      const { clientWidth: width, clientHeight: height } = canvas;
      const room = free ?? { left: 0, top: 0, right: width, bottom: height };
      const shown = [];
      ships.forEach((ship, i) => {
        const place = placeOf(ship, camera, width, height);
        labels[i].hidden = !place;
        if (!place) return;
        if (!sizes.has(i)) sizes.set(i, [labels[i].offsetWidth, labels[i].offsetHeight]);
        shown.push({ label: labels[i], place, size: sizes.get(i) });
      });
      const places = moveApart(shown, room);
      shown.forEach(({ label }, i) => (label.style.transform = `translate(-50%, -100%) translate(${places[i].map((x) => `${x.toFixed(1)}px`).join()})`));
    },
  };
}
