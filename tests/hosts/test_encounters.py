"""The three-instance encounter in hosts that are not ours, beside our own master and beside the laws.

All of them step in parallel (jacobi): what is sent at a point is applied in the next step. Where a host's steps are
0.05 s, its rows are ours to the bit. libcosim and fmpy.simulate_fmu make each step's length from their clocks, as the
difference of two points in time, with jitter in its last bits: their rows differ by what that jitter moves a ship.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.fmi.names import APPLIED, IMPULSE, STATE, named
from shipcollision_fmu.ship.frames import rotation

from .conftest import NAMES, NATIVE
from .encounter import Encounter, Rows, run_master
from .masters import MASTERS

pytestmark = pytest.mark.slow

EXACT = {"fmpy-loop", "fmpy-ssp", "ecos-api", "ecos-ssp", "ecos-ssp-fmi3", "container", "container-fmi3"}
JITTER = 1e-10
"""Relative difference from ours in the others: at 6 s a step's length jitters by 1e-14 of itself, which an impact with
its deep overlap multiplies. 2e-12 on one processor, 1.7e-11 on another, as each rounds."""
ROUNDING = 1e-9
"""Difference of native FMUs from the models in Python, whose sines differ in the last bit."""

Ours = dict[str, tuple[Rows, int, dict[str, list[float]]]]
Ran = dict[tuple[str, str], tuple[Rows, int | None]]


@pytest.fixture(scope="module")
def ran(encounters: dict[str, Encounter], ours: Ours, tmp_path_factory: pytest.TempPathFactory) -> Ran:
    """Every host on every encounter, once, two hosts at a time."""

    def run(host: str) -> list[dict[str, Any]]:
        more = {name: {"given": ours[name][2]} if host == "fmpy-simulate" else {} for name in NAMES}
        return run_master(host, [encounters[name].case(**more[name]) for name in NAMES], folder)

    folder = tmp_path_factory.mktemp("hosts")
    with ThreadPoolExecutor(2) as pool:
        found = dict(zip(MASTERS, pool.map(run, MASTERS), strict=True))
    return {
        (host, name): (encounters[name].rows(result), result["impacts"])
        for host, results in found.items()
        for name, result in zip(NAMES, results, strict=True)
    }


def shown(rows: Rows) -> Rows:
    """Whether a host shows a point: most do not show the start, or not all."""
    seen = ~np.isnan(rows).any(axis=1)
    assert seen.sum() >= len(rows) - 1
    return seen


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("host", MASTERS)
def test_a_host_agrees_with_our_master(ran: Ran, ours: Ours, host: str, name: str) -> None:
    (rows, impacts), (expected, collisions, _) = ran[host, name], ours[name]
    assert rows.shape == expected.shape
    assert impacts in (None, collisions)
    seen = shown(rows)
    if host in EXACT:
        np.testing.assert_array_equal(rows[seen], expected[seen])
    else:
        assert differ(rows[seen], expected[seen]) <= JITTER


def differ(rows: Rows, expected: Rows) -> float:
    """The largest difference as a share of its vector."""
    vectors = np.abs(expected).max(axis=0).reshape(-1, 3).max(axis=1).repeat(3)
    return float((np.abs(rows - expected) / vectors).max())


def test_native_fmus_agree_with_the_models(ours: Ours) -> None:
    assert differ(ours[NATIVE][0], ours["under_way"][0]) <= ROUNDING
    assert ours[NATIVE][1] == ours["under_way"][1]


@pytest.mark.parametrize("host", MASTERS)
def test_every_impulse_is_applied_once_and_a_step_later(
    ran: Ran, ours: Ours, encounters: dict[str, Encounter], host: str
) -> None:
    for name in NAMES:
        rows, encounter = ran[host, name][0], encounters[name]
        sent = ours[name][0] if host == "fmpy-simulate" else rows  # there each FMU is fed with what ours sent
        seen = shown(rows)
        for ship in encounter.ships:
            issued = sent[:, encounter.column("collision", named(ship, IMPULSE))]
            applied = rows[:, encounter.column(ship, APPLIED)]
            both = seen[1:] & seen[:-1]
            assert issued[-1].any()
            np.testing.assert_array_equal(applied[1:][both], issued[:-1][both])
            np.testing.assert_array_equal(applied[-1], issued[-1])  # the ships are apart at the end


@pytest.mark.parametrize("host", MASTERS)
def test_what_the_ships_took_adds_up_to_nothing(ran: Ran, encounters: dict[str, Encounter], host: str) -> None:
    """In n, linear and about the origin: every impulse taken at the pose that the ship had when she took it, which in a
    parallel master is a step after it was issued."""
    for name in NAMES:
        rows, encounter = ran[host, name][0], encounters[name]
        total, size = np.zeros(6), np.zeros(6)
        for k in range(2, len(rows)):
            for ship in encounter.ships:
                state = rows[k - 1, encounter.column(ship, STATE)]
                column, R = encounter.column(ship, APPLIED), rotation(state[3:6])
                J = rows[k, column] - rows[k - 1, column]
                linear = R @ J[:3]
                wrench = np.concatenate([linear, R @ J[3:] + np.cross(state[:3], linear)])
                # Moments in n are of two parts, about CO and of CO: the ledger keeps them to 1e-12 of the parts.
                parts = np.linalg.norm(J[3:]) + np.linalg.norm(state[:3]) * np.linalg.norm(linear)
                total = total + wrench
                size = size + np.concatenate([np.abs(linear), [parts] * 3])
        assert size[:3].max() > 1e6
        assert np.abs(total[:3]).max() <= 1e-12 * size[:3].max()
        assert np.abs(total[3:]).max() <= 1e-12 * size[3:].max()


@pytest.mark.parametrize("host", MASTERS)
def test_a_coasting_ship_takes_exactly_its_impulse(ran: Ran, encounters: dict[str, Encounter], host: str) -> None:
    """M dnu = J. A ship that coasts keeps the velocity of her CG and her angular velocity in n once struck: what she
    had after the strike follows from where she is a step later."""
    rows, encounter = ran[host, "guan2014"][0], encounters["guan2014"]
    for name, ship in encounter.scenario.load_ships().items():
        strikes = 0
        for k in range(2, len(rows)):
            before, after = (rows[i, encounter.column(name, STATE)] for i in (k - 1, k))
            applied = rows[[k - 1, k]][:, encounter.column(name, APPLIED)]
            J, R_0, R_1 = applied[1] - applied[0], rotation(before[3:6]), rotation(after[3:6])
            w = R_0.T @ R_1 @ after[9:]
            v = R_0.T @ R_1 @ (after[6:9] + np.cross(after[9:], ship.r_bg)) - np.cross(w, ship.r_bg)
            gained = ship.M @ (np.concatenate([v, w]) - before[6:])
            for part in (slice(0, 3), slice(3, 6)):
                momentum = np.abs(ship.M @ before[6:])[part].max()
                assert np.abs(gained - J)[part].max() <= 1e-12 * max(momentum, np.abs(applied[1])[part].max())
            strikes += bool(J.any())
        assert strikes > 0
