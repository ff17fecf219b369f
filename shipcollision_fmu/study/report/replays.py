"""write_replay(): a row of a study computed again, run as a scenario, and its replay as a page."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from ...cosim.simulate import simulate
from ...errors import HostError, InputError, StepError, StudyError
from ...files import IN_PLACE, describe_failure
from ...scenario.scenario import load_scenario
from ...show.page import PAGE, write_page
from ..definition.study import Study, read_study
from ..engine.changes import describe_changes
from ..rows.case_scenario import write_case
from ..rows.compute import compute_rows
from .study_table import REMEDY, StudyTable

__all__ = ["Replay", "find_replay", "read_own_study", "write_replay", "write_replays"]

REPLAYS = "replays"
"""Folder of the replays in that of the study."""
OTHER_NUMBERS = (
    "row {row}: computed again on this machine it has other numbers than in the table: another processor or compiler "
    "rounds otherwise"
)


class Replay(NamedTuple):
    """The page of a row, and whether the row computed again has the numbers of the table, bit for bit."""

    row: int
    page: Path
    is_identical: bool


def read_own_study(table: StudyTable) -> tuple[Study | None, str]:
    """The study of a folder by its copy of the study file; None, and why, where no row of it can be computed again."""
    try:
        study = read_study(table.folder / "study.toml")
    except InputError as error:
        return None, str(error)
    if study.fingerprint == table.fingerprint:
        return study, ""
    return None, describe_changes(study, table.told, table.folder)


def find_replay(table: StudyTable, row: int) -> str | None:
    """The path of the replay of a row from the folder of the study; None where there is none."""
    path = f"{REPLAYS}/row-{row}/{PAGE}"
    return path if (table.folder / path).is_file() else None


def write_replays(
    table: StudyTable, study: Study, rows: Sequence[int], progress: Callable[[int, int], None] | None,
    notify: Callable[[str], None] | None,
) -> None:  # fmt: skip
    """Replays of some rows. One that cannot be made is a line to notify."""
    for done, row in enumerate(rows):
        try:
            replay = write_replay(table, study, row)
        except (InputError, StepError, HostError) as error:
            if notify is not None:
                notify(f"no replay of row {row}: {error}")
            if isinstance(error, HostError):  # a full disk, or a package that is missing: so it is for all
                return
            continue
        if notify is not None and not replay.is_identical:
            notify(OTHER_NUMBERS.format(row=row))
        if progress is not None:
            progress(done + 1, len(rows))


def write_replay(table: StudyTable, study: Study, row: int) -> Replay:
    """The replay of a row, written into the folder of the study.

    Raises StudyError for a row that is refused, that is not computed yet, or that the study does not have; HostError
    where nothing can be written, or where the engine of the study is missing.
    """
    if 0 <= row < study.rows and not table.has_row(row):
        raise StudyError(f"{table.folder}: row {row} is not computed yet: {REMEDY}")
    folder = table.folder / REPLAYS / f"row-{row}"
    with _write_whole(folder) as aside:
        path = write_case(study, row, aside)
        (again,) = compute_rows(study, row, 1, table.engine).encounters.to_pylist()
        (line,) = table.read_cases([row], list(again))
        is_native = table.engine == "native"
        simulate(load_scenario(path), engine=table.engine, in_process=not is_native, out=aside, overwrite=True)
        write_page(aside)
    return Replay(row, folder / PAGE, line == again)


@contextmanager
def _write_whole(folder: Path) -> Iterator[Path]:
    """A folder beside `folder` that takes its place at the end; after an error, such as a full disk, nothing stays."""
    is_new = not folder.parent.exists()
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(prefix=".shipcollision-", dir=folder.parent) as place:
            aside = Path(place, folder.name)
            aside.mkdir()
            try:
                yield aside
            except HostError as error:  # it names the folder that the user will look for
                raise HostError(str(error).replace(str(aside), str(folder))) from None
            if folder.exists():
                folder.rename(Path(place, "earlier"))
            aside.rename(folder)
    except OSError as error:
        raise describe_failure(folder, error, IN_PLACE) from None
    finally:
        if is_new and folder.parent.is_dir() and not any(folder.parent.iterdir()):
            folder.parent.rmdir()
