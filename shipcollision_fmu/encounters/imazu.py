"""The 22 cases of Imazu's problem: own ship and one to three targets, all bound for one point at one time.

    own       heading 000, from 6 NM south of the point, 12 kn, there after 30 min
    targets   each in a straight line to the same point, there at the same time: their courses say where they come from
              12 kn; the first target of the cases in SLOW 8.4 kn, for own to overtake

H. Imazu (1987), Research on collision avoidance manoeuvre, PhD thesis, University of Tokyo (in Japanese), as tabulated
by R. Sawada, K. Sato, T. Majima (2021), Automatic ship collision avoidance using deep reinforcement learning with LSTM
in continuous action spaces, J. Mar. Sci. Technol. 26:509-524, doi 10.1007/s00773-020-00755-0, table 4. The table was
read in three public transcriptions, which agree but for case 2: one has its course as 090, which would lead away from
the point, the others 270. In the table cases 5 and 8 are the same, and so are 15 and 22; case 12 has two targets.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, isfinite, radians, sin
from pathlib import Path
from typing import Any

from ..errors import ScenarioError
from ..manoeuvring.trials.steady_course import self_propulsion
from ..scenario.scenario import Scenario, scenario_of
from ..scenario.toml_writer import scenario_text
from ..ship.loading.library import load_ship
from .encounter_file import ship_reference
from .request import FASTEST, whole_steps

__all__ = ["COURSES", "KNOT", "SLOW", "Imazu", "imazu", "imazu_with"]

KNOT = 1852.0 / 3600.0
"""[m/s]"""
COURSES: dict[int, tuple[int, ...]] = {
    1: (180,), 2: (270,), 3: (0,), 4: (45,),
    5: (180, 270), 6: (350, 315), 7: (0, 315), 8: (180, 270), 9: (330, 270), 10: (270, 15), 11: (90, 330),
    12: (315, 350),
    13: (180, 10, 45), 14: (350, 315, 270), 15: (0, 315, 270), 16: (45, 90, 270), 17: (0, 10, 315), 18: (225, 345, 330),
    19: (15, 345, 225), 20: (0, 345, 270), 21: (345, 15, 270), 22: (0, 315, 270),
}  # fmt: skip
"""Of the targets, by case [deg]; own steers 000."""
SLOW = frozenset({3, 7, 15, 16, 17, 20, 22})
"""Cases whose first target is slower."""
SLOW_RATIO = 0.7
"""8.4 kn of 12 kn."""


@dataclass(frozen=True)
class Imazu:
    """A case: the file's text, the scenario, and the time at which all midships would be at n's origin [s]."""

    text: str
    scenario: Scenario
    time: float


def imazu(
    case: int,
    *,
    own: str = "kvlcc2",
    target: str = "kvlcc2",
    speed: float = 12.0 * KNOT,
    time: float = 1800.0,
    after: float = 120.0,
    step: float = 0.05,
    hydrodynamics: bool = False,
    degrees_of_freedom: int | None = None,
    directory: str | Path = ".",
) -> Imazu:
    """Case 1 to 22 as a scenario file for `directory`; `speed` is own's [m/s], `time` that to the meeting [s].

    Other speeds and times scale the ranges and keep the geometry. Raises ScenarioError and ShipError in one line.
    """
    if case not in COURSES:
        raise ScenarioError(f"Imazu case {case} does not exist: take 1 to 22")
    for name, value, least, most in (
        ("own_speed", speed, 0.1, FASTEST), ("time", time, step, 7200.0), ("after", after, step, 7200.0),
        ("step", step, 1e-3, 10.0),
    ):  # fmt: skip
        if not (isfinite(value) and least <= value <= most):
            raise ScenarioError(f"Imazu case {case}: {name} = {value:g} must be {least:g} to {most:g}: give SI units")
    steps = whole_steps(time, step)
    T = steps * step
    courses = COURSES[case]
    names = ["target"] if len(courses) == 1 else [f"target_{i}" for i in range(1, len(courses) + 1)]
    ratios = [SLOW_RATIO if case in SLOW and i == 0 else 1.0 for i in range(len(courses))]
    tables: dict[str, dict[str, Any]] = {
        "scenario": {
            "name": f"imazu_{case:02d}",
            "description": f"Imazu's case {case}: own and {len(courses)} target{'s' * (len(courses) > 1)}.",
            "duration": round((steps + whole_steps(after, step)) * step, 9),
            "step": step,
        }
    }
    for name, course, ratio in zip(["own", *names], (0, *courses), (1.0, *ratios), strict=True):
        file = own if name == "own" else target
        if hydrodynamics and load_ship(file).manoeuvring is None:
            raise ScenarioError(f"ship {file!r} can only coast, she has no [manoeuvring]: leave out --hydrodynamics")
        table = _ship_table(file, round(ratio * speed, 6), course, T, hydrodynamics, Path(directory))
        tables[f"ships.{name}"] = table | {"degrees_of_freedom": degrees_of_freedom}
    tables["collision"] = {"friction": 0.3, "restitution": 0.0}
    comment = [
        f"Made by `shipcollision encounter imazu --case {case}`: Imazu's problem, case {case} of 22.",
        f"On their courses all ships are at n's origin after {T:g} s; their hulls meet before.",
        "Imazu (1987), as tabulated by Sawada, Sato and Majima (2021), J. Mar. Sci. Technol. 26:509-524, table 4.",
    ]
    text = scenario_text(comment, tables)
    return Imazu(text, scenario_of(text, f"Imazu case {case}", directory), T)


def _ship_table(
    file: str, speed: float, course: int, time: float, hydrodynamics: bool, directory: Path
) -> dict[str, Any]:  # fmt: skip
    """A ship that is at n's origin after `time` [s] on a course [deg]."""
    orders = [{"time": 0.0, "rudder_deg": 0.0, "rev_per_s": self_propulsion(file, speed)}] if hydrodynamics else None
    return {
        "ship": ship_reference(file, directory),
        "position": [round(-speed * time * f(radians(course)), 4) + 0.0 for f in (cos, sin)],
        "heading_deg": float(course),
        "speed": speed,
        "hydrodynamics": hydrodynamics or None,
        "orders": orders,
    }


_OPTIONS = {"own": "own", "target": "target", "own_speed": "speed", "time": "time", "after": "after", "step": "step",
            "hydrodynamics": "hydrodynamics", "degrees_of_freedom": "degrees_of_freedom"}  # fmt: skip


def imazu_with(case: int | None, options: Mapping[str, Any], directory: str | Path) -> Imazu:
    """From the options of an encounter by name, of which None stands for one that is not given."""
    if case is None:
        raise ScenarioError("which of Imazu's cases? give --case 1 to 22")
    given = {name: value for name, value in options.items() if value is not None}
    given.pop("side", None)  # has a default
    for name in given:
        if name not in _OPTIONS:
            raise ScenarioError(f"Imazu's cases have no {name}: take {', '.join(_OPTIONS)}")
    return imazu(case, **{_OPTIONS[name]: value for name, value in given.items()}, directory=directory)
