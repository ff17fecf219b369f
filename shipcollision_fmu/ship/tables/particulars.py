"""[ship], [particulars], [added_mass], [seakeeping] and [wind] of a ship file (models/ships/NAME.toml).

One class per table, one field per key: name, unit, limits and meaning stand there and nowhere else. SI units, angles in
radians except keys that end in `_deg`. Unknown keys, NaN and numbers in quotes are refused.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from .table import ESTIMATED, NotNegative, Positive, Row, Table, Vector

__all__ = ["RHO_SEA", "AddedMassTable", "ParticularsTable", "SeakeepingTable", "ShipTable", "WindTable", "WindType"]

RHO_SEA = 1025.0
"""Density of sea water [kg/m3]."""


class ShipTable(Table):
    """[ship]: name and type of the ship, and the source of its numbers."""

    name: str = Field(default="ship", min_length=1, description="the ship's name")
    kind: str = Field(
        default="cargo vessel", min_length=1,
        description='the ship\'s type, e.g. "bulk carrier"; hull, machinery and stability are estimated by it',
    )  # fmt: skip
    source: str = Field(default="not stated", min_length=1, description="where every number of the file comes from")
    licence: str = Field(default="", description="the licence of the data")


class ParticularsTable(Table):
    """[particulars]: size, mass, and how the mass is spread."""

    L_pp: Positive = Field(description="the length between perpendiculars [m]")
    L_oa: Positive | None = Field(default=None, description="the length over all [m]")
    B: Positive = Field(description="the breadth [m]")
    T: Positive = Field(description="the draught amidships [m]")
    mass: Positive = Field(
        description="the displacement [kg] (not the dead-weight); or C_b instead", json_schema_extra=ESTIMATED
    )
    rho: Positive = Field(default=RHO_SEA, description="the density of the water it floats in [kg/m3]; 1000 in a tank")
    C_b: Positive | None = Field(default=None, description="the block coefficient mass / (rho L_pp B T)")
    r_bg: Vector | None = Field(default=None, description="the centre of gravity from CO in b [x, y, z] [m]")
    k_xx: Positive | None = Field(default=None, description="the radius of gyration in roll about CG [m]")
    k_yy: Positive | None = Field(default=None, description="the radius of gyration in pitch about CG [m]")
    k_zz: Positive | None = Field(default=None, description="the radius of gyration in yaw about CG [m]")
    GM_T: Positive | None = Field(default=None, description="the transverse metacentric height [m]")
    GM_L: Positive | None = Field(default=None, description="the longitudinal metacentric height [m]")
    allow_inconsistent: Annotated[str, Field(min_length=1)] | None = Field(
        default=None,
        description="the reason why a mass that contradicts the main dimensions, or dimensions of no ship, are kept",
    )


class AddedMassTable(Table):
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
    def _check_M_A_alone(self) -> AddedMassTable:
        if self.M_A is not None:
            others = sorted(self.model_fields_set - {"M_A"})
            if others:
                raise ValueError(
                    f"[added_mass] gives {', '.join(others)} beside M_A, which is the whole matrix: remove them"
                )
        return self


class SeakeepingTable(Table):
    """[seakeeping]: heave, roll and pitch, in 4 and 6 degrees of freedom. Missing values are estimated."""

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


class WindTable(Table):
    """[wind]: areas above the water and wind coefficients. Missing values are estimated (ship/windage.py)."""

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
