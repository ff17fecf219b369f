"""How often the first step in contact of guan2014_added_mass changes file: how far a reader has to jump to follow it.

    python benchmarks/file_changes.py

A file change is a call whose caller and callee are functions of the package defined in different files. Calls out of
the package (numpy, pybullet) do not count; a function that is called back from there counts as called by the function
of the package that called out. The way back from a call is not counted again.

The step is one of the collision model (model.py), of 0.05 s in five substeps; the two ships meet in it.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import shipcollision_fmu
from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cli.console import print_table
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.collision.model import ShipCollision

__all__ = ["count_file_changes", "file_changes_of_a_contact_step"]

SCENARIO = "guan2014_added_mass"
PACKAGE = str(Path(shipcollision_fmu.__file__).parent) + "/"

Change = tuple[str, str, str]
"""(file of the caller, file of the callee, name of the callee)."""


def count_file_changes(call: Callable[[], None]) -> Counter[Change]:
    """Calls from one file of the package into another while `call` runs."""
    changes: Counter[Change] = Counter()

    def count(frame: FrameType, event: str, _: Any) -> None:
        callee = frame.f_code.co_filename
        if event != "call" or not callee.startswith(PACKAGE):
            return
        caller = frame.f_back
        while caller is not None and not caller.f_code.co_filename.startswith(PACKAGE):
            caller = caller.f_back
        if caller is not None and caller.f_code.co_filename != callee:
            source, target = caller.f_code.co_filename[len(PACKAGE) :], callee[len(PACKAGE) :]
            changes[source, target, frame.f_code.co_name] += 1

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        call()
    finally:
        sys.setprofile(before)
    return changes


def file_changes_of_a_contact_step() -> Counter[Change]:
    """File changes of the first step of the scenario in which the hulls touch."""
    counted: list[Counter[Change]] = []
    step = ShipCollision.step

    def counting_step(model: ShipCollision, t: float, H: float) -> None:
        changes = count_file_changes(lambda: step(model, t, H))
        if model.outputs.contact_active:
            counted.append(changes)

    ShipCollision.step = counting_step  # type: ignore[method-assign]  # watched while it steps
    try:
        simulate(load_scenario(SCENARIO), in_process=True)
    finally:
        ShipCollision.step = step  # type: ignore[method-assign]  # watched while it steps
    return counted[0]


def main() -> None:
    """Count, and print the changes by file, the most frequent first."""
    changes = file_changes_of_a_contact_step()
    shown = make_table("from", "into", "function", ">changes", title=f"file changes: {sum(changes.values())}")
    for (source, target, name), number in changes.most_common():
        shown.add_row(source, target, name, str(number))
    print_table(shown)


if __name__ == "__main__":
    main()
