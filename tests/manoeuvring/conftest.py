"""Ships ready to step."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import pytest

from shipcollision_fmu.manoeuvring.model import ShipManoeuvring
from tests.ship_engines import make_model, reuse_model

ZERO = (0.0, 0.0, 0.0)


@pytest.fixture
def start(engine: str) -> Callable[..., ShipManoeuvring]:
    """An initialised ship of each engine: start(ship=..., velocity=..., orders=...)."""
    return started


def started(
    ship: str = "kvlcc2", *, degrees_of_freedom: int = 6, hydrodynamics: bool = False,
    position: Sequence[float] = ZERO, attitude: Sequence[float] = ZERO, velocity: Sequence[float] = ZERO,
    rate: Sequence[float] = ZERO, substep: float = 0.05, coasting: str = "kirchhoff",
    again: bool = False, **inputs: Any,
) -> ShipManoeuvring:  # fmt: skip
    """`again`: the same ship as in the last call with it, which keeps its inputs. Inputs by name; `orders` and `wind`
    are pairs: rudder [rad] and propeller [1/s], speed [m/s] and direction [rad]."""
    model: ShipManoeuvring = reuse_model() if again else make_model()
    p = model.parameters
    p.ship, p.degrees_of_freedom, p.hydrodynamics, p.substep = ship, degrees_of_freedom, hydrodynamics, substep
    p.coasting = coasting
    p.initial_position[:], p.initial_attitude[:] = position, attitude
    p.initial_velocity[:], p.initial_rate[:] = velocity, rate
    i = model.inputs
    i.rudder_order, i.propeller_order = inputs.pop("orders", (i.rudder_order, i.propeller_order))
    i.wind_speed, i.wind_direction = inputs.pop("wind", (i.wind_speed, i.wind_direction))
    for name, values in inputs.items():
        getattr(i, name)[:] = values
    model.initialise()
    return model
