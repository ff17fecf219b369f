"""Published figures beside ours, computed when the page is built."""

from __future__ import annotations

from functools import cache

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.manoeuvring.trials.steady_course import find_steady_course
from shipcollision_fmu.manoeuvring.trials.trials import sail_turning_circle

from .markdown import table

__all__ = ["guan2014", "turning_circles"]

CIRCLES = (
    # ship, port, source, advance / L, tactical diameter / L
    ("kvlcc2", False, "table 6, computed", 3.62, 3.71),
    ("kvlcc2", True, "table 6, computed", 3.56, 3.59),
    ("kvlcc2_l7", False, "table 6, computed", 3.31, 3.36),
    ("kvlcc2_l7", True, "table 6, computed", 3.26, 3.26),
    ("kvlcc2_l7", False, "table 4, measured", 3.25, 3.34),
    ("kvlcc2_l7", True, "table 4, measured", 3.11, 3.08),
)
"""Turning circles with 35 degrees of rudder in Yasukawa and Yoshimura (2015)."""


@cache
def guan2014() -> str:
    """The table of 24 numbers: as printed, as corrected, as computed, with the tolerance."""
    rows = []
    for row in simulate(load_scenario("guan2014"), in_process=True).summary["paper"]:
        corrected = f"{row['paper']:.4f}" if row["paper"] != row["printed"] else ""
        rows.append((
            row["ship"], f"`{row['quantity']}`", row["unit"], f"{row['printed']:.4f}", corrected,
            f"{row['computed']:.4f}", f"{row['difference']:+.4f}", f"{row['tolerance']:g}",
            "yes" if row["within"] else "**no**",
        ))  # fmt: skip
    return table(
        ("ship", "quantity", "unit", "printed", "corrected", "computed", "difference", "tolerance", "within"), rows
    )


@cache
def turning_circles() -> str:
    """Advance and tactical diameter [L] of KVLCC2 and its 7 m model, published and computed."""
    sailed = {
        (ship, port): sail_turning_circle(find_steady_course(ship), 35.0, port=port)
        for ship, port in {(ship, port) for ship, port, *_ in CIRCLES}
    }
    rows = []
    for ship, port, source, advance, diameter in CIRCLES:
        ours = sailed[ship, port]
        cells = [
            cell
            for published, computed in ((advance, ours["advance"]), (diameter, ours["tactical diameter"]))
            for cell in (f"{published:.2f}", f"{computed:.2f}", f"{computed / published - 1.0:+.1%}")
        ]
        rows.append((f"`{ship}`", "port" if port else "starboard", source, *cells))
    header = ("ship", "side", "source", "advance", "ours", "difference", "tactical diameter", "ours", "difference")
    return table(header, rows)
