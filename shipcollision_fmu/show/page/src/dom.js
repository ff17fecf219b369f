// Elements are made here and nowhere from markup, so that a name is only ever text.

/** An element with attributes (or `on...` listeners, `class`, `text`) and children. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "text") made.textContent = value;
    else if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value !== undefined && value !== false) made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children);
  return made;
}

/** Opens a dialog, or closes it. Its button at the end has the focus, and it begins at its beginning all the same. */
export function toggleDialog(dialog) {
  if (dialog.open) return dialog.close();
  dialog.showModal();
  dialog.scrollTop = 0;
}

const SVG = "http://www.w3.org/2000/svg";

/** An icon of 20 x 20 drawn by one path. */
export function icon(path) {
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", "0 0 20 20");
  svg.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(SVG, "path");
  line.setAttribute("d", path);
  svg.append(line);
  return svg;
}
