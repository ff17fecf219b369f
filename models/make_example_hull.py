"""Writes models/hulls/example.obj, the hull of the ship `mesh_example`: 120 m long, with a bulbous bow and flare.

    python3 models/make_example_hull.py > models/hulls/example.obj

A stack of waterlines in the manner of many naval architects' programs: millimetres, x forward from the aft
perpendicular, y to port, z up from the keel.
"""

from __future__ import annotations

import sys

LENGTH, BREADTH, DRAUGHT, DEPTH = 120.0, 20.0, 7.0, 12.0
BOW, STERN, BULB, FLARE = 28.0, 30.0, 4.0, 4.0
HEIGHTS = (0.0, 0.6, 1.4, 2.4, 3.6, 4.6, 5.4, 6.2, 7.0, 9.5, 12.0)
BOW_POINTS, STERN_POINTS = 9, 5


def waterline(z: float) -> list[tuple[float, float, float]]:
    """Corners [m] at the height z above the keel, counter-clockwise seen from above: stem, port side, transom."""
    above = max(z - DRAUGHT, 0.0) / (DEPTH - DRAUGHT)
    bulb = BULB * max(0.0, 1.0 - ((z - 2.4) / 3.0) ** 2)
    bow = BOW - FLARE * (1.0 - above) + bulb
    full = 2.0 + above  # the exponent of the waterline: fuller towards the deck, which is flare
    half = BREADTH / 2 - 1.0 * max(0.0, 1.0 - z / 1.4)  # bilge
    port = []
    for k in range(BOW_POINTS):  # from the stem aft
        s = 1.0 - k / BOW_POINTS
        port.append((LENGTH - BOW + bow * s, half * (1.0 - s**full), z))
    for k in range(STERN_POINTS + 1):
        s = k / STERN_POINTS
        port.append((STERN * (1.0 - s), half * (1.0 - 0.4 * s**2), z))
    return port + [(x, -y, z) for x, y, z in reversed(port[1:])]


def obj() -> str:
    """The text of the file."""
    rings = [waterline(z) for z in HEIGHTS]
    n = len(rings[0])
    lines = ["# Made by models/make_example_hull.py. Millimetres; x forward, y to port, z up.", "o hull"]
    lines += [f"v {1000 * x:.1f} {1000 * y:.1f} {1000 * z:.1f}" for ring in rings for x, y, z in ring]
    lines.append("f " + " ".join(str(i) for i in range(n, 0, -1)))  # the bottom, looking down
    lines.append("f " + " ".join(str((len(rings) - 1) * n + i) for i in range(1, n + 1)))  # the deck, looking up
    for level in range(len(rings) - 1):
        for i in range(n):
            a, b = level * n + i + 1, level * n + (i + 1) % n + 1
            lines += [f"f {a} {b} {b + n}", f"f {a} {b + n} {a + n}"]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.stdout.write(obj())
