"""Every shipped scenario under both algorithms: the books balance, contact gives no energy, and both masters agree."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.cosim.run import Run
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.scenario.scenario import Scenario, list_scenario_names
from shipcollision_fmu.ship.degrees_of_freedom import FREE
from shipcollision_fmu.ship.frames import rotation
from shipcollision_fmu.ship.loading.library import load_ship

ALGORITHMS = ("gauss-seidel", "jacobi")
OWN_RESPONSE = "guan2014"
"""The scenario whose response is PyBullet's own."""


def scenario_param(name: str, *more: str, marks: tuple[Any, ...] = ()) -> Any:
    """A scenario, and more, as parameters of a test."""
    needs = (pytest.mark.needs("pybullet"),) if name == OWN_RESPONSE else ()
    return pytest.param(name, *more, marks=(*needs, *marks))


@dataclass
class Watch:
    """What went through the models of a run, taken down beside them."""

    dissipated: list[float] = field(default_factory=list)
    strikes: list[dict[str, Any]] = field(default_factory=list)
    diagnosis: list[str] = field(default_factory=list)  # texts of findings about the wiring

    def step(self, model: ShipCollision, original: Any, t: float, h: float) -> None:
        original(model, t, h)
        self.dissipated.append(model.outputs.energy.dissipated)
        self.diagnosis += [model.outputs.diagnosis.text] if model.outputs.diagnosis.count else []

    def strike(self, model: ShipManoeuvring, original: Any, *arguments: Any) -> Any:
        nu, applied = np.array(model.outputs.velocity + model.outputs.rate), np.array(model.outputs.impulse_applied)
        struck = original(model, *arguments)
        self.strikes.append({
            "ship": model.parameters.ship, "free": list(FREE[model.parameters.degrees_of_freedom]), "before": nu,
            "after": np.array(struck[0]), "impulse": np.array(model.inputs.impulse) - applied,
            "x": np.array(model.outputs.position), "R": rotation(model.outputs.attitude),
        })  # fmt: skip
        return struck


@dataclass(frozen=True)
class Watched:
    scenario: Scenario
    run: Run
    watch: Watch


@cache
def run_watched(name: str, algorithm: str) -> Watched:
    """A scenario in process, with step 0.05 s, watched."""
    scenario, watch = load_scenario(name), Watch()
    step, apply_pending = ShipCollision.step, ShipManoeuvring._apply_pending
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ShipCollision, "step", lambda m, t, h: watch.step(m, step, t, h))
        patch.setattr(ShipManoeuvring, "_apply_pending", lambda m, *a: watch.strike(m, apply_pending, *a))
        run = simulate(scenario, algorithm=algorithm, step=0.05, in_process=True)
    return Watched(scenario, run, watch)


@pytest.fixture(scope="module", autouse=True)
def _runs_end_with_the_module() -> Iterator[None]:
    yield
    run_watched.cache_clear()


LONG = "kvlcc2_crossing"
"""The longest run: slow."""
SCENARIOS = [scenario_param(name, marks=(pytest.mark.slow,) * (name == LONG)) for name in list_scenario_names()]


def each() -> Any:
    return pytest.mark.parametrize(
        ("name", "algorithm"),
        [
            scenario_param(n, a, marks=(pytest.mark.slow,) * (n == LONG))
            for n in list_scenario_names()
            for a in ALGORITHMS
        ],
    )


@pytest.mark.slow
@each()
def test_nothing_is_found_wrong_with_the_wiring(name: str, algorithm: str) -> None:
    assert run_watched(name, algorithm).watch.diagnosis == []


@pytest.mark.slow
@each()
def test_nothing_is_found_wrong_with_the_wiring_in_coarse_steps(name: str, algorithm: str) -> None:
    """Steps of 0.5 s, in which ships move by metres."""
    watch, step = Watch(), ShipCollision.step
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ShipCollision, "step", lambda m, t, h: watch.step(m, step, t, h))
        simulate(load_scenario(name), algorithm=algorithm, step=0.5, in_process=True)
    assert watch.dissipated
    assert watch.diagnosis == []


@each()
def test_ships_collide_once_and_come_clear(name: str, algorithm: str) -> None:
    watched = run_watched(name, algorithm)
    assert watched.run.summary["collisions"] == 1
    assert watched.run.contacts["time"].max() < watched.run.states["time"][-1] - 0.1


@each()
def test_impulses_and_moments_on_the_ships_are_equal_and_opposite(name: str, algorithm: str) -> None:
    """As the ships take them, where they are by then, about n's origin, and so about any fixed point; to 1e-12 of the
    impulse and of its moment there. In every step of a sequential master. A parallel one takes the first impulse at
    poses for which it was not meant, and what that was short of in the next steps: there the whole run balances."""
    watched = run_watched(name, algorithm)
    n, strikes = len(watched.scenario.ships), watched.watch.strikes
    taken = [[(s["x"], s["R"], s["impulse"]) for s in strikes[k : k + n]] for k in range(0, len(strikes), n)]
    steps = [rows for rows in taken if any(J.any() for _, _, J in rows)]
    assert steps
    largest = max(np.linalg.norm(J[:3]) for rows in steps for _, _, J in rows)
    for rows in steps if algorithm == "gauss-seidel" else [[row for step in steps for row in step]]:
        P = [R @ J[:3] for _, R, J in rows]
        L = [R @ J[3:] + np.cross(x, p) for (x, R, J), p in zip(rows, P, strict=True)]
        # A small impulse is a difference of two large cumulative numbers: their rounding is the floor.
        total = sum(np.linalg.norm(p) for p in P) + 1e-3 * largest
        # Moments in n are of two parts, about CO and of CO: the ledger keeps them to 1e-12 of the parts.
        parts = ((np.linalg.norm(J[3:]), np.linalg.norm(x) * np.linalg.norm(J[:3])) for x, _, J in rows)
        moment = sum(about_co + of_co for about_co, of_co in parts) + 1e-3 * largest * 500.0
        assert np.abs(sum(P)).max() <= 1e-12 * total
        assert np.abs(sum(L)).max() <= 1e-12 * moment


@each()
def test_every_application_is_inertia_times_change_of_velocity(name: str, algorithm: str) -> None:
    struck = [s for s in run_watched(name, algorithm).watch.strikes if s["impulse"].any()]
    assert struck
    for s in struck:
        free = s["free"]
        M = load_ship(s["ship"]).M[np.ix_(free, free)]
        momentum = M @ (s["after"] - s["before"])[free]
        scale = np.abs(M) @ np.abs(s["before"])[free]  # nu is rounded to its own size
        assert np.all(np.abs(momentum - s["impulse"][free]) <= 1e-12 * (np.abs(s["impulse"][free]) + scale))


@each()
def test_all_that_was_issued_has_been_applied(name: str, algorithm: str) -> None:
    for books in run_watched(name, algorithm).run.summary["ledger"].values():
        assert books["issued"] == books["applied"]
        assert books["pending"] == [0.0] * 6


@each()
def test_contact_never_gives_kinetic_energy(name: str, algorithm: str) -> None:
    """Neither in the collision model's account nor in that of the ships, in any step; and not by any step of a parallel
    master, in which a single one may give back what the one before took too much of, a thousandth of the whole."""
    watched = run_watched(name, algorithm)
    dissipated = np.array([0.0, *watched.watch.dissipated])
    assert np.diff(dissipated).min() >= -1e-9 * dissipated[-1]
    n, work = len(watched.scenario.ships), []
    strikes = watched.watch.strikes
    for k in range(0, len(strikes), n):
        change = 0.0
        for s in strikes[k : k + n]:
            M = load_ship_M(s["ship"])
            change += 0.5 * (s["after"] @ M @ s["after"] - s["before"] @ M @ s["before"])
        work.append(change)
    assert len(work) == watched.scenario.changed(step=0.05).steps
    assert max(work) <= (1e-9 if algorithm == "gauss-seidel" else 1e-3) * dissipated[-1]
    assert max(np.cumsum(work)) <= 0.0
    assert -sum(work) == pytest.approx(dissipated[-1], rel=0.02)


@pytest.mark.parametrize("name", SCENARIOS)
def test_both_masters_end_at_the_same_velocities(name: str) -> None:
    """Within 2 % of the change that the collision made, at 0.05 s: the velocity of CO, and the whole twist in the norm
    of the kinetic energy, which is the one that may add metres and radians."""
    one, other = (run_watched(name, algorithm) for algorithm in ALGORITHMS)
    for ship, start in one.scenario.ships.items():
        M = load_ship_M(start.ship)
        made = sum((change for _, change in changes(one, ship)), np.zeros(6))
        differs = final_twist(one, ship) - final_twist(other, ship)
        assert np.linalg.norm(differs[:3]) <= 0.02 * np.linalg.norm(made[:3])
        assert np.sqrt(differs @ M @ differs) <= 0.02 * np.sqrt(made @ M @ made)


def changes(watched: Watched, ship: str) -> list[tuple[int, np.ndarray]]:
    """Step and change of twist (6,), in b about CO, of every strike that a ship took."""
    names = list(watched.scenario.ships)
    mine = watched.watch.strikes[names.index(ship) :: len(names)]
    return [(k, s["after"] - s["before"]) for k, s in enumerate(mine) if s["impulse"].any()]


def final_twist(watched: Watched, ship: str) -> np.ndarray:
    last = watched.run.states[-1]
    velocity = [last[f"{ship}.velocity.{c}"] for c in ("surge", "sway", "heave")]
    return np.array(velocity + [last[f"{ship}.rate.{c}"] for c in ("roll", "pitch", "yaw")])


_M: dict[str, np.ndarray] = {}


def load_ship_M(name: str) -> np.ndarray:
    if name not in _M:
        _M[name] = load_ship(name).M
    return _M[name]


@pytest.mark.needs("pybullet")
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_linear_momentum_without_added_mass_is_the_same_after_as_before(algorithm: str) -> None:
    momentum = run_watched(OWN_RESPONSE, algorithm).run.summary["momentum"]
    assert momentum["closed"]
    np.testing.assert_allclose(momentum["after"]["linear"], momentum["before"]["linear"], atol=1e-12 * 1e9)
    assert not run_watched("guan2014_added_mass", algorithm).run.summary["momentum"]["closed"]


@pytest.mark.slow
def test_of_ships_that_sail_momentum_is_not_closed() -> None:
    assert not run_watched(LONG, "gauss-seidel").run.summary["momentum"]["closed"]


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", SCENARIOS)
def test_fmus_and_models_in_process_give_identical_states(name: str, tmp_path: Path) -> None:
    scenario = load_scenario(name)
    simulate(scenario, out=tmp_path / "fmu")
    simulate(scenario, in_process=True, out=tmp_path / "process")
    for file in ("states.csv", "contacts.csv", "events.json", "summary.json"):
        assert (tmp_path / "fmu" / file).read_bytes() == (tmp_path / "process" / file).read_bytes()
