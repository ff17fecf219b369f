"""KG, GM and k_xx of a ship whose file does not give them.

    GM = (GM/B of its type) B, at least the Intact Stability Code's        KM = KB + BM (hydrostatics.py)
    KG = KM - GM, and at most (KG/D of its type) D                         D: depth of the hull
    k_xx: the rolling ship has the period of the Intact Stability Code (roll_period.py), within 0.28 B to 0.45 B

Of KG and GM, GM is estimated: it is what rules and guides state, and what a master keeps by ballast. GM is the small
difference of two large numbers, so a KG that is 5 % wrong makes it three times as large or none. A given GM_T is kept.
Outside C_b 0.40 to 0.90 there are no hydrostatics: CG is then at the waterline, and k_xx = 0.37 B.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi, sqrt
from typing import NamedTuple

from ..frames import Array
from ..hydrostatics import GRAVITY, compute_hydrostatics
from ..roll_period import compute_is_code_period, compute_roll_inertia
from ..seakeeping import BLOCK
from ..ship_type import find_ship_type
from ..tables.particulars import ParticularsTable

__all__ = ["K_XX", "estimate_k_xx", "estimate_stability"]

K_XX = 0.37
"""k_xx over B of a ship without hydrostatics, and the first guess of the others."""

SLIMMEST, WIDEST = 0.28, 0.45
"""k_xx over B of ships: the mass of a homogeneous bar and that of a shell. Beyond, the formula for the period, made for
ships of up to 150 m or so, asks for masses that no ship has."""


class Stability(NamedTuple):
    """KG above the keel and GM [m], and a note on the estimate."""

    KG: float
    GM: float
    note: str


def estimate_stability(p: ParticularsTable, kind: str, depth: float) -> Stability | None:
    """KG and GM of a ship without r_bg; None where C_b is outside the formulas of hydrostatics. depth [m]."""
    C_b = _compute_C_b(p)
    if not BLOCK[0] <= C_b <= BLOCK[1]:
        return None
    KM = compute_hydrostatics(p.L_pp, p.B, p.T, C_b, p.T).GM_T  # with CG at the keel
    if p.GM_T is not None:
        return Stability(KM - p.GM_T, p.GM_T, f"KG = {KM - p.GM_T:.2f} m (KM - GM_T)")
    of = find_ship_type(kind)
    GM, how = of.GM_over_B * p.B, f"GM = {of.GM_over_B:g} B of a {of.name}"
    if of.least_GM > GM:
        GM, how = of.least_GM, f"least GM = {of.least_GM:g} m of the Intact Stability Code"
    KG, highest = KM - GM, of.highest_KG * depth
    if highest < KG:
        KG, GM, how = highest, KM - highest, f"{of.highest_KG:g} depth, at most, for a {of.name}"
    return Stability(KG, GM, f"KG = {KG:.2f} m ({how})")


def estimate_k_xx(p: ParticularsTable, GM: float | None, inertia: Callable[[float], Array]) -> tuple[float, str]:
    """k_xx [m] and a note on it; `inertia` gives M for a k_xx [m], GM [m]."""
    if GM is None or GM <= 0.0:
        return K_XX * p.B, f"k_xx = {K_XX} B"
    period = compute_is_code_period(p.L_pp, p.B, p.T, GM)
    needed = (period / (2.0 * pi)) ** 2 * p.mass * GRAVITY * GM
    low, high = ((k * p.B) ** 2 for k in (SLIMMEST, WIDEST))
    of_low, of_high = (compute_roll_inertia(inertia(sqrt(k_2))) for k_2 in (low, high))
    share = min(1.0, max(0.0, (needed - of_low) / (of_high - of_low)))  # the inertia is linear in k_xx^2
    k_xx = sqrt(low + share * (high - low))
    how = f"{k_xx / p.B:.3f} B, roll period {period:.1f} s of the Intact Stability Code"
    if share in (0.0, 1.0):
        how = f"{k_xx / p.B:.3f} B; the Intact Stability Code's roll period of {period:.1f} s needs another"
    return k_xx, f"k_xx = {k_xx:.4g} m ({how})"


def _compute_C_b(p: ParticularsTable) -> float:
    return p.mass / (p.rho * p.L_pp * p.B * p.T)
