"""Limits in the model description are those that the models keep: just outside is refused, the limit itself is not."""

from __future__ import annotations

import math

import pytest

from shipcollision_fmu.cosim.component import InProcessComponent
from shipcollision_fmu.cosim.simulate import run_steps
from shipcollision_fmu.errors import InputError
from shipcollision_fmu.fmi.interface import Interface
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.fmi.variable_access import VariableAccess
from shipcollision_fmu.fmi.variables import Variable
from shipcollision_fmu.scenario.scenario import load_scenario

LIMITED = [
    (made_from, line, limit, outward)
    for made_from in (COLLISION, MANOEUVRING)
    for line in made_from.table(("own", "target"))
    if line.causality == "parameter"
    for limit, outward in ((line.minimum, -math.inf), (line.maximum, math.inf))
    if limit is not None
]


@pytest.mark.parametrize(
    ("made_from", "line", "limit", "outward"), LIMITED, ids=[f"{line.name} {limit}" for _, line, limit, _ in LIMITED]
)
def test_beyond_a_limit_is_refused(made_from: Interface, line: Variable, limit: float, outward: float) -> None:
    access = made_from.make_access(("own", "target"))
    reference = access.references([line.name])
    if line.kind == "Integer":
        access.set_integer(reference, [int(limit) + (1 if outward > 0 else -1)])
    else:
        access.set_real(reference, [math.nextafter(limit, outward)])
    with pytest.raises(InputError):
        access.initialise()


def test_there_are_limits() -> None:
    names = {line.name for _, line, _, _ in LIMITED}
    assert {"friction", "restitution", "substep", "degrees_of_freedom", "own.fender.stiffness"} <= names


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
@pytest.mark.parametrize("scenario", ["guan2014", "guan2014_added_mass"])
def test_outputs_stay_within_theirs(scenario: str, algorithm: str) -> None:
    """In every step of a run with contact."""
    made: list[VariableAccess] = []

    def component(name: str, access: VariableAccess) -> InProcessComponent:
        made.append(access)
        return InProcessComponent(name, access)

    def check(done: int, total: int) -> None:
        collision = made[-1]
        for reference, line in limited:
            get = collision.get_real if line.kind == "Real" else collision.get_integer
            (value,) = get([reference])
            assert line.minimum is None or value >= line.minimum, line.name
            assert line.maximum is None or value <= line.maximum, line.name

    table = COLLISION.table(("own", "target"))
    limited = [
        (k, line)
        for k, line in enumerate(table)
        if line.causality == "output" and (line.minimum, line.maximum) != (None, None)
    ]
    assert {"impact.angle", "contact[8].impulse_normal"} <= {line.name for _, line in limited}
    loaded = load_scenario(scenario).changed(algorithm=algorithm, step=None)
    run_steps(
        loaded,
        loaded.load_ships(),
        (
            lambda name: component(name, MANOEUVRING.make_access()),
            lambda: component("collision", COLLISION.make_access()),
        ),
        check,
    )
    assert made[-1].get_integer(made[-1].references(["impact.count"])) != [0]


@pytest.mark.parametrize("made_from", [COLLISION, MANOEUVRING])
def test_numbers_and_counts_are_never_negative(made_from: Interface) -> None:
    """Of the outputs, what counts or numbers something says so."""
    for line in made_from.table(("own", "target")):
        if line.causality == "output" and line.kind == "Integer":
            assert line.minimum == 0, line.name
