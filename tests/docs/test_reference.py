"""The reference pages against the tables in the code: every key, variable, option, column and name is on its page.

The pages come from the JSON schema and from the arrays of FMI 3.0. Here the same things are found in another way: from
the pydantic models themselves, from the model descriptions, and from a run.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from itertools import product
from pathlib import Path
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

import click
import pytest
from pydantic import BaseModel

import shipcollision_fmu
from docs.generate.parts import PARTS, filled
from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.cli import main
from shipcollision_fmu.fmi.builder.package import VERSIONS
from shipcollision_fmu.fmi.interface import SHIPS, Interface
from shipcollision_fmu.fmi.ship_collision import INTERFACE as COLLISION
from shipcollision_fmu.fmi.ship_manoeuvring import INTERFACE as MANOEUVRING
from shipcollision_fmu.scenario.scenario import Scenario
from shipcollision_fmu.scenario.tables.environment import CurrentTable
from shipcollision_fmu.ship.loading.ship_file import ShipFile

PAGES = Path(__file__).parents[2] / "docs"
FMUS = {"ship-collision.md": COLLISION, "ship-manoeuvring.md": MANOEUVRING}


@cache
def page(name: str) -> str:
    """A page as MkDocs gets it."""
    return filled((PAGES / name).read_text(encoding="utf-8"))


def rows(text: str) -> list[list[str]]:
    """The cells of all rows of all tables; a bar within code does not end a cell."""
    found = []
    for line in text.splitlines():
        if line.startswith("| ") and not line.startswith("| ---"):
            guarded = re.sub(r"`[^`]*`", lambda code: code[0].replace("|", "\0"), line)
            found.append([cell.strip().replace("\0", "|") for cell in guarded[2:-2].split(" | ")])
    return found


# -- files ------------------------------------------------------------------------------------------------------------


def keys(model: type[BaseModel], place: str = "") -> Iterator[str]:
    """Every key below a pydantic model: `ships.NAME.orders[].time`."""
    for name, field in model.model_fields.items():
        path = f"{place}.{name}" if place else name
        yield path
        yield from _inner(field.annotation, path)


def _inner(annotation: Any, path: str) -> Iterator[str]:
    origin, arguments = get_origin(annotation), get_args(annotation)
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield from keys(annotation, path)
    elif origin is Annotated:
        yield from _inner(arguments[0], path)
    elif origin in (Union, UnionType):
        for argument in arguments:
            yield from _inner(argument, path)
    elif origin is list:
        yield from _inner(arguments[0], f"{path}[]")
    elif origin is dict:
        yield from _inner(arguments[1], f"{path}.NAME")


@pytest.mark.parametrize(("name", "model"), [("ship-file.md", ShipFile), ("scenario-file.md", Scenario)])
def test_every_key_of_a_file_is_on_its_page(name: str, model: type[BaseModel]) -> None:
    expected = [*keys(model), *(keys(CurrentTable, "environment.current") if model is Scenario else ())]
    assert len(expected) > 60
    assert re.findall(r"`\{ #(\S+) \}", page(f"reference/{name}")) != []
    assert sorted(re.findall(r"^\| `\w+`\{ #(\S+) \}", page(f"reference/{name}"), re.MULTILINE)) == sorted(expected)


def test_rows_have_type_unit_limits_default_and_meaning() -> None:
    found = {row[0].partition("{ #")[2].removesuffix(" }"): row for row in rows(page("reference/ship-file.md"))}
    assert found["particulars.L_pp"][1:] == ["number", "m", "> 0", "required", "the length between perpendiculars"]
    assert found["propeller.t_P"][3] == "≥ 0, < 1"
    assert found["rudder.max_angle_deg"][1:5] == ["number", "deg", "> 0, ≤ 90", "`35.0`"]
    assert found["particulars.r_bg"][1:3] == ["list (3) of numbers", "m"]
    assert all(len(row) == 6 for row in found.values())


def test_the_start_values_of_the_fmu_are_the_defaults_of_its_parameters() -> None:
    found = {row[0].partition("{ #")[2].removesuffix(" }"): row for row in rows(page("reference/scenario-file.md"))}
    assert found["collision.friction"][4] == "`0.3` (of the FMU)"
    assert found["collision.response"][1] == 'one of `"pgs"`, `"closed_form"`, `"bullet"`'
    assert found["collision.response"][4] == '`"pgs"` (of the FMU)'


@pytest.mark.needs("pybullet")
@pytest.mark.parametrize("part", [part for part in PARTS if part != "api"])
def test_braces_of_the_text_are_escaped(part: str) -> None:
    """attr_list takes `{...}` at the end of a cell or a paragraph for attributes, and the reader misses it."""
    text = re.sub(r"^```.*?^```", "", PARTS[part](), flags=re.DOTALL | re.MULTILINE)
    outside = re.sub(r"`[^`]*`", "", re.sub(r"\{ #\S+ \}", "", text))
    assert re.findall(r"(?<!\\)[{}].*", outside) == []


@pytest.mark.parametrize("name", ["ship-file.md", "scenario-file.md"])
def test_every_key_has_a_meaning(name: str) -> None:
    silent = [row[0] for row in rows(page(f"reference/{name}")) if not row[-1]]
    assert silent == []


@pytest.mark.needs("pybullet")
def test_every_key_of_events_json_is_on_its_page() -> None:
    """Those of a real run, and those that the schema requires anywhere."""
    text = page("reference/run-folder.md")
    schema = (Path(shipcollision_fmu.__file__).parent / "results" / "events.schema.json").read_text("utf-8")
    named = {key for found in re.findall(r'"required": (\[.*?\])', schema) for key in json.loads(found)}
    assert len(named) > 30
    assert {key for key in named if f"| `{key}`{{ #" not in text} == set()


# -- variables --------------------------------------------------------------------------------------------------------


def expanded(pattern: str) -> list[str]:
    """The names that `contact[1..8].normal.north|east|down` stands for."""
    choices: list[list[str]] = []
    for part in re.split(r"\.(?!\.|\d)", pattern):
        if found := re.fullmatch(r"(\w+)\[1\.\.(\d+)\]", part):
            choices.append([f"{found[1]}[{i}]" for i in range(1, int(found[2]) + 1)])
        else:
            choices.append(part.split("|"))
    return [".".join(parts) for parts in product(*choices)]


def patterns(name: str) -> list[tuple[str, str]]:
    """First two columns of the tables of variables: patterns of FMI 2.0, arrays of FMI 3.0."""
    return re.findall(r"^\| `([^`]+)`\{ #\S+ \} \| `([^`]+)` \|", page(f"reference/{name}"), re.MULTILINE)


def for_all_ships(names: list[str]) -> list[str]:
    first = f"{SHIPS[0]}."
    others = [f"{ship}.{name.removeprefix(first)}" for ship in SHIPS[1:] for name in names if name.startswith(first)]
    return [*names, *others]


@pytest.mark.parametrize(("name", "interface"), FMUS.items())
def test_every_variable_of_both_versions_is_on_its_page(name: str, interface: Interface) -> None:
    scalars = for_all_ships([scalar for pattern, _ in patterns(name) for scalar in expanded(pattern)])
    description = VERSIONS[2].description(interface, SHIPS, "", None)
    assert sorted(scalars) == sorted(variable.get("name") for variable in description.iter("ScalarVariable"))
    arrays = for_all_ships([array.partition("[")[0] for _, array in patterns(name)])
    description = VERSIONS[3].description(interface, SHIPS, "", None)
    variables = [variable for variable in next(description.iter("ModelVariables")) if variable.get("name") != "time"]
    assert sorted(arrays) == sorted(variable.get("name") for variable in variables)


@pytest.mark.parametrize(("name", "interface"), FMUS.items())
def test_units_meanings_and_references_are_those_of_the_table(name: str, interface: Interface) -> None:
    text, table = page(f"reference/{name}"), interface.table(SHIPS)
    by_first = {re.search(r"#(\S+) \}", row[0])[1]: row for row in rows(text) if "{ #" in row[0]}  # type: ignore[index]  # such a row has one
    for line in table:
        if line.name in by_first:
            assert (line.unit or "") in by_first[line.name]
    for reference, line in enumerate(table):
        assert f"    | {reference} | `{line.name}` |" in text


# -- commands, columns, names -----------------------------------------------------------------------------------------


def test_every_option_of_every_command_is_on_its_page() -> None:
    sections = dict(
        re.findall(r"^## `(\S+)`\n(.*?)(?=^## |\Z)", page("reference/commands.md"), re.MULTILINE | re.DOTALL)
    )
    assert set(sections) == set(main.commands)
    for name, command in main.commands.items():
        for parameter in command.params:
            if isinstance(parameter, click.Option):
                assert all(option in sections[name] for option in (*parameter.opts, *parameter.secondary_opts))


@pytest.mark.needs("pybullet")
def test_every_column_and_key_of_a_run_is_on_its_page() -> None:
    run = simulate(load_scenario("guan2014"), in_process=True)
    text = page("reference/run-folder.md")
    first = f"{SHIPS[0]}."
    columns = [column for column in run.states.dtype.names if column == "time" or column.startswith(first)]
    sailed = simulate(load_scenario("kvlcc2_crossing"), step=1.0, in_process=True)
    conning = (*sailed.machinery.dtype.names[:3], *sailed.surroundings.dtype.names)
    for name in (*columns, *run.contacts.dtype.names, *run.signals.dtype.names, *conning, *run.summary, *run.timing):
        assert f"`{name}`" in text, name


def test_every_exported_name_is_on_its_page() -> None:
    text = page("reference/python.md")
    for name in shipcollision_fmu.__all__:
        thing = getattr(shipcollision_fmu, name)
        if hasattr(thing, "__qualname__"):
            assert f"::: {thing.__module__}.{thing.__qualname__}\n" in text


def test_every_part_is_on_a_page() -> None:
    marks = {
        mark
        for path in PAGES.rglob("*.md")
        for mark in re.findall(r"<!-- generate: (.+?) -->", path.read_text("utf-8"))
    }
    assert marks == set(PARTS)
