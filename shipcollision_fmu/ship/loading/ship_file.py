"""A whole ship file, validated: its tables one by one, and that they go together (consistency.py).

What the main dimensions can give is completed first. All problems of a file are collected into one message.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, get_args

from pydantic import Field, PrivateAttr, TypeAdapter, ValidationError, model_validator

from ...errors import ShipError
from ..ship_type import find_ship_type
from ..tables.hull import HullTable
from ..tables.manoeuvring import EngineTable, ManoeuvringTable, PropellerTable, RudderTable
from ..tables.particulars import AddedMassTable, ParticularsTable, SeakeepingTable, ShipTable, WindTable
from ..tables.table import ESTIMATED, Table
from .consistency import find_contradictions, find_wrong_sizes
from .dimensions_estimate import MMG_TABLES, complete_dimensions, is_estimable
from .messages import describe_problems, join_problems
from .mmg_estimate import Dimensions, complete_tables
from .motora_charts import estimate_added_mass

__all__ = ["ShipFile", "validate_ship_file"]


class ShipFile(Table):
    """A whole ship file."""

    ship: ShipTable = Field(default_factory=ShipTable, description="the table [ship] with name, kind and source")
    particulars: ParticularsTable = Field(description="the table [particulars] with L_pp, B, T, and mass or C_b")
    added_mass: AddedMassTable = Field(default_factory=AddedMassTable, description="the table [added_mass]")
    hull: HullTable = Field(
        description='the table [hull], at least shape = "box" and depth', json_schema_extra=ESTIMATED
    )
    manoeuvring: ManoeuvringTable | None = None
    propeller: PropellerTable | None = None
    rudder: RudderTable | None = None
    engine: EngineTable | None = None
    seakeeping: SeakeepingTable = Field(default_factory=SeakeepingTable, description="the table [seakeeping]")
    wind: WindTable = Field(default_factory=WindTable, description="the table [wind]")

    _estimated: tuple[str, ...] = PrivateAttr(default=())

    @property
    def estimated(self) -> tuple[str, ...]:
        """A note on each value that `[manoeuvring] estimate = true` has put into the tables."""
        return self._estimated

    @model_validator(mode="after")
    def _check_together(self) -> ShipFile:
        if problems := list(find_contradictions({name: getattr(self, name) for name in type(self).model_fields})):
            raise ValueError("\n".join(problems))
        return self


def validate_ship_file(data: Mapping[str, Any], file: str) -> ShipFile:
    """The validated content of a ship file; `file` names it in messages.

    Raises ShipError with one line that has all problems: file, key, what is wrong, its value, the limit, the remedy.
    """
    data, notes = complete_dimensions(data)
    table = data.get("manoeuvring")
    if isinstance(table, Mapping) and table.get("estimate") is True:
        content = _complete_and_validate(data, file)
    else:
        content = _validate(data, file)
    content._estimated = (*notes, *content.estimated)
    return content


def _complete_and_validate(data: Mapping[str, Any], file: str) -> ShipFile:
    """The content with its MMG set completed. Given values are checked first, then take part in the estimate."""
    rest = {key: value for key, value in data.items() if key not in MMG_TABLES}
    if problems := _find_problems({**rest, **{key: data.get(key, {}) for key in MMG_TABLES}}, may_lack=MMG_TABLES):
        raise ShipError(f"{file}: {join_problems(problems)}")
    content = _validate(rest, file)
    p = content.particulars
    if wrong := list(find_wrong_sizes(p)):
        raise ShipError(f"{file}: {join_problems(wrong)}")
    d = Dimensions(p.L_pp, p.B, p.T, p.mass / (p.rho * p.L_pp * p.B * p.T), p.r_bg[0] if p.r_bg else 0.0, p.rho)
    own_masses, of = _find_planar_masses(d, content), find_ship_type(content.wind.type or content.ship.kind)
    try:
        tables, _ = complete_tables(d, {}, own_masses, of)
        for name in MMG_TABLES:
            own = data.get(name, {})
            tables[name] = {**tables[name], **own} if isinstance(own, Mapping) else own
        checked = _validate({**rest, **tables}, file)
        given = {name: getattr(checked, name).model_dump(include=set(data.get(name, {}))) for name in MMG_TABLES}
        tables, notes = complete_tables(d, given, own_masses, of)
    except ShipError as error:
        raise ShipError(f"{file}: {str(error).removeprefix(f'{file}: ')}") from None
    content = _validate({**rest, **tables}, file)
    content._estimated = tuple(notes)
    return content


def _find_planar_masses(d: Dimensions, content: ShipFile) -> tuple[float, float]:
    """m_x, m_y over 1/2 rho L^2 T of [added_mass], or of the Motora charts."""
    mass, added = content.particulars.mass, content.added_mass
    if added.M_A is not None:
        m_x, m_y = added.M_A[0][0] / mass, added.M_A[1][1] / mass
    else:
        m_x, m_y, _ = estimate_added_mass(d)
        m_x, m_y = (m_x if added.m_x is None else added.m_x), (m_y if added.m_y is None else added.m_y)
    unit = 2.0 * d.C_b * d.B / d.L  # the mass over 1/2 rho L^2 T
    return m_x * unit, m_y * unit


def _validate(data: Mapping[str, Any], file: str) -> ShipFile:
    if problems := _find_problems(data):
        raise ShipError(f"{file}: {join_problems(problems)}")
    return ShipFile.model_validate(data)


def _find_problems(data: Mapping[str, Any], may_lack: Sequence[str] = ()) -> list[str]:
    """All problems of the tables, and of them together. Tables in `may_lack` need not be whole."""
    try:
        ShipFile.model_validate(data)
        return []
    except ValidationError as error:
        raised = error
    problems = describe_problems(raised, ShipFile, lambda place: place[0] in may_lack or _follows(place, data))
    if any(problem["loc"] for problem in raised.errors()):  # else the tables were compared already
        problems += find_contradictions(dict(_validate_alone(data)))
    return problems


def _follows(place: tuple[int | str, ...], data: Mapping[str, Any]) -> bool:
    """Whether what is missing there would follow from main dimensions that are refused themselves."""
    if place == ("particulars", "mass"):
        return isinstance(data["particulars"], Mapping) and "C_b" in data["particulars"]
    return is_estimable(place)


def _validate_alone(data: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """The tables that are valid for themselves but for unknown keys, by name."""
    for name, field in ShipFile.model_fields.items():
        try:
            if name in data:
                table: Any = field.annotation
                yield name, TypeAdapter(table).validate_python(_leave_known(data[name], table))
            elif not field.is_required():
                yield name, field.get_default(call_default_factory=True)
        except ValidationError:
            continue


def _leave_known(given: Any, table: Any) -> Any:
    """The table without its unknown keys, which are a problem of their own."""
    known = next(model for model in (table, *get_args(table)) if hasattr(model, "model_fields")).model_fields
    return {key: value for key, value in given.items() if key in known} if isinstance(given, Mapping) else given
