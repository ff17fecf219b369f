// The part of the picture that nothing covers: what is looked at belongs there. It is measured from the elements that
// stand over the picture, so it holds in any window, on a phone, and where cards and bars are away.

const MARGIN = 8; // [px] around what covers the picture
const APART = ".labels, .notice, .sr-only"; // over the picture, but for a moment or see-through

/** The largest rectangle of a picture that no cover touches; all are {left, top, right, bottom} [px] from its top left. */
export function findFreeRectangle(width, height, covers) {
  const edges = (near, far, size) => [...new Set([0, size, ...covers.flatMap((cover) => [cover[near], cover[far]])])]
    .filter((edge) => edge >= 0 && edge <= size).sort((a, b) => a - b);
  const [xs, ys] = [edges("left", "right", width), edges("top", "bottom", height)];
  let best = { left: 0, top: 0, right: width, bottom: height }, largest = 0;
  for (const left of xs) for (const right of xs) for (const top of ys) for (const bottom of ys) {
    const area = (right - left) * (bottom - top);
    if (right <= left || bottom <= top || area <= largest) continue;
    if (covers.some((c) => c.left < right && c.right > left && c.top < bottom && c.bottom > top)) continue;
    largest = area;
    best = { left, top, right, bottom };
  }
  return best;
}

/** The free part of a canvas [px] as it lies on the page now. */
export function measureFreeRectangle(canvas) {
  const at = canvas.getBoundingClientRect();
  const covers = [...canvas.parentElement.children].filter((node) => node !== canvas && !node.matches(APART)).map((node) => node.getBoundingClientRect());
  return findFreeRectangle(at.width, at.height, covers.filter(({ width, height }) => width && height).map((cover) => ({
    left: cover.left - at.left - MARGIN, top: cover.top - at.top - MARGIN, right: cover.right - at.left + MARGIN, bottom: cover.bottom - at.top + MARGIN,
  })));
}
