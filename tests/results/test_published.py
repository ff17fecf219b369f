"""Guan et al. 2014: their frame and symbols."""

from __future__ import annotations

from math import asin, degrees, sqrt

import numpy as np
import pytest

from shipcollision_fmu.results.published import compare_published, interpolate_state, paper_quantities
from shipcollision_fmu.scenario.tables.reference import Reference
from shipcollision_fmu.scenario.tables.ship_start import ShipStart
from shipcollision_fmu.ship.frames import rotation
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.ship_state import ShipState

ORIGIN = np.zeros(3)


def test_their_world_is_east_north_up() -> None:
    """A ship at (1, 2, 3) in n, heading 0: x = east, y = north, z = up; forward is +y, starboard +x."""
    got = paper_quantities(ShipState(1.0, 2, 3, 0, 0, 0, 4, 5, 6, 0.1, 0.2, 0.3), ORIGIN)
    assert [got[q] for q in ("x", "y", "z")] == [2.0, 1.0, -3.0]
    assert [got[q] for q in ("v_x", "v_y", "v_z")] == [5.0, 4.0, -6.0]
    assert [got[q] for q in ("w_x", "w_y", "w_z")] == [0.2, 0.1, -0.3]
    assert [got[q] for q in ("h", "p", "r")] == [0.0, 0.0, 0.0]


def test_heading_of_the_published_own_ship() -> None:
    """Table 2, own ship before: h = 0.2908, running straight ahead at (-2.8282, 4.2215) m/s.

    2 asin(h) = 33.81 deg counter-clockwise from +y is heading -33.81 deg, and that is where the velocity points.
    """
    heading = -2 * asin(0.2908)
    got = paper_quantities(ShipState.upright(0.0, 0.0, heading, 5.0813), ORIGIN)
    assert got["h"] == pytest.approx(0.2908, abs=1e-12)
    assert degrees(-heading) == pytest.approx(33.812, abs=1e-3)
    assert got["v_x"] == pytest.approx(-2.8282, abs=1e-3)
    assert got["v_y"] == pytest.approx(4.2215, abs=1e-3)


@pytest.mark.parametrize(
    ("h", "p", "r", "v"),
    [(0.2908, -0.0073, 0.0014, (-2.8282, 4.2215, 0.0)), (-0.0872, 0.0034, 0.0048, (0.4467, 2.5331, 0.0))],
)
def test_the_published_row_before_can_be_written_as_a_scenario(
    h: float, p: float, r: float, v: tuple[float, float, float]
) -> None:
    """quaternion = [r, p, -h, w], n from b; position and velocity_ned by the swap of axes. Row r as corrected."""
    w = sqrt(1 - h * h - p * p - r * r)
    ship = ShipStart(
        ship="x", position=[81.6614, -343.212], quaternion=[r, p, -h, w], velocity_ned=[v[1], v[0], -v[2]],
        angular_velocity_ned=[-0.0013, -0.0009, 0.0],
    )  # fmt: skip
    start = ship.start
    got = paper_quantities(ShipState(*start.position, *start.attitude, *start.velocity, *start.rate), ORIGIN)
    expected = {"x": -343.212, "y": 81.6614, "z": 0, "h": h, "p": p, "r": r, "w_x": -0.0009, "w_y": -0.0013, "w_z": 0}
    expected |= dict(zip(("v_x", "v_y", "v_z"), v, strict=True))
    assert got == pytest.approx(expected, abs=1e-12)


def test_small_roll_and_pitch_are_half_angles() -> None:
    """r is about the forward axis, starboard down positive like phi; p about the starboard axis, bow up like theta."""
    got = paper_quantities(ShipState.upright(0.0, 0.0, 0.0)._replace(roll=0.02, pitch=0.01), ORIGIN)
    assert got["r"] == pytest.approx(0.01, abs=1e-4)
    assert got["p"] == pytest.approx(0.005, abs=1e-4)


def test_numbers_are_of_the_centre_of_gravity() -> None:
    """Velocity of a point that turns with the ship: the derivative of its position."""
    r_bg, attitude, nu = np.array([10.0, 1.0, -2.0]), np.array([0.1, -0.05, 0.7]), np.array([3.0, 0.5, 0.1, 0, 0, 0.02])
    got = paper_quantities(ShipState(*ORIGIN, *attitude, *nu), r_bg)
    R_nb = rotation(attitude)
    np.testing.assert_allclose([got["y"], got["x"], -got["z"]], R_nb @ r_bg, rtol=1e-14)
    v_n = R_nb @ (nu[:3] + np.cross(nu[3:], r_bg))
    np.testing.assert_allclose([got["v_y"], got["v_x"], -got["v_z"]], v_n, rtol=1e-14)


def states(own_north: list[float]) -> np.ndarray:
    rows = np.zeros(len(own_north), dtype=[("time", float), *((f"own.{v}", float) for v in (
        "position.north", "position.east", "position.down", "attitude.roll", "attitude.pitch", "attitude.yaw",
        "velocity.surge", "velocity.sway", "velocity.heave", "rate.roll", "rate.pitch", "rate.yaw"))])  # fmt: skip
    rows["time"] = np.arange(len(own_north))
    rows["own.position.north"] = own_north
    return rows


def test_states_between_communication_points_are_interpolated() -> None:
    assert interpolate_state(states([0.0, 10.0, 30.0]), "own", 1.25).north == 15.0
    assert interpolate_state(states([0.0, 10.0, 30.0]), "own", 2.0).north == 30.0


def test_a_row_holds_printed_corrected_and_computed() -> None:
    tolerance = {"horizontal": 0.5, "vertical": 0.1, "quaternion": 0.005, "velocity": 0.02, "rate": 0.003}
    own = {"printed": {"y": 20.0, "h": 0.1, "w_z": 0.5}, "corrected": {"y": 15.4}, "tolerance": tolerance}
    reference = Reference.model_validate({"source": "x", "time": 1.25, "ships": {"own": own}})
    y, h, w_z = compare_published(reference, states([0.0, 10.0, 30.0]), {"own": load_ship("kvlcc2")})
    x_g = 11.2  # of KVLCC2, forward of midship, heading north
    assert y == {
        "ship": "own", "quantity": "y", "unit": "m", "printed": 20.0, "paper": 15.4, "computed": 15.0 + x_g,
        "difference": 15.0 + x_g - 15.4, "tolerance": 0.5, "within": False,
    }  # fmt: skip
    assert (h["unit"], h["tolerance"], h["difference"], h["within"]) == ("1", 0.005, -0.1, False)
    assert (w_z["unit"], w_z["tolerance"], w_z["paper"]) == ("rad/s", 0.003, 0.5)


def test_within_includes_the_tolerance_itself() -> None:
    tolerance = {"horizontal": 0.5, "vertical": 0.1, "quaternion": 0.005, "velocity": 0.25, "rate": 0.003}
    own = {"printed": {"v_x": 0.25, "v_y": -0.251}, "tolerance": tolerance}
    reference = Reference.model_validate({"source": "x", "time": 1.0, "ships": {"own": own}})
    rows = compare_published(reference, states([0.0, 0.0]), {"own": load_ship("kvlcc2")})
    assert [row["within"] for row in rows] == [True, False]
