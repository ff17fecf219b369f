"""Right-hand sides per second of the manoeuvring model, beside an independent open MMG package.

    python -m venv /tmp/peer && /tmp/peer/bin/pip install shipmmg .      shipmmg wants Python 3.11, numpy 2.3 or later
    /tmp/peer/bin/python benchmarks/manoeuvring_rhs.py

shipmmg (MIT) is installed for this comparison only; without it the rates are printed alone. Both integrate the same
turning circle of KVLCC2's 7 m model, with 10.4 rev/s and 35 deg of helm, in pure Python: ours with its own Runge-Kutta
steps of order 4, shipmmg as it comes, with SciPy's solve_ivp (RK45). Two rates are measured: the right-hand side called
by itself, at a state in the turn, and evaluations per second of the whole integration, where each pays for its own
integrator. They take turns, and each figure is the best of ROUNDS short ones, in processor time: what else the machine
does only adds to it.
Our ships in 6 degrees of freedom integrate twice the states; shipmmg has only 3.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from math import radians
from time import process_time
from typing import Any

from rich.console import Console
from rich.table import Table

from shipcollision_fmu.manoeuvring.mmg import CALM, Machines, Mmg, Orders, Six
from shipcollision_fmu.manoeuvring.mmg_3dof import Mmg3Dof
from shipcollision_fmu.manoeuvring.mmg_6dof import Mmg6Dof
from shipcollision_fmu.ship.loading.library import load_ship

ROUNDS = 40
DURATION = 20.0
"""[s] The 7 m model's first 50 degrees."""
STEP = 0.05
"""[s] Of ours; four evaluations each."""
SPEED, REVOLUTIONS, HELM = 1.179, 10.4, radians(35.0)

CALLS = 500
"""Of the right-hand side by itself."""
TURN = (0.9, -0.3, 0.12)
"""u, v [m/s], r [rad/s] of the model in its turn."""

Measured = tuple[float, float]
"""Evaluations per second: of the right-hand side by itself, and of the whole integration."""
Contender = Callable[[], Measured]


def alone(call: Callable[[], object]) -> float:
    """Calls per second."""
    begin = process_time()
    for _ in range(CALLS):
        call()
    return CALLS / (process_time() - begin)


def ours(mmg: Mmg) -> Contender:
    """Our equations of motion."""
    steps = round(DURATION / STEP)
    eta: Six = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    nu: Six = (SPEED, 0.0, 0.0, 0.0, 0.0, 0.0)

    u, v, r = TURN
    x = mmg._pack(eta, (u, v, 0.0, 0.0, 0.0, r))

    def run() -> Measured:
        begin = process_time()
        mmg.advance(eta, nu, Machines(HELM, REVOLUTIONS, (1.0, 0.0)), Orders(HELM, REVOLUTIONS), CALM, DURATION, steps)
        whole = 4 * steps / (process_time() - begin)
        return alone(lambda: mmg._derivative(x, HELM, REVOLUTIONS, CALM)), whole

    return run


def shipmmg() -> Contender | None:
    """simulate_mmg_3dof of shipmmg with the same coefficients; None when it is not installed."""
    try:
        import numpy as np
        from scipy.integrate import RK45
        from shipmmg.mmg_3dof import Mmg3DofBasicParams, Mmg3DofManeuveringParams, simulate_mmg_3dof
    except ImportError:
        return None
    ship = load_ship("kvlcc2_l7")
    hull, propeller, rudder = ship.manoeuvring, ship.propeller, ship.rudder
    assert hull is not None
    assert propeller is not None
    assert rudder is not None
    L, d, rho = ship.L_pp, ship.T, ship.rho
    unit = 0.5 * rho * L**2 * d
    assert hull.m_x is not None
    assert hull.m_y is not None
    assert hull.J_z is not None
    basic = {
        "L_pp": L, "B": ship.B, "d": d, "x_G": float(ship.r_bg[0]), "D_p": propeller.D_p, "m": ship.mass,
        "I_zG": ship.mass * (0.25 * L) ** 2, "A_R": rudder.A_R, "η": propeller.D_p / rudder.H_R,
        "m_x": hull.m_x * unit, "m_y": hull.m_y * unit, "J_z": hull.J_z * unit * L**2, "f_α": rudder.f_alpha,  # noqa: RUF001  # the other program's symbols
        "ϵ": rudder.epsilon, "t_R": rudder.t_R, "x_R": rudder.x_R * L, "a_H": rudder.a_H, "x_H": rudder.x_H * L,
        "γ_R_minus": rudder.gamma_R_minus, "γ_R_plus": rudder.gamma_R_plus, "l_R": rudder.l_R, "κ": rudder.kappa,  # noqa: RUF001  # the other program's symbols
        "t_P": propeller.t_P, "w_P0": propeller.w_P0, "x_P": propeller.x_P,
    }  # fmt: skip
    derivatives = {
        "k_0": propeller.k_0, "k_1": propeller.k_1, "k_2": propeller.k_2, "R_0_dash": hull.R_0,
        **{f"{key}_dash": getattr(hull, key) for key in (
            "X_vv", "X_vr", "X_rr", "X_vvvv", "Y_v", "Y_r", "Y_vvv", "Y_vvr", "Y_vrr", "Y_rrr",
            "N_v", "N_r", "N_vvv", "N_vvr", "N_vrr", "N_rrr",
        )},
    }  # fmt: skip
    basics = Mmg3DofBasicParams(**_fields(Mmg3DofBasicParams, basic))
    coefficients = Mmg3DofManeuveringParams(**_fields(Mmg3DofManeuveringParams, derivatives))
    times = np.linspace(0.0, DURATION, 201)
    helm, revolutions = np.full_like(times, HELM), np.full_like(times, REVOLUTIONS)

    u, v, r = TURN
    state = np.array([u, v, r, 0.0, 0.0, 0.0, HELM, REVOLUTIONS])
    right_hand_side: list[Any] = []

    class Listening(RK45):  # type: ignore[misc]  # SciPy has no types
        """SciPy's RK45, which remembers the right-hand side that it is given."""

        def __init__(self, fun: Any, *rest: Any, **options: Any) -> None:
            right_hand_side.append(fun)
            super().__init__(fun, *rest, **options)

    simulate_mmg_3dof(basics, coefficients, times[:3], helm[:3], revolutions[:3], u0=SPEED, ρ=rho, method=Listening)

    def run() -> Measured:
        begin = process_time()
        solution = simulate_mmg_3dof(basics, coefficients, times, helm, revolutions, u0=SPEED, ρ=rho)
        whole = int(solution.nfev) / (process_time() - begin)
        return alone(lambda: right_hand_side[0](0.1, state)), whole

    return run


def _fields(of: type, values: dict[str, float]) -> dict[str, float]:
    """The values under the names the dataclass has: Python reads U+03F5 as U+03B5 in code, but not in a string."""
    import unicodedata

    plain = {unicodedata.normalize("NFKC", key): value for key, value in values.items()}
    known = getattr(of, "__dataclass_fields__")  # noqa: B009  # types do not have it for mypy
    return {key: plain[key] for key in known}


def main() -> None:
    """Print the table."""
    ship = load_ship("kvlcc2_l7")
    contenders: dict[str, Contender] = {
        f"{freedom} degrees of freedom": ours(Mmg3Dof(ship) if freedom == 3 else Mmg6Dof(ship, freedom))
        for freedom in (3, 4, 6)
    }
    peer = shipmmg()
    if peer is not None:
        contenders["shipmmg (3)"] = peer
    best: dict[str, Measured] = dict.fromkeys(contenders, (0.0, 0.0))
    for _ in range(ROUNDS):
        for name, run in contenders.items():
            rates = run()
            best[name] = (max(best[name][0], rates[0]), max(best[name][1], rates[1]))
    beside = best.get("shipmmg (3)")
    shown = Table("KVLCC2, 7 m model", "right-hand side [1/s]", "ratio", "integrated [1/s]", "ratio")
    for name, rates in best.items():
        cells = []
        for k in (0, 1):
            cells += [f"{rates[k]:,.0f}", "" if beside is None else f"{rates[k] / beside[k]:.1f}"]
        shown.add_row(name, *cells)
    Console(width=100).print(shown)
    if peer is None:
        sys.stderr.write("shipmmg is not installed: see the head of this file\n")


if __name__ == "__main__":
    main()
