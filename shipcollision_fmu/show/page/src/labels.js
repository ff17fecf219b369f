// Names over ships that are too small in the picture to be told apart by their colours.
import * as THREE from "three";
import { element } from "./dom.js";

const HOUSE = 34; // height of house and mast above the deck [m], at most
const SMALL = 0.16; // of the picture's width: a ship that is longer needs no name

export function makeLabels(ships, canvas) {
  const labels = ships.map(({ info }) => {
    const dot = element("i");
    dot.style.background = info.colour;
    return element("span", { class: "label", hidden: true }, dot, info.name);
  });
  const node = element("div", { class: "labels", "aria-hidden": "true" }, ...labels);
  const ends = [new THREE.Vector3(), new THREE.Vector3()];
  return {
    node,
    update(camera) {
      const { clientWidth: width, clientHeight: height } = canvas;
      ships.forEach(({ node: ship, info }, i) => {
        const top = info.height + Math.min(HOUSE, 0.4 * info.L_oa);
        ends.forEach((end, k) => ship.localToWorld(end.set((k - 0.5) * info.L_oa, 0, -top)).project(camera));
        const [a, b] = ends;
        const middle = [(a.x + b.x) / 2, (a.y + b.y) / 2];
        const length = Math.hypot(((a.x - b.x) * width) / 2, ((a.y - b.y) * height) / 2);
        const isShown = length < SMALL * width && a.z < 1 && b.z < 1 && Math.abs(middle[0]) < 1 && Math.abs(middle[1]) < 1;
        labels[i].hidden = !isShown;
        if (!isShown) return;
        const x = ((middle[0] + 1) / 2) * width;
        const y = ((1 - Math.max(a.y, b.y)) / 2) * height - 4;
        labels[i].style.transform = `translate(-50%, -100%) translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      });
    },
  };
}
