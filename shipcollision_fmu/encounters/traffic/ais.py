"""Values by which AIS says "not available", taken out of a table.

    heading 511 deg      sog 102.3 kn      cog 360 deg      lat 91, lon 181 deg      draught 0 m
    a = b = c = d = 0: no dimensions       a = c = 0, b and d not: dimensions b and d without a reference point

Recommendation ITU-R M.1371-5 (2014), annex 8, tables 48 and 51 to 53, figure 41. A course of 360 deg is north in
maritime-schema, whose writers round. It counts as "not available" where the heading says otherwise.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeGuard

from ...scenario.tracks.ais_codes import COG, HEADING, LATITUDE, LONGITUDE, SOG

__all__ = ["drop_unavailable", "drop_unavailable_sizes"]

NORTHERLY = 5.0
"""[deg] Headings within it of north agree with a course of 360."""


def drop_unavailable(initial: Any) -> Any:
    """The table `initial` of a ship without values that are "not available"; their names under `unavailable`."""
    if not isinstance(initial, Mapping):
        return initial
    kept, gone = {key: value for key, value in initial.items() if key != "unavailable"}, []
    for key, value in (("heading", HEADING), ("sog", SOG)):
        if _equals(kept.get(key), value):
            gone.append(f"{key} {value:g}")
            del kept[key]
    heading = kept.get("heading")
    if _equals(kept.get("cog"), COG) and _is_number(heading) and NORTHERLY < heading % 360.0 < 360.0 - NORTHERLY:
        gone.append(f"cog {COG:g}")
        del kept["cog"]
    position = kept.get("position")
    if isinstance(position, Mapping):
        latitude, longitude = (position.get(key, position.get(long)) for key, long in _POSITION)
        if _equals(latitude, LATITUDE) or _equals(longitude, LONGITUDE):
            gone.append("position")
            del kept["position"]
    return {**kept, "unavailable": gone}


_POSITION = (("lat", "latitude"), ("lon", "longitude"))


def drop_unavailable_sizes(dimensions: Any) -> Any:
    """The table of dimensions without those that are "not available"."""
    if not isinstance(dimensions, Mapping):
        return dimensions
    kept = dict(dimensions)
    for key in ("length", "width", "draught"):
        if _equals(kept.get(key), 0.0):
            del kept[key]
    a, b, c, d = (kept.get(key) for key in "abcd")
    if _equals(a, 0.0) and _equals(c, 0.0):
        if _is_number(b) and _is_number(d) and b > 0.0 and d > 0.0:
            kept = {"length": b, "width": d, **kept}
        for key in "abcd":
            kept.pop(key, None)
    return kept


def _is_number(value: object) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _equals(value: object, number: float) -> bool:
    return _is_number(value) and abs(value - number) < 1e-6
