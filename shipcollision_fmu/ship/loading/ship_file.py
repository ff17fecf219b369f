"""A whole ship file, validated: its tables one by one, and that they go together.

A mass, a C_b and an inertia that contradict each other are refused, because they make every result wrong: a ship
heavier than the box of water it displaces, or a container ship with half its displacement. Published data contain such
ships (Guan et al. 2014, Table 1, prints dead-weights as mass), hence `allow_inconsistent = "why"`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import Field, PrivateAttr, ValidationError, model_validator

from ...errors import ShipError
from ..ship_type import find_ship_type
from ..tables.hull import HullTable
from ..tables.manoeuvring import EngineTable, ManoeuvringTable, PropellerTable, RudderTable
from ..tables.particulars import AddedMassTable, ParticularsTable, SeakeepingTable, ShipTable, WindTable
from ..tables.table import Table
from .messages import describe_error
from .mmg_estimate import Dimensions, complete_tables
from .motora_charts import estimate_added_mass

__all__ = ["ShipFile", "validate_ship_file"]

C_B_LIMITS = (0.40, 0.90)
"""Block coefficients of displacement ships; fine yachts and full barges lie just inside."""

C_B_TOLERANCE = 0.02
"""Relative difference allowed between a given C_b and the one from the mass: published C_b have two digits."""


MMG_X_G = 0.15
"""x_G over L_pp of a ship with [manoeuvring]; ships in service stay within 0.05."""


class ShipFile(Table):
    """A whole ship file."""

    ship: ShipTable = Field(description="the table [ship] with name, kind and source")
    particulars: ParticularsTable = Field(description="the table [particulars] with L_pp, B, T and mass")
    added_mass: AddedMassTable = Field(default_factory=AddedMassTable, description="the table [added_mass]")
    hull: HullTable = Field(description='the table [hull], at least shape = "box" and depth')
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
    def _check_mass(self) -> ShipFile:
        p = self.particulars
        box = p.rho * p.L_pp * p.B * p.T
        C_b = p.mass / box
        low, high = C_B_LIMITS
        remedy = 'give the displacement and its draught, or give the reason why it is kept: allow_inconsistent = "..."'
        if p.allow_inconsistent is not None:
            return self
        if C_b > 1.0:
            raise ValueError(
                f"[particulars] mass = {p.mass:.6g} kg is more than rho L_pp B T = {box:.6g} kg, all the water that a "
                f"box of these dimensions displaces: {remedy}"
            )
        if not low <= C_b <= high:
            raise ValueError(
                f"[particulars] mass = {p.mass:.6g} kg means C_b = mass / (rho L_pp B T) = {C_b:.3f}, outside "
                f"{low:.2f} to {high:.2f}: {remedy}"
            )
        if p.C_b is not None and abs(p.C_b / C_b - 1.0) > C_B_TOLERANCE:
            raise ValueError(
                f"[particulars] C_b = {p.C_b} contradicts mass / (rho L_pp B T) = {C_b:.3f} by more than "
                f"{C_B_TOLERANCE:.0%}: remove C_b, or {remedy}"
            )
        return self

    @model_validator(mode="after")
    def _check_centre_of_gravity(self) -> ShipFile:
        p = self.particulars
        limits = (p.L_pp / 2, p.B / 2, max(p.T, self.hull.depth))
        for axis, value, limit in zip("xyz", p.r_bg or (0.0, 0.0, 0.0), limits, strict=True):
            if abs(value) > limit:
                raise ValueError(f"[particulars] r_bg: {axis} = {value} m puts CG outside the ship: at most {limit} m")
        return self

    @model_validator(mode="after")
    def _check_hull(self) -> ShipFile:
        p, hull = self.particulars, self.hull
        if hull.depth <= p.T:
            raise ValueError(
                f"[hull] depth = {hull.depth} m must be greater than the draught T = {p.T} m: the deck would be awash"
            )
        if hull.shape == "parametric":
            L = p.L_oa or p.L_pp
            midbody = L - hull.bow_length - hull.stern_length
            if midbody <= 0.0:
                raise ValueError(
                    f"[hull] bow_length + stern_length = {hull.bow_length + hull.stern_length} m leave no parallel "
                    f"midbody in {L} m of length: shorten them"
                )
            if hull.bilge >= min(p.T, p.B / 2):
                raise ValueError(f"[hull] bilge = {hull.bilge} m must be less than T = {p.T} m and B/2 = {p.B / 2} m")
        return self

    @model_validator(mode="after")
    def _check_one_added_mass(self) -> ShipFile:
        if self.manoeuvring is not None and self.manoeuvring.m_x is not None:
            twice = [key for key in ("m_x", "m_y", "j_z", "M_A") if getattr(self.added_mass, key) is not None]
            if twice:
                raise ValueError(
                    f"[added_mass] {', '.join(twice)} and [manoeuvring] m_x, m_y, J_z are two added masses of one "
                    "ship: remove one of the two sets"
                )
        return self

    @model_validator(mode="after")
    def _check_mmg_sizes(self) -> ShipFile:
        if self.manoeuvring is None:
            return self
        p = self.particulars
        x_G = p.r_bg[0] if p.r_bg is not None else 0.0
        if abs(x_G) > MMG_X_G * p.L_pp:
            raise ValueError(
                f"[particulars] r_bg: x = {x_G} m is {x_G / p.L_pp:.2g} L_pp, with [manoeuvring] at most {MMG_X_G} "
                "either way: give CG in metres forward of midship, not from the after perpendicular"
            )
        own = 2.0 * p.mass / (p.rho * p.L_pp**2 * p.T)  # the mass over 1/2 rho L^2 T
        for key, most, power in (("m_x", 1.0, 2), ("m_y", 2.0, 2), ("J_z", 0.15, 4)):
            value = getattr(self.manoeuvring, key)
            if value is not None and value > most * own:
                raise ValueError(
                    f"[manoeuvring] {key} = {value:.6g} is {value / own:.3g} times the ship's own m' = {own:.3g}, must "
                    f"be at most {most:g} times: give it over 1/2 rho L_pp^{power} T = "
                    f"{0.5 * p.rho * p.L_pp**power * p.T:.4g}, neither in kg or kg m2 nor as a fraction of the ship's"
                )
        return self

    @model_validator(mode="after")
    def _check_mmg_set(self) -> ShipFile:
        if self.manoeuvring is not None:
            lacking = [t for t in ("propeller", "rudder", "engine") if getattr(self, t) is None]
            if len(lacking) in (1, 2):
                raise ValueError(
                    f"[manoeuvring] needs {', '.join(f'[{t}]' for t in lacking)} as well: propeller, rudder and engine "
                    "work together; add them, or remove all three and the ship can only drift"
                )
        return self


def validate_ship_file(data: Mapping[str, Any], file: str) -> ShipFile:
    """The validated content of a ship file; `file` names it in messages.

    Raises ShipError with one line: file, key, what is wrong, its value, the limit, the remedy.
    """
    table = data.get("manoeuvring")
    if isinstance(table, Mapping) and table.get("estimate") is True:
        return _complete_and_validate(data, file)
    return _validate(data, file)


_ESTIMATED = ("manoeuvring", "propeller", "rudder", "engine")
"""Tables that `[manoeuvring] estimate = true` completes."""


def _complete_and_validate(data: Mapping[str, Any], file: str) -> ShipFile:
    """The content with its MMG set completed. Given values are checked first, then take part in the estimate."""
    rest = {key: value for key, value in data.items() if key not in _ESTIMATED}
    content = _validate(rest, file)
    p = content.particulars
    d = Dimensions(p.L_pp, p.B, p.T, p.mass / (p.rho * p.L_pp * p.B * p.T), p.r_bg[0] if p.r_bg else 0.0, p.rho)
    own_masses, of = _find_planar_masses(d, content), find_ship_type(content.wind.type or content.ship.kind)
    try:
        tables, _ = complete_tables(d, {}, own_masses, of)
        for name in _ESTIMATED:
            own = data.get(name, {})
            tables[name] = {**tables[name], **own} if isinstance(own, Mapping) else own
        checked = _validate({**rest, **tables}, file)
        given = {name: getattr(checked, name).model_dump(include=set(data.get(name, {}))) for name in _ESTIMATED}
        tables, notes = complete_tables(d, given, own_masses, of)
    except ShipError as error:
        raise ShipError(f"{file}: {error}") from None
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
    try:
        return ShipFile.model_validate(data)
    except ValidationError as error:
        raise ShipError(f"{file}: {describe_error(error, ShipFile)}") from None
