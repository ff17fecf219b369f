"""`nmea`: a finished run as a log of NMEA 0183 and AIS sentences."""

from __future__ import annotations

from pathlib import Path

import click

from .console import say
from .options import PATH

__all__ = ["nmea"]

FILE = "run.nmea"
LEFT_OUT = (
    ((b"RSA,", b"RPM,"), "left out: rudder and revolutions (RSA, RPM), which machinery.csv does not have of this ship"),
    ((b"MWV,",), "left out: wind (MWV), as the folder has no surroundings.csv"),
)
"""Kinds of sentences, and the line where the log has none of them."""


@click.command()
@click.argument("folder", metavar="DIR", type=PATH)
@click.option("--ship", metavar="NAME", help="Own ship, whose instruments speak.  [default: the first]")
@click.option("--tags", is_flag=True, help="A TAG block with the time before each sentence; a track needs it.")
@click.option("--out", type=PATH, metavar="FILE", help=f"The log.  [default: DIR/{FILE}]")
def nmea(folder: Path, ship: str | None, tags: bool, out: Path | None) -> None:
    """Write a run's NMEA and AIS sentences.

    DIR is its folder. Charting programs replay the log: own ship by RMC, GGA, VTG, HDT, ROT, RSA, RPM and MWV, all
    ships by AIS. A scenario's [place] says where and when; without it the ships are at 54 N 7 E on 1 January 2026.
    """
    from ..files import write_file
    from ..live.extra import require_protocols
    from ..live.protocols.run_log import write_log

    require_protocols()
    log, fleet = write_log(folder, ship, tags=tags)
    path = write_file(out if out is not None else folder / FILE, log)
    say(f"{path}: {log.count(bytes([10]))} sentences of {fleet.own}, and AIS of {len(fleet.identities)} ships")
    for kinds, said in LEFT_OUT:
        if not any(kind in log for kind in kinds):
            say(said)
