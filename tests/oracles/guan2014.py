"""The impact of two ships with surge, sway, roll and yaw, in the symbols of Guan et al. (2014): the oracle.

Frames: x along ship A, forward; y to port; z up. A unit normal n points from A into B, t is the tangent; alpha is the
angle from x to t, beta from x to ship B's forward axis u, both positive clockwise seen from above:

    t = (cos alpha, -sin alpha)     n = (sin alpha, cos alpha)
    u = (cos beta, -sin beta)       v = (sin beta, cos beta)             B's surge and sway axes
    impulse on A = -(I_xi n + I_eta t)      on B = +(I_xi n + I_eta t)

Rates are right-handed about x (u for B) and z. M_x = M (1 + m_x) and so on contain the added mass, J_x and J_z the
added inertia; h is the height of the contact above the centre of gravity, d = (x_C, y_C) - (x, y). With g = beta -
alpha, the arms of unit impulses are (a_Bn, a_Bt like A's, with d_B)

    yaw    a_An = d_Ax cos alpha - d_Ay sin alpha      a_At = -(d_Ax sin alpha + d_Ay cos alpha)
    roll   b_An = -h_A cos alpha     b_At = h_A sin alpha     b_Bn = -h_B cos g     b_Bt = -h_B sin g

What the paper prints and what is corrected here:

- (4), yaw of B: the arm is printed with (x_C - x_A), twice; it is (x_C - x_B). As printed, angular momentum is lost.
- (3), (4), signs of yaw: printed for yaw clockwise, as alpha and beta are, beside a roll that is right-handed. Here
  both are right-handed: the bracket has + for A and - for B.
- (4), roll of B: printed with +; it is -, else action and reaction differ for any sign of h.
- (3), (4), rates: printed without the rates before impact, which must be zero then. Here they are added.
- 2.2: no equation for I_xi and I_eta. They follow from restitution and Coulomb friction at the contact, below.

    stick    I_xi  = ((1+e) xi_0 W_tt - eta_0 W_nt) / D      I_eta = (eta_0 W_nn - (1+e) xi_0 W_nt) / D
             D = W_nn W_tt - W_nt^2                           if |I_eta| <= mu I_xi
    slide    I_xi  = (1+e) xi_0 / (W_nn + s mu W_nt)          I_eta = s mu I_xi
             s = sign(eta_0), or -sign(W_nt) where there is no slip yet

Pedersen and Zhang (1998) write D_xi = W_nn, K_eta = W_tt, D_eta = K_xi = W_nt (no roll), mu* = I_eta/I_xi at stick.
The general form, in 6 x 6 and any direction, is newton_impact.py: the two agree to rounding.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import copysign, cos, inf, sin

from tests.oracles.newton_impact import STILL

__all__ = ["GuanImpact", "GuanShip", "solve_guan_impact"]


@dataclass(frozen=True)
class GuanShip:
    """A ship at impact. M_x, M_y [kg], J_x, J_z [kg m2]: with added mass, math.inf for what cannot move.

    x, y: centre of gravity [m]; h: height of the contact above it [m]; u, v: surge, sway [m/s]; p, r: roll and yaw rate
    [rad/s].
    """

    M_x: float
    M_y: float
    J_z: float
    J_x: float
    x: float
    y: float
    h: float = 0.0
    u: float = 0.0
    v: float = 0.0
    p: float = 0.0
    r: float = 0.0


@dataclass(frozen=True)
class GuanImpact:
    """What the impact makes: I_xi, I_eta [N s]; W_nn, W_tt, W_nt [1/kg]; the ships after; stuck or slid.

    Closing and tangential speed (A less B) before (0) and after (f) [m/s]; impulse ratio I_eta/I_xi at stick; energy
    lost along and across the normal [J].
    """

    I_xi: float
    I_eta: float
    W_nn: float
    W_tt: float
    W_nt: float
    xi_0: float
    eta_0: float
    xi_f: float
    eta_f: float
    stick_ratio: float
    A: GuanShip
    B: GuanShip
    E_xi: float
    E_eta: float
    stuck: bool


def solve_guan_impact(
    A: GuanShip, B: GuanShip, x_C: float, y_C: float, alpha: float, beta: float, mu: float, e: float
) -> GuanImpact:
    """The impact at (x_C, y_C) [m] with the angles alpha, beta [rad]; guards against nothing (it is an oracle).

    The contact must be closing (xi_0 > 0).
    """
    ca, sa, cg, sg = cos(alpha), sin(alpha), cos(beta - alpha), sin(beta - alpha)
    dAx, dAy, dBx, dBy = x_C - A.x, y_C - A.y, x_C - B.x, y_C - B.y
    aAn, aAt = dAx * ca - dAy * sa, -(dAx * sa + dAy * ca)
    aBn, aBt = dBx * ca - dBy * sa, -(dBx * sa + dBy * ca)
    bAn, bAt = -A.h * ca, A.h * sa
    bBn, bBt = -B.h * cg, -B.h * sg

    W_nn = (
        sa**2 / A.M_x + ca**2 / A.M_y + aAn**2 / A.J_z + bAn**2 / A.J_x
        + sg**2 / B.M_x + cg**2 / B.M_y + aBn**2 / B.J_z + bBn**2 / B.J_x
    )  # fmt: skip
    W_tt = (
        ca**2 / A.M_x + sa**2 / A.M_y + aAt**2 / A.J_z + bAt**2 / A.J_x
        + cg**2 / B.M_x + sg**2 / B.M_y + aBt**2 / B.J_z + bBt**2 / B.J_x
    )  # fmt: skip
    W_nt = (
        sa * ca * (1 / A.M_x - 1 / A.M_y) + aAn * aAt / A.J_z + bAn * bAt / A.J_x
        + sg * cg * (1 / B.M_y - 1 / B.M_x) + aBn * aBt / B.J_z + bBn * bBt / B.J_x
    )  # fmt: skip

    xi_0 = A.u * sa + A.v * ca + A.r * aAn + A.p * bAn - (-B.u * sg + B.v * cg + B.r * aBn + B.p * bBn)
    eta_0 = A.u * ca - A.v * sa + A.r * aAt + A.p * bAt - (B.u * cg + B.v * sg + B.r * aBt + B.p * bBt)

    D = W_nn * W_tt - W_nt**2
    I_xi = ((1 + e) * xi_0 * W_tt - eta_0 * W_nt) / D
    I_eta = (eta_0 * W_nn - (1 + e) * xi_0 * W_nt) / D
    ratio = I_eta / I_xi if I_xi else inf
    stuck = I_xi > 0 and abs(I_eta) <= mu * I_xi
    if not stuck:
        s = copysign(1.0, eta_0 if abs(eta_0) > STILL * xi_0 else -W_nt)
        I_xi = (1 + e) * xi_0 / (W_nn + s * mu * W_nt)
        I_eta = s * mu * I_xi

    A_f = replace(
        A,
        u=A.u - (I_xi * sa + I_eta * ca) / A.M_x,
        v=A.v - (I_xi * ca - I_eta * sa) / A.M_y,
        r=A.r - (I_xi * aAn + I_eta * aAt) / A.J_z,
        p=A.p - (I_xi * bAn + I_eta * bAt) / A.J_x,
    )
    B_f = replace(
        B,
        u=B.u + (-I_xi * sg + I_eta * cg) / B.M_x,
        v=B.v + (I_xi * cg + I_eta * sg) / B.M_y,
        r=B.r + (I_xi * aBn + I_eta * aBt) / B.J_z,
        p=B.p + (I_xi * bBn + I_eta * bBt) / B.J_x,
    )
    xi_f = xi_0 - W_nn * I_xi - W_nt * I_eta
    eta_f = eta_0 - W_nt * I_xi - W_tt * I_eta
    E_xi, E_eta = I_xi * (xi_0 + xi_f) / 2, I_eta * (eta_0 + eta_f) / 2
    return GuanImpact(
        I_xi, I_eta, W_nn, W_tt, W_nt, xi_0, eta_0, xi_f, eta_f, ratio, A_f, B_f, E_xi, E_eta, stuck
    )  # fmt: skip
