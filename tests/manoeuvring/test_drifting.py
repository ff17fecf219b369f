"""A ship with hydrodynamics and without propeller, rudder and engine: it drifts, and nobody can steer it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from shipcollision_fmu.errors import ScenarioError, StepError
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.ship.loading.library import load_ship
from tests.ship_files import ship_toml

Start = Callable[..., ShipManoeuvring]


@pytest.fixture(scope="module")
def lighter(tmp_path_factory: pytest.TempPathFactory) -> str:
    """KVLCC2's hull without its machinery."""
    table = load_ship("kvlcc2").manoeuvring
    assert table is not None
    text = ship_toml(
        ship={"name": "Lighter", "source": "kvlcc2 without its machinery"},
        particulars={"L_pp": 320.0, "B": 58.0, "T": 20.8, "mass": 320.415e6, "r_bg": [0.0, 0.0, 2.2]},
        hull={"depth": 30.0}, manoeuvring=table.model_dump(exclude={"estimate"}),
    )  # fmt: skip
    path: Path = tmp_path_factory.mktemp("ships") / "lighter.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
def test_it_drifts_with_wind_and_current(start: Start, lighter: str, degrees_of_freedom: int) -> None:
    ship = start(
        lighter, hydrodynamics=True, degrees_of_freedom=degrees_of_freedom, current=[0.5, 0.0], wind=[15.0, 4.7],
        substep=0.5,
    )  # fmt: skip
    for k in range(120):
        ship.step(10.0 * k, 10.0)
    assert ship.outputs.position[0] > 10.0  # bow on, the current has little to take hold of
    assert ship.outputs.position[1] > 100.0
    assert ship.outputs.propeller == ship.outputs.rudder == [0.0] * 6
    assert ship.outputs.rudder_angle == ship.outputs.propeller_speed == 0.0


ORDERS = ["rudder", "propeller"]


@pytest.mark.parametrize("name", ORDERS)
def test_an_order_at_the_start_is_refused(start: Start, lighter: str, name: str) -> None:
    orders = [0.25 if name == ordered else 0.0 for ordered in ORDERS]
    line = rf"{name}_order = 0\.25 at the start, but ship 'Lighter' has no \[{name}\]: order 0, or add the tables"
    with pytest.raises(ScenarioError, match=line):
        start(lighter, hydrodynamics=True, degrees_of_freedom=3, orders=orders)


@pytest.mark.parametrize("name", ORDERS)
def test_an_order_on_the_way_is_refused(start: Start, lighter: str, name: str) -> None:
    ship = start(lighter, hydrodynamics=True, degrees_of_freedom=3)
    setattr(ship.inputs, f"{name}_order", 0.25)
    before = ship.get_state()
    with pytest.raises(StepError, match=rf"{name}_order = 0\.25 at t = 3 s, but ship 'Lighter' has no \[{name}\]"):
        ship.step(3.0, 1.0)
    assert ship.get_state() == before
    setattr(ship.inputs, f"{name}_order", 0.0)
    ship.step(3.0, 1.0)


def test_coasting_it_takes_any_order(start: Start, lighter: str) -> None:
    """As every coasting ship does: nothing acts on it."""
    start(lighter, orders=[0.1, 1.0]).step(0.0, 1.0)
