"""What a ship file (models/ships/NAME.toml) may say, and what it may not.

One class per table, one field per key: name, unit, limits and meaning stand here and nowhere else. SI units, angles in
radians except keys that end in `_deg`. Unknown keys, NaN and numbers in quotes are refused.

A mass, a C_b and an inertia that contradict each other are refused too: a ship heavier than the box of water it
displaces, or a container ship with half its displacement, spoils every number computed from it. Published data do
contain such ships (Guan et al. 2014, Table 1, prints dead-weights as mass), hence `allow_inconsistent = "why"`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, ValidationError, model_validator

from ..errors import ShipError
from .estimate import Dimensions, completed
from .refusal import one_line

__all__ = [
    "RHO_SEA", "AddedMassTable", "EngineTable", "HullTable", "ManoeuvringTable", "ParticularsTable", "PropellerTable",
    "RudderTable", "SeakeepingTable", "ShipFile", "ShipTable", "WindTable", "ship_file",
]  # fmt: skip

RHO_SEA = 1025.0
"""Density of sea water [kg/m3]."""

C_B_LIMITS = (0.40, 0.90)
"""Block coefficients of displacement ships; fine yachts and full barges lie just inside."""

C_B_TOLERANCE = 0.02
"""Relative difference allowed between a given C_b and the one from the mass: published C_b have two digits."""

Positive = Annotated[float, Field(gt=0.0)]
NotNegative = Annotated[float, Field(ge=0.0)]
Vector = Annotated[list[float], Field(min_length=3, max_length=3)]
Row = Annotated[list[float], Field(min_length=6, max_length=6)]


Axis = Literal["+x", "-x", "+y", "-y", "+z", "-z"]

MESH_KEYS = frozenset({"file", "unit", "scale", "forward", "up", "origin", "max_parts"})
"""Keys of [hull] that go with shape = "mesh" only."""


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class ShipTable(_Table):
    """[ship]: what it is and where its numbers come from."""

    name: str = Field(min_length=1, description="the ship's name")
    kind: str = Field(min_length=1, description='the ship\'s type, e.g. "bulk carrier"')
    source: str = Field(min_length=1, description="where every number of the file comes from")
    licence: str = Field(default="", description="the licence of the data")


class ParticularsTable(_Table):
    """[particulars]: size, mass, and how the mass is spread."""

    L_pp: Positive = Field(description="the length between perpendiculars [m]")
    L_oa: Positive | None = Field(default=None, description="the length over all [m]")
    B: Positive = Field(description="the breadth [m]")
    T: Positive = Field(description="the draught amidships [m]")
    mass: Positive = Field(description="the displacement [kg] (not the dead-weight)")
    rho: Positive = Field(default=RHO_SEA, description="the density of the water it floats in [kg/m3]; 1000 in a tank")
    C_b: Positive | None = Field(default=None, description="the block coefficient mass / (rho L_pp B T)")
    r_bg: Vector | None = Field(default=None, description="the centre of gravity from CO in b [x, y, z] [m]")
    k_xx: Positive | None = Field(default=None, description="the radius of gyration in roll about CG [m]")
    k_yy: Positive | None = Field(default=None, description="the radius of gyration in pitch about CG [m]")
    k_zz: Positive | None = Field(default=None, description="the radius of gyration in yaw about CG [m]")
    GM_T: Positive | None = Field(default=None, description="the transverse metacentric height [m]")
    GM_L: Positive | None = Field(default=None, description="the longitudinal metacentric height [m]")
    allow_inconsistent: Annotated[str, Field(min_length=1)] | None = Field(
        default=None, description="the reason why a mass that contradicts the main dimensions is kept"
    )


class AddedMassTable(_Table):
    """[added_mass]: fractions of the mass and of the rigid-body inertias about CG, or the full matrix."""

    m_x: NotNegative | None = Field(default=None, description="the surge added mass as a fraction of the mass")
    m_y: NotNegative | None = Field(default=None, description="the sway added mass as a fraction of the mass")
    m_z: NotNegative | None = Field(default=None, description="the heave added mass as a fraction of the mass")
    j_x: NotNegative | None = Field(default=None, description="the added roll inertia as a fraction of I_xx")
    j_y: NotNegative | None = Field(default=None, description="the added pitch inertia as a fraction of I_yy")
    j_z: NotNegative | None = Field(default=None, description="the added yaw inertia as a fraction of I_zz")
    z_y: float | None = Field(default=None, description="the depth below CO at which the sway added mass acts [m]")
    M_A: Annotated[list[Row], Field(min_length=6, max_length=6)] | None = Field(
        default=None, description="the added mass matrix (6 x 6) about CO in b [kg, kg m, kg m2]"
    )

    @model_validator(mode="after")
    def _one_or_the_other(self) -> AddedMassTable:
        if self.M_A is not None:
            others = sorted(self.model_fields_set - {"M_A"})
            if others:
                raise ValueError(f"[added_mass] gives M_A and {', '.join(others)}: M_A says it all, remove the rest")
        return self


class HullTable(_Table):
    """[hull]: the shape that touches other ships. Its meaning is drawn in ship/hull.py."""

    shape: Literal["parametric", "box", "mesh"] = Field(description='"parametric", "box" or "mesh"')
    depth: Positive = Field(description="the depth, keel to deck [m]")
    bow_length: NotNegative = Field(default=0.0, description="the length of the bow from its shoulder to the stem [m]")
    bow_exponent: Annotated[float, Field(ge=1.0, le=10.0)] = Field(
        default=2.0, description="p of the deck line y = B/2 (1 - s^p); from 1, a wedge, to 10, almost blunt"
    )
    stem_rake_deg: Annotated[float, Field(ge=0.0, le=60.0)] = Field(
        default=0.0, description="the stem's rake from the vertical [deg], top forward"
    )
    stern_length: NotNegative = Field(default=0.0, description="the length over which the stern narrows [m]")
    stern_exponent: Annotated[float, Field(ge=1.0, le=10.0)] = Field(
        default=2.0, description="p of the stern's deck line; as bow_exponent"
    )
    transom_fraction: Annotated[float, Field(gt=0.0, le=1.0)] = Field(default=0.5, description="transom breadth / B")
    flare_deg: Annotated[float, Field(ge=0.0, le=60.0)] = Field(
        default=0.0, description="the bow's flare above the waterline [deg] from the vertical"
    )
    bilge: NotNegative = Field(default=0.0, description="the height and breadth of the chamfer at the keel [m]")
    trim_x: float = Field(default=0.0, description="the shift of the whole hull forward of CO [m]")
    file: Annotated[str, Field(min_length=1)] | None = Field(
        default=None, description="the hull's .obj or .stl file, relative to the ship file"
    )
    unit: Literal["m", "cm", "mm", "ft", "in"] = Field(default="m", description="the unit of length of the mesh file")
    scale: Positive | None = Field(default=None, description="metres per unit of the mesh file, instead of unit")
    forward: Axis = Field(default="+x", description="the mesh file's axis that points to the bow")
    up: Axis = Field(default="+z", description="the mesh file's axis that points up")
    origin: Vector = Field(default=[0.0, 0.0, 0.0], description="CO in the mesh file's coordinates and unit")
    max_parts: Annotated[int, Field(ge=1, le=64)] = Field(
        default=16, description="the most convex parts that the mesh is cut into"
    )

    @model_validator(mode="after")
    def _mesh_keys_go_with_a_mesh(self) -> HullTable:
        if self.shape != "mesh":
            if others := sorted(self.model_fields_set & MESH_KEYS):
                raise ValueError(f'[hull] shape = "{self.shape}" has no {", ".join(others)}: only "mesh" has')
            return self
        if others := sorted(self.model_fields_set - MESH_KEYS - {"shape", "depth"}):
            raise ValueError(f'[hull] shape = "mesh" has no {", ".join(others)}: the file says it all')
        if self.file is None:
            raise ValueError('[hull] file is missing: shape = "mesh" needs the name of an .obj or .stl file')
        if self.scale is not None and "unit" in self.model_fields_set:
            raise ValueError(f'[hull] unit = "{self.unit}" and scale = {self.scale} are two units: remove one')
        if self.forward[1] == self.up[1]:
            raise ValueError(
                f'[hull] forward = "{self.forward}" and up = "{self.up}" lie along one axis: name two different ones'
            )
        return self

    @model_validator(mode="after")
    def _fits_its_shape(self) -> HullTable:
        if self.shape == "mesh":
            return self
        if self.shape == "box":
            others = sorted(self.model_fields_set - {"shape", "depth"})
            if others:
                raise ValueError(
                    f'[hull] shape = "box" has no {", ".join(others)}: give depth only, or shape = "parametric"'
                )
        else:
            for key in ("bow_length", "stern_length"):
                if getattr(self, key) <= 0.0:
                    raise ValueError(
                        f'[hull] {key} = {getattr(self, key)} m must be greater than 0 with shape = "parametric": '
                        f"it is {type(self).model_fields[key].description}"
                    )
        return self


class ManoeuvringTable(_Table):
    """[manoeuvring]: hull derivatives of the MMG standard model, non-dimensional (primed), about midship.

    Forces over 1/2 rho L d U^2, moments over 1/2 rho L^2 d U^2, velocities v' = v/U, r' = r L/U; m_x, m_y over
    1/2 rho L^2 d and J_z over 1/2 rho L^4 d. Yasukawa & Yoshimura (2015), J. Mar. Sci. Technol. 20:37-52.
    With estimate = true, what is missing here and in [propeller], [rudder], [engine] is estimated (ship/estimate.py).
    """

    estimate: bool = Field(default=False, description="true: estimate what is missing from L_pp, B, T and C_b")
    R_0: NotNegative = Field(description="the resistance coefficient in straight motion")
    X_vv: float
    X_vr: float
    X_rr: float
    X_vvvv: float
    Y_v: float
    Y_r: float
    Y_vvv: float
    Y_vvr: float
    Y_vrr: float
    Y_rrr: float
    N_v: float
    N_r: float
    N_vvv: float
    N_vvr: float
    N_vrr: float
    N_rrr: float
    m_x: NotNegative | None = Field(default=None, description="the non-dimensional added mass in surge")
    m_y: NotNegative | None = Field(default=None, description="the non-dimensional added mass in sway")
    J_z: NotNegative | None = Field(default=None, description="the non-dimensional added yaw inertia about midship")

    @model_validator(mode="after")
    def _all_added_masses_or_none(self) -> ManoeuvringTable:
        given = [key for key in ("m_x", "m_y", "J_z") if getattr(self, key) is not None]
        if len(given) not in (0, 3):
            raise ValueError(f"[manoeuvring] gives {', '.join(given)} of m_x, m_y, J_z: give all three or none")
        return self


class PropellerTable(_Table):
    """[propeller]: one fixed-pitch propeller on the centreline, and what the hull does to its inflow."""

    D_p: Positive = Field(description="the diameter [m]")
    t_P: Annotated[float, Field(ge=0.0, lt=1.0)] = Field(description="the thrust deduction fraction")
    w_P0: Annotated[float, Field(ge=0.0, lt=1.0)] = Field(description="the wake fraction in straight motion")
    x_P: float = Field(description="the propeller's effective position x_P / L in the wake formula")
    C_1: NotNegative = Field(description="C_1 of the wake formula")
    C_2_plus: Positive = Field(description="C_2 of the wake formula for beta_P > 0")
    C_2_minus: Positive = Field(description="C_2 of the wake formula for beta_P < 0")
    k_0: Positive = Field(description="k_0 of K_T = k_0 + k_1 J + k_2 J^2")
    k_1: float = Field(description="k_1 of K_T = k_0 + k_1 J + k_2 J^2")
    k_2: float = Field(description="k_2 of K_T = k_0 + k_1 J + k_2 J^2")
    astern_factor: Annotated[float, Field(gt=0.0, le=1.0)] = Field(
        default=1.0, description="thrust at negative revolutions over that of the mirrored curve; from a crash stop"
    )
    z_P: float | None = Field(default=None, description="the depth of the shaft below CO [m]")
    service_speed: Positive | None = Field(default=None, description="the service speed [m/s]")
    service_rev_per_s: Positive | None = Field(default=None, description="the revolutions at service speed [1/s]")


class RudderTable(_Table):
    """[rudder]: one rudder behind the propeller, its interaction with hull and propeller, and its steering gear."""

    A_R: Positive = Field(description="the movable area [m2]")
    H_R: Positive = Field(description="the span [m]")
    f_alpha: Positive = Field(description="the slope of the normal force coefficient [1/rad]")
    t_R: float = Field(description="the steering resistance deduction")
    a_H: float = Field(description="the rudder force increase on the hull")
    x_H: float = Field(description="where that increase acts, x_H / L")
    x_R: float = Field(description="the rudder's position x_R / L")
    l_R: float = Field(description="the effective position l_R / L in the inflow formula")
    gamma_R_minus: float = Field(description="the flow straightening for beta_R < 0")
    gamma_R_plus: float = Field(description="the flow straightening for beta_R > 0")
    epsilon: Positive = Field(description="the wake ratio between rudder and propeller")
    kappa: float = Field(description="the propeller race factor")
    max_angle_deg: Annotated[float, Field(gt=0.0, le=90.0)] = Field(
        default=35.0, description="the largest rudder angle [deg]"
    )
    rate_deg_per_s: Positive = Field(default=2.34, description="the rudder's rate [deg/s]")
    z_R: float | None = Field(default=None, description="the depth of the rudder's centroid below CO [m]")


class EngineTable(_Table):
    """[engine]: how fast the propeller follows its order."""

    rate: Positive = Field(description="the change of revolutions per second [1/s2]")
    max_rev_per_s: Positive = Field(description="the largest revolutions ahead [1/s]")
    max_astern_rev_per_s: NotNegative = Field(default=0.0, description="the largest revolutions astern [1/s]")
    reversal_delay: NotNegative = Field(
        default=0.0, description="the time that a stopped engine takes to be started the other way round [s]"
    )


class SeakeepingTable(_Table):
    """[seakeeping]: heave, roll and pitch, in 4 and 6 degrees of freedom. What is missing is estimated."""

    zeta_heave: NotNegative | None = Field(default=None, description="the damping ratio in heave")
    zeta_roll: NotNegative | None = Field(default=None, description="the damping ratio in roll at small angles")
    zeta_pitch: NotNegative | None = Field(default=None, description="the damping ratio in pitch")
    zeta_roll_per_rad: NotNegative | None = Field(
        default=None, description="what the damping ratio in roll gains per radian of amplitude [1/rad]"
    )
    x_F: float | None = Field(default=None, description="the centre of flotation, forward of midship [m]")
    z_H: float | None = Field(default=None, description="the depth below CO at which the hull's sway force acts [m]")


WindType = Literal[
    "car carrier", "cargo vessel, loaded", "cargo vessel, container on deck", "container ship, loaded", "destroyer",
    "diving support vessel", "drilling vessel", "ferry", "fishing vessel", "liquefied natural gas tanker",
    "offshore supply vessel", "passenger liner", "research vessel", "speed boat", "tanker, loaded",
    "tanker, in ballast", "tender",
]  # fmt: skip
"""The ships of Blendermann (1994)."""


class WindTable(_Table):
    """[wind]: what the wind finds above the water. What is missing is estimated (ship/windage.py)."""

    type: WindType | None = Field(default=None, description='the type of ship in Blendermann (1994), e.g. "ferry"')
    A_Fw: Positive | None = Field(default=None, description="the frontal projected area above the water [m2]")
    A_Lw: Positive | None = Field(default=None, description="the lateral projected area above the water [m2]")
    s_L: float | None = Field(default=None, description="the centroid of A_Lw, forward of midship [m]")
    s_H: NotNegative | None = Field(default=None, description="the height of that centroid above the water [m]")
    C_Dt: Positive | None = Field(default=None, description="the transverse drag coefficient")
    C_Dl_bow: Positive | None = Field(default=None, description="the longitudinal drag coefficient, wind from ahead")
    C_Dl_stern: Positive | None = Field(default=None, description="the same, wind from astern")
    delta: Annotated[float, Field(ge=0.0, lt=1.0)] | None = Field(default=None, description="the cross-force parameter")
    kappa: NotNegative | None = Field(default=None, description="the rolling moment factor")


class ShipFile(_Table):
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
        """What `[manoeuvring] estimate = true` has put into the tables, and how."""
        return self._estimated

    @model_validator(mode="after")
    def _mass_fits_the_dimensions(self) -> ShipFile:
        p = self.particulars
        box = p.rho * p.L_pp * p.B * p.T
        C_b = p.mass / box
        low, high = C_B_LIMITS
        remedy = 'give the displacement and its draught, or say why it is kept: allow_inconsistent = "..."'
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
    def _centre_of_gravity_is_aboard(self) -> ShipFile:
        p = self.particulars
        limits = (p.L_pp / 2, p.B / 2, max(p.T, self.hull.depth))
        for axis, value, limit in zip("xyz", p.r_bg or (0.0, 0.0, 0.0), limits, strict=True):
            if abs(value) > limit:
                raise ValueError(f"[particulars] r_bg: {axis} = {value} m puts CG outside the ship: at most {limit} m")
        return self

    @model_validator(mode="after")
    def _hull_fits_the_dimensions(self) -> ShipFile:
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
    def _one_added_mass(self) -> ShipFile:
        if self.manoeuvring is not None and self.manoeuvring.m_x is not None:
            twice = [key for key in ("m_x", "m_y", "j_z", "M_A") if getattr(self.added_mass, key) is not None]
            if twice:
                raise ValueError(
                    f"[added_mass] {', '.join(twice)} and [manoeuvring] m_x, m_y, J_z are two added masses of one "
                    "ship: remove one of the two sets"
                )
        return self

    @model_validator(mode="after")
    def _mmg_set_is_whole(self) -> ShipFile:
        if self.manoeuvring is not None:
            lacking = [t for t in ("propeller", "rudder", "engine") if getattr(self, t) is None]
            if len(lacking) in (1, 2):
                raise ValueError(
                    f"[manoeuvring] needs {', '.join(f'[{t}]' for t in lacking)} as well: propeller, rudder and engine "
                    "work together; add them, or remove all three and the ship can only drift"
                )
        return self


def ship_file(data: Mapping[str, Any], file: str) -> ShipFile:
    """The validated content of a ship file; `file` names it in messages.

    Raises ShipError with one line: file, key, what is wrong, its value, the limit, the remedy.
    """
    table = data.get("manoeuvring")
    if isinstance(table, Mapping) and table.get("estimate") is True:
        return _estimated_file(data, file)
    return _validated(data, file)


_ESTIMATED = ("manoeuvring", "propeller", "rudder", "engine")
"""Tables that `[manoeuvring] estimate = true` completes."""


def _estimated_file(data: Mapping[str, Any], file: str) -> ShipFile:
    """The content with its MMG set completed. First what is given is checked, then it takes part in the estimate."""
    rest = {key: value for key, value in data.items() if key not in _ESTIMATED}
    content = _validated(rest, file)
    p, added = content.particulars, content.added_mass
    d = Dimensions(p.L_pp, p.B, p.T, p.mass / (p.rho * p.L_pp * p.B * p.T), p.r_bg[0] if p.r_bg else 0.0, p.rho)
    unit = 2.0 * d.C_b * d.B / d.L  # the mass over 1/2 rho L^2 T
    own_masses: tuple[float, float] | None = None
    if added.M_A is not None:
        own_masses = (added.M_A[0][0] / p.mass * unit, added.M_A[1][1] / p.mass * unit)
    elif added.m_x is not None and added.m_y is not None and added.j_z is not None:
        own_masses = (added.m_x * unit, added.m_y * unit)
    try:
        tables, _ = completed(d, {}, own_masses)
        for name in _ESTIMATED:
            own = data.get(name, {})
            tables[name] = {**tables[name], **own} if isinstance(own, Mapping) else own
        checked = _validated({**rest, **tables}, file)
        given = {name: getattr(checked, name).model_dump(include=set(data.get(name, {}))) for name in _ESTIMATED}
        tables, notes = completed(d, given, own_masses)
    except ShipError as error:
        raise ShipError(f"{file}: {error}") from None
    content = _validated({**rest, **tables}, file)
    content._estimated = tuple(notes)
    return content


def _validated(data: Mapping[str, Any], file: str) -> ShipFile:
    try:
        return ShipFile.model_validate(data)
    except ValidationError as error:
        raise ShipError(f"{file}: {one_line(error, ShipFile)}") from None
