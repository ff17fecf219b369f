"""The sentences of a finished run as a file, from the run's folder alone.

Without machinery.csv there is no RSA and no RPM, without surroundings.csv no MWV: another master need not write them.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from datetime import datetime
from functools import reduce
from operator import xor
from pathlib import Path
from typing import Any

from ...errors import InputError
from ...scenario.tables.place import EVERYWHERE, Place
from ...scenario.tracks.tangent_plane import TangentPlane
from ...ship.ship_state import ShipState
from ...show.scene.machinery import read_machinery, read_wind
from ...show.scene.run_folder import RunFolder, read_run_folder
from .feeds import Fleet, NmeaFeed
from .identity import Hull, make_identity
from .sample import Sample, ShipSample, Wind

__all__ = ["list_samples", "make_fleet", "write_log"]


def write_log(folder: Path, own: str | None = None, *, tags: bool = False) -> tuple[bytes, Fleet]:
    """The log of the run in `folder` as seen from a ship (default: the first), and its ships.

    tags: each sentence has a TAG block with its time, which a scenario's `track` needs. Raises InputError for a folder
    that holds no run, and for a ship that is not there.
    """
    run = read_run_folder(folder)
    fleet = make_fleet(run, own)
    feed, lines = NmeaFeed(fleet), list[bytes]()
    for sample in list_samples(run):
        sentences = feed.take(sample)
        tag = _tag(fleet.time(sample.time)) if tags else b""
        lines += [tag + sentence for sentence in sentences]
    return b"".join(lines), fleet


def make_fleet(run: RunFolder, own: str | None = None) -> Fleet:
    """The ships of a run, with what its summary says of them. Raises InputError for an `own` that is not there."""
    summary = json.loads((run.path / "summary.json").read_text(encoding="utf-8"))
    names = list(run.bodies.ships)
    own = names[0] if own is None else own
    if own not in names:
        raise InputError(f"{run.path} has no ship {own!r}: the ships are {', '.join(names)}")
    place = Place.model_validate_json(json.dumps(summary["place"])) if "place" in summary else EVERYWHERE
    identities = {}
    for i, (name, body) in enumerate(run.bodies.ships.items()):
        told: dict[str, Any] = summary["ships"].get(name, {})
        hull = Hull(body.kind, body.L_oa, body.B, body.T, float(told.get("mass", 0.0)))
        identities[name] = make_identity(i, name, hull, told.get("ais", {}), told.get("track", {}).get("mmsi"))
    return Fleet(own, identities, TangentPlane(place.latitude, place.longitude), place.start)


def list_samples(run: RunFolder) -> Iterator[Sample]:
    """The run at its communication points. Raises InputError for tables that are not whole."""
    names = list(run.bodies.ships)
    machinery = {name: table.tolist() for name, table in read_machinery(run).items()}
    table = read_wind(run)
    wind = None if table is None else table.tolist()
    for k, (time, row) in enumerate(zip(run.times.tolist(), run.states.tolist(), strict=True)):
        ships = {
            name: ShipSample(ShipState(*state), *(machinery[name][k] if name in machinery else ()))
            for name, state in zip(names, row, strict=True)
        }
        yield Sample(time, ships, None if wind is None else Wind(*wind[k]))


def _tag(time: datetime) -> bytes:
    r"""The TAG block of a time, in milliseconds since 1970: \c:1767225600000*HH\."""
    content = f"c:{round(time.timestamp() * 1000.0)}".encode()
    return b"\\%s*%02X\\" % (content, reduce(xor, content))
