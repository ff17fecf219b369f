"""One impact along its normal impulse: slip, stick and slip again, with energetic restitution (Routh, Keller, Stronge).

The impulse P (normal part p, growing from 0) changes the relative velocity v of a contact by dv = W dP, and at every
instant friction obeys Coulomb's law:

    slip     dP/dp = (1, -mu s/|s|)                          the slip s turns as it goes: slip_flow.py
    stick    dP/dp = (1, q),   q = -W_tt^-1 W_tn             if |q| <= mu
    again    dP/dp = (1, -mu D),   D constant                otherwise; slip does not stop a second time

The normal velocity v_n rises from the approach to zero (compression) and on (restitution). The contact ends when the
normal impulse has given back the share e^2 of the work that it took in (Stronge):

    integral of v_n dp over restitution = -e^2 times that over compression

    E_n = -integral of v_n dp = (1 - e^2) W_c >= 0           energy lost along the normal     [J]
    E_t = -integral of s.dP_t = mu integral of |s| dp >= 0   energy lost to friction          [J]

so energy is never created, whatever the geometry. Newton's restitution (v_n after = -e v_n before) with friction can
create it, see tests/oracles/newton_impact.py. Where slip neither stops nor turns, and without friction, the impulse is
that of the closed form at any e; where a plastic impact ends in stick, too.

Friction that presses the hulls together faster than the normal impulse parts them (a "jam") needs no special case: the
slip then decelerates, stops, and the path goes on from there. W may be singular, as it is for ships that move in the
plane. The arithmetic is in units of the approach speed and of W_nn.

Sources: Keller (1986), "Impact with friction", J. Appl. Mech. 53:1-4; Stronge (2000), Impact Mechanics, chapters 3
and 4; Batlle (1996), "Rough balanced collisions", J. Appl. Mech. 63:168-172.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import atan2, cos, exp, hypot, inf, log, sin, sqrt
from typing import Literal

import numpy as np

from ...errors import StepError
from ...ship.frames import Array
from .slip_flow import SlipFlow, Stretch

__all__ = ["ImpactProcess", "solve_impact_process"]

STILL = 1e-14
"""Slip, in units of the approach speed, that counts as none: rounding."""

REST = 1e-100
"""Approach speed [m/s] that counts as none: below it squares of speeds leave the range of numbers."""

RANK = 1e-9
"""Share of W_nn below which an impulse does not move the hulls along the normal: neither ship can give way."""

FLAT = 1e-12
"""Eigenvalues of W_tt below this share of W_nn are directions in which neither ship can move; friction does nothing.
With a normal that slopes by less than 1e-6 where heave is held, up to mu 1e-6 of the approach is left by that."""

MAX_STRETCHES = 10_000
"""Bound on the stretches of a turning slip. It is met only where two settled directions all but coincide; the slip then
goes straight on, as it very nearly does anyway."""

Ending = Literal["apart", "slip", "stick", "reslip"]


@dataclass(frozen=True, eq=False)
class ImpactProcess:
    """An impact. P (d,) [N s] on ship b in contact axes (normal first); after (d,): relative velocity [m/s].

    Energy lost along the normal and to friction [J]; how it ended: apart (there was no approach), slip (it never
    stopped), stick, or again (it stopped and started anew).
    """

    P: Array
    after: Array
    energy_normal: float
    energy_tangential: float
    ending: Ending


def solve_impact_process(W: Array, v: Array, mu: float, e: float) -> ImpactProcess:
    """The impact of one contact. W (d, d) [1/kg] and v (d,) [m/s] in contact axes, normal first, d = 2 or 3.

    v is of ship b relative to ship a, its normal part negative on approach. mu >= 0; 0 <= e <= 1.
    Raises StepError when neither ship can move along the normal.
    """
    W, v = np.asarray(W, dtype=float), np.asarray(v, dtype=float)
    d = len(v)
    if v[0] >= -REST:
        return ImpactProcess(np.zeros(d), v.copy(), 0.0, 0.0, "apart")
    speed, W_nn = -float(v[0]), float(W[0, 0])
    if W_nn <= 0.0:
        raise StepError(f"W_nn = {W_nn:g} 1/kg at a contact must be > 0: neither ship can move along the normal")
    # Tangents along the eigenvectors of W_tt.
    values, axes = np.linalg.eigh(W[1:, 1:] / W_nn)
    w = axes.T @ W[1:, 0] / W_nn
    slip = axes.T @ v[1:] / speed
    flat = values < FLAT
    values, w = np.where(flat, 0.0, values), np.where(flat, 0.0, w)
    padded = [np.concatenate([x, np.zeros(3 - d)]).tolist() for x in (values, w, slip)]
    impact = _Impact(SlipFlow(padded[1][0], padded[1][1], padded[0][0], padded[0][1], mu), e * e, padded[2])
    ending = _followed(impact)
    P = np.concatenate([[impact.P[0]], axes @ impact.P[1:d]]) * (speed / W_nn)
    unit = speed * speed / W_nn
    return ImpactProcess(P, v + W @ P, impact.E_n * unit, impact.E_t * unit, ending)


class _Impact:
    """Where an impact is on its path. Everything in units of the approach speed and W_nn."""

    def __init__(self, flow: SlipFlow, returned: float, slip: list[float]) -> None:
        self.flow = flow
        self.returned = returned  # e^2
        self.v_n = -1.0
        self.slip = slip
        self.P = [0.0, 0.0, 0.0]
        self.stored = 0.0  # work that restitution may still give back
        self.compressing = True
        self.E_n = self.E_t = 0.0

    def move(self, p: float, P_1: float, P_2: float, N: float, E_t: float) -> None:
        """Take the impulses and works of a stretch that lies in compression or in restitution as a whole."""
        flow = self.flow
        self.P = [self.P[0] + p, self.P[1] + P_1, self.P[2] + P_2]
        self.v_n += p + flow.w_1 * P_1 + flow.w_2 * P_2
        self.slip = [
            self.slip[0] + flow.w_1 * p + flow.A_1 * P_1,
            self.slip[1] + flow.w_2 * p + flow.A_2 * P_2,
        ]
        self.stored -= N * (self.returned if self.compressing else 1.0)
        self.E_n -= N
        self.E_t += E_t

    def turn(self) -> bool:
        """Normal velocity zero: from compression to restitution, or back. Whether the contact ends here."""
        self.v_n, self.compressing = 0.0, not self.compressing
        return not self.compressing and self.stored <= 0.0


def _followed(impact: _Impact) -> Ending:
    flow = impact.flow
    if flow.mu == 0.0:
        _straight(impact, 0.0, 0.0, inf)
        return "slip"
    if hypot(*impact.slip) > STILL and _slid(impact):
        return "slip"
    impact.slip = [0.0, 0.0]
    q_1 = -flow.w_1 / flow.A_1 if flow.A_1 else 0.0
    q_2 = -flow.w_2 / flow.A_2 if flow.A_2 else 0.0
    if hypot(q_1, q_2) <= flow.mu:
        _straight(impact, q_1, q_2, inf)
        return "stick"
    c, s = flow.restart()
    _straight(impact, -flow.mu * c, -flow.mu * s, inf)
    return "reslip"


def _straight(impact: _Impact, q_1: float, q_2: float, p_most: float) -> bool:
    """Along dP/dp = (1, q_1, q_2) for p_most, in which the slip stops. Whether the contact ends on the way."""
    flow = impact.flow
    a_n = 1.0 + flow.w_1 * q_1 + flow.w_2 * q_2  # dv_n/dp
    if p_most == inf and a_n <= RANK:
        return True  # no impulse along this way moves the hulls apart
    while True:
        v_n = impact.v_n
        to_zero = -v_n / a_n if v_n * a_n < 0.0 else inf
        to_end = inf
        if not impact.compressing:
            square = v_n * v_n + 2.0 * a_n * impact.stored
            if square >= 0.0 and v_n + sqrt(square) > 0.0:
                to_end = 2.0 * impact.stored / (v_n + sqrt(square))
        p = min(to_zero, to_end, p_most)
        if p == inf:
            return True
        s_1, s_2 = impact.slip
        a_1, a_2 = flow.w_1 + flow.A_1 * q_1, flow.w_2 + flow.A_2 * q_2
        slipped = q_1 * (s_1 + 0.5 * a_1 * p) + q_2 * (s_2 + 0.5 * a_2 * p)
        impact.move(p, q_1 * p, q_2 * p, p * (v_n + 0.5 * a_n * p), -p * slipped)
        p_most -= p
        if p == to_end:
            return True
        if p == to_zero:
            if impact.turn():
                return True
        else:
            return False


def _slid(impact: _Impact) -> bool:
    """Follow the slip until the contact ends (True) or the slip stops (False)."""
    flow = impact.flow
    angle, log_slip = atan2(impact.slip[1], impact.slip[0]), log(hypot(*impact.slip))
    tau = inf
    for _ in range(MAX_STRETCHES):
        if exp(log_slip) <= STILL:
            return False
        if flow.settled(angle):
            break
        # Not farther than the slip could turn by a radian or change by e, nor than an impulse of about the approach.
        tau = min(tau, 1.0 / flow.rate, 1.0 / exp(log_slip))
        end, columns = flow.stretch(angle, log_slip, impact.v_n, tau)
        if columns is None:
            tau *= 0.5
            continue
        event = _event(impact, end)
        if event == "again, shorter":
            tau *= 0.5
            continue
        if event:
            end = _located(impact, angle, log_slip, tau, event)
        impact.move(end.p, end.P_1, end.P_2, end.N, _friction_work(impact, end))
        if event == "given back" or (event == "turn" and impact.turn()):
            return True
        angle, log_slip = end.angle, end.log_slip
        tau *= 2.0
    sigma, g = exp(log_slip), flow.growth(angle)
    q_1, q_2 = -flow.mu * cos(angle), -flow.mu * sin(angle)
    impact.slip = [sigma * cos(angle), sigma * sin(angle)]
    return _straight(impact, q_1, q_2, -sigma / g if g < 0.0 else inf)


def _friction_work(impact: _Impact, end: Stretch) -> float:
    """Energy (in the units here) lost to friction along a stretch: all that is lost, less that along the normal."""
    flow = impact.flow
    dv_n = end.p + flow.w_1 * end.P_1 + flow.w_2 * end.P_2
    ds_1, ds_2 = flow.w_1 * end.p + flow.A_1 * end.P_1, flow.w_2 * end.p + flow.A_2 * end.P_2
    s_1, s_2 = impact.slip
    lost = end.p * (impact.v_n + 0.5 * dv_n) + end.P_1 * (s_1 + 0.5 * ds_1) + end.P_2 * (s_2 + 0.5 * ds_2)
    return -lost + end.N


Event = Literal["", "turn", "given back", "again, shorter"]


def _normal_velocity(impact: _Impact, end: Stretch) -> float:
    return impact.v_n + end.p + impact.flow.w_1 * end.P_1 + impact.flow.w_2 * end.P_2


def _event(impact: _Impact, end: Stretch) -> Event:
    """What happens on a stretch first: v_n passes zero, or restitution has given back its share."""
    v_n = _normal_velocity(impact, end)
    if impact.compressing:
        return "turn" if v_n >= 0.0 else ""
    if v_n < 0.0:  # rare: a slip that turned presses the hulls together anew
        return "again, shorter" if impact.v_n == 0.0 or impact.stored <= end.N + RANK else "turn"
    return "given back" if impact.stored <= end.N else ""


def _located(impact: _Impact, angle: float, log_slip: float, tau: float, event: Event) -> Stretch:
    """The stretch up to the event, which lies within tau."""

    def at(x: float) -> Stretch:
        return impact.flow.stretch(angle, log_slip, impact.v_n, x)[0]

    def miss(x: float) -> float:
        end = at(x)
        return end.N - impact.stored if event == "given back" else _normal_velocity(impact, end)

    return at(_root(miss, tau))


def _root(f: Callable[[float], float], b: float) -> float:
    """Zero of f between 0 and b, to rounding: regula falsi with Illinois' weights."""
    a, f_a, f_b = 0.0, f(0.0), f(b)
    for _ in range(100):
        if f_b == 0.0 or f_a == f_b:
            return b
        c = b - f_b * (b - a) / (f_b - f_a)
        if c in (a, b):
            return c
        f_c = f(c)
        if f_c * f_b < 0.0:
            a, f_a = b, f_b
        else:
            f_a *= 0.5
        b, f_b = c, f_c
        if abs(b - a) <= 1e-16 * abs(b):
            break
    return b
