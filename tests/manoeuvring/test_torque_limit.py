"""An engine of limited torque: bollard pull, revolutions in a flow, and that no other ship is touched."""

from __future__ import annotations

from math import pi, sqrt
from pathlib import Path

import pytest

from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.manoeuvring.propeller import Propeller
from shipcollision_fmu.manoeuvring.torque_limit import TorqueLimit
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.propeller_torque import make_torque_law
from shipcollision_fmu.ship.ship import Ship
from tests.ship_files import ship_toml

from .conftest import started


def estimated(kind: str, L: float, B: float, T: float, C_b: float) -> str:
    """The file of a ship from four numbers."""
    size = {"L_pp": L, "B": B, "T": T, "mass": C_b * 1025.0 * L * B * T, "r_bg": None}
    return ship_toml(ship={"kind": kind}, particulars=size, hull={"depth": 1.5 * T}, manoeuvring={"estimate": True})


TUG, TANKER = estimated("tug", 29.0, 11.0, 4.8, 0.55), estimated("tanker", 174.0, 32.2, 11.0, 0.79)


def written(folder: Path, text: str) -> str:
    path = folder / "ship.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def torque_of(ship: Ship, u_P: float, n: float) -> float:
    """[N m]"""
    table = ship.propeller
    assert table is not None
    law = make_torque_law(table.k_0, table.k_1, table.k_2)
    thrust = Propeller(ship, table).compute_thrust(u_P, n) / (ship.rho * table.D_p**2)
    return ship.rho * table.D_p**3 * law.compute(thrust, u_P, n * table.D_p)


def limit_of(ship: Ship) -> tuple[TorqueLimit, float]:
    """The limit, and the engine's torque [N m]."""
    assert ship.propeller is not None
    assert ship.engine is not None
    assert ship.engine.power is not None
    limit = Propeller(ship, ship.propeller).limit_torque(ship.engine)
    assert limit is not None
    return limit, ship.engine.power / (2.0 * pi * ship.engine.max_rev_per_s)


def on_the_spot(path: str) -> ShipManoeuvring:
    return started(path, degrees_of_freedom=3, hydrodynamics=True, orders=[0.0, 99.0], substep=0.2)


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("text", [TUG, TANKER], ids=["tug", "tanker"])
def test_bollard_pull_is_that_of_the_rule_of_thumb(text: str, tmp_path: Path) -> None:
    """0.9 x 1.10/100 t for each brake horsepower of an open propeller of fixed pitch (Hensen, Tug use in port, known
    from secondary sources), a third either way. Without a limit of torque it was two to three times the rule."""
    ship = load_ship(written(tmp_path, text))
    assert ship.engine is not None
    assert ship.engine.power is not None
    assert ship.propeller is not None
    model = on_the_spot(str(tmp_path / "ship.toml"))
    pull = model.outputs.propeller[0] / (1.0 - ship.propeller.t_P)
    rule = ship.engine.power / 745.7 * 0.9 * 1.10 / 100.0 * 9806.65
    assert 0.67 * rule < pull < 1.33 * rule


@pytest.mark.usefixtures("engine")
def test_on_the_spot_the_revolutions_fall_to_three_quarters(tmp_path: Path) -> None:
    """The torque coefficient on the spot is 1.6 to 2 times that at service speed; the engine gives no more torque."""
    path = written(tmp_path, TANKER)
    ship = load_ship(path)
    limit, most_torque = limit_of(ship)
    model = on_the_spot(path)
    n = model.outputs.propeller_speed
    assert n == limit.find_range(0.0)[1]
    assert torque_of(ship, 0.0, n) == pytest.approx(most_torque, rel=1e-3)
    assert ship.engine is not None
    assert 0.6 < n / ship.engine.max_rev_per_s < 0.85


@pytest.mark.parametrize("u_P", [-3.0, 0.0, 1.3, 4.0, 6.5])
def test_the_torque_is_the_engines_at_both_limits(u_P: float, tmp_path: Path) -> None:
    """Between two places of the table as well; astern a flow from ahead may hold the propeller."""
    ship = load_ship(written(tmp_path, TANKER))
    limit, most_torque = limit_of(ship)
    least, most = limit.find_range(u_P)
    assert least <= 0.0 < most
    assert torque_of(ship, u_P, most) == pytest.approx(most_torque, rel=0.02)
    assert least == 0.0 or -torque_of(ship, u_P, least) == pytest.approx(most_torque, rel=0.02)


def test_what_is_surely_free_is_within_the_limit(tmp_path: Path) -> None:
    """At any speed and drift. At service speed and revolutions, where ships sail for hours, the glance is enough."""
    ship = load_ship(written(tmp_path, TANKER))
    limit, _ = limit_of(ship)
    assert ship.propeller is not None
    assert ship.propeller.service_speed is not None
    assert ship.propeller.service_rev_per_s is not None
    assert limit.is_surely_free(ship.propeller.service_speed, ship.propeller.service_rev_per_s)
    propeller = Propeller(ship, ship.propeller)
    for u in (0.0, 0.3, 2.0, 5.0, 7.7, 30.0):
        for beta in (-0.5, 0.0, 0.5):
            most = limit.find_range(propeller.compute_inflow(u, 10.0, beta, 0.0))[1]
            assert not limit.is_surely_free(u, most * (1.0 + 1e-9))
    assert not limit.is_surely_free(-1.0, 0.1)


def test_power_goes_with_the_cube_of_the_revolutions(tmp_path: Path) -> None:
    """Twice the power at the same rated revolutions: sqrt(2) of the revolutions on the spot."""
    ship = load_ship(written(tmp_path, TANKER))
    assert ship.engine is not None
    assert ship.engine.power is not None
    assert ship.propeller is not None
    propeller = Propeller(ship, ship.propeller)
    one = propeller.limit_torque(ship.engine)
    two = propeller.limit_torque(ship.engine.model_copy(update={"power": 2.0 * ship.engine.power}))
    slower = propeller.limit_torque(ship.engine.model_copy(update={"rated_rev_per_s": 0.5 * ship.engine.max_rev_per_s}))
    assert one is not None
    assert two is not None
    assert slower is not None
    assert two.find_range(0.0)[1] == pytest.approx(sqrt(2.0) * one.find_range(0.0)[1], rel=1e-9)
    assert slower.find_range(0.0) == pytest.approx(two.find_range(0.0), rel=1e-9)


@pytest.mark.usefixtures("engine")
def test_the_engine_follows_its_limit_as_the_ship_gathers_way(tmp_path: Path) -> None:
    path = written(tmp_path, TANKER)
    model, speeds = on_the_spot(path), []
    for k in range(20):
        model.step(20.0 * k, 20.0)
        speeds.append(model.outputs.propeller_speed)
    ship = load_ship(path)
    assert ship.engine is not None
    assert speeds == sorted(speeds)
    assert speeds[-1] > 1.15 * speeds[0]
    assert speeds[-1] <= ship.engine.max_rev_per_s


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("degrees_of_freedom", [4, 6])
def test_it_is_the_same_in_all_degrees_of_freedom(degrees_of_freedom: int, tmp_path: Path) -> None:
    path = written(tmp_path, TANKER)
    runs = []
    for free in (3, degrees_of_freedom):
        model = started(
            path,
            degrees_of_freedom=free,
            hydrodynamics=True,
            velocity=[3.0, 0.0, 0.0],
            orders=[0.0, 99.0],
            current=[0.5, 0.0],
        )
        model.step(0.0, 5.0)
        runs.append(model.outputs.propeller_speed)
    assert runs[1] == pytest.approx(runs[0], rel=1e-3)


@pytest.mark.usefixtures("engine")
def test_an_engine_of_unknown_power_has_no_limit() -> None:
    """KVLCC2 and its model sail as the free-running tests did, at constant revolutions."""
    ship = load_ship("kvlcc2")
    assert ship.propeller is not None
    assert ship.engine is not None
    assert Propeller(ship, ship.propeller).limit_torque(ship.engine) is None
    model = started("kvlcc2", degrees_of_freedom=3, hydrodynamics=True, orders=[0.0, 1.2268])
    model.step(0.0, 10.0)
    assert model.outputs.propeller_speed == 1.2268
