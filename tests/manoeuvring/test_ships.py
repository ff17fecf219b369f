"""The shipped ships sail: equilibrium at their service speed, turning and stopping as ships do."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import radians

import pytest

from shipcollision_fmu.manoeuvring.mmg import CALM, Machines, Orders, Six
from shipcollision_fmu.manoeuvring.mmg_3dof import Mmg3Dof
from shipcollision_fmu.ship.loading.library import list_ship_names, load_ship

from .conftest import started

SAILING = [name for name in list_ship_names() if load_ship(name).manoeuvring is not None]


@cache
def service(name: str) -> tuple[float, float]:
    table = load_ship(name).propeller
    assert table is not None
    assert table.service_speed is not None
    assert table.service_rev_per_s is not None
    return table.service_speed, table.service_rev_per_s


def test_who_sails() -> None:
    assert {"kvlcc2", "kvlcc2_l7", "kcs", "guan2014_own_manoeuvring", "guan2014_target_manoeuvring"} <= set(SAILING)


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("name", [name for name in SAILING if name != "kvlcc2_l7"])
def test_service_speed_is_near_equilibrium(name: str) -> None:
    """All but the 7 m model's, whose revolutions are those of its free-running tests, not of these equations."""
    U, n = service(name)
    ship = started(name, degrees_of_freedom=3, hydrodynamics=True, velocity=[U, 0.0, 0.0], orders=[0.0, n])
    thrust, drag = ship.outputs.propeller[0], -ship.outputs.hull[0]
    assert thrust == pytest.approx(drag, rel=0.01)


@pytest.mark.one_in(2)
@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("name", SAILING)
@pytest.mark.parametrize("degrees_of_freedom", [3, 6])
def test_turning_circle_meets_the_imo_criteria(name: str, degrees_of_freedom: int) -> None:
    """MSC.137(76): advance at most 4.5 L, tactical diameter at most 5 L; and no ship turns within two lengths."""
    L, (U, n) = load_ship(name).L_pp, service(name)
    ship = started(
        name, degrees_of_freedom=degrees_of_freedom, hydrodynamics=True, velocity=[U, 0.0, 0.0],
        orders=[radians(35.0), n], substep=0.1 if L > 50.0 else 0.05,
    )  # fmt: skip
    h, advance = 0.05 * L / U, 0.0
    for k in range(400):
        ship.step(k * h, h)
        if ship.outputs.attitude[2] < radians(90.0):
            advance = ship.outputs.position[0] / L
        if ship.outputs.attitude[2] >= radians(180.0):
            break
    assert 2.0 < advance < 4.5
    assert 2.0 < ship.outputs.position[1] / L < 5.0


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize(("name", "least", "most"), [("kcs", 10.0, 20.0), ("guan2014_target_manoeuvring", 10.0, 20.0)])
def test_container_ships_heel_far_outwards(name: str, least: float, most: float) -> None:
    """With GM_T of 0.6 m at 24 kn and the helm hard over: more than ten degrees, as masters know."""
    U, n = service(name)
    ship = started(
        name, degrees_of_freedom=6, hydrodynamics=True, velocity=[U, 0.0, 0.0], orders=[radians(35.0), n], substep=0.2
    )
    heel = 0.0
    for k in range(150):
        ship.step(2.0 * k, 2.0)
        heel = min(heel, ship.outputs.attitude[0])
    assert -radians(most) < heel < -radians(least)


def test_crash_stop() -> None:
    """Full astern from service speed: KVLCC2 within the 20 L that MSC.137(76) may allow a ship of her displacement, and
    not before the 12 L of the best VLCCs; a weaker astern thrust takes longer."""
    reach = [_stopped(factor) for factor in (1.0, 0.6)]
    assert 12.0 < reach[0] < 20.0
    assert reach[1] > 1.2 * reach[0]


def _stopped(factor: float) -> float:
    ship = load_ship("kvlcc2")
    assert ship.propeller is not None
    mmg = Mmg3Dof(replace(ship, propeller=ship.propeller.model_copy(update={"astern_factor": factor})))
    U, n = service("kvlcc2")
    eta: Six = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    nu: Six = (U, 0.0, 0.0, 0.0, 0.0, 0.0)
    machines = Machines(0.0, n, (1.0, 0.0))
    while nu[0] > 0.0:
        eta, nu, machines = mmg.advance(eta, nu, machines, Orders(0.0, -1.0), CALM, 5.0, 10)
    return eta[0] / ship.L_pp
