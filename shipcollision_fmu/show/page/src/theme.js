// Light and dark: as the system has it until somebody chooses; a choice is kept where the browser allows it.

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

export function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  for (const listener of listeners) listener();
}

export function toggleTheme() {
  setTheme(isDark() ? "light" : "dark");
  try {
    localStorage.setItem(KEY, document.documentElement.dataset.theme);
  } catch {
    // not kept, then
  }
}

export function startTheme(asked) {
  const system = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  setTheme(asked ?? stored() ?? system);
}

export const onTheme = (listener) => listeners.push(listener);

/** A ship's colour as a line on the panel: lighter in the dark. */
export function lineColour(colour) {
  if (!isDark()) return colour;
  const parts = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  return `rgb(${parts.map((part) => Math.round(part + (255 - part) * 0.38)).join(" ")})`;
}
