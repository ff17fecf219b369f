"""Turning circles and zigzags of published ships, to compare ships from four numbers with; support, not a test.

Each figure has its source and a grade: `read` (in the source, or in a public quotation of it), `recorded` (read off the
published track), `sailed` (the published set of measured coefficients, sailed by the equations below, which share no
code with the package), `recalled` (from memory, fairly sure, not read).

Lengths are in L_pp, of warships in the length of the waterline. What no source was found for is left out, and so are
ships of which no figure could be sourced: DTMB 5415, ONR Tumblehome, Series 60; and Seiun Maru, whose public set is
mostly the regression that is to be tested. MARIN's overshoots are read to 0.3 deg, of zigzags that begin to port.
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


def accelerate_mariner_1965(state: State, delta: float) -> State:
    """Chislett & Strom-Tejsen (1965), Hy-6: a Mariner class cargo ship at 15 kn, from planar motion tests.

    Velocities are over the approach speed U_0, forces over 1/2 rho L^2 U_0^2. The coefficients show it: N_vu = N_v,
    N_du = 2 N_d and N_duu = N_d are the expansion of v u and u^2 about U_0. Public code has the momentary speed in its
    place. Then the rudder loses its force with (2 U - U_0)^2: a tactical diameter of 6.4 L at 35 deg.
    """
    L, U = 160.93, 7.7175
    u, v, r, d = (state[0] - U) / U, state[1] / U, state[2] * L / U, -delta
    m, x_G, I_z = 798.0, -0.023, 39.2  # these and all below times 1e-5
    X = (
        -184.0 * u - 110.0 * u * u - 215.0 * u**3 - 899.0 * v * v + 18.0 * r * r - 95.0 * d * d - 190.0 * u * d * d
        + 798.0 * r * v + 93.0 * v * d + 93.0 * u * v * d
    )  # fmt: skip
    Y = (
        -1160.0 * v * (1.0 + u) - 499.0 * r * (1.0 + u) - 8078.0 * v**3 + 15356.0 * v * v * r
        + 278.0 * d * (1.0 + u) ** 2 - 90.0 * d**3 - 4.0 * v * d * d + 1190.0 * v * v * d - 4.0 * (1.0 + u) ** 2
    )  # fmt: skip
    N = (
        -264.0 * v * (1.0 + u) - 166.0 * r * (1.0 + u) + 1636.0 * v**3 - 5483.0 * v * v * r
        - 139.0 * d * (1.0 + u) ** 2 + 45.0 * d**3 + 13.0 * v * d * d - 489.0 * v * v * d + 3.0 * (1.0 + u) ** 2
    )  # fmt: skip
    m_v, m_vr, m_rv, m_r = m + 748.0, m * x_G + 9.354, m * x_G - 4.646, I_z + 43.8
    v_dot, r_dot = _solve_two(m_v, m_vr, m_rv, m_r, Y, N)
    return [X / (m + 42.0) * U * U / L, v_dot * U * U / L, r_dot * (U / L) ** 2]


def accelerate_ferry_1981(state: State, delta: float) -> State:
    """Wolff (1981), Institut fuer Schiffbau 412: a twin-screw ferry at 20 kn, from tests with a computerised carriage.

    Velocities are over the momentary speed U, forces over 1/2 rho L^2 U^2; Delta u' = (u - U_0)/U.
    """
    L, U_0 = 139.6, 20.0 * 1852.0 / 3600.0
    U = hypot(state[0], state[1])
    u, v, r, d = state[0] / U, state[1] / U, state[2] * L / U, -delta
    w = (state[0] - U_0) / U
    m, mx_G, I_z = 6765.0, -116.0, 319.0  # these and all below times 1e-6
    X = (
        -4336.0 * w - 2355.0 * w * w - 2594.0 * w**3 - 3279.0 * v * v - 19.0 * r - 571.0 * r * r - 2879.0 * d * d
        + 2185.0 * d**4 - 2559.0 * v * v * w - 734.0 * r * r * w + 3425.0 * d * d * w + 4627.0 * v * r + 877.0 * v * d
        - 351.0 * r * d
    )  # fmt: skip
    Y = (
        57.0 * w - 12095.0 * v - 137302.0 * v**3 + 1901.0 * r - 1361.0 * r**3 + 3587.0 * d + 98.0 * d * d
        - 6262.0 * d**5 - 1297.0 * r * w - 5096.0 * d * w + 3192.0 * d**3 * w - 44365.0 * v * r * r
        - 36490.0 * v * v * r + 2199.0 * v * d * d - 2752.0 * r * d * d
    )  # fmt: skip
    N = (
        -36.0 * w - 3919.0 * v - 33857.0 * v**3 - 2579.0 * r - 2253.0 * r**3 - 1621.0 * d - 73.0 * d * d + 2886.0 * d**5
        - 3666.0 * v * w - 1322.0 * r**3 * w + 2259.0 * d * w - 1382.0 * d**3 * w - 60110.0 * v * v * r
        + 570.0 * v * d * d - 2950.0 * v * v * d + 237.0 * r * d * d - 329.0 * r * r * d
    )  # fmt: skip
    v_dot, r_dot = _solve_two(
        m + 7396.0, mx_G + 600.0, mx_G - 426.0 - 10049.0 * v * v, I_z + 231.0, Y - m * u * r, N - mx_G * u * r
    )
    return [(X + m * v * r + mx_G * r * r) / m * U * U / L, v_dot * U * U / L, r_dot * (U / L) ** 2]


def _solve_two(a: float, b: float, c: float, d: float, Y: float, N: float) -> tuple[float, float]:
    """v_dot, r_dot of a v_dot + b r_dot = Y and c v_dot + d r_dot = N."""
    det = a * d - b * c
    return (d * Y - b * N) / det, (a * N - c * Y) / det


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

    Recalled are breadth and C_b of the tanker of 190 000 dwt, breadth, draught and C_b of the ferry (their product fits
    the mass that is read within 3 %), and all dimensions of the three ships of before 1950; the others are read.
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
MARINER = PublishedShip(
    "Mariner", "cargo", 160.93, 23.17, 7.47, 0.60, 7.7175,
    (
        Source(
            "Chislett & Strom-Tejsen (1965), Hydro- and Aerodynamics Laboratory, Hy-6", "sailed",
            cache(lambda: sail_published(accelerate_mariner_1965, 160.93, 7.7175, 0)),
        ),
    ),
)  # fmt: skip
FERRY = PublishedShip(
    "ferry of 140 m", "ferry", 139.6, 16.77, 5.90, 0.644, 10.289,
    (
        Source(
            "Wolff (1981), Institut fuer Schiffbau Hamburg, report 412", "sailed",
            cache(lambda: sail_published(accelerate_ferry_1981, 139.6, 10.289, 0)),
        ),
    ),
)  # fmt: skip
FLETCHER = PublishedShip(
    "Fletcher class", "destroyer", 112.5, 12.04, 3.96, 0.462, 30.0 * 1852.0 / 3600.0,
    (
        Source(
            "trials at 30 kn with one rudder, read in a secondary source", "read",
            _fixed(tactical_diameter=867.0 / 112.5),
        ),
    ),
)  # fmt: skip
YAMATO = PublishedShip(
    "Yamato", "battleship", 256.0, 38.7, 10.8, 0.648, 26.0 * 1852.0 / 3600.0,
    (
        Source(
            "trials at 26 kn with two rudders, read in a secondary source", "read",
            _fixed(advance=600.0 / 256.0, tactical_diameter=640.0 / 256.0),
        ),
    ),
)  # fmt: skip
TITANIC = PublishedShip(
    "Titanic", "passenger liner", 259.1, 28.2, 10.5, 0.674, 20.0 * 1852.0 / 3600.0,
    (Source("sea trials of 1912 at 20 kn, 40 deg", "recalled", _fixed(tactical_diameter=3850.0 / 850.0)),),
)  # fmt: skip
SHIPS = (KVLCC2, ESSO_OSAKA, TANKER, S175, MARINER, FERRY, FLETCHER, YAMATO, TITANIC)
"""KCS, whose set of coefficients this package ships, is compared with that ship's own trial (estimated_ships.py)."""
