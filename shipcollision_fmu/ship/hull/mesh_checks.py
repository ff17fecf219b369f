"""Whether a mesh lies in b as a ship does: size, axes and place are refused when wrong, and warned of when suspicious.

refused   length and breadth, the middle, and the keel farther from those of [particulars] than any ship's
warned    the middle or the keel farther than most ships'; a fuller end forward; a fuller plan below than above
"""

from __future__ import annotations

from itertools import permutations

import numpy as np

from ...errors import ShipError
from ..frames import Array
from .convex import Indices
from .file_frame import UNIT_NAMES, UNITS, FileFrame

__all__ = ["check_axes", "check_place", "check_size", "list_suspicions"]

SIZE_TOLERANCE = 0.25
"""Relative difference allowed between the mesh's length and breadth and those of [particulars]: bulb, rudder."""
MIDSHIP_TOLERANCE, CENTRELINE_TOLERANCE, KEEL_TOLERANCE = 0.1, 0.05, 0.25
"""Distance allowed between the mesh's middle and CO, over L_oa (bulb) and B, and between its keel and T, over the depth
(rudder, sonar dome)."""
USUAL_MIDSHIP, USUAL_CENTRELINE, USUAL_KEEL = 0.03, 0.01, 0.05
"""As above, for most ships: more is warned of."""
END = 0.1
"""Length of an end of the ship, over that of the mesh, whose areas in plan are compared."""
FULLER_END = 1.2
"""Area of the fore end in plan over that of the after end from which `forward` is taken to point to the transom. The
fore end of ships with a transom or a cruiser stern is the smaller one; those of double-ended craft are equal."""
NEAR_KEEL, NEAR_DECK = 0.02, 0.98
"""Heights above the lowest point, over the depth, of the plans by which a hull that is upside down is told."""
FULLER_KEEL = 1.05
"""Area of the plan near the keel over that near the deck from which a hull is taken to be upside down."""
SAME_BREADTH = 0.05
"""Relative difference of the breadths up to which both ends count as equally broad."""
STATIONS = 20
"""Sections of an end."""


def check_size(name: str, placed: Array, L_oa: float, frame: FileFrame) -> None:
    """Refuse a mesh whose longest extent is not L_oa, and name the unit that would do."""
    longest = float(np.ptp(placed, axis=0).max())
    if _is_alike(longest, L_oa):
        return
    said = frame.describe_unit()
    in_file = longest / frame.metres
    unit = next((u for u, metres in UNITS.items() if _is_alike(in_file * metres, L_oa)), None)
    remedy = f'looks like {UNIT_NAMES[unit]}: set unit = "{unit}"' if unit else "set unit or scale, or correct L_oa"
    raise ShipError(f"{name}: is {longest:.6g} m long with {said}, and L_oa = {L_oa:.6g} m: {remedy}")


def check_axes(name: str, placed: Array, L_oa: float, B: float, frame: FileFrame) -> None:
    """Refuse a mesh unless length lies forward and breadth across; else the axes are named that would do."""
    x, y, z = np.ptp(placed, axis=0).tolist()
    if _is_alike(x, L_oa) and _is_alike(y, B):
        return
    extent = dict(zip("xyz", np.ptp(placed @ frame.axes, axis=0).tolist(), strict=True))
    sizes = ", ".join(f"{axis} {size:.6g} m" for axis, size in extent.items())
    for forward, across, up in permutations("xyz"):
        if (
            _is_alike(extent[forward], L_oa)
            and _is_alike(extent[across], B)
            and (forward, up) != (frame.forward[1], frame.up[1])
        ):
            raise ShipError(
                f'{name}: extents along the file\'s axes are {sizes}; with forward = "{frame.forward}" and up = '
                f'"{frame.up}" it is {x:.6g} m long and {y:.6g} m broad, not L_oa = {L_oa:.6g} and B = {B:.6g} m: set '
                f'forward = "+{forward}" or "-{forward}" and up = "+{up}" or "-{up}"'
            )
    if (
        _is_alike(x, L_oa)
        and _is_alike(2.0 * y, B)
        and min(abs(placed[:, 1].min()), abs(placed[:, 1].max())) < 0.02 * B
    ):
        raise ShipError(
            f"{name}: is {y:.6g} m broad on one side of the centreline, and B = {B:.6g} m: looks like half a hull; "
            "mirror it in the program that made the file"
        )
    raise ShipError(
        f"{name}: is {x:.6g} m long, {y:.6g} m broad and {z:.6g} m high, and L_oa = {L_oa:.6g} m, B = {B:.6g} m: at "
        f"most {SIZE_TOLERANCE:.0%} apart; correct the mesh or [particulars]"
    )


def _is_alike(size: float, expected: float) -> bool:
    return bool(1.0 / (1.0 + SIZE_TOLERANCE) <= size / expected <= 1.0 + SIZE_TOLERANCE)


def check_place(name: str, placed: Array, L_oa: float, B: float, T: float, depth: float) -> None:
    """Refuse a mesh unless CO lies amidships on the centreline, and the keel at the draught T below it."""
    low, high = placed.min(axis=0), placed.max(axis=0)
    middle = 0.5 * (low + high)
    remedy = "set origin to midship, centreline and waterline in the file's coordinates"
    for what, value, most in (
        ("forward of", middle[0], MIDSHIP_TOLERANCE * L_oa), ("to starboard of", middle[1], CENTRELINE_TOLERANCE * B),
    ):  # fmt: skip
        if abs(value) > most:
            raise ShipError(f"{name}: its middle lies {value:.6g} m {what} CO, at most {most:.6g} m: {remedy}")
    if abs(high[2] - T) > KEEL_TOLERANCE * depth:
        raise ShipError(
            f"{name}: its lowest point lies {high[2]:.6g} m below CO, and the draught is T = {T:.6g} m: {remedy} (or "
            "up is wrong)"
        )


# -- suspicions -------------------------------------------------------------------------------------


def list_suspicions(placed: Array, triangles: Indices, T: float, depth: float, frame: FileFrame) -> list[str]:
    """What is unusual about a closed mesh that lies in b [m], each with its remedy."""
    return [
        *_doubt_place(placed, T, depth, frame),
        *_doubt_forward(placed, triangles, frame),
        *_doubt_up(placed, triangles, depth, frame),
    ]


def _doubt_place(placed: Array, T: float, depth: float, frame: FileFrame) -> list[str]:
    low, high = placed.min(axis=0), placed.max(axis=0)
    middle = 0.5 * (low + high)
    length, breadth = (high - low)[:2]
    off = np.array([middle[0], middle[1], high[2] - T])
    most = np.array([USUAL_MIDSHIP * length, USUAL_CENTRELINE * breadth, USUAL_KEEL * depth])
    if not (np.abs(off) > most).any():
        return []
    x, y, z = off.tolist()
    origin = ", ".join(f"{v:.6g}" for v in frame.to_file(np.where(np.abs(off) > most, off, 0.0)).tolist())
    return [
        f"its middle lies {x:.3g} m forward and {y:.3g} m to starboard of CO, and its keel {z:.3g} m below the draught "
        f"T: unless the ship is built so, set origin = [{origin}]"
    ]


def _doubt_forward(placed: Array, triangles: Indices, frame: FileFrame) -> list[str]:
    """The bow is the end that is finer in plan and has the smaller sections; where both are as broad, the latter."""
    low, high = float(placed[:, 0].min()), float(placed[:, 0].max())
    at = ((np.arange(STATIONS) + 0.5) / STATIONS * END * (high - low)).tolist()
    fore, aft = (
        np.mean([_measure_section(placed, triangles, 0, end + side * x) for x in at], axis=0).tolist()
        for end, side in ((high, -1.0), (low, 1.0))
    )
    which = 0 if abs(fore[0] / aft[0] - 1.0) > SAME_BREADTH else 1
    if fore[which] <= FULLER_END * aft[which] or fore[1] <= aft[1]:
        return []
    other = f"{'-' if frame.forward[0] == '+' else '+'}{frame.forward[1]}"
    what = ("m broad", "m2 in section")[which]
    return [
        f'forward = "{frame.forward}" points to its fuller end ({fore[which]:.3g} {what} over the last tenth of the '
        f"length, the other {aft[which]:.3g}), as if it sailed with the transom first: unless it does, set forward = "
        f'"{other}"'
    ]


def _doubt_up(placed: Array, triangles: Indices, depth: float, frame: FileFrame) -> list[str]:
    """A ship's plan grows from the keel to the waterline, and at the deck it is not smaller than at the keel."""
    lowest = float(placed[:, 2].max())
    keel, middle, deck = (
        _measure_section(placed, triangles, 2, lowest - part * depth)[1] for part in (NEAR_KEEL, 0.5, NEAR_DECK)
    )
    if keel <= FULLER_KEEL * deck or keel < 0.999 * middle:
        return []
    other = f"{'-' if frame.up[0] == '+' else '+'}{frame.up[1]}"
    return [
        f'up = "{frame.up}" points to its keel: its plan near the lowest point ({keel:.4g} m2) is larger than near the '
        f'deck ({deck:.4g} m2); unless it is built so, set up = "{other}"'
    ]


def _measure_section(placed: Array, triangles: Indices, axis: int, value: float) -> tuple[float, float]:
    """Breadth [m] and area [m2] of the section at this value of x (0) or z (2).

    Each triangle crosses the plane in a segment. The area follows from these by Green's theorem.
    """
    corners = placed[triangles]
    above = corners[:, :, axis] > value
    crossing = above.any(axis=1) & ~above.all(axis=1)
    if not crossing.any():
        return 0.0, 0.0
    corners, above = corners[crossing], above[crossing]
    lone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    row = np.arange(len(lone))
    a, b, c = (corners[row, (lone + k) % 3] for k in range(3))
    p, q = (a + ((value - a[:, axis]) / (w[:, axis] - a[:, axis]))[:, None] * (w - a) for w in (b, c))
    turn = np.where(above[row, lone], 1.0, -1.0)
    i, j = (k for k in range(3) if k != axis)
    area = 0.5 * abs(float((turn * (p[:, i] * q[:, j] - q[:, i] * p[:, j])).sum()))
    return float(np.ptp(np.concatenate([p[:, 1], q[:, 1]]))), area
