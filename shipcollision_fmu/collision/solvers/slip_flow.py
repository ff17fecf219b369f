"""The slip flow of one contact: how the slip turns and slows down while friction acts against it.

Along the normal impulse p [N s] the slip s = sigma (cos phi, sin phi) [m/s] obeys, with D = (cos phi, sin phi) and the
unit vector D' across D,

    dsigma/dp = g(phi) = D.w - mu D.A D          w (2,), A (2, 2): rows of W for the slip, by normal and by friction
    sigma dphi/dp = h(phi) = D'.w - mu D'.A D
    dv_n/dp       = 1 - mu D.n                            n (2,): row of W for the normal, by friction

n = w, but where motions are held (held_motions.py). These equations are singular where the slip stops. In the time tau
with dp = sigma dtau they are regular:

    dphi/dtau = h,    d(ln sigma)/dtau = g,    dp/dtau = sigma,    dP_t/dtau = -mu sigma D,
    dN/dtau = sigma v_n,    dE_t/dtau = mu sigma^2

The slip stops at tau = infinity, along an invariant direction, h = 0, in which the path is straight. The equations are
integrated by Gragg's midpoint rule with extrapolation (Bulirsch and Stoer). The direction is an angle in axes in which
A is diagonal. Speeds are in units of the approach speed, W in units of W_nn.

Sources: Keller (1986), J. Appl. Mech. 53:1-4; Batlle (1996), J. Appl. Mech. 63:168-172 (the flow of the slip); Hairer,
Norsett and Wanner (1993), Solving Ordinary Differential Equations I, section II.9 (extrapolation).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, exp, hypot, sin

__all__ = ["SlipFlow", "Stretch"]

TOLERANCE = 1e-13
"""Local error of a step, absolute in units of the approach speed, relative where a number is larger than 1. Larger: the
impulse is off by as much per stretch. Smaller: rounding keeps the extrapolation from converging."""

INVARIANT = 1e-14
"""Turning of the slip, as a share of its bound, below which the direction is invariant: the turning is rounding."""

COLUMNS = tuple(range(2, 22, 2))
"""Midpoint steps of the columns of the extrapolation: order 20 at most."""

SHARES = [[1.0 / ((n / COLUMNS[k - 1 - j]) ** 2 - 1.0) for j in range(k)] for k, n in enumerate(COLUMNS)]
"""Per column, the shares of Neville's scheme, by which a value is led on from that of the column before."""

State = tuple[float, float, float, float, float, float, float]


@dataclass(frozen=True)
class Stretch:
    """A stretch of the path: angle and ln sigma at its end; its impulses p and P_t = (P_1, P_2), N = integral of
    v_n dp, and E_t = mu integral of sigma dp, lost to friction."""

    angle: float
    log_slip: float
    p: float
    P_1: float
    P_2: float
    N: float
    E_t: float


@dataclass(frozen=True)
class SlipFlow:
    """The slip flow of one contact with w = (w_1, w_2), n = (n_1, n_2), A = diag(A_1, A_2) and friction mu."""

    w_1: float
    w_2: float
    n_1: float
    n_2: float
    A_1: float
    A_2: float
    mu: float

    @property
    def rate(self) -> float:
        """Bound of |g| and |h|."""
        return hypot(self.w_1, self.w_2) + self.mu * max(self.A_1, self.A_2)

    def growth(self, angle: float) -> float:
        """g: change of the slip's size per normal impulse."""
        c, s = cos(angle), sin(angle)
        return self.w_1 * c + self.w_2 * s - self.mu * (self.A_1 * c * c + self.A_2 * s * s)

    def turning(self, angle: float) -> float:
        """h: change of the slip's direction per normal impulse, times its size."""
        c, s = cos(angle), sin(angle)
        return self.w_2 * c - self.w_1 * s + self.mu * (self.A_1 - self.A_2) * s * c

    def is_invariant(self, angle: float) -> bool:
        """Whether the slip keeps this direction."""
        return abs(self.turning(angle)) <= INVARIANT * self.rate

    def integrate(self, angle: float, log_slip: float, v_n: float, tau: float) -> tuple[Stretch, int | None]:
        """The path over tau from a slip and a normal velocity, and the columns that it took; None: too few."""
        end, columns = self._extrapolate(angle, log_slip, v_n, tau)
        return Stretch(*end), columns

    def _extrapolate(self, angle: float, log_slip: float, v_n: float, tau: float) -> tuple[State, int | None]:
        """The state after tau by midpoint rules with ever more steps, extrapolated, and the columns that it took; None:
        too few."""
        row: list[State] = []
        for column, n in enumerate(COLUMNS):
            new = [self._midpoint(angle, log_slip, v_n, tau, n)]
            for last, share in zip(row, SHARES[column], strict=True):
                (a, b, c, d, e, f, g), (k, m, o, q, r, s, t) = new[-1], last
                new.append((
                    a + (a - k) * share, b + (b - m) * share, c + (c - o) * share, d + (d - q) * share,
                    e + (e - r) * share, f + (f - s) * share, g + (g - t) * share,
                ))  # fmt: skip
            if column >= 3:
                best, second = new[-1], new[-2]
                if all(abs(a - b) <= TOLERANCE * max(1.0, abs(a)) for a, b in zip(best, second, strict=True)):
                    return best, column
            row = new
        return row[-1], None

    def _midpoint(self, phi: float, log_slip: float, v_n: float, tau: float, n: int) -> State:
        """Gragg's smoothed midpoint rule of n (even) steps: its error is a series in (tau/n)^2.

        State: phi, ln sigma, p, P_1, P_2, N, E_t. As plain numbers: over tuples it takes six times as long.
        """
        w_1, w_2, n_1, n_2, mu = self.w_1, self.w_2, self.n_1, self.n_2, self.mu
        diagonal_1, diagonal_2, across = mu * self.A_1, mu * self.A_2, mu * (self.A_1 - self.A_2)
        h = tau / n
        was_phi = now_phi = phi
        was_log = now_log = log_slip
        was_p = was_1 = was_2 = was_N = was_E = p = P_1 = P_2 = N = E = 0.0
        for k in range(n + 1):
            step = 2.0 * h if 0 < k < n else h
            c, s, sigma = cos(now_phi), sin(now_phi), exp(now_log)
            friction = -mu * sigma
            turning = w_2 * c - w_1 * s + across * s * c
            growth = w_1 * c + w_2 * s - diagonal_1 * c * c - diagonal_2 * s * s
            power = sigma * (v_n + p + n_1 * P_1 + n_2 * P_2)
            was_phi, now_phi = now_phi, was_phi + step * turning
            was_log, now_log = now_log, was_log + step * growth
            was_p, p = p, was_p + step * sigma
            was_1, P_1 = P_1, was_1 + step * (friction * c)
            was_2, P_2 = P_2, was_2 + step * (friction * s)
            was_N, N = N, was_N + step * power
            was_E, E = E, was_E + step * (-friction * sigma)
        return (
            0.5 * (was_phi + now_phi), 0.5 * (was_log + now_log), 0.5 * (was_p + p), 0.5 * (was_1 + P_1),
            0.5 * (was_2 + P_2), 0.5 * (was_N + N), 0.5 * (was_E + E),
        )  # fmt: skip

    def solve_reslip(self) -> tuple[float, float]:
        """Direction (cos, sin) in which slip starts from rest when friction cannot hold the contact.

        There h = 0 and g > 0:  (g + mu A) D = w with |D| = 1. It is one equation for g with one root (Batlle).
        """
        mu, w_1, w_2, A_1, A_2 = self.mu, self.w_1, self.w_2, self.A_1, self.A_2
        g = max(abs(w_1) - mu * A_1, abs(w_2) - mu * A_2, 0.0)
        for _ in range(100):
            b_1, b_2 = g + mu * A_1, g + mu * A_2
            x = w_1 / b_1 if w_1 else 0.0
            y = w_2 / b_2 if w_2 else 0.0
            size = hypot(x, y)
            # Newton's method for 1/|D(g)| = 1, concave and rising: from the left it never overshoots.
            slope = (x * x / b_1 if w_1 else 0.0) + (y * y / b_2 if w_2 else 0.0)
            step = size * size * (size - 1.0) / slope
            if step <= 1e-16 * g:
                break
            g += step
        return x / size, y / size
