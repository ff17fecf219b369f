"""The exact solution of the law of contact (contact_law.py) at one contact, for any positive definite W (3, 3).

Three cases are tried in turn: apart, stick, slide.

Sliding is one equation for the angle of friction, solved by Newton's method. Newton's method fails where friction is so
strong that it presses the hulls together on the way, or where the hulls can hardly move in some direction. There the
normal impulse itself is the unknown:

    f(P_n) = v_n + W_nn P_n + w . P_t(P_n) = 0        P_t(P_n): friction of most dissipation in a disc of radius mu P_n

f(0) < 0, and f grows without bound for any positive definite W, so a zero exists and is bracketed. P_t(P_n) minimises a
quadratic form on a disc: P_t = -(W_tt + g)^-1 (v_t + w P_n) with one g >= 0, and g = 0 where the contact sticks.

References: Jourdan, Alart and Jean (1998), Comput. Methods Appl. Mech. Eng. 155:31-47 (block form with friction);
More and Sorensen (1983), SIAM J. Sci. Stat. Comput. 4:553-572 (the quadratic form on a disc).
"""

from __future__ import annotations

from math import atan2, copysign, cos, hypot, sin

from .contact_law import ContactBlock, solve_friction_in_disc

__all__ = ["solve_one_contact"]

ROUNDING = 1e-14
"""Approach, as a share of the approach before, that counts as stopped. Smaller: the bracket never closes."""

LAST_STEP = 1e-9
"""Step of Newton's method [rad] from which the impulse follows to first order: what is left is its square. Larger: the
sweeps do not end. Smaller: one more iteration each, and the same impulse."""

Row = tuple[float, float, float]
NONE: Row = (0.0, 0.0, 0.0)


def solve_one_contact(W: ContactBlock, v: Row, mu: float, start_angle: float | None = None) -> tuple[Row, float | None]:
    """Impulse (P_n, P_1, P_2) [N s] of one contact with the velocity v [m/s] before, and the angle of friction [rad] if
    the contact slides.

    start_angle: from which the search starts; None: against the slip before.
    """
    v_n, v_1, v_2 = v
    if v_n >= 0.0:
        return NONE, None
    stick = _solve_stick(W, v, mu)
    if stick is not None:
        return stick, None
    if mu == 0.0:
        return (-v_n / W.W_nn, 0.0, 0.0), None
    sliding = _solve_slide(W, v, mu, atan2(-v_2, -v_1) if start_angle is None else start_angle)
    return sliding if sliding is not None else _solve_bracketed(W, v, mu)


def _solve_stick(W: ContactBlock, v: Row, mu: float) -> Row | None:
    """The impulse that stops all three directions; None if it is not in the cone."""
    v_n, v_1, v_2 = v
    if (W.h_1 == 0.0 and v_1 != 0.0) or (W.h_2 == 0.0 and v_2 != 0.0):
        return None
    rest = W.W_nn - W.w_1 * W.w_1 * W.h_1 - W.w_2 * W.w_2 * W.h_2
    if rest <= ROUNDING * W.W_nn:  # friction that holds both tangents holds the normal
        return None
    P_n = (W.w_1 * W.h_1 * v_1 + W.w_2 * W.h_2 * v_2 - v_n) / rest
    P_1, P_2 = -(v_1 + W.w_1 * P_n) * W.h_1, -(v_2 + W.w_2 * P_n) * W.h_2
    return (P_n, P_1, P_2) if hypot(P_1, P_2) <= mu * P_n else None


def _solve_slide(W: ContactBlock, v: Row, mu: float, angle: float) -> tuple[Row, float] | None:
    """Impulse P_n (1, mu cos, mu sin) that stops the approach and leaves a slip opposite to friction; None if Newton's
    method does not find one."""
    W_nn, w_1, w_2, a_1, a_2, _, _ = W
    v_n, v_1, v_2 = v
    for _ in range(15):
        c, s = cos(angle), sin(angle)
        W_eff = W_nn + mu * (w_1 * c + w_2 * s)
        if W_eff <= 1e-3 * W_nn:
            return None
        P_n = -v_n / W_eff
        P_1, P_2 = mu * P_n * c, mu * P_n * s
        slip_1, slip_2 = v_1 + w_1 * P_n + a_1 * P_1, v_2 + w_2 * P_n + a_2 * P_2
        across, along = s * slip_1 - c * slip_2, c * slip_1 + s * slip_2
        grown = -P_n * mu * (w_2 * c - w_1 * s) / W_eff  # dP_n / dangle
        d_1 = w_1 * grown + a_1 * mu * (grown * c - P_n * s)
        d_2 = w_2 * grown + a_2 * mu * (grown * s + P_n * c)
        slope = along + s * d_1 - c * d_2
        if slope == 0.0:
            return None
        step = -across / slope
        if abs(step) <= LAST_STEP:
            if along > 0.0:
                return None
            P = P_n + grown * step, P_1 + mu * (grown * c - P_n * s) * step, P_2 + mu * (grown * s + P_n * c) * step
            return P, angle + step
        angle += step if abs(step) <= 0.5 else copysign(0.5, step)
    # Rounding may keep the step from getting smaller: then the slip across friction, which it would change, decides.
    return ((P_n, P_1, P_2), angle) if along < 0.0 and abs(across) <= 1e-12 * hypot(v_n, v_1, v_2) else None


def _solve_bracketed(W: ContactBlock, v: Row, mu: float) -> tuple[Row, float | None]:
    """Impulse and angle of friction of a sliding contact by the zero of f(P_n).

    The zero is bracketed from P_n = 0 outwards; the bracket is closed by secants and halving.
    """

    def f(P_n: float) -> float:
        P_1, P_2 = solve_friction_in_disc(W, v[1] + W.w_1 * P_n, v[2] + W.w_2 * P_n, mu * P_n)
        return v[0] + W.W_nn * P_n + W.w_1 * P_1 + W.w_2 * P_2

    low, f_low = 0.0, v[0]
    high = -0.125 * v[0] / W.W_nn
    f_high = f(high)
    stopped = ROUNDING * v[0]
    for _ in range(200):
        if f_high >= stopped:
            break
        low, f_low, high = high, f_high, 2.0 * high
        f_high = f(high)
    else:  # no impulse in the cone stops the ships: none moves along any of its directions
        return (-v[0] / W.W_nn, 0.0, 0.0), None
    for k in range(200):
        middle = 0.5 * (low + high) if k % 3 == 2 else low - f_low * (high - low) / (f_high - f_low)
        if not low < middle < high:
            break
        f_middle = f(middle)
        if f_middle < stopped:
            low, f_low = middle, f_middle
        else:
            high, f_high = middle, max(f_middle, 0.0)
    P_n = low if -f_low < f_high else high
    P_1, P_2 = solve_friction_in_disc(W, v[1] + W.w_1 * P_n, v[2] + W.w_2 * P_n, mu * P_n)
    return (P_n, P_1, P_2), atan2(P_2, P_1)
