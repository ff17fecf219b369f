"""[manoeuvring], [propeller], [rudder] and [engine] of a ship file: the MMG set of a ship under way."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from .table import NotNegative, Positive, Table

__all__ = ["EngineTable", "ManoeuvringTable", "PropellerTable", "RudderTable"]


Fraction = Annotated[float, Field(ge=-0.7, le=0.7)]
"""A place on the ship over its length; larger ones are in metres."""


class ManoeuvringTable(Table):
    """[manoeuvring]: hull derivatives of the MMG standard model, non-dimensional (primed), about midship.

    Forces over 1/2 rho L d U^2, moments over 1/2 rho L^2 d U^2, velocities v' = v/U, r' = r L/U; m_x, m_y over
    1/2 rho L^2 d and J_z over 1/2 rho L^4 d. Yasukawa & Yoshimura (2015), J. Mar. Sci. Technol. 20:37-52.
    With estimate = true, missing values here and in [propeller], [rudder], [engine] are estimated (mmg_estimate.py).
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
    def _check_added_masses(self) -> ManoeuvringTable:
        given = [key for key in ("m_x", "m_y", "J_z") if getattr(self, key) is not None]
        if len(given) not in (0, 3):
            raise ValueError(f"[manoeuvring] gives {', '.join(given)} of m_x, m_y, J_z: give all three or none")
        return self


class PropellerTable(Table):
    """[propeller]: one fixed-pitch propeller on the centreline, and what the hull does to its inflow."""

    D_p: Positive = Field(description="the diameter [m]")
    t_P: Annotated[float, Field(ge=0.0, lt=1.0)] = Field(description="the thrust deduction fraction")
    w_P0: Annotated[float, Field(ge=0.0, lt=1.0)] = Field(description="the wake fraction in straight motion")
    x_P: Fraction = Field(description="the propeller's effective position x_P / L in the wake formula, not in metres")
    C_1: NotNegative = Field(description="C_1 of the wake formula")
    C_2_plus: Positive = Field(description="C_2 of the wake formula for beta_P > 0")
    C_2_minus: Positive = Field(description="C_2 of the wake formula for beta_P < 0")
    k_0: Positive = Field(description="k_0 of K_T = k_0 + k_1 J + k_2 J^2")
    k_1: float = Field(description="k_1 of K_T = k_0 + k_1 J + k_2 J^2")
    k_2: float = Field(description="k_2 of K_T = k_0 + k_1 J + k_2 J^2")
    astern_factor: Annotated[float, Field(gt=0.0, le=1.0)] = Field(
        default=1.0, description="of what turning astern adds to the stopped propeller's drag; from a crash stop"
    )
    z_P: float | None = Field(default=None, description="the depth of the shaft below CO [m]")
    service_speed: Positive | None = Field(default=None, description="the service speed [m/s]")
    service_rev_per_s: Positive | None = Field(default=None, description="the revolutions at service speed [1/s]")


class RudderTable(Table):
    """[rudder]: one rudder behind the propeller, its interaction with hull and propeller, and its steering gear."""

    A_R: Positive = Field(description="the movable area [m2]")
    H_R: Positive = Field(description="the span [m]")
    f_alpha: Positive = Field(description="the slope of the normal force coefficient [1/rad]")
    t_R: float = Field(description="the steering resistance deduction")
    a_H: float = Field(description="the rudder force increase on the hull")
    x_H: Fraction = Field(description="where that increase acts, x_H / L, not in metres")
    x_R: Annotated[float, Field(ge=-0.6, le=-0.3)] = Field(
        description="the rudder's position x_R / L, forward of midship, not in metres"
    )
    l_R: Annotated[float, Field(ge=-2.0, le=2.0)] = Field(
        description="the effective position l_R / L in the inflow formula, not in metres"
    )
    gamma_R_minus: float = Field(description="the flow straightening for beta_R < 0")
    gamma_R_plus: float = Field(description="the flow straightening for beta_R > 0")
    epsilon: Positive = Field(description="the wake ratio between rudder and propeller")
    kappa: float = Field(description="the propeller race factor")
    max_angle_deg: Annotated[float, Field(gt=0.0, le=90.0)] = Field(
        default=35.0, description="the largest rudder angle [deg]"
    )
    rate_deg_per_s: Positive = Field(default=2.34, description="the rudder's rate [deg/s]")
    z_R: float | None = Field(default=None, description="the depth of the rudder's centroid below CO [m]")


class EngineTable(Table):
    """[engine]: how fast the propeller follows its order, and what the engine's torque allows."""

    rate: Positive = Field(description="the change of revolutions per second [1/s2]")
    max_rev_per_s: Positive = Field(description="the largest revolutions ahead [1/s]")
    max_astern_rev_per_s: NotNegative = Field(default=0.0, description="the largest revolutions astern [1/s]")
    reversal_delay: NotNegative = Field(
        default=0.0, description="the time that a stopped engine takes to be started the other way round [s]"
    )
    power: Positive | None = Field(
        default=None, description="the rated power at the propeller [W]; none: no torque limits the revolutions"
    )
    rated_rev_per_s: Positive | None = Field(
        default=None, description="the revolutions of the rated power [1/s]; max_rev_per_s where it is missing"
    )
