"""Trials of ships from four numbers, beside published ones; support for tests and benchmarks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from shipcollision_fmu.manoeuvring.trials.steady_course import SteadyCourse, find_steady_course
from shipcollision_fmu.manoeuvring.trials.trials import sail_turning_circle, sail_zigzag
from tests.oracles.published_turning import SHIPS, PublishedShip, Source
from tests.ship_files import estimated_toml

__all__ = [
    "COMPARED", "FIGURES", "TYPES", "keep_speed_without_limit", "sail_from_four_numbers", "sail_type",
    "zigzag_from_four_numbers",
]  # fmt: skip

FIGURES = ("advance", "tactical diameter", "steady radius", "drift angle", "speed kept", "10/10", "20/20")


def sail_circle(start: SteadyCourse) -> dict[str, float]:
    """The figures of a turning circle at 35 deg to starboard, by the names of published_turning.py."""
    circle = sail_turning_circle(start, 35.0)
    return {name: circle[name] for name in FIGURES[:5]}


def sail_zigzags(start: SteadyCourse) -> dict[str, float]:
    """First overshoots [deg] of the 10/10 and the 20/20 zigzag."""
    return {f"{a:g}/{a:g}": sail_zigzag(start, a, a)["first overshoot"] for a in (10.0, 20.0)}


@cache
def _sail_kcs() -> dict[str, float]:
    start = find_steady_course("kcs")
    return sail_circle(start) | sail_zigzags(start)


KCS = PublishedShip(
    "KCS", "container ship", 230.0, 32.2, 10.8, 0.651, 12.35,
    (Source("Yoshimura's set for SIMMAN 2008 (models/ships/kcs.toml), sailed by this package", "sailed", _sail_kcs),),
)  # fmt: skip
COMPARED = (*SHIPS, KCS)


@cache
def sail_from_four_numbers(ship: PublishedShip) -> Mapping[str, float]:
    """The circle of the ship estimated from L, B, T, C_b and its kind, at the speed of the published test."""
    return _sail(ship, sail_circle)


@cache
def zigzag_from_four_numbers(ship: PublishedShip) -> Mapping[str, float]:
    """First overshoots [deg] of the same ship."""
    return _sail(ship, sail_zigzags)


@cache
def keep_speed_without_limit(ship: PublishedShip) -> float:
    """Speed kept in the circle at constant revolutions: with an engine that no torque limits, as in model tests."""
    return _sail(ship, sail_circle, engine={"power": 1e13})["speed kept"]


def _sail(
    ship: PublishedShip, trial: Callable[[SteadyCourse], dict[str, float]], **tables: dict[str, float]
) -> dict[str, float]:
    four = (ship.L, ship.B, ship.T, ship.C_b)
    text = estimated_toml(*four, kind=ship.kind, propeller={"service_speed": ship.speed}, **tables)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "ship.toml"
        path.write_text(text, encoding="utf-8")
        return trial(find_steady_course(str(path)))


TYPES = {
    "car carrier": (5.9, 3.6, 0.58), "cargo vessel, loaded": (6.4, 2.4, 0.70),
    "cargo vessel, container on deck": (6.3, 2.6, 0.66), "container ship, loaded": (7.1, 3.0, 0.62),
    "destroyer": (8.3, 3.3, 0.50), "diving support vessel": (5.0, 3.0, 0.65), "drilling vessel": (5.2, 3.2, 0.68),
    "ferry": (6.0, 4.2, 0.57), "fishing vessel": (3.8, 2.3, 0.55), "liquefied natural gas tanker": (6.2, 3.9, 0.72),
    "offshore supply vessel": (4.3, 3.0, 0.68), "passenger liner": (7.2, 4.0, 0.60),
    "research vessel": (4.9, 2.8, 0.58), "speed boat": (3.5, 4.0, 0.42), "tanker, loaded": (5.7, 2.8, 0.82),
    "tanker, in ballast": (5.7, 5.0, 0.74), "tender": (4.0, 3.0, 0.50),
}  # fmt: skip
"""L/B, B/T and C_b that are usual of Blendermann's 17 types."""


def sail_type(ship_type: str, L: float, degrees_of_freedom: int, *, zigzags: bool = False) -> dict[str, float]:
    """Figures of a ship of the type, L [m] long, at its estimated service speed."""
    slenderness, flatness, C_b = TYPES[ship_type]
    B = L / slenderness
    with TemporaryDirectory() as folder:
        path = Path(folder) / "ship.toml"
        path.write_text(estimated_toml(L, B, B / flatness, C_b, kind=ship_type), encoding="utf-8")
        start = find_steady_course(str(path), degrees_of_freedom=degrees_of_freedom)
        return sail_circle(start) | (sail_zigzags(start) if zigzags else {}) | {"L/V": L / start.speed}
