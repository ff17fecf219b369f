"""Turning circles and zigzags of published ships, to compare ships from four numbers with; support, not a test.

Each figure has its source and a grade: `read` (in the source, or in a public quotation of it), `recorded` (read off the
published track), `sailed` (the published set of measured coefficients, sailed by the equations below, which share no
code with the package), `recalled` (from memory, fairly sure, not read).

Lengths are in L_pp. What no source was found for is left out, and so are ships of which no figure could be sourced:
DTMB 5415, ONR Tumblehome, Series 60, Seiun Maru. MARIN's overshoots are read to 0.3 deg, of zigzags that begin to port.
The Mariner set of Chislett & Strom-Tejsen (1965) is left out, too: as
it circulates in public code it gives a tactical diameter of 6.4 L at 35 deg of rudder, far above the ship's trials.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from math import atan, atan2, cos, degrees, hypot, pi, radians, sin, sqrt

__all__ = ["SHIPS", "PublishedShip", "Source"]

State = list[float]
"""u, v [m/s], r [rad/s], x, y [m], psi [rad], and of some models p [rad/s], phi [rad]."""
Model = Callable[[State, float], State]
"""Accelerations u_dot, v_dot, r_dot, and p_dot, phi_dot of some models, at the rudder angle delta [rad] > 0 to
starboard."""


def accelerate_tanker_1972(state: State, delta: float) -> State:
    """Van Berlekom & Goddard (1972), Trans. SNAME 80:264-298: a tanker of 190 000 dwt in deep water at 80 rev/min."""
    u, v, r = state[:3]
    L, n, t = 304.8, 80.0 / 60.0, 0.22
    beta, c2 = atan(v / u), 0.605 * u * n + 38.2 * n * n
    thrust = -0.00695 * u * u / L - 0.00063 * u * n + L * 0.0000354 * n * n
    drifting = c2 * abs(beta) * beta * abs(delta)
    X = (
        -0.0377 * u * u + L * 2.020 * v * r + 0.3 * v * v - 0.093 * c2 * delta**2 + 0.152 * c2 * beta * delta
        + L * thrust * (1.0 - t)
    ) / L  # fmt: skip
    Y = (
        -1.205 * u * v - 2.4 * abs(v) * v + 0.208 * c2 * delta - L * 0.752 * u * r - 2.16 * drifting
        + 0.04 * thrust * L
    ) / L  # fmt: skip
    N = -0.451 * u * v - L * 0.3 * abs(v) * r - 0.098 * c2 * delta - L * 0.231 * u * r + 0.688 * drifting
    N -= L * 0.02 * thrust
    return [X / 1.05, Y / 2.02, N / (L * L * 0.1232)]


def accelerate_s175_1982(state: State, delta: float, n: float) -> State:
    """Son & Nomoto (1982), Nav. Archit. Ocean Eng. 20:73-83: S-175 with roll, GM 0.3 m, at n [1/s]."""
    L = 175.0
    U = hypot(state[0], state[1])
    u, v, r = state[0] / U, state[1] / U, state[2] * L / U
    p, phi, delta = state[6] * L / U, state[7], -delta
    m, m_x, m_y, I_x, J_x, I_z, J_z = 0.00792, 0.000238, 0.007049, 0.0000176, 0.0000034, 0.000456, 0.000419
    alpha_y, l_x, l_y, area, aspect, D, t = 0.05, 0.0313, 0.0313, 33.0376, 1.8219, 6.533, 0.175
    weight = 9.81 * 21222.0 / (L * L * U * U / 2.0)
    v_R = 0.088 * v - 0.156 * r - 0.275 * r**3 + 1.96 * r * r * v
    u_P = u * (1.0 - 0.184 + 1.09 * (v - 0.526 * r) ** 2)
    J = u_P * U / (n * D)
    K_T = 0.527 - 0.455 * J
    u_R = u_P * 0.921 * sqrt(1.0 + 8.0 * 0.631 * K_T / (pi * J * J))
    F_N = -(6.13 * aspect / (aspect + 2.25)) * (area / L**2) * (u_R**2 + v_R**2) * sin(delta + atan(v_R / u_R))
    T = 2.0 * D**4 / (U * U * L * L) * K_T * n * n
    X = (
        -0.0004226 * u * u + (1.0 - t) * T - 0.00311 * v * r - 0.00386 * v * v + 0.0002 * r * r - 0.0002 * phi * phi
        + 0.71 * F_N * sin(delta) + (m + m_y) * v * r
    )  # fmt: skip
    Y = (
        -0.0116 * v + 0.00242 * r - 0.000063 * phi - 0.109 * v**3 + 0.00177 * r**3 + 0.0214 * v * v * r
        - 0.0405 * v * r * r + 0.04605 * v * v * phi + 0.00304 * v * phi * phi + 0.009325 * r * r * phi
        - 0.001368 * r * phi * phi + 1.237 * F_N * cos(delta) - (m + m_x) * u * r
    )  # fmt: skip
    K = (
        0.0003026 * v - 0.000063 * r - 0.0000075 * p - 0.000021 * phi + 0.002843 * v**3 - 0.0000462 * r**3
        - 0.000588 * v * v * r + 0.0010565 * v * r * r - 0.0012012 * v * v * phi - 0.0000793 * v * phi * phi
        - 0.000243 * r * r * phi + 0.00003569 * r * phi * phi - 1.237 * 0.033 * F_N * cos(delta) + m_x * l_x * u * r
        - weight * 0.3 / L * phi
    )  # fmt: skip
    N = (
        -0.0038545 * v - 0.00222 * r + 0.000213 * p - 0.0001424 * phi + 0.001492 * v**3 - 0.00229 * r**3
        - 0.0424 * v * v * r + 0.00156 * v * r * r - 0.019058 * v * v * phi - 0.0053766 * v * phi * phi
        - 0.0038592 * r * r * phi + 0.0024195 * r * phi * phi - (0.5 + 0.237 * 0.48) * F_N * cos(delta)
    )  # fmt: skip
    m_22, m_32, m_42, m_33, m_44 = m + m_y, -m_y * l_y, m_y * alpha_y, I_x + J_x, I_z + J_z
    det = m_22 * m_33 * m_44 - m_32**2 * m_44 - m_42**2 * m_33
    a = U * U / L
    return [
        X * a / (m + m_x),
        (m_33 * m_44 * Y - m_32 * m_44 * K - m_42 * m_33 * N) / det * a,
        (-m_42 * m_33 * Y + m_32 * m_42 * K + N * (m_22 * m_33 - m_32**2)) / det * a / L,
        (-m_32 * m_44 * Y + K * (m_22 * m_44 - m_42**2) + m_32 * m_42 * N) / det * a / L,
        state[6],
    ]


def sail_published(model: Model, L: float, speed: float, extra: int) -> dict[str, float]:
    """Figures of the turning circle at 35 deg to starboard, and first overshoots of the 10/10 and 20/20 zigzags."""
    figures = _sail_circle(model, L, speed, extra)
    for angle in (10.0, 20.0):
        figures[f"{angle:g}/{angle:g}"] = _sail_zigzag(model, L, speed, extra, radians(angle))
    return figures


def _advance(model: Model, x: State, delta: float, h: float) -> State:
    """x after h [s] by the Runge-Kutta method of order 4."""

    def slope(z: State) -> State:
        made = model(z, delta)
        u, v, r, psi = z[0], z[1], z[2], z[5]
        return [*made[:3], u * cos(psi) - v * sin(psi), u * sin(psi) + v * cos(psi), r, *made[3:]]

    def moved(k: State, by: float) -> State:
        return [a + by * b for a, b in zip(x, k, strict=True)]

    a = slope(x)
    b = slope(moved(a, 0.5 * h))
    c = slope(moved(b, 0.5 * h))
    d = slope(moved(c, h))
    return [z + h / 6.0 * (p + 2.0 * q + 2.0 * s + t) for z, p, q, s, t in zip(x, a, b, c, d, strict=True)]


RATE = radians(65.0 / 28.0)
"""Rudder rate of SOLAS [rad/s]."""


def _sail_circle(model: Model, L: float, speed: float, extra: int) -> dict[str, float]:
    x, delta, h = [speed, *[0.0] * (5 + extra)], 0.0, 0.01 * L / speed
    figures: dict[str, float] = {}
    while abs(x[5]) < 4.0 * pi:
        delta = min(radians(35.0), delta + RATE * h)
        x = _advance(model, x, delta, h)
        if abs(x[5]) >= pi / 2.0:
            figures.setdefault("advance", x[3] / L)
        if abs(x[5]) >= pi:
            figures.setdefault("tactical diameter", abs(x[4]) / L)
    U = hypot(x[0], x[1])
    figures |= {
        "steady radius": U / abs(x[2]) / L, "drift angle": degrees(atan2(abs(x[1]), x[0])), "speed kept": U / speed,
    }  # fmt: skip
    return figures


def _sail_zigzag(model: Model, L: float, speed: float, extra: int, angle: float) -> float:
    """First overshoot [deg]."""
    x, delta, h, order, most = [speed, *[0.0] * (5 + extra)], 0.0, 0.01 * L / speed, angle, 0.0
    side = 0.0
    for _ in range(5000):
        delta += max(-RATE * h, min(RATE * h, order - delta))
        x = _advance(model, x, delta, h)
        if order > 0.0 and abs(x[5]) >= angle:
            order, side = -angle, x[5]
        most = max(most, abs(x[5])) if order < 0.0 else 0.0
        if order < 0.0 and x[5] * side > 0.0 and abs(x[5]) < 0.98 * most:
            break
    return degrees(most - angle)


def _sail_s175() -> dict[str, float]:
    """At 8.28 m/s (Froude number 0.2) and the revolutions that keep it."""
    low, high = 0.5, 4.0
    for _ in range(60):
        n = 0.5 * (low + high)
        low, high = (low, n) if accelerate_s175_1982([8.28, 1e-9, *[0.0] * 6], 0.0, n)[0] > 0.0 else (n, high)
    return sail_published(lambda x, delta: accelerate_s175_1982(x, delta, high), 175.0, 8.28, 2)


@dataclass(frozen=True)
class Source:
    """Where figures come from, their grade, and the figures, or how they are made."""

    name: str
    grade: str
    figures: Callable[[], Mapping[str, float]]


@dataclass(frozen=True)
class PublishedShip:
    """Kind, the four numbers, the approach speed [m/s] of the tests, and the sources; the first one is compared with.

    Breadth and C_b of the tanker of 190 000 dwt are recalled; the other dimensions are read.
    """

    name: str
    kind: str
    L: float
    B: float
    T: float
    C_b: float
    speed: float
    sources: tuple[Source, ...]


def _fixed(**figures: float) -> Callable[[], Mapping[str, float]]:
    return lambda: {name.replace("_", " ").replace(" over ", "/"): value for name, value in figures.items()}


@cache
def _sail_tanker() -> dict[str, float]:
    return sail_published(accelerate_tanker_1972, 304.8, 8.23, 0)


KVLCC2 = PublishedShip(
    "KVLCC2", "tanker", 320.0, 58.0, 20.8, 0.81, 7.974,
    (
        Source(
            "MARIN for SIMMAN 2008, free-running model 1/45.7, to port", "recorded",
            lambda: {
                "advance": 3.02, "tactical diameter": 3.08, "steady radius": 1.16, "drift angle": 20.4,
                "speed kept": 0.355, "10/10": 9.4, "20/20": 14.9,
            },
        ),
        Source(
            "Yasukawa & Yoshimura (2015) table 6, computed for the full ship, to starboard", "read",
            _fixed(advance=3.62, tactical_diameter=3.71),
        ),
        Source(
            "Yasukawa & Yoshimura (2015) table 4, free-running 7 m model, to starboard", "read",
            _fixed(advance=3.25, tactical_diameter=3.34),
        ),
    ),
)  # fmt: skip
ESSO_OSAKA = PublishedShip(
    "Esso Osaka", "tanker", 325.0, 53.0, 21.73, 0.831, 5.14,
    (
        Source(
            "Crane (1979), Trans. SNAME 87:251-283, trials of the ship in deep water", "recalled",
            _fixed(advance=1015.0 / 325.0, tactical_diameter=925.0 / 325.0),
        ),
    ),
)  # fmt: skip
TANKER = PublishedShip(
    "tanker of 190 000 dwt", "tanker", 304.8, 47.17, 18.46, 0.83, 8.23,
    (Source("Van Berlekom & Goddard (1972), Trans. SNAME 80:264-298", "sailed", _sail_tanker),),
)  # fmt: skip
S175 = PublishedShip(
    "S-175", "container ship", 175.0, 25.4, 8.5, 0.559, 8.28,
    (Source("Son & Nomoto (1982), Nav. Archit. Ocean Eng. 20:73-83", "sailed", cache(_sail_s175)),),
)  # fmt: skip
SHIPS = (KVLCC2, ESSO_OSAKA, TANKER, S175)
"""KCS, whose set of coefficients this package ships, is compared with that ship's own trial (estimated_ships.py)."""
