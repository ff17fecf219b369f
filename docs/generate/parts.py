"""The parts by name, and pages filled with them."""

from __future__ import annotations

import re
from collections.abc import Callable

from . import api, batch, columns, commands, estimates, findings, published, rooms, schema, study, variables

__all__ = ["PARTS", "filled"]

PARTS: dict[str, Callable[[], str]] = {
    "ship file": schema.ship_file,
    "scenario file": schema.scenario_file,
    "estimates": estimates.estimates,
    "events": schema.events,
    "ShipCollision": variables.ship_collision,
    "ShipManoeuvring": variables.ship_manoeuvring,
    "commands": commands.commands,
    "columns": columns.columns,
    "impacts": batch.impacts,
    "encounters": batch.encounters,
    "encounter ships": batch.ships,
    "encounter collisions": batch.collisions,
    "study keys": study.keys,
    "study variables": study.variables,
    "study distributions": study.distributions,
    "study encounters": study.encounters,
    "study collisions": study.collisions,
    "findings": findings.findings,
    "api": api.api,
    "rooms": rooms.rooms,
    "guan2014": published.guan2014,
    "turning circles": published.turning_circles,
}
"""What makes the part of each name. A page that names another part ends the build."""

_MARK = re.compile(r"^<!-- generate: (.+?) -->$", re.MULTILINE)


def filled(markdown: str) -> str:
    """The text of a page with its parts put in. Raises KeyError for a part that does not exist."""
    return _MARK.sub(lambda found: PARTS[found[1]](), markdown)
