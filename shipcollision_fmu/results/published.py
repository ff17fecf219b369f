"""Computed states beside published ones, in the frame and symbols of Guan et al. 2014.

    x, y, z         east, north, up of the ship's centre of gravity [m]
    h, p, r         z, x and y of the attitude's quaternion [1], of a ship whose body axes are starboard, forward, up
    v_x, v_y, v_z   velocity of the centre of gravity [m/s]
    w_x, w_y, w_z   angular velocity [rad/s]

The frame is Bullet's world w (ship/frames.py); the centre of gravity is the origin of Bullet's bodies:

    x_g = x + R_nb r_bg          v_g = R_nb (v + omega x r_bg)

The published time is seldom a communication point, so states are interpolated linearly between two rows.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from ..fmi.names import STATE
from ..scenario.tables.reference import Quantity, Reference
from ..ship.frames import Array, quaternion_w, swap_axes
from ..ship.ship import Ship
from ..ship.ship_state import ShipState

__all__ = ["compare_published", "interpolate_state", "paper_quantities"]

_KINDS = {
    **dict.fromkeys(("x", "y"), ("m", "horizontal")), "z": ("m", "vertical"),
    **dict.fromkeys(("h", "p", "r"), ("1", "quaternion")),
    **dict.fromkeys(("v_x", "v_y", "v_z"), ("m/s", "velocity")),
    **dict.fromkeys(("w_x", "w_y", "w_z"), ("rad/s", "rate")),
}  # fmt: skip
"""Unit, and field of Tolerance, of each quantity."""


def compare_published(
    reference: Reference, states: npt.NDArray[Any], ships: Mapping[str, Ship]
) -> list[dict[str, Any]]:
    """A row for each published number.

    Keys: ship, quantity, unit, printed, paper (as corrected), computed, difference, tolerance, within (the tolerance).
    """
    rows = []
    for name, published in reference.ships.items():
        computed = paper_quantities(interpolate_state(states, name, reference.time), ships[name].r_bg)
        for quantity, printed in published.printed.items():
            paper = published.corrected.get(quantity, printed)
            difference = computed[quantity] - paper
            unit, group = _KINDS[quantity]
            tolerance = float(getattr(published.tolerance, group))
            rows.append({
                "ship": name,
                "quantity": quantity,
                "unit": unit,
                "printed": float(printed),
                "paper": float(paper),
                "computed": computed[quantity],
                "difference": difference,
                "tolerance": tolerance,
                "within": abs(difference) <= tolerance,
            })  # fmt: skip
    return rows


def interpolate_state(states: npt.NDArray[Any], name: str, time: float) -> ShipState:
    """State of a ship at a time [s], interpolated linearly between communication points."""
    return ShipState(*(float(np.interp(time, states["time"], states[f"{name}.{variable}"])) for variable in STATE))


def paper_quantities(state: ShipState, r_bg: Array) -> dict[Quantity, float]:
    """The paper's twelve quantities of a ship's state about CO."""
    R_nb = state.R_nb
    x, y, z = swap_axes(np.array(state.position) + R_nb @ r_bg)
    p, r, h, _ = quaternion_w(R_nb)
    v_x, v_y, v_z = swap_axes(state.velocity_at(r_bg))
    w_x, w_y, w_z = swap_axes(R_nb @ np.array(state.rate))
    values: dict[Quantity, float] = {
        "x": x, "y": y, "z": z, "h": h, "p": p, "r": r,
        "v_x": v_x, "v_y": v_y, "v_z": v_z, "w_x": w_x, "w_y": w_y, "w_z": w_z,
    }  # fmt: skip
    return {quantity: float(value) for quantity, value in values.items()}
