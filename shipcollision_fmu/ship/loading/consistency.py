"""Whether the tables of a ship file go together: each contradiction, with its limit and its remedy.

A mass, a C_b and an inertia that contradict each other are refused, because they make every result wrong: a ship
heavier than the box of water it displaces, or a container ship with half its displacement. Published data contain such
ships (Guan et al. 2014, Table 1, prints dead-weights as mass), hence `allow_inconsistent = "why"`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ..hull.room_for_the_bow import describe_lack_of_room, find_largest_bilge
from ..tables.hull import HullTable
from ..tables.manoeuvring import ManoeuvringTable
from ..tables.particulars import AddedMassTable, ParticularsTable

__all__ = ["find_contradictions", "find_wrong_sizes"]

C_B_LIMITS = (0.40, 0.90)
"""Block coefficients of displacement ships; fine yachts and full barges lie just inside."""

C_B_TOLERANCE = 0.02
"""Relative difference allowed between a given C_b and the one from the mass: published C_b have two digits."""

SIZES = {"L_pp": (0.5, 500.0), "B": (0.05, 250.0), "T": (0.01, 250.0)}
"""Least and largest dimensions [m]: a model of a buoy and more than the longest ship ever, 458 m. Wider limits let
millimetres, centimetres and feet pass."""

PROPORTIONS = {
    ("L_pp", "B"): (1.0, 40.0), ("B", "T"): (0.5, 60.0), ("L_oa", "L_pp"): (0.5, 2.0),
    ("k_xx", "B"): (0.0, 2.0), ("k_yy", "L_pp"): (0.0, 1.0), ("k_zz", "L_pp"): (0.0, 1.0),
}  # fmt: skip
"""Least and largest ratio, of those that are given: a buoy and a floating log have L_pp/B = 1 and 17, a racing
shell 30; a log and a flat pontoon B/T = 1.4 and 40. Wider limits let one length in another unit pass."""

DEEPEST_HULL = 50.0
"""Depth over T; a light pontoon of 6 m with a draught of 0.3 m has 20."""

MMG_X_G = 0.15
"""x_G over L_pp of a ship with [manoeuvring]; ships in service stay within 0.05."""


def find_contradictions(tables: Mapping[str, Any]) -> Iterator[str]:
    """A message for each contradiction between the tables that are there; an optional table that is absent is None.

    A check whose tables were refused themselves, and therefore are not there, is left out.
    """
    for check, needs in CHECKS:
        if all(name in tables for name in needs):
            yield from check(*(tables[name] for name in needs))


def _check_size(p: ParticularsTable) -> Iterator[str]:
    if p.allow_inconsistent is None:
        yield from find_wrong_sizes(p)


def find_wrong_sizes(p: ParticularsTable) -> Iterator[str]:
    """A message for main dimensions that are no ship's, or else for each ratio of two lengths. Whatever the reason to
    keep them, the estimate of an MMG set has no numbers for these."""
    remedy = 'metres, or, for a body that is no ship and coasts, give the reason: allow_inconsistent = "..."'
    wrong = [
        f"{key} = {getattr(p, key):.6g} m must be {low:g} to {high:g} m"
        for key, (low, high) in SIZES.items()
        if not low <= getattr(p, key) <= high
    ]
    if wrong:
        yield f"[particulars] {', '.join(wrong)}: give {remedy}"
        return
    for (one, other), (low, high) in PROPORTIONS.items():
        a, b = getattr(p, one), getattr(p, other)
        if a is not None and not low <= a / b <= high:
            yield (
                f"[particulars] {one} = {a:.6g} m over {other} = {b:.6g} m is {a / b:.3g}, must be {low:g} to "
                f"{high:g}: give both in {remedy}"
            )


def _check_mass(p: ParticularsTable) -> Iterator[str]:
    box = p.rho * p.L_pp * p.B * p.T
    C_b = p.mass / box
    low, high = C_B_LIMITS
    remedy = 'give the displacement and its draught, or give the reason why it is kept: allow_inconsistent = "..."'
    if p.allow_inconsistent is not None:
        return
    if p.C_b is not None and not low <= p.C_b <= high and abs(p.C_b / C_b - 1.0) < 1e-9:  # the mass is that of C_b
        yield (
            f"[particulars] C_b = {p.C_b} must be {low:.2f} to {high:.2f}: give mass / (rho L_pp B T) at the draught, "
            'or the reason why it is kept: allow_inconsistent = "..."'
        )
    elif C_b > 1.0:
        yield (
            f"[particulars] mass = {p.mass:.6g} kg is more than rho L_pp B T = {box:.6g} kg, all the water that a "
            f"box of these dimensions displaces: {remedy}"
        )
    elif not low <= C_b <= high:
        yield (
            f"[particulars] mass = {p.mass:.6g} kg means C_b = mass / (rho L_pp B T) = {C_b:.3f}, outside "
            f"{low:.2f} to {high:.2f}: {remedy}"
        )
    elif p.C_b is not None and abs(p.C_b / C_b - 1.0) > C_B_TOLERANCE:
        yield (
            f"[particulars] C_b = {p.C_b} contradicts mass / (rho L_pp B T) = {C_b:.3f} by more than "
            f"{C_B_TOLERANCE:.0%}: remove C_b, or {remedy}"
        )


def _check_centre_of_gravity(p: ParticularsTable, hull: HullTable) -> Iterator[str]:
    limits = (p.L_pp / 2, p.B / 2, max(p.T, hull.depth))
    for axis, value, limit in zip("xyz", p.r_bg or (0.0, 0.0, 0.0), limits, strict=True):
        if abs(value) > limit:
            yield f"[particulars] r_bg: {axis} = {value} m puts CG outside the ship: at most {limit} m"


def _check_hull(p: ParticularsTable, hull: HullTable) -> Iterator[str]:
    if hull.depth <= p.T:
        yield f"[hull] depth = {hull.depth} m must be greater than the draught T = {p.T} m: the deck would be awash"
        return
    if hull.depth > DEEPEST_HULL * p.T:
        yield (
            f"[hull] depth = {hull.depth} m must be at most {DEEPEST_HULL:g} times the draught T = {p.T} m: give both "
            "in metres"
        )
    if hull.shape != "parametric":
        return
    L = p.L_oa or p.L_pp
    if L - hull.bow_length - hull.stern_length <= 0.0:
        yield (
            f"[hull] bow_length + stern_length = {hull.bow_length + hull.stern_length} m leave no parallel "
            f"midbody in {L} m of length: shorten them"
        )
    elif hull.bilge >= min(p.T, p.B / 2):
        yield (
            f"[hull] bilge = {hull.bilge} m must be less than T = {p.T} m and B/2 = {p.B / 2} m: give at most "
            f"{find_largest_bilge(L, p.B, p.T, hull):.4g}"
        )
    elif lack := describe_lack_of_room(L, p.B, p.T, hull):
        yield lack


def _check_one_added_mass(added: AddedMassTable, mmg: ManoeuvringTable | None) -> Iterator[str]:
    if mmg is not None and mmg.m_x is not None:
        twice = [key for key in ("m_x", "m_y", "j_z", "M_A") if getattr(added, key) is not None]
        if twice:
            yield (
                f"[added_mass] {', '.join(twice)} and [manoeuvring] m_x, m_y, J_z are two added masses of one "
                "ship: remove one of the two sets"
            )


def _check_mmg_sizes(p: ParticularsTable, mmg: ManoeuvringTable | None) -> Iterator[str]:
    if mmg is None:
        return
    x_G = p.r_bg[0] if p.r_bg is not None else 0.0
    if abs(x_G) > MMG_X_G * p.L_pp:
        yield (
            f"[particulars] r_bg: x = {x_G} m is {x_G / p.L_pp:.2g} L_pp, with [manoeuvring] at most {MMG_X_G} "
            "either way: give CG in metres forward of midship, not from the after perpendicular"
        )
    own = 2.0 * p.mass / (p.rho * p.L_pp**2 * p.T)  # the mass over 1/2 rho L^2 T
    for key, most, power in (("m_x", 1.0, 2), ("m_y", 2.0, 2), ("J_z", 0.15, 4)):
        value = getattr(mmg, key)
        if value is not None and value > most * own:
            yield (
                f"[manoeuvring] {key} = {value:.6g} is {value / own:.3g} times the ship's own m' = {own:.3g}, must "
                f"be at most {most:g} times: give it over 1/2 rho L_pp^{power} T = "
                f"{0.5 * p.rho * p.L_pp**power * p.T:.4g}, neither in kg or kg m2 nor as a fraction of the ship's"
            )


def _check_mmg_set(mmg: ManoeuvringTable | None, *machines: object) -> Iterator[str]:
    lacking = [name for name, table in zip(MACHINES, machines, strict=True) if table is None]
    if mmg is not None and len(lacking) in (1, 2):
        yield (
            f"[manoeuvring] needs {', '.join(f'[{t}]' for t in lacking)} as well: propeller, rudder and engine "
            "work together; add them, or remove all three and the ship can only drift"
        )


MACHINES = ("propeller", "rudder", "engine")

CHECKS: tuple[tuple[Callable[..., Iterator[str]], tuple[str, ...]], ...] = (
    (_check_size, ("particulars",)),
    (_check_mass, ("particulars",)),
    (_check_centre_of_gravity, ("particulars", "hull")),
    (_check_hull, ("particulars", "hull")),
    (_check_one_added_mass, ("added_mass", "manoeuvring")),
    (_check_mmg_sizes, ("particulars", "manoeuvring")),
    (_check_mmg_set, ("manoeuvring", *MACHINES)),
)
"""Each check and the tables that it needs, in the order in which they are reported."""
