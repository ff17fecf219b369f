"""Checks of a study that need its level of detail and its kinds of encounter."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...encounters.request import KINDS
from ...errors import StudyError
from .distributions import Distribution, TableColumn
from .empirical import EmpiricalTable
from .study_file import StudyFile
from .variables import IMPACT, NUMBERS, SAILED, SITUATION, SURROUNDINGS, WORDS, acts_with

__all__ = ["check_level", "find_limits"]


def check_level(
    file: StudyFile, variables: Mapping[str, Distribution], tables: Mapping[str, EmpiricalTable], source: str
) -> None:  # fmt: skip
    """Raise StudyError for a variable that does not act at the level or with the kinds of the study."""
    level, kinds = file.study.level, _list_kinds(file, variables, tables)
    if file.situations is not None:
        _check_situations(file, source)
    for name in (*variables, *file.grid):
        if name in WORDS and file.situations is not None:
            continue
        place = f"{source}: [{'grid' if name in file.grid else 'encounter'}] {name}"
        if name in NUMBERS and level not in NUMBERS[name].levels:
            raise StudyError(
                f'{place} has no effect at level = "{level}": remove it, or take level = "{NUMBERS[name].levels[0]}"'
            )
        limits = find_limits(name, file.grid, variables, tables)
        _check_astern(place, name, level, limits)
        _check_kinds(place, name, kinds, limits)
    _check_surroundings(file, source)
    place = f"{source}: [{'grid' if 'kind' in file.grid else 'encounter'}] kind"
    for kind in kinds:
        if kind != SITUATION and KINDS[kind].sailed and level != "sailed":
            raise StudyError(f'{place} = "{kind}" needs ships that steer: take level = "sailed", or another kind')


def _check_astern(place: str, name: str, level: str, limits: tuple[float, float] | None) -> None:
    """A ship that is sailed to the impact goes ahead."""
    if level == SAILED and name in ("own_speed", "target_speed") and limits is not None and limits[0] < 0.0:
        raise StudyError(f'{place} goes down to {limits[0]:g}, must be at least 0 at level = "sailed": change least')


def _check_situations(file: StudyFile, source: str) -> None:
    if file.study.level == IMPACT:
        raise StudyError(f'{source}: [situations] needs ships that move: take level = "encounter" or "sailed"')
    for name in WORDS:
        if name in file.encounter.model_fields_set or name in file.grid:
            raise StudyError(f"{source}: {name} has no effect with [situations]: remove it")


def _check_surroundings(file: StudyFile, source: str) -> None:
    given = {*file.encounter.model_fields_set, *file.grid}
    for what in ("current", "wind"):
        both = {name for name in SURROUNDINGS if name.startswith(what)}
        if len(given & both) == 1:
            (missing,) = both - given
            raise StudyError(f"{source}: [encounter] {missing} is missing: a {what} has a speed and a direction")


def _list_kinds(
    file: StudyFile, variables: Mapping[str, Distribution], tables: Mapping[str, EmpiricalTable]
) -> list[str]:
    if file.situations is not None:
        return [SITUATION]
    if "kind" in file.grid:
        return [str(word) for word in file.grid["kind"]]
    given = variables["kind"]
    if isinstance(given, TableColumn):
        return sorted(set(tables[given.table].columns[given.column].tolist()))
    return given.words()


def find_limits(
    name: str, grid: Mapping[str, list[Any]], variables: Mapping[str, Distribution],
    tables: Mapping[str, EmpiricalTable],
) -> tuple[float, float] | None:  # fmt: skip
    """Least and greatest value of a number; None of a word, and of a variable that is not given."""
    if name in WORDS or name not in (*grid, *variables):
        return None
    if name in grid:
        return min(grid[name]), max(grid[name])
    given = variables[name]
    if isinstance(given, TableColumn):
        values = tables[given.table].columns[given.column]
        return float(values.min()), float(values.max())
    return given.limits()


def _check_kinds(place: str, name: str, kinds: list[str], limits: tuple[float, float] | None) -> None:
    """A variable must act with one of the kinds at least, and its values fit all of them."""
    for kind in kinds if name == "angle_deg" and limits is not None else ():
        if kind == SITUATION:
            break
        least, most = KINDS[kind].angles
        if limits is not None and not least <= limits[0] <= limits[1] <= most:
            raise StudyError(
                f'{place} goes from {limits[0]:g} to {limits[1]:g}, must be {least:g} to {most:g} for kind "{kind}": '
                'change it, or take kind "crossing"'
            )
    if kinds and not any(acts_with(name, kind) for kind in kinds):
        able = [kind for kind in KINDS if acts_with(name, kind)]
        if kinds == [SITUATION]:
            raise StudyError(f"{place} has no effect with [situations]: remove it")
        raise StudyError(f'{place} has no effect with kind "{kinds[0]}": remove it, or take kind {" or ".join(able)}')
