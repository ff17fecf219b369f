"""write_case(): a case of a study as a scenario file, which is run and shown as any other.

level impact      begins a thousandth of a second before the impact; the run goes on after the first contact
level encounter   the run of the row, to rounding
level sailed      the run of the row
situations        the run of the row
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from ...errors import StudyError
from ...files import is_file, write_files
from ...scenario.scenario import Scenario
from ...scenario.toml_writer import format_toml
from ...ship.loading.toml import parse_toml
from ..definition.study import Study
from ..definition.variables import IMPACT, SAILED
from .cases import Cases, draw_cases
from .compute import choose_engine
from .encounter_rows import make_coasting_scenario, make_impact_scenario
from .fleet_ships import find_ship
from .impact_rows import PAIRS, as_cases
from .sailed_rows import make_sailed_scenario
from .ship_folder import ShipFolder
from .situation_rows import draw_into, make_situation

__all__ = ["write_case"]


def write_case(study: Study, row: int, out: str | Path) -> Path:
    """The path of the scenario file of a row, written with its ship files into the folder `out`.

    Raises StudyError for a row that the study does not have, and for a case that is refused; HostError for a folder
    that cannot be written.
    """
    if not isinstance(row, int | np.integer) or not 0 <= row < study.rows:
        raise StudyError(f"{study.source}: row = {row!r} is not in the study: it has rows 0 to {study.rows - 1}")
    cases, name = draw_cases(study, row, 1), f"{study.name}_{row}"
    with ShipFolder() as ships, TemporaryDirectory(prefix="shipcollision-") as folder:
        scenario = _make_scenario(study, row, cases, ships, Path(folder, "situation"))
        files = _describe(scenario, study, name, row)
    write_files(Path(out), files)
    return Path(out, f"{name}.toml")


def _make_scenario(study: Study, row: int, cases: Cases, ships: ShipFolder, folder: Path) -> Scenario:
    if study.situations:
        key = str(cases.situation[0]), int(cases.ships["own"][0]), int(cases.ships["target"][0])
        made = make_situation(study, key, ships, folder)
        if isinstance(made, str):
            raise StudyError(f"{study.source}: row {row} is refused: {made}")
        return draw_into(made, cases, 0)
    if study.level == SAILED:
        return make_sailed_scenario(study, cases, 0, ships)
    own, target = (find_ship(study, role, int(cases.ships[role][0])) for role in ("own", "target"))
    impacts = PAIRS[choose_engine("auto")].find(own, target, study.run.degrees_of_freedom)
    (found,) = impacts.run(as_cases(cases))
    if found["status"]:
        raise StudyError(f"{study.source}: row {row} is refused: {found['reason'].decode()}")
    make = make_impact_scenario if study.level == IMPACT else make_coasting_scenario
    return make(study, {"own": ships.write(own), "target": ships.write(target)}, found, cases, 0)


def _describe(scenario: Scenario, study: Study, name: str, row: int) -> dict[str, str | bytes]:
    """The scenario file and, beside it, the files of its ships and their meshes, by name."""
    tables, files = scenario.model_dump(exclude_unset=True, exclude_none=True), dict[str, str | bytes]()
    tables["scenario"].update(name=name, description=f"Row {row} of the study {study.name}.")
    for role, table in tables["ships"].items():
        path = Path(scenario.ship_file(role))
        if is_file(path):
            table["ship"] = f"{name}_{role}.toml"
            files |= _read_ship(path, f"{name}_{role}")
    groups = ((group, tables.get(group, {})) for group in ("ships", "obstacles"))
    named = {f"{group}.{key}": table for group, of in groups for key, table in of.items()}
    single = {group: tables[group] for group in ("scenario", "collision", "environment") if tables.get(group)}
    order = {"scenario": single.pop("scenario"), **named, **single}
    return {**files, f"{name}.toml": format_toml([f"Row {row} of the study {study.name}."], order)}


def _read_ship(path: Path, name: str) -> dict[str, str | bytes]:
    """A ship file and its mesh under a name. The mesh of a study is in a temporary folder of this process."""
    text = path.read_text(encoding="utf-8")
    tables = parse_toml(text, path.name, StudyError)
    if "file" not in tables.get("hull", {}):
        return {f"{name}.toml": text}
    mesh = Path(tables["hull"]["file"])
    own = f"{name}{mesh.suffix}"
    tables["hull"]["file"] = own
    return {f"{name}.toml": format_toml((), tables), own: (path.parent / mesh).read_bytes()}
