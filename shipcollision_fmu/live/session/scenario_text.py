"""The scenario file of a live run: the scenario that was loaded, with the orders, current and wind as they were given.

Ship files and recordings are those beside it (input_files.py). Published results are left out: they are of another
run.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...scenario.order_schedule import find_point
from ...scenario.scenario import Scenario
from ...scenario.tables.environment import EnvironmentChange
from ...scenario.toml_writer import format_toml
from .bridge import Bridge
from .input_files import InputFiles
from .order_log import Logged

__all__ = ["write_scenario"]


def write_scenario(
    scenario: Scenario, inputs: InputFiles, steps: int, bridges: Mapping[str, Bridge],
    changes: Mapping[int, EnvironmentChange],
) -> str:  # fmt: skip
    """The text of the file, which lies beside `inputs`. `changes`: those of current and wind that people
    made, by communication point."""
    tables = scenario.model_dump(exclude_unset=True, exclude_none=True)
    step = scenario.step
    tables["scenario"]["duration"] = find_time(steps, step)
    for name, table in tables["ships"].items():
        if "ship" in table:
            table["ship"] = inputs.ships[name]
        if "track" in table:
            table["track"]["file"] = inputs.recordings[name]
            table["track"].setdefault("until", scenario.scenario.duration)  # a track depends on where it is cut
        _write_ship(table, bridges[name], steps, step)
    environment = tables.get("environment", {})
    timed = _list_changes(environment.pop("changes", []), changes, steps, step)
    if timed:
        environment["changes"] = timed
    groups = ((group, tables.get(group, {})) for group in ("ships", "obstacles"))
    named = {f"{group}.{key}": table for group, of in groups for key, table in of.items()}
    single = {"place": tables.get("place"), "collision": tables.get("collision"), "environment": environment}
    order = {"scenario": tables["scenario"], **named, **{key: table for key, table in single.items() if table}}
    return format_toml(["A live run, with all orders as they were given."], order)


def find_time(k: int, step: float) -> float:
    """A time [s] of communication point k that leads back to it, with as few digits as possible."""
    time = round(k * step, 9)
    return time if find_point(time, step) == k else k * step


def _write_ship(table: dict[str, Any], bridge: Bridge, steps: int, step: float) -> None:
    """Put the orders that were given into the table of a ship."""
    if bridge.limits is None:
        kept = [order for order in table.pop("orders", []) if order["time"] <= find_time(steps, step)]
        if kept:
            table["orders"] = kept
        return
    table.pop("orders", None)
    given = [_write_order(find_time(k, step), order) for k, order in bridge.log.list_orders() if k < max(steps, 1)]
    if given:
        table["orders"] = given
    if bridge.evasion_ended is not None and bridge.evasion_ended < steps:
        table["evasion"]["until"] = find_time(bridge.evasion_ended, step)
    if "route" not in table and not any("heading_deg" in order for order in given):
        table.pop("autopilot", None)  # a scenario with an autopilot that has nothing to steer is refused


def _write_order(time: float, order: Logged) -> dict[str, Any]:
    keys = {"rudder_deg": order.rudder_deg, "heading_deg": order.heading_deg, "rev_per_s": order.rev_per_s}
    return {"time": time, **{key: float(value) for key, value in keys.items() if value is not None}}


def _list_changes(
    timed: list[dict[str, Any]], changes: Mapping[int, EnvironmentChange], steps: int, step: float
) -> list[dict[str, Any]]:
    """The changes of the scenario up to the first that a person made, and those."""
    first = min(changes, default=steps)
    kept = [change for change in timed if find_point(change["time"], step) < first]
    made = [
        {"time": find_time(k, step), **change.model_dump(exclude_none=True, exclude={"time"})}
        for k, change in changes.items()
        if k < steps
    ]
    return [*kept, *made]
