"""The published collision of Guan et al. (2014) beside ours, from a run made for the page."""

from __future__ import annotations

from shipcollision_fmu import load_scenario
from shipcollision_fmu.cosim.simulate import simulate

from .markdown import table

__all__ = ["guan2014"]


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
