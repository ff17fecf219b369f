"""Mass, depth and the lengths of bow and stern of a ship whose file leaves them out.

    mass = C_b rho L_pp B T
    depth = T times (depth/T of its type)     bow_length, stern_length = L_oa times the shares of its type

The forms are usual ones of ships in service, found by comparing with ships whose figures are published, not by a
published rule: depth of KVLCC2 30 m, KCS 19 m, S-175 15.4 m and of a 47 000 dwt tanker 17.5 m are met within 10 %. The
depth is that of the deck which a collision meets: of car carriers, ferries and passenger ships an upper one.

With these, the main dimensions alone make a whole ship: a file without [hull] and without any table of the MMG set
sails by the estimate of mmg_estimate.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import Any, NamedTuple

from ..ship_type import find_ship_type
from ..tables.hull import MESH_KEYS
from ..tables.particulars import RHO_SEA, ShipTable

__all__ = ["complete_dimensions", "estimate_hull", "is_estimable"]


class Form(NamedTuple):
    """Depth over T, and the lengths of bow and stern over L_oa; shares above 0.5 would leave no midbody."""

    depth: float
    bow: float
    stern: float


FORMS = {
    "tanker, loaded": Form(1.45, 0.17, 0.27), "tanker, in ballast": Form(2.70, 0.17, 0.27),
    "bulk carrier": Form(1.40, 0.15, 0.24), "liquefied natural gas tanker": Form(2.20, 0.20, 0.26),
    "cargo vessel, loaded": Form(1.40, 0.22, 0.24), "cargo vessel, container on deck": Form(1.45, 0.24, 0.24),
    "container ship, loaded": Form(1.80, 0.27, 0.26), "car carrier": Form(3.40, 0.25, 0.22),
    "ferry": Form(2.30, 0.30, 0.22), "passenger liner": Form(2.40, 0.30, 0.22),
    "drilling vessel": Form(1.70, 0.17, 0.17), "offshore supply vessel": Form(1.25, 0.25, 0.10),
    "diving support vessel": Form(1.50, 0.25, 0.12), "research vessel": Form(1.50, 0.30, 0.20),
    "destroyer": Form(1.90, 0.40, 0.20), "fishing vessel": Form(1.35, 0.35, 0.20), "tug": Form(1.25, 0.35, 0.20),
    "tender": Form(2.00, 0.35, 0.15), "speed boat": Form(2.20, 0.45, 0.10),
}  # fmt: skip
"""By type of ship. With other depths the ship is struck above or below its deck, and KG, GM and windage differ."""

UNSAID: str = ShipTable.model_fields["kind"].default

MMG_TABLES = ("manoeuvring", "propeller", "rudder", "engine")


def complete_dimensions(data: Mapping[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """The tables of a ship file with mass and [hull] completed where the main dimensions suffice; a note on each."""
    done, notes = dict(data), list[str]()
    p = data.get("particulars")
    if not isinstance(p, Mapping):
        return done, notes
    sizes = _read_numbers(p, "L_pp", "B", "T", "rho")
    if sizes is None:
        return done, notes
    L, B, T, rho = sizes
    if "mass" not in p and (C_b := _read_numbers(p, "C_b")) is not None:
        mass = C_b[0] * rho * L * B * T
        done["particulars"] = {**p, "mass": mass}
        notes.append(f"mass = {mass:.6g} kg (C_b rho L_pp B T)")
    if not any(name in data for name in ("hull", *MMG_TABLES)) and "allow_inconsistent" not in p:
        done["manoeuvring"] = {"estimate": True}
    kind, hull = _read_kind(data), data.get("hull", {})
    if kind == UNSAID and "kind" not in data.get("ship", {}):
        notes.append(f'[ship] kind = "{UNSAID}" (none is given)')
    L_oa = (_read_numbers(p, "L_oa") or (L,))[0]
    if kind is not None and isinstance(hull, Mapping):
        values, note = estimate_hull(kind, L_oa, T, hull)
        if note:
            done["hull"] = {**hull, **values}
            notes.append(note)
    return done, notes


def estimate_hull(kind: str, L_oa: float, T: float, given: Mapping[str, Any]) -> tuple[dict[str, Any], str]:
    """The keys of [hull] that are missing in `given`, and a note on them; none for a hull from a mesh file."""
    if given.get("shape") == "mesh" or MESH_KEYS & given.keys():
        return {}, ""
    of = find_ship_type(kind)
    form, values = FORMS[of.name], dict[str, Any]()
    if "shape" not in given:
        values["shape"] = "parametric"
    if "depth" not in given:
        values["depth"] = form.depth * T
    if given.get("shape", "parametric") == "parametric":
        for key, share, other in (("bow_length", form.bow, "stern_length"), ("stern_length", form.stern, "bow_length")):
            if key not in given:
                (rest,) = _read_numbers(given, other) or (0.0,)
                values[key] = min(share * L_oa, 0.9 * max(L_oa - rest, 0.1 * L_oa))
    said = ", ".join(f"{key} = {_format(value)}" for key, value in values.items())
    return values, f"[hull] {said} (usual of a {of.name})" if said else ""


def is_estimable(place: tuple[int | str, ...]) -> bool:
    """Whether the main dimensions can give what is missing at that place of a file."""
    return place in (("hull",), ("hull", "shape"), ("hull", "depth"), ("hull", "bow_length"), ("hull", "stern_length"))


def _read_kind(data: Mapping[str, Any]) -> str | None:
    """The kind; that of a cargo vessel where none is given, None where it is no text, which validation refuses."""
    ship = data.get("ship", {})
    kind = ship.get("kind", UNSAID) if isinstance(ship, Mapping) else None
    return kind if isinstance(kind, str) else None


def _read_numbers(table: Mapping[str, Any], *keys: str) -> tuple[float, ...] | None:
    """The values of the keys, if all are positive numbers; validation says what the others are."""
    values = [table.get(key, RHO_SEA if key == "rho" else None) for key in keys]
    if not all(isinstance(v, int | float) and not isinstance(v, bool) and isfinite(v) and v > 0 for v in values):
        return None
    return tuple(float(v) for v in values if v is not None)


def _format(value: object) -> str:
    return f"{value:.4g} m" if isinstance(value, float) else f'"{value}"'
