// Labels that do not overlap.

const GAP = 6; // [px]

/**
 * Places [x, y] of the middle of the lower edge of labels, [{place, size: [width, height]}], within a room {left, top,
 * right, bottom}: where they belong, else as near beside each other as they can be, in the order from left to right.
 */
export function moveApart(labels, room) {
  const within = (x, [width]) => Math.min(room.right - width / 2, Math.max(room.left + width / 2, x));
  const places = labels.map(({ place: [x, y], size }) => [within(x, size), Math.min(room.bottom, Math.max(room.top + size[1], y))]);
  const order = labels.map((_, i) => i).sort((a, b) => places[a][0] - places[b][0] || a - b);
  for (let round = 0; round < labels.length; round++) {
    for (let k = 1; k < order.length; k++) {
      const [a, b] = [order[k - 1], order[k]];
      const wide = (labels[a].size[0] + labels[b].size[0]) / 2 + GAP, high = Math.max(labels[a].size[1], labels[b].size[1]);
      const missing = wide - (places[b][0] - places[a][0]);
      if (missing <= 0 || Math.abs(places[a][1] - places[b][1]) >= high) continue;
      const left = within(places[a][0] - missing / 2, labels[a].size);
      const right = within(left + wide, labels[b].size);
      places[a][0] = right - wide; // where the room ends, the other one moves the whole way
      places[b][0] = right;
    }
  }
  return places;
}
