"""Instruments of the live page against the frames of the library, and a turn that is done in small steps."""

from __future__ import annotations

from math import degrees, pi
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.ship.frames import rotation

from .javascript import run_javascript

CURRENT = [0.7, -0.4]


def read_instruments(ships: list[dict[str, list[float]]]) -> list[Any]:
    found: list[Any] = run_javascript(
        "live/navigation.js", "instruments, velocityOverGround",
        "return data.ships.map((s) => ({ ...instruments(s, data.current), over: velocityOverGround(s) }));",
        {"ships": ships, "current": CURRENT},
    )  # fmt: skip
    return found


def turn_rate(eta: np.ndarray[Any, Any], nu: np.ndarray[Any, Any]) -> float:
    """Rate of the yaw angle [rad/s], by turning the ship for a microsecond."""
    p, q, r = nu[3:] * 1e-6
    R = rotation(eta[3:]) @ (np.eye(3) + np.array([[0.0, -r, q], [r, 0.0, -p], [-q, p, 0.0]]))
    return float((np.arctan2(R[1, 0], R[0, 0]) - eta[5] + pi) % (2.0 * pi) - pi) / 1e-6


def test_speeds_and_turn_are_those_of_the_frames() -> None:
    rng = np.random.default_rng(7)
    eta = rng.uniform(-1.0, 1.0, (50, 6)) * [1e3, 1e3, 2.0, 0.5, 0.2, 10.0]
    nu = rng.uniform(-1.0, 1.0, (50, 6)) * [9.0, 3.0, 1.0, 0.1, 0.05, 0.05]
    found = read_instruments([{"eta": e.tolist(), "nu": n.tolist()} for e, n in zip(eta, nu, strict=True)])
    for e, n, one in zip(eta, nu, found, strict=True):
        over = rotation(e[3:]) @ n[:3]
        assert one["over"] == pytest.approx(over.tolist(), abs=1e-12)
        assert one["sog"] == pytest.approx(float(np.hypot(*over[:2])))
        assert one["cog"] == pytest.approx(float(np.arctan2(over[1], over[0])) % (2.0 * pi))
        assert one["heading"] == pytest.approx(e[5] % (2.0 * pi))
        assert one["rot"] == pytest.approx(turn_rate(e, n), rel=1e-4, abs=1e-8)


def test_the_log_counts_from_the_water() -> None:
    """Heading east at 5 m/s over ground, in a current of 0.4 m/s to the west: 5.4 through the water.
    At rest there is no course over ground."""
    east = {"eta": [0.0, 0.0, 0.0, 0.0, 0.0, 2.5 * pi], "nu": [5.0, 0.0, 0.0, 0.0, 0.0, 0.0]}
    still = {"eta": [0.0] * 6, "nu": [0.0] * 6}
    moving, resting = read_instruments([east, still])
    assert moving["log"] == pytest.approx(5.4)
    assert degrees(moving["heading"]) == pytest.approx(90.0)
    assert resting["cog"] is None
    assert resting["log"] == pytest.approx(-0.7)
