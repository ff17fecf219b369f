// Light and dark: as the system has it, and dark while the picture is a night, until somebody chooses; a choice is kept
// where the browser allows it.

const KEY = "shipcollision-theme";
const listeners = [];

function stored() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null; // a page from a file: or in a frame may have no storage
  }
}

export const isDark = () => document.documentElement.dataset.theme === "dark";

let chosen = null; // by the address or the user
let isNight = false;

function show() {
  const system = isNight || matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  document.documentElement.dataset.theme = chosen ?? system;
  for (const listener of listeners) listener();
}

export function toggleTheme() {
  chosen = isDark() ? "light" : "dark";
  show();
  try {
    localStorage.setItem(KEY, chosen);
  } catch {
    // not kept, then
  }
}

export function startTheme(asked) {
  chosen = asked ?? stored();
  show();
}

/** The picture is one of the night, or no longer: white cards beside it would blind. */
export function followSky(isOfNight) {
  if (isNight === isOfNight) return;
  isNight = isOfNight;
  show();
}

export const onTheme = (listener) => listeners.push(listener);

/** A ship's colour as a line on the panel: lighter in the dark. */
export function lineColour(colour) {
  if (!isDark()) return colour;
  const parts = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  return `rgb(${parts.map((part) => Math.round(part + (255 - part) * 0.38)).join(" ")})`;
}
