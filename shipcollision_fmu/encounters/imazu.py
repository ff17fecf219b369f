"""imazu(): the 22 cases of Imazu's problem, own ship and one to three targets bound for one point at one time.

    own       heading 000, from 6 NM south of the point, 12 kn, there after 30 min
    targets   each in a straight line to the same point, there at the same time: the course gives the start
              12 kn; the first target of the cases in SLOW 8.4 kn, for own to overtake

H. Imazu (1987), Research on collision avoidance manoeuvre, PhD thesis, University of Tokyo (in Japanese), as tabulated
by R. Sawada, K. Sato, T. Majima (2021), Automatic ship collision avoidance using deep reinforcement learning with LSTM
in continuous action spaces, J. Mar. Sci. Technol. 26:509-524, doi 10.1007/s00773-020-00755-0, table 4. The table was
read in three public transcriptions, which agree except in case 2. One gives the course as 090, which would lead away
from the point; the others give 270. In the table case 5 equals 8, and 15 equals 22; case 12 has two targets.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, isfinite, radians, sin
from pathlib import Path
from typing import Any

from ..errors import ScenarioError
from ..manoeuvring.trials.steady_course import find_self_propulsion
from ..scenario.scenario import Scenario, parse_scenario
from ..scenario.toml_writer import format_toml
from .encounter_file import CONTACT_LAW
from .request import FASTEST, LONGEST, count_steps
from .ship_table import build_ship_table, refer_to_ship, require_manoeuvring, round_off
from .units import KNOT

__all__ = ["COURSES", "SLOW", "Imazu", "imazu", "imazu_from_options"]

COURSES: dict[int, tuple[int, ...]] = {
    1: (180,), 2: (270,), 3: (0,), 4: (45,),
    5: (180, 270), 6: (350, 315), 7: (0, 315), 8: (180, 270), 9: (330, 270), 10: (270, 15), 11: (90, 330),
    12: (315, 350),
    13: (180, 10, 45), 14: (350, 315, 270), 15: (0, 315, 270), 16: (45, 90, 270), 17: (0, 10, 315), 18: (225, 345, 330),
    19: (15, 345, 225), 20: (0, 345, 270), 21: (345, 15, 270), 22: (0, 315, 270),
}  # fmt: skip
"""Courses of the targets by case [deg]; own steers 000. As published; a change makes it another problem."""
SLOW = frozenset({3, 7, 15, 16, 17, 20, 22})
"""Cases whose first target is slower than own, to be overtaken. As published."""
SLOW_RATIO = 0.7
"""Speed of such a target as a fraction of own's: 8.4 kn of 12 kn."""


@dataclass(frozen=True)
class Imazu:
    """A case: the file's text, its scenario, and the time at which every midship would be at n's origin [s]."""

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
    """Case 1 to 22 as a scenario file for `directory`.

    speed   own's [m/s]; the targets' follow in proportion       time    from the start to the meeting [s]
    after   from the meeting to the end [s]                      step    communication step [s]

    Other speeds and times scale the ranges and keep the geometry. Raises ScenarioError for values out of range and for
    ships that overlap at the start; ShipError for a ship that cannot be loaded.
    """
    if case not in COURSES:
        raise ScenarioError(f"Imazu case {case} does not exist: take 1 to 22")
    for name, value, least, most in (
        ("own_speed", speed, 0.1, FASTEST), ("time", time, step, LONGEST), ("after", after, step, LONGEST),
        ("step", step, 1e-3, 10.0),
    ):  # fmt: skip
        if not (isfinite(value) and least <= value <= most):
            raise ScenarioError(f"Imazu case {case}: {name} = {value:g} must be {least:g} to {most:g}: give SI units")
    steps = count_steps(time, step)
    T = steps * step
    courses = COURSES[case]
    names = ["target"] if len(courses) == 1 else [f"target_{i}" for i in range(1, len(courses) + 1)]
    ratios = [SLOW_RATIO if case in SLOW and i == 0 else 1.0 for i in range(len(courses))]
    tables: dict[str, dict[str, Any]] = {
        "scenario": {
            "name": f"imazu_{case:02d}",
            "description": f"Imazu's case {case}: own and {len(courses)} target{'s' * (len(courses) > 1)}.",
            "duration": round((steps + count_steps(after, step)) * step, 9),
            "step": step,
        }
    }
    for name, course, ratio in zip(["own", *names], (0, *courses), (1.0, *ratios), strict=True):
        file = own if name == "own" else target
        if hydrodynamics:
            require_manoeuvring(file, "leave out --hydrodynamics")
        table = _ship_table(file, round(ratio * speed, 6), course, T, hydrodynamics, Path(directory))
        tables[f"ships.{name}"] = table | {"degrees_of_freedom": degrees_of_freedom}
    tables["collision"] = CONTACT_LAW
    comment = [
        f"Made by `shipcollision encounter imazu --case {case}`: Imazu's problem, case {case} of 22.",
        f"On their courses all ships are at n's origin after {T:g} s; their hulls touch before.",
        "Imazu (1987), as tabulated by Sawada, Sato and Majima (2021), J. Mar. Sci. Technol. 26:509-524, table 4.",
    ]
    text = format_toml(comment, tables)
    return Imazu(text, parse_scenario(text, f"Imazu case {case}", directory), T)


def _ship_table(
    file: str, speed: float, course: int, time: float, hydrodynamics: bool, directory: Path
) -> dict[str, Any]:  # fmt: skip
    """The table of a ship that is at n's origin after `time` [s] on a course [deg]."""
    distance, psi = speed * time, radians(course)
    return build_ship_table(
        refer_to_ship(file, directory),
        (round_off(-distance * cos(psi), 4), round_off(-distance * sin(psi), 4)),
        float(course),
        speed,
        hydrodynamics=hydrodynamics,
        orders=[{"time": 0.0, "rudder_deg": 0.0, "rev_per_s": find_self_propulsion(file, speed)}]
        if hydrodynamics
        else None,
    )


_OPTIONS = {"own": "own", "target": "target", "own_speed": "speed", "time": "time", "after": "after", "step": "step",
            "hydrodynamics": "hydrodynamics", "degrees_of_freedom": "degrees_of_freedom"}  # fmt: skip
"""Parameters of imazu() by the names that an encounter has for them."""


def imazu_from_options(case: int | None, options: Mapping[str, Any], directory: str | Path) -> Imazu:
    """The case, with the options of an encounter by name; an option of value None counts as not given."""
    if case is None:
        raise ScenarioError("which of Imazu's cases? give --case 1 to 22")
    given = {name: value for name, value in options.items() if value is not None}
    given.pop("side", None)  # the command line always gives it
    for name in given:
        if name not in _OPTIONS:
            raise ScenarioError(f"Imazu's cases have no {name}: take {', '.join(_OPTIONS)}")
    return imazu(case, **{_OPTIONS[name]: value for name, value in given.items()}, directory=directory)
