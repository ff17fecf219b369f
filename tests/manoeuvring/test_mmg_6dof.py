"""Four and six degrees of freedom: natural motions, energy, heel, and the plane motion that they contain."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, degrees, log, pi, radians, sin, sqrt, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shipcollision_fmu.errors import StepError
from shipcollision_fmu.manoeuvring.mmg_6dof import Mmg6Dof
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.ship.degrees_of_freedom import FREE, level_axes
from shipcollision_fmu.ship.frames import Array, rotation
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.seakeeping import Seakeeping, compute_seakeeping

from .conftest import started

Start = Callable[..., ShipManoeuvring]
SIX = {"degrees_of_freedom": 6, "hydrodynamics": True}
FOUR = {"degrees_of_freedom": 4, "hydrodynamics": True}
KVLCC2 = load_ship("kvlcc2")
M = KVLCC2.M
SPEEDS = np.sqrt(M[0, 0] / np.diag(M))
SCALE = np.diag(M) * SPEEDS

DECOUPLED = """
extends = "kvlcc2"
[particulars]
r_bg = [0.0, 0.0, 0.0]
[added_mass]
z_y = 0.0
[seakeeping]
z_H = 0.0
zeta_heave = 0.1
zeta_roll = 0.05
zeta_pitch = 0.15
zeta_roll_per_rad = 0.0
[rudder]
z_R = 0.0
[propeller]
z_P = 0.0
"""
"""CG at CO, all forces at the waterline: heave, roll and pitch are three pendulums of their own."""


@pytest.fixture(scope="module")
def decoupled(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("ships") / "decoupled.toml"
    path.write_text(DECOUPLED, encoding="utf-8")
    return str(path)


def sail(model: ShipManoeuvring, duration: float, h: float = 0.5) -> None:
    for k in range(round(duration / h)):
        model.step(k * h, h)


def state(model: ShipManoeuvring) -> Array:
    o = model.outputs
    return np.array([*o.position, *o.attitude, *o.velocity, *o.rate])


def energy(model: ShipManoeuvring, mmg: Mmg6Dof) -> float:
    x = state(model)
    return float(0.5 * x[6:] @ M @ x[6:]) + mmg.restoring.compute_energy(x[2], x[3], x[4])


# -- natural motions ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("motion", ["heave", "roll", "pitch"])
def test_period_and_damping_of_a_decay(start: Start, decoupled: str, motion: str) -> None:
    """Damped period 2 pi/(w sqrt(1 - zeta^2)) and decay per period exp(-2 pi zeta/sqrt(1 - zeta^2)), within 2 %."""
    ship = load_ship(decoupled)
    sea = compute_seakeeping(ship)
    i, zeta = {"heave": (2, 0.1), "roll": (3, 0.05), "pitch": (4, 0.15)}[motion]
    K = (sea.K_33, sea.K_44, sea.K_55)[i - 2]
    w, damped = sqrt(K / ship.M[i, i]), sqrt(1.0 - zeta**2)
    eta = [0.0] * 6
    eta[i] = 0.5 if motion == "heave" else 1e-3
    model = start(decoupled, **SIX, position=eta[:3], attitude=eta[3:])
    h, times, peaks, before = 0.02, [], [], eta[i]
    rate_before = 0.0
    for k in range(round(2.6 * 2 * pi / w / h)):
        model.step(k * h, h)
        x = state(model)
        if before * x[i] < 0.0:
            times.append((k + before / (before - x[i])) * h)
        if rate_before * x[i + 6] < 0.0:
            peaks.append(abs(x[i]))
        before, rate_before = x[i], x[i + 6]
    assert times[2] - times[0] == pytest.approx(2 * pi / w / damped, rel=0.02)
    assert times[4] - times[2] == pytest.approx(2 * pi / w / damped, rel=0.02)
    assert log(peaks[0] / peaks[2]) == pytest.approx(2 * pi * zeta / damped, rel=0.02)


def test_quadratic_roll_damping(start: Start, tmp_path: Path) -> None:
    """From 10 deg: the damping ratio zeta + zeta_q phi_a takes 2 pi of itself per period, phi_a the mean amplitude."""
    path = tmp_path / "decoupled.toml"
    path.write_text(DECOUPLED.replace("zeta_roll_per_rad = 0.0", "zeta_roll_per_rad = 0.3"), encoding="utf-8")
    model = start(str(path), **SIX, attitude=[radians(6.0), 0.0, 0.0])
    peaks, before = [radians(6.0)], 0.0
    for k in range(1200):
        model.step(0.05 * k, 0.05)
        if before * model.outputs.rate[0] < 0.0:
            peaks.append(abs(model.outputs.attitude[0]))
        before = model.outputs.rate[0]
    assert len(peaks) >= 5
    for one, other in zip(peaks, peaks[2:], strict=False):
        zeta = 0.05 + 0.3 * sqrt(one * other)
        assert log(one / other) == pytest.approx(2 * pi * zeta / sqrt(1 - zeta**2), rel=0.02)


def linear(sea: Seakeeping, degrees_of_freedom: int) -> Array:
    """d/dt of (eta, nu) at rest, linearised, of the free degrees of freedom; (12, 12)."""
    free = list(FREE[degrees_of_freedom])
    K, D = np.zeros((6, 6)), np.zeros((6, 6))
    K[2, 2], K[3, 3], K[4, 4] = sea.K_33, sea.K_44, sea.K_55
    D[2, 2], D[3, 3], D[4, 4] = sea.D_33, sea.D_44, sea.D_55
    A = np.zeros((12, 12))
    block = np.ix_(free, free)
    inverse = np.zeros((6, 6))
    inverse[block] = np.linalg.inv(M[block])
    A[free, [6 + i for i in free]] = 1.0
    A[6:, :6], A[6:, 6:] = -inverse @ K, -inverse @ D
    return A


def exponential(A: Array) -> Array:
    """exp(A), by squaring a Taylor series."""
    A = A / 2.0**12
    series: Array = np.eye(12) + A @ (np.eye(12) + A @ (np.eye(12) + A / 3.0) / 2.0)
    for _ in range(12):
        series = series @ series
    return series


@pytest.mark.parametrize("degrees_of_freedom", [4, 6])
def test_small_motions_after_a_blow_are_those_of_the_linear_system(start: Start, degrees_of_freedom: int) -> None:
    """KVLCC2 with all its couplings, hit in every degree of freedom, against the matrix exponential; a minute, 1 %."""
    P = 1e-4 * SCALE * [0.5, 1.0, 0.4, 0.6, -0.3, 0.7]
    model = start(degrees_of_freedom=degrees_of_freedom, hydrodynamics=True, impulse=P)
    free = list(FREE[degrees_of_freedom])
    x_0 = np.zeros(12)
    x_0[[6 + i for i in free]] = np.linalg.solve(M[np.ix_(free, free)], P[free])
    over_a_step = exponential(0.25 * linear(compute_seakeeping(KVLCC2), degrees_of_freedom))
    computed, expected = [], [x_0]
    for k in range(240):
        model.step(0.25 * k, 0.25)
        computed.append(state(model))
        expected.append(over_a_step @ expected[-1])
    del expected[0]
    scale = np.abs(expected).max(axis=0)
    moving = [i for i in (2, 3, 4, 6, 7, 8, 9, 10, 11) if scale[i] > 0.0]
    np.testing.assert_allclose(
        (np.array(computed) / np.where(scale > 0, scale, 1))[:, moving],
        (np.array(expected) / np.where(scale > 0, scale, 1))[:, moving], atol=0.01,
    )  # fmt: skip


def test_sway_coupling_shortens_the_roll_period(start: Start) -> None:
    """A floating ship rolls about an axis above the centre of its sway added mass: w^2 = K_44/(M_44 - M_24^2/M_22)."""
    sea = compute_seakeeping(KVLCC2)
    odd = [1, 3, 5]
    w = sqrt(sea.K_44 * np.linalg.inv(M[np.ix_(odd, odd)])[1, 1])
    model, before, times = start(**SIX, attitude=[1e-3, 0.0, 0.0]), 1e-3, []
    for k in range(900):
        model.step(0.05 * k, 0.05)
        phi = model.outputs.attitude[0]
        if before * phi < 0.0:
            times.append((k + before / (before - phi)) * 0.05)
        before = phi
    assert times[2] - times[0] == pytest.approx(2 * pi / w, rel=0.02)
    assert 2 * pi / w < 21.0


# -- impulses, energy, rest -----------------------------------------------------------------------------------------


@pytest.mark.usefixtures("engine")
@settings(max_examples=40, deadline=None)
@given(
    st.sampled_from([4, 6]), st.lists(st.floats(-2.0, 2.0), min_size=6, max_size=6), st.floats(-8.0, 10.0),
    st.floats(-3.0, 3.0),
)  # fmt: skip
def test_an_impulse_changes_M_nu_by_itself_at_any_speed(n: int, P: list[float], u: float, v: float) -> None:
    """M nu in b; in 4 degrees of freedom of the level axes, which L gives (ship/degrees_of_freedom.py)."""
    attitude, given_impulse = [0.05, 0.0, 1.0], np.array(P) * SCALE
    axes = np.eye(6) if n == 6 else level_axes(attitude)
    nu = axes @ [u, v, 0.0, 0.002, 0.0, 0.005]
    ship = started(
        degrees_of_freedom=n, hydrodynamics=True, velocity=nu[:3], rate=nu[3:], attitude=attitude, orders=[0.0, 1.0],
        impulse=given_impulse, again=True,
    )  # fmt: skip
    before = state(ship)[6:]
    ship.step(0.0, 1e-16)
    free = list(FREE[n])
    change = np.linalg.solve(axes, state(ship)[6:] - before)
    taken = M[np.ix_(free, free)] @ change[free]
    np.testing.assert_allclose(taken / SCALE[free], (axes.T @ given_impulse / SCALE)[free], atol=1e-12)
    np.testing.assert_allclose((change * SPEEDS)[[i for i in range(6) if i not in free]], 0.0, atol=1e-13)


@pytest.mark.usefixtures("engine")
@settings(max_examples=15, deadline=None)
@given(
    st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6), st.floats(-0.3, 0.3), st.floats(-0.03, 0.03),
    st.floats(-1.0, 1.0),
)  # fmt: skip
def test_without_input_the_energy_only_falls(nu: list[float], phi: float, theta: float, D: float) -> None:
    """Kinetic and potential, propeller stopped, from any motion."""
    mmg = Mmg6Dof(KVLCC2, 6)
    x = np.array(nu) * [8.0, 4.0, 0.5, 0.03, 0.005, 0.02]
    ship = started(
        **SIX, velocity=x[:3], rate=x[3:], attitude=[phi, theta, 0.4], position=[0.0, 0.0, D], again=True,
        orders=[0.0, 0.0], impulse=[0.0] * 6,
    )  # fmt: skip
    before = energy(ship, mmg)
    for k in range(120):
        ship.step(0.5 * k, 0.5)
        after = energy(ship, mmg)
        assert after <= before * (1.0 + 1e-9) + 1.0
        before = after


@pytest.mark.parametrize("mode", [FOUR, SIX], ids=["4", "6"])
def test_at_rest_it_stays_at_rest(start: Start, mode: dict[str, Any]) -> None:
    ship = start(**mode, attitude=[0.0, 0.0, 1.0], substep=1.0)
    sail(ship, 3600.0, 60.0)
    np.testing.assert_allclose(state(ship), [0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 0, 0], atol=1e-15)


def test_free_drift_settles_and_stays_bounded_for_an_hour(start: Start) -> None:
    """Struck while at rest: roll, heave and pitch are gone within minutes, the drift dies away."""
    ship = start(
        **SIX, attitude=[0.2, 0.01, 0.0], position=[0.0, 0.0, 0.5], impulse=SCALE * [0.2, 0.5, 0.2, 0.5, 0.1, 0.3],
        substep=0.5,
    )  # fmt: skip
    sail(ship, 600.0, 5.0)
    settled = state(ship)
    assert abs(degrees(settled[3])) < 0.2
    assert abs(degrees(settled[4])) < 0.005
    assert abs(settled[2]) < 0.01
    sail(ship, 3000.0, 5.0)
    x = state(ship)
    assert np.abs(x[6:9]).max() < 0.3
    assert np.abs(x[:2]).max() < 3000.0
    assert abs(degrees(x[3])) < 0.01
    assert np.linalg.norm(x[6:8]) < np.linalg.norm(settled[6:8])


def test_a_beam_impact_rolls_but_hardly_heaves_or_pitches(start: Start) -> None:
    """95 MN s on KVLCC2's side, 120 m forward, 5 m above the water: 1 deg of roll, 3 mm of heave, next to no pitch."""
    F = 95e6
    ship = start(**SIX, impulse=[0.0, F, 0.0, F * 5.0, 0.0, F * 120.0])
    most = np.zeros(12)
    for k in range(600):
        ship.step(0.1 * k, 0.1)
        most = np.maximum(most, np.abs(state(ship)))
    assert degrees(most[3]) == pytest.approx(0.99, abs=0.03)
    assert degrees(most[4]) == pytest.approx(0.004, abs=0.001)
    assert most[2] == pytest.approx(0.003, abs=0.0005)
    assert most[7] == pytest.approx(0.18, abs=0.01)
    assert degrees(most[11]) == pytest.approx(0.19, abs=0.01)


# -- signs, current, plane motion ----------------------------------------------------------------------------------


@pytest.mark.one_in(2)
@pytest.mark.parametrize("mode", [FOUR, SIX], ids=["4", "6"])
@pytest.mark.parametrize("side", [1, -1], ids=["starboard", "port"])
def test_heel_in_a_turn_is_first_inwards_then_outwards(start: Start, mode: dict[str, Any], side: int) -> None:
    """In the steady turn K_44 phi = -(Y_H z_H + Y_R z_R + m z_G u r ...): outwards for CG above the centre of Y_H."""
    ship = start(**mode, velocity=[7.97, 0.0, 0.0], orders=[side * radians(35.0), 1.2268], substep=0.1)
    sail(ship, 15.0)
    assert side * ship.outputs.attitude[0] > radians(0.01)  # into the turn: only the rudder's force is there yet
    heels = []
    for k in range(300):
        ship.step(1.0 * k, 1.0)
        heels.append(side * degrees(ship.outputs.attitude[0]))
    assert -1.0 < min(heels) < -0.3
    assert heels[-1] < -0.05


@pytest.mark.slow
@pytest.mark.parametrize("mode", [FOUR, SIX], ids=["4", "6"])
def test_steady_heel_is_what_the_forces_say(start: Start, mode: dict[str, Any]) -> None:
    """By hand: K_44 sin(phi) = -z_H Y_H - z_RY Y_R + m z_G u r, from the forces that the model reports."""
    ship = start(**mode, velocity=[7.97, 0.0, 0.0], orders=[radians(20.0), 1.2268], substep=0.1)
    sail(ship, 1500.0, 5.0)
    o, sea = ship.outputs, compute_seakeeping(KVLCC2)
    u, r, z_G, a_H = o.velocity[0], o.rate[2], 2.2, 0.312
    z_RY = (sea.z_R + a_H * sea.z_H) / (1 + a_H)
    K = -sea.z_H * o.hull[1] - z_RY * o.rudder[1] + KVLCC2.mass * z_G * u * r
    assert sea.K_44 * sin(o.attitude[0]) == pytest.approx(K, rel=0.02)
    assert o.attitude[0] < 0.0


def test_bow_up_is_positive_pitch(start: Start) -> None:
    """A push upwards under the bow."""
    ship = start(**SIX, force=[0.0, 0.0, -1e7, 0.0, 1e7 * 140.0, 0.0])
    sail(ship, 5.0)
    assert ship.outputs.attitude[1] > 0.0
    assert ship.outputs.position[2] < 0.0


def test_a_push_to_starboard_above_the_water_heels_to_starboard(start: Start) -> None:
    ship = start(**SIX, force=[0.0, 1e6, 0.0, 1e6 * 15.0, 0.0, 0.0])
    sail(ship, 5.0)
    assert ship.outputs.attitude[0] > 0.0
    assert ship.outputs.velocity[1] > 0.0


@pytest.mark.parametrize("mode", [FOUR, SIX], ids=["4", "6"])
def test_without_levers_it_is_the_plane_motion(start: Start, decoupled: str, mode: dict[str, Any]) -> None:
    """All forces in the plane of CO and CG there: nothing heels the ship, and the equations are those of 3 degrees."""
    keys = {"velocity": [7.0, 0.2, 0.0], "orders": [0.5, 1.2], "current": [0.4, -0.3], "substep": 0.5}
    spatial = start(decoupled, **mode, **keys)
    plane = start(decoupled, hydrodynamics=True, degrees_of_freedom=3, **keys)
    for model in (spatial, plane):
        model.inputs.rudder_order = 0.5
        sail(model, 600.0, 5.0)
    np.testing.assert_allclose(state(spatial), state(plane), rtol=1e-9, atol=1e-8)


@pytest.mark.one_in(2)
@pytest.mark.parametrize(("mode", "apart"), [(FOUR, 0.3), (SIX, 1.0)], ids=["4", "6"])
def test_plane_track_of_a_stiff_ship(start: Start, mode: dict[str, Any], apart: float) -> None:
    """KVLCC2 heels half a degree in a turn: its track of 5 km stays within a metre of that in 3 degrees of freedom."""
    keys = {"velocity": [7.97, 0.0, 0.0], "orders": [radians(35.0), 1.2268], "substep": 0.25}
    spatial, plane = start(**mode, **keys), start(hydrodynamics=True, degrees_of_freedom=3, **keys)
    for k in range(240):
        for model in (spatial, plane):
            model.step(5.0 * k, 5.0)
        assert np.abs(state(spatial)[:2] - state(plane)[:2]).max() < apart


@pytest.mark.one_in(2)
@pytest.mark.parametrize("mode", [FOUR, SIX], ids=["4", "6"])
def test_manoeuvre_in_a_current_is_the_same_manoeuvre_carried_along(start: Start, mode: dict[str, Any]) -> None:
    c_n, c_e, psi, T = 0.7, -0.4, 0.9, 200.0
    keys = {"orders": [0.5, 1.1], "substep": 0.1}
    still = start(**mode, attitude=[0.0, 0.0, psi], velocity=[6.0, 0.2, 0.0], **keys)
    u_c, v_c = c_n * cos(psi) + c_e * sin(psi), c_e * cos(psi) - c_n * sin(psi)
    moving = start(
        **mode, attitude=[0.0, 0.0, psi], velocity=[6.0 + u_c, 0.2 + v_c, 0.0], current=[c_n, c_e], **keys
    )  # fmt: skip
    sail(still, T)
    sail(moving, T)
    expected = np.array(still.outputs.position) + [c_n * T, c_e * T, 0.0]
    np.testing.assert_allclose(moving.outputs.position, expected, atol=1e-6)
    np.testing.assert_allclose(moving.outputs.attitude, still.outputs.attitude, atol=1e-9)


def _after_a_minute(substep: float) -> Array:
    ship = started(
        **SIX, velocity=[6.0, -1.2, 0.1], rate=[0.01, 0.001, 0.008], attitude=[0.1, 0.002, 0.0], orders=[0.0, 1.2],
        substep=substep,
    )  # fmt: skip
    ship.step(0.0, 64.0)
    return state(ship)


@pytest.mark.usefixtures("engine")
def test_converges_with_the_fourth_power_of_the_substep() -> None:
    """But for the kink of |p| p, which is small: better than a factor of 8 per halving."""
    exact = _after_a_minute(0.03125)
    scale = np.array([100.0, 10.0, 1.0, 0.1, 0.01, 0.1, 1.0, 1.0, 0.1, 0.01, 0.01, 0.01])
    errors = [float(np.linalg.norm((_after_a_minute(s) - exact) / scale)) for s in (1.0, 0.5, 0.25)]
    assert errors[0] / errors[1] > 8.0
    assert errors[1] / errors[2] > 8.0


def test_forces_by_origin_explain_the_motion(start: Start) -> None:
    """At rest but heeled, trimmed and sunk: M nu_dot is the sum of what is reported."""
    h = 1e-6
    ship = start(
        **SIX, attitude=[0.1, 0.005, 0.3], position=[0.0, 0.0, 0.4], orders=[0.0, 1.2], wind=[15.0, 1.0],
    )  # fmt: skip
    o = ship.outputs
    tau = np.sum([o.hull, o.propeller, o.rudder, o.wind], axis=0)
    ship.step(0.0, h)
    nu_dot = state(ship)[6:] / h
    np.testing.assert_allclose(M @ nu_dot / SCALE, tau / SCALE, rtol=1e-4, atol=1e-7)


def test_standing_on_end_is_refused(start: Start) -> None:
    ship = start(**SIX, impulse=[0.0, 0.0, 0.0, 0.0, 8e12, 0.0])
    with pytest.raises(StepError, match=r"pitch angle comes to 1\.4\d+ rad, must stay below 1\.4 rad; look at impulse"):
        sail(ship, 3.0, 0.01)
    assert ship.outputs.attitude[1] < 1.4


def test_four_degrees_hold_heave_and_pitch(start: Start) -> None:
    """CO stays at its depth, however she heels: the velocity in b is level in n, the rate turns no pitch up."""
    ship = start(**FOUR, velocity=[7.0, 0.0, 0.0], position=[0.0, 0.0, 0.3], orders=[0.5, 1.2])
    ship.inputs.impulse[:] = list(0.1 * SCALE)
    sail(ship, 60.0)
    x = state(ship)
    assert x[2] == 0.3
    assert x[4] == 0.0
    assert abs(x[3]) > 1e-3
    R = rotation(x[3:6])
    assert R[2] @ x[6:9] == pytest.approx(0.0, abs=1e-15)
    assert cos(x[3]) * x[10] - sin(x[3]) * x[11] == pytest.approx(0.0, abs=1e-17)


def test_in_four_degrees_velocity_is_that_of_the_track_in_b(start: Start) -> None:
    """R_nb velocity is d(position)/dt, and the Euler angles' rates are those of the rate in b: heeled by a blow."""
    ship, h = start(**FOUR, velocity=[5.0, 0.0, 0.0], orders=[0.3, 1.0]), 1e-4
    ship.inputs.impulse[:] = list(SCALE * [0.0, 1.0, 0.0, 0.5, 0.0, 0.3])
    sail(ship, 3.0)
    assert abs(ship.outputs.attitude[0]) > 0.05
    states = []
    for _ in range(3):
        states.append(state(ship))
        ship.step(3.0, h)
    before, x, after = states
    rates = (after[:6] - before[:6]) / (2 * h)
    np.testing.assert_allclose(rotation(x[3:6]) @ x[6:9], rates[:3], atol=1e-7)
    np.testing.assert_allclose(np.linalg.solve(level_axes(x[3:6]), x[6:])[3:], rates[3:], atol=1e-8)


def test_a_heeled_start_keeps_its_level_motion(start: Start) -> None:
    """Heeled, sway along b has a part down, which is left out and said; the same motion, level, is taken as it is."""
    attitude, velocity, rate = [0.1, 0.0, 0.7], [5.0, 1.0, 0.0], [0.02, 0.0, 0.01]
    ship = start(**FOUR, velocity=velocity, rate=rate, attitude=attitude)
    before, after = (np.linalg.solve(level_axes(attitude), nu) for nu in ([*velocity, *rate], state(ship)[6:]))
    np.testing.assert_allclose(after, before * [1, 1, 0, 1, 0, 1], atol=1e-15)
    assert ship.warning.startswith(
        "initial heave velocity = 0.0998334 and pitch rate = -0.000998334 in level axes left out: 4 degrees of freedom"
    )
    ship.step(0.0, 0.1)
    assert ship.warning == ""
    level = start(**FOUR, velocity=[0.0, 1.0, -tan(0.1)], attitude=attitude)
    assert level.warning == ""
    np.testing.assert_allclose(level.outputs.velocity, [0.0, 1.0, -tan(0.1)], rtol=1e-14)


def test_a_heeled_start_from_another_program_has_its_rounding(start: Start) -> None:
    """A state of a ship that a blow has heeled, written with nine digits: what is held is not zero to the last bit."""
    ship = start(**FOUR, velocity=[6.0, 0.0, 0.0], orders=[0.5, 1.0])
    ship.inputs.impulse[:] = list(SCALE * [0.0, 1.0, 0.0, 0.5, 0.0, 0.3])
    sail(ship, 3.0)
    x = [round(value, 9) + 1e-9 for value in state(ship).tolist()]
    assert abs(x[3]) > 0.05
    again = start(**FOUR, velocity=x[6:9], rate=x[9:], attitude=x[3:6], orders=[0.5, 1.0])
    assert again.warning == ""
    assert again.outputs.attitude[1] == 0.0
    np.testing.assert_allclose(state(again)[6:], x[6:], atol=3e-9)
    w, q = np.linalg.solve(level_axes(again.outputs.attitude), state(again)[6:])[[2, 4]]
    assert (w, q) == pytest.approx((0.0, 0.0), abs=1e-16)


@pytest.mark.parametrize("heave", [1e-9, -1e-7])
def test_rounding_in_a_held_motion_of_an_upright_start_becomes_zero(start: Start, heave: float) -> None:
    ship = start(**FOUR, velocity=[5.0, 0.3, heave], attitude=[0.0, 1e-9, 0.7])
    assert ship.outputs.velocity == [5.0, 0.3, 0.0]
    assert ship.outputs.attitude == [0.0, 0.0, 0.7]
    assert ship.warning == ""


def test_roll_damping_is_stronger_under_way(start: Start) -> None:
    """The rolling hull is a wing that moves sideways: it damps more at speed, about zeta = 0.05 at rest."""
    decays = []
    for u, n in ((0.0, 0.0), (7.97, 1.2268)):
        ship = start(**SIX, velocity=[u, 0.0, 0.0], attitude=[0.02, 0.0, 0.0], orders=[0.0, n])
        peaks, before = [0.02], 0.0
        for k in range(1400):
            ship.step(0.05 * k, 0.05)
            if before * ship.outputs.rate[0] < 0.0:
                peaks.append(abs(ship.outputs.attitude[0]))
            before = ship.outputs.rate[0]
        decays.append(log(peaks[0] / peaks[2]) / 2 / pi)
    assert 0.045 < decays[0] < 0.07
    assert 1.01 * decays[0] < decays[1] < 1.5 * decays[0]
