"""The impact process of one contact (Routh, Keller, Stronge): slip, stick and reslip. The response `closed_form`.

The normal part p of the impulse P [N s] grows from zero and takes the place of time. P changes the relative velocity v
[m/s] of the contact by dv = W dP, and friction obeys Coulomb's law throughout:

    slip     dP/dp = (1, -mu s/|s|)                          the slip s turns on the way: slip_flow.py
    stick    dP/dp = (1, q),   q = -W_tt^-1 W_tn             if |q| <= mu
    reslip   dP/dp = (1, -mu D),   D constant                otherwise; slip does not stop a second time

The normal velocity v_n rises from the approach to zero (compression) and on (restitution). The impact ends when the
normal impulse has given back the share e^2 of the work that it took in (Stronge's energetic restitution):

    integral of v_n dp over restitution = -e^2 times that over compression

    E_n = -integral of v_n dp = (1 - e^2) W_c >= 0           energy lost along the normal     [J]
    E_t = -integral of s.dP_t = mu integral of |s| dp >= 0   energy lost to friction          [J]

so energy is never created, whatever the geometry (but for H_tn in held_motions.py). Newton's restitution (v_n after =
-e v_n before) with friction can create energy, see tests/oracles/newton_impact.py. Both give the same impulse where
slip neither stops nor turns, where there is no friction, and where a plastic impact ends in stick.

A jam, in which friction presses the hulls together faster than the normal impulse parts them, needs no special case:
the slip slows down and stops, and the path goes on from there. W may be singular, as it is for ships that move in the
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
from .slip_flow import INVARIANT, SlipFlow, Stretch

__all__ = ["ImpactProcess", "estimate_losses", "solve_impact_process"]

STILL = 1e-14
"""Slip, as a share of the approach speed, that counts as none: it is rounding."""

REST = 1e-100
"""Approach speed [m/s] that counts as none: squares of a smaller speed leave the range of numbers."""

RANK = 1e-9
"""Share of W_nn below which an impulse does not move the hulls along the normal: no ship can give way."""

IMMOBILE = 1e-12
"""Share of W_nn below which an eigenvalue of W_tt is a direction in which no ship moves, so that friction does nothing.
Where heave is held and the normal slopes by less than 1e-6, up to mu 1e-6 of the approach is left by that. A larger
share leaves more, by its square root; with a smaller share friction is divided by rounding."""

MAX_STRETCHES = 500
"""Bound on the stretches of a turning slip. It is met only where two invariant directions nearly coincide. The slip
then goes straight on, which is nearly its path."""

MOST_GUESSES = 60
"""Bound on the guesses of the instant at which an event lies. Four are mostly enough."""

ROUNDING = 1e-15
"""What is left of the normal velocity or of the work at an event, or of its instant as a share, that is rounding: a
hundredth of the error of the path."""

STEP = 0.5
"""Most by which the slip changes in a step of estimate_losses, as a share of itself. With 1 the parts are off by some
per cent."""

NEAR = 0.005
"""Angle [rad] to a direction that the slip approaches and then keeps, from which estimate_losses follows that one."""

STOPPED = 1e-4
"""Slip, as a share of the approach speed or of the first slip, that estimate_losses takes for stopped: 1e-8 of the
energy."""

MAX_STEPS = 200
"""Bound on the steps of estimate_losses. Where it is met, the slip hardly changes and is taken for stopped."""

Ending = Literal["apart", "slip", "stick", "reslip"]


@dataclass(frozen=True, eq=False)
class ImpactProcess:
    """The end of an impact. P (d,) [N s] on ship b in contact axes, normal first; after (d,): relative velocity [m/s].

    energy_normal, energy_tangential: lost along the normal and to friction [J]. ending: apart (there was no approach),
    slip (the slip never stopped), stick, or reslip (the slip stopped and started anew). stretches: of a turning slip
    that were integrated.
    """

    P: Array
    after: Array
    energy_normal: float
    energy_tangential: float
    ending: Ending
    stretches: int = 0


def solve_impact_process(W: Array, v: Array, mu: float, e: float, H: Array | None = None) -> ImpactProcess:
    """The end of the impact of one contact with friction mu >= 0 and restitution 0 <= e <= 1.

    W (d, d) [1/kg] and v (d,) [m/s] in contact axes, normal first, d = 2 or 3. v is of ship b relative to ship a, with
    a negative normal part on approach. H (d, d): what held motions add to the slip (held_motions.py).
    Raises StepError when no ship can move along the normal.
    """
    W, v = np.asarray(W, dtype=float), np.asarray(v, dtype=float)
    d = len(v)
    if v[0] >= -REST:
        return ImpactProcess(np.zeros(d), v.copy(), 0.0, 0.0, "apart")
    speed, W_nn = -float(v[0]), float(W[0, 0])
    if W_nn <= 0.0:
        raise StepError(f"W_nn = {W_nn:g} 1/kg at a contact must be > 0: neither ship can move along the normal")
    path, (c, s) = _start(W, v, mu, e, H)
    ending = _follow(path, _follow_slip)
    p, P_1, P_2 = path.P
    P = np.array([p, c * P_1 - s * P_2, s * P_1 + c * P_2])[:d] * (speed / W_nn)
    unit = speed * speed / W_nn
    return ImpactProcess(P, v + W @ P, path.E_n * unit, path.E_t * unit, ending, path.stretches)


def estimate_losses(W: Array, v: Array, mu: float, e: float, H: Array | None = None) -> tuple[float, float]:
    """(energy_normal, energy_tangential) of solve_impact_process [J], at a small part of its cost.

    Exact where the slip keeps its direction until it stops, and from there on. A slip that turns is followed in steps,
    in each of which friction has one direction. The share of friction is then accurate to 1 %, mostly to 0.1 %, and the
    sum to some per cent.
    """
    speed, W_nn = -float(v[0]), float(W[0, 0])
    if speed <= REST or W_nn <= 0.0:
        return 0.0, 0.0
    path, _ = _start(W, v, mu, e, H)
    _follow(path, _step_along_slip)
    unit = speed * speed / W_nn
    return path.E_n * unit, path.E_t * unit


def _start(W: Array, v: Array, mu: float, e: float, H: Array | None) -> tuple[_Path, tuple[float, float]]:
    """The path at its start, with tangents along the eigenvectors of W_tt, and the (cos, sin) of their turn."""
    speed, W_nn = -float(v[0]), float(W[0, 0])
    to_slip = W if H is None else W + H
    if len(v) == 2:
        w, n, A, slip = (to_slip[1, 0], 0.0), (W[0, 1], 0.0), (to_slip[1, 1], 0.0), (v[1], 0.0)
        c, s = 1.0, 0.0
    else:
        _, (w_1, a, b), (w_2, _, d) = to_slip.tolist()
        _, n_1, n_2 = W[0].tolist()
        _, v_1, v_2 = v.tolist()
        turn = 0.5 * atan2(2.0 * b, a - d)
        c, s = cos(turn), sin(turn)
        w, n, slip = ((c * x + s * y, c * y - s * x) for x, y in ((w_1, w_2), (n_1, n_2), (v_1, v_2)))
        A = (a * c * c + 2.0 * b * c * s + d * s * s, a * s * s - 2.0 * b * c * s + d * c * c)
    mobile = [1.0 / W_nn if x >= IMMOBILE * W_nn else 0.0 for x in A]
    scaled = [float(x * m) for part in (w, n, A) for x, m in zip(part, mobile, strict=True)]
    flow = SlipFlow(scaled[0], scaled[1], scaled[2], scaled[3], scaled[4], scaled[5], mu)
    return _Path(flow, e * e, [float(x) / speed for x in slip]), (c, s)


class _Path:
    """The state of an impact on its path, in units of the approach speed and W_nn."""

    def __init__(self, flow: SlipFlow, returned: float, slip: list[float]) -> None:
        self.flow = flow
        self.returned = returned  # e^2
        self.v_n = -1.0
        self.slip = slip
        self.P = [0.0, 0.0, 0.0]
        self.stored = 0.0  # work that restitution may still give back
        self.compressing = True
        self.E_n = self.E_t = 0.0
        self.stretches = 0

    def move(self, p: float, P_1: float, P_2: float, N: float, E_t: float) -> None:
        """Add the impulses and works of a stretch that lies as a whole in compression or in restitution."""
        flow = self.flow
        self.P = [self.P[0] + p, self.P[1] + P_1, self.P[2] + P_2]
        self.v_n += p + flow.n_1 * P_1 + flow.n_2 * P_2
        self.slip = [
            self.slip[0] + flow.w_1 * p + flow.A_1 * P_1,
            self.slip[1] + flow.w_2 * p + flow.A_2 * P_2,
        ]
        self.stored -= N * (self.returned if self.compressing else 1.0)
        self.E_n -= N
        self.E_t += E_t

    def turn(self) -> bool:
        """Whether the impact ends here, where v_n is zero; else change from compression to restitution, or back."""
        self.v_n, self.compressing = 0.0, not self.compressing
        return not self.compressing and self.stored <= 0.0


def _follow(path: _Path, follow_slip: Callable[[_Path], bool]) -> Ending:
    """How the impact ends, with `path` at its end. follow_slip: whether the impact ends while the contact slips."""
    flow = path.flow
    if flow.mu == 0.0:
        _follow_straight(path, 0.0, 0.0, inf)
        return "slip"
    if hypot(*path.slip) > STILL and follow_slip(path):
        return "slip"
    path.slip = [0.0, 0.0]
    q_1 = -flow.w_1 / flow.A_1 if flow.A_1 else 0.0
    q_2 = -flow.w_2 / flow.A_2 if flow.A_2 else 0.0
    if hypot(q_1, q_2) <= flow.mu:
        _follow_straight(path, q_1, q_2, inf)
        return "stick"
    c, s = flow.solve_reslip()
    _follow_straight(path, -flow.mu * c, -flow.mu * s, inf)
    return "reslip"


def _follow_straight(path: _Path, q_1: float, q_2: float, p_most: float) -> bool:
    """Whether the impact ends on the straight path dP/dp = (1, q_1, q_2) before p_most, at which the slip stops."""
    flow = path.flow
    a_n = 1.0 + flow.n_1 * q_1 + flow.n_2 * q_2  # dv_n/dp
    if p_most == inf and a_n <= RANK:
        return True  # no impulse in this direction moves the hulls apart
    while True:
        v_n = path.v_n
        to_zero = -v_n / a_n if v_n * a_n < 0.0 else inf
        to_end = inf
        if not path.compressing:
            square = v_n * v_n + 2.0 * a_n * path.stored
            if square >= 0.0 and v_n + sqrt(square) > 0.0:
                to_end = 2.0 * path.stored / (v_n + sqrt(square))
        p = min(to_zero, to_end, p_most)
        if p == inf:
            return True
        s_1, s_2 = path.slip
        a_1, a_2 = flow.w_1 + flow.A_1 * q_1, flow.w_2 + flow.A_2 * q_2
        slipped = q_1 * (s_1 + 0.5 * a_1 * p) + q_2 * (s_2 + 0.5 * a_2 * p)
        path.move(p, q_1 * p, q_2 * p, p * (v_n + 0.5 * a_n * p), -p * slipped)
        p_most -= p
        if p == to_end:
            return True
        if p == to_zero:
            if path.turn():
                return True
        else:
            return False


def _step_along_slip(path: _Path) -> bool:
    """As _follow_slip, in straight steps: friction in a step is the mean of Runge and Kutta's four directions."""
    flow = path.flow
    w_1, w_2, A_1, A_2, mu, rate = flow.w_1, flow.w_2, flow.A_1, flow.A_2, flow.mu, flow.rate
    stopped = STOPPED * max(1.0, hypot(*path.slip))

    def direction(x: float, y: float) -> tuple[float, float]:
        size = -mu / (hypot(x, y) or 1.0)
        return size * x, size * y

    for _ in range(MAX_STEPS):
        x, y = path.slip
        sigma = hypot(x, y)
        if sigma <= stopped:
            return False
        a_1, a_2 = direction(x, y)
        u, v = w_1 + A_1 * a_1, w_2 + A_2 * a_2
        turning = (v * x - u * y) / sigma
        bend = -(w_1 * x + w_2 * y) / sigma + mu * (A_1 - A_2) * (x * x - y * y) / (
            sigma * sigma
        )  # of turning, by angle
        if abs(turning) <= max(INVARIANT * rate, -NEAR * bend):
            return _keep_direction(path, turning / bend if bend < 0.0 else 0.0)
        p = STEP * sigma / (hypot(u, v) + abs(bend))
        b_1, b_2 = direction(x + 0.5 * p * u, y + 0.5 * p * v)
        c_1, c_2 = direction(x + 0.5 * p * (w_1 + A_1 * b_1), y + 0.5 * p * (w_2 + A_2 * b_2))
        d_1, d_2 = direction(x + p * (w_1 + A_1 * c_1), y + p * (w_2 + A_2 * c_2))
        q_1, q_2 = (a_1 + 2.0 * (b_1 + c_1) + d_1) / 6.0, (a_2 + 2.0 * (b_2 + c_2) + d_2) / 6.0
        if _follow_straight(path, q_1, q_2, p):
            return True
    return False


def _keep_direction(path: _Path, ahead: float) -> bool:
    """As _follow_slip, straight on in the direction that lies -ahead [rad] from the slip."""
    flow, (x, y) = path.flow, path.slip
    sigma, angle = hypot(x, y), atan2(y, x) - ahead
    path.slip = [sigma * cos(angle), sigma * sin(angle)]
    g = flow.growth(angle)
    return _follow_straight(path, -flow.mu * cos(angle), -flow.mu * sin(angle), -sigma / g if g < 0.0 else inf)


def _follow_slip(path: _Path) -> bool:
    """Whether the impact ends while the contact slips; else the slip has stopped."""
    flow = path.flow
    angle, log_slip = atan2(path.slip[1], path.slip[0]), log(hypot(*path.slip))
    tau = inf
    for _ in range(MAX_STRETCHES):
        if exp(log_slip) <= STILL:
            return False
        if flow.is_invariant(angle):
            break
        # At most: the slip turns by a radian or changes by a factor e; the impulse is about that of the approach.
        tau = min(tau, 1.0 / flow.rate, 1.0 / exp(log_slip))
        end, columns = flow.integrate(angle, log_slip, path.v_n, tau)
        path.stretches += 1
        if columns is None:
            tau *= 0.5
            continue
        event = _find_event(path, end)
        if event == "shorten":
            tau *= 0.5
            continue
        if event:
            end = _locate_event(path, angle, log_slip, end, tau, event)
        path.move(end.p, end.P_1, end.P_2, end.N, end.E_t)
        if event == "given back" or (event == "turn" and path.turn()):
            return True
        angle, log_slip = end.angle, end.log_slip
        tau *= 2.0
    path.slip = [exp(log_slip) * cos(angle), exp(log_slip) * sin(angle)]
    return _keep_direction(path, 0.0)


Event = Literal["", "turn", "given back", "shorten"]


def _normal_velocity(path: _Path, end: Stretch) -> float:
    """v_n at the end of a stretch."""
    return path.v_n + end.p + path.flow.n_1 * end.P_1 + path.flow.n_2 * end.P_2


def _find_event(path: _Path, end: Stretch) -> Event:
    """The first event of a stretch: v_n passes zero, or restitution has given back its share."""
    v_n = _normal_velocity(path, end)
    if path.compressing:
        return "turn" if v_n >= 0.0 else ""
    if v_n < 0.0:  # rare: a slip that has turned presses the hulls together again
        return "shorten" if path.v_n == 0.0 or path.stored <= end.N + RANK else "turn"
    return "given back" if path.stored <= end.N else ""


def _locate_event(path: _Path, angle: float, log_slip: float, end: Stretch, tau: float, event: Event) -> Stretch:
    """The stretch up to an event that lies within tau, of which `end` is the whole stretch.

    Newton's method, as the rates of what passes zero are known; it keeps to the bracket of the zero.
    """
    flow = path.flow

    def passes(stretch: Stretch) -> float:
        return stretch.N - path.stored if event == "given back" else _normal_velocity(path, stretch)

    f_0, f_1 = -path.stored if event == "given back" else path.v_n, passes(end)
    share = f_0 / (f_0 - f_1) if f_0 != f_1 else 1.0
    low, high, x = 0.0, tau, tau * (sqrt(share) if event == "given back" else share)  # restitution begins at v_n = 0
    for _ in range(MOST_GUESSES):
        end, _ = flow.integrate(angle, log_slip, path.v_n, x)
        path.stretches += 1
        f, c, s = passes(end), cos(end.angle), sin(end.angle)
        if (f < 0.0) == (f_0 < 0.0):
            low = x
        else:
            high = x
        rate = exp(end.log_slip)  # dp/dtau
        rate *= _normal_velocity(path, end) if event == "given back" else 1.0 - flow.mu * (flow.n_1 * c + flow.n_2 * s)
        new = x - f / rate if rate else low
        if abs(f) <= ROUNDING or abs(new - x) <= ROUNDING * x:
            break
        x = new if low < new < high else 0.5 * (low + high)
    return end
