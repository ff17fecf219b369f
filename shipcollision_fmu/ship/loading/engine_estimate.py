"""Power, revolutions and times of an engine, from the power at service speed, the ship's type and its length.

    power    = tow P_s (1 + sea margin)/(1 - engine margin)      P_s = 2 pi n_s Q: power at service speed in calm water
    n_rated  = n_s (power/P_s)^(1/3)                             along the propeller law
    rate     = n_rated/(time from full ahead to stop)    reversal_delay, max_astern_rev_per_s: of the machinery

Margins of 15 % and 10 % are those of MAN, Basic principles of ship propulsion. tow: ship_type.py.

Times. IMO, MSC/Circ.1053, appendix 3, reckons with 60 s until the astern thrust is there, for ships of 100 to 300 m.
Direct-reversing diesels have it here, in three parts: the propeller runs down, the engine is restarted, it runs up.
Other machinery is quicker: its times are makers' usual ones, no rule was found. An astern speed of at least 70 % of the
ahead speed is asked for by IACS, UR M25. A propeller of controllable pitch and a thruster that swivels are modelled as
one of fixed pitch that reverses within their time.
"""

from __future__ import annotations

from typing import NamedTuple

from ..ship_type import ShipType

__all__ = ["MACHINERY", "Machinery", "choose_machinery", "estimate_engine"]

SEA_MARGIN, ENGINE_MARGIN = 0.15, 0.10

SLOW_DIESEL_LENGTH = 100.0
"""[m] Shorter ships have a medium-speed diesel with a gear and a controllable pitch."""

SMALL_CRAFT_LENGTH = 24.0
"""[m] Shorter ships have a fast diesel with a reversing gear. Limit of the Load Lines Convention."""


class Machinery(NamedTuple):
    """Times from full ahead to stop and from stop to full ahead [s], pause between [s], astern over ahead speed."""

    run: float
    pause: float
    astern: float


MACHINERY = {
    "slow diesel": Machinery(32.0, 18.0, 0.7),
    "diesel with CPP": Machinery(18.0, 0.0, 0.7),
    "gas turbine with CPP": Machinery(12.0, 0.0, 0.7),
    "azimuth": Machinery(8.0, 0.0, 1.0),
    "diesel with reversing gear": Machinery(5.0, 5.0, 0.7),
    "waterjet": Machinery(4.0, 0.0, 0.7),
}
"""Full ahead to full astern: 72, 31, 20, 16, 14 and 7 s. With longer times ships stop later."""


def choose_machinery(of: ShipType, L: float) -> str:
    """The machinery of a ship of a type and a length [m]."""
    if L < SMALL_CRAFT_LENGTH and of.machinery in ("slow diesel", "diesel with CPP", "gas turbine with CPP"):
        return "diesel with reversing gear"
    if L < SLOW_DIESEL_LENGTH and of.machinery == "slow diesel":
        return "diesel with CPP"
    return of.machinery


def estimate_engine(of: ShipType, L: float, service_power: float, n: float) -> tuple[dict[str, float], str]:
    """The table [engine] and how it was found; service_power P_s [W] at n [1/s]."""
    machinery = choose_machinery(of, L)
    run, pause, astern = MACHINERY[machinery]
    over = of.tow * (1.0 + SEA_MARGIN) / (1.0 - ENGINE_MARGIN)
    rated = n * over ** (1.0 / 3.0)
    table = {
        "rate": rated / run, "max_rev_per_s": rated, "max_astern_rev_per_s": astern * rated, "reversal_delay": pause,
    }  # fmt: skip
    if service_power > 0.0:  # else given revolutions do not drive the ship, and no engine can be sized
        table["power"] = over * service_power
    return table, f"{machinery}; sea margin {SEA_MARGIN:.0%}, engine margin {ENGINE_MARGIN:.0%}"
