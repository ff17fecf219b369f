"""write_ship_file(): a ship file from length, width and type; the estimates of ship/loading/ give the rest.

A ship that coasts has a hull that is usual of its type. A ship that sails has the machinery, too: its file has no
[hull], which asks for the estimate of the whole ship. engine_reach() tells how fast its engine drives it.
"""

from __future__ import annotations

from typing import Any

from ...errors import ScenarioError
from ...ship.loading.engine_estimate import ENGINE_MARGIN, SEA_MARGIN
from ...ship.loading.library import load_ship
from ...ship.ship_type import find_ship_type, names_a_type
from ..toml_writer import format_toml
from .ais_codes import describe_ship_type
from .ship_size import ShipSize

__all__ = ["describe_kind", "find_engine_reach", "write_ship_file"]

BLOCK_COEFFICIENTS = {
    "tanker, loaded": 0.82, "bulk carrier": 0.82, "cargo vessel, loaded": 0.75, "passenger liner": 0.62, "ferry": 0.62,
}  # fmt: skip
"""C_b by type, typical values; they set the mass of a ship made from its dimensions."""
OTHER_BLOCK_COEFFICIENT = 0.65
"""C_b of the other types."""
BREADTH_TO_DRAUGHT = 3.0
"""B/T of a ship whose draught is not given."""

RESERVE = ((1.0 + SEA_MARGIN) / (1.0 - ENGINE_MARGIN)) ** (1.0 / 3.0)
"""Largest speed over service speed of an estimated engine: its margins, along the propeller law."""

KINDS = {
    "military": "naval ship", "search and rescue": "patrol vessel", "law enforcement": "patrol vessel",
    "dredging": "offshore supply vessel", "anti-pollution": "offshore supply vessel", "towing": "tug",
    "sailing": "yacht", "wing in ground": "speed boat",
}  # fmt: skip
"""A word that names a type for words of AIS and CommonOcean that do not."""


def write_ship_file(role: str, size: ShipSize, file: str, remedy: str, sails: bool) -> str:
    """The text of a ship file of the dimensions given; `file` names the file that they are from.

    Raises ScenarioError, ending with `remedy`, when length or width is missing; and for a ship wider than long.
    """
    L, B = size.length, size.width
    if L is None or B is None:
        missing = " and ".join(name for name, value in (("length", L), ("width", B)) if value is None)
        raise ScenarioError(f"{file}: {role} has no {missing}: {remedy}")
    if B >= L:
        raise ScenarioError(f"{file}: {role} is wider than long, width = {B:g} m and length = {L:g} m: check them")
    T = round(B / BREADTH_TO_DRAUGHT, 3) if size.draught is None else size.draught
    kind, is_named = describe_kind(size.kind)
    typical = BLOCK_COEFFICIENTS.get(find_ship_type(kind).name, OTHER_BLOCK_COEFFICIENT)
    C_b = typical if is_named else OTHER_BLOCK_COEFFICIENT
    draught = f"T = B/{BREADTH_TO_DRAUGHT:g}" if size.draught is None else "draught from the same file"
    estimated = "hull, mass and machinery" if sails else "hull and mass"
    tables: dict[str, dict[str, Any]] = {
        "ship": {
            "name": size.name or role,
            "kind": kind,
            "source": f"Length and width: {file}. Estimated: {draught}; C_b = {C_b:g}; {estimated} of its type.",
        },
        "particulars": {"L_pp": L, "L_oa": L, "B": B, "T": T, "C_b": C_b},
        **(_size_engine(size.top_speed) if sails else {"hull": {"shape": "parametric"}}),
    }
    return format_toml([f"Made by `shipcollision import {file}`: {role}."], tables)


def _size_engine(top_speed: float | None) -> dict[str, dict[str, Any]]:
    """Tables by which a ship's engine is estimated for its largest speed [m/s]; none: for the speed usual of its type.

    Without [hull] and the tables of the MMG set the whole ship is estimated, so nothing needs to ask for it.
    """
    if top_speed is None:
        return {}
    service_speed = round(top_speed / RESERVE, 6)
    return {"manoeuvring": {"estimate": True}, "propeller": {"service_speed": service_speed}}


def describe_kind(said: str | int | None) -> tuple[str, bool]:
    """A kind that names a type of ship, for [ship] kind, and whether the file names one."""
    words = describe_ship_type(said) if isinstance(said, int) else said
    if not words:
        return "cargo vessel (type not given)", False
    lower = words.lower()
    if "passenger" in lower and ("ro-ro" in lower or "car" in lower.split()):
        return f"{words} (ferry)", True
    if names_a_type(words):
        return words, True
    named = next((kind for word, kind in KINDS.items() if word in lower), None)
    return (f"{words} (cargo vessel)", False) if named is None else (f"{words} ({named})", True)


def find_engine_reach(ship: str) -> float | None:
    """The speed [m/s] at the engine's largest revolutions; None for a ship that can only coast."""
    loaded = load_ship(ship)
    propeller, engine = loaded.propeller, loaded.engine
    if loaded.manoeuvring is None or propeller is None or engine is None:
        return None
    if not propeller.service_speed or not propeller.service_rev_per_s:
        return None
    return propeller.service_speed * engine.max_rev_per_s / propeller.service_rev_per_s
