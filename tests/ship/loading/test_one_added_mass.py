"""A hull has one added mass, whether its file has manoeuvring data or not."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from shipcollision_fmu.ship.inertia import is_positive_definite
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.loading.motora_charts import Dimensions, estimate_added_mass
from tests.ship_files import ship_tables, ship_toml

SAILING: dict[str, Any] = {"estimate": True}
HULLS = {
    "barge": {},
    "container ship": {"particulars": {"L_pp": 250.0, "B": 32.2, "T": 8.5, "mass": 4.2e7}, "hull": {"depth": 18.0}},
    "boat": {"particulars": {"L_pp": 12.0, "B": 3.5, "T": 0.9, "mass": 1.8e4}, "hull": {"depth": 2.0}},
    "trimmed": {"particulars": {"r_bg": [2.0, 0.0, -1.5], "k_zz": 24.0}},
    "own sway": {"added_mass": {"m_y": 0.4}},
}  # fmt: skip


@pytest.mark.parametrize("hull", HULLS)
def test_manoeuvring_data_do_not_change_the_inertia(hull: str) -> None:
    coasting, sailing = (load_ship(ship_tables(**HULLS[hull], **more)) for more in ({}, {"manoeuvring": SAILING}))
    np.testing.assert_array_equal(sailing.M, coasting.M)


def test_an_mmg_set_without_added_mass_has_the_estimate() -> None:
    mmg = load_ship(ship_tables(manoeuvring=SAILING)).manoeuvring
    assert mmg is not None
    given = mmg.model_dump(exclude={"m_x", "m_y", "J_z"})
    np.testing.assert_array_equal(load_ship(ship_tables(manoeuvring=given)).M, load_ship(ship_tables()).M)


@pytest.mark.parametrize("degrees_of_freedom", [3, 4, 6])
def test_the_same_impact_with_and_without_manoeuvring_data(tmp_path: Any, degrees_of_freedom: int) -> None:
    """A hull of 100 m is struck by its like at right angles, well forward of midship."""
    results = []
    for name, table in (("coasting", None), ("sailing", SAILING)):
        path = tmp_path / f"{name}.toml"
        path.write_text(ship_toml(**({"manoeuvring": table} if table else {})), encoding="utf-8")
        results.append(_strike(str(path), degrees_of_freedom))
    np.testing.assert_array_equal(results[1], results[0])
    assert results[0][-1] > 1e6  # J: they met


def _strike(path: str, degrees_of_freedom: int) -> list[float]:
    """Impulse on the struck ship, its twist after applying it, and the energy lost."""
    model = ShipCollision(("own", "target"))
    for ship in model.parameters.ships:
        ship.ship, ship.degrees_of_freedom = path, degrees_of_freedom
    own, target = model.inputs.ships
    own.position[:], own.velocity[:] = [-60.2, 30.0, 0.0], [4.0, 0.0, 0.0]
    target.attitude[2] = np.pi / 2
    model.initialise()
    model.step(0.0, 0.1)
    impulse = list(model.outputs.ships[1].impulse)
    ship = ShipManoeuvring()
    ship.parameters.ship, ship.parameters.degrees_of_freedom = path, degrees_of_freedom
    ship.parameters.initial_attitude[2] = np.pi / 2
    ship.initialise()
    ship.inputs.impulse[:] = impulse
    ship.step(0.0, 1e-9)
    return [*impulse, *ship.outputs.velocity, *ship.outputs.rate, model.outputs.energy.dissipated]


def test_an_mmg_set_of_its_own_is_the_added_mass_of_both_models() -> None:
    """KVLCC2: m_x' = 0.022, m_y' = 0.223, J_z' = 0.011 over 1/2 rho L^2 T and 1/2 rho L^4 T, measured."""
    ship = load_ship("kvlcc2")
    unit = 0.5 * 1025.0 * 320.0**2 * 20.8
    assert ship.M_A[0, 0] == pytest.approx(0.022 * unit)
    assert ship.M_A[1, 1] == pytest.approx(0.223 * unit)
    assert ship.M_A[5, 5] == pytest.approx(0.011 * unit * 320.0**2)


def test_every_hull_has_a_plausible_added_mass() -> None:
    """Also far outside the charts: logs and rafts, deep and shallow, and a mass that contradicts the dimensions."""
    for LB, TB, C_b in product(
        (0.5, 1.0, 4.0, 8.0, 14.0, 40.0), (0.01, 0.1, 0.4, 0.8, 3.0), (0.1, 0.4, 0.65, 0.9, 1.5)
    ):
        d = Dimensions(100.0, 100.0 / LB, 100.0 / LB * TB, C_b, 0.0, 1025.0)
        m_x, m_y, J_z = estimate_added_mass(d)
        assert 0.01 <= m_x <= 0.3
        assert 0.05 <= m_y <= 2.0
        assert 0.01 <= J_z <= 0.15


def test_charts_reach_the_assembled_ship() -> None:
    particulars = {"mass": 2.0e6, "allow_inconsistent": "a shell with C_b 0.2"}
    assert is_positive_definite(load_ship(ship_tables(particulars=particulars)).M)
