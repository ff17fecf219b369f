"""A ship from its validated file: its matrices, and estimates of missing values by named formulas.

    k_yy = k_zz = 0.25 L_pp        radii of gyration about CG [m]

Where the file gives none, the centre of gravity and k_xx are those of stability_estimate.py, the added mass that of
added_mass_estimate.py.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...errors import ShipError
from ..frames import Array
from ..hydrostatics import compute_hydrostatics
from ..inertia import is_positive_definite, rigid_body_inertia
from ..seakeeping import BLOCK, compute_seakeeping
from ..ship import Ship
from ..ship_type import CARGO_VESSEL, list_type_words, names_a_type
from ..windage import compute_windage
from .added_mass_estimate import assemble_added_mass
from .messages import suggest
from .ship_file import ShipFile
from .stability_estimate import estimate_k_xx, estimate_stability

__all__ = ["assemble_ship"]

LARGEST = {"L_pp": 460.0, "B": 125.0, "T": 30.0}
"""[m] Seawise Giant was 458 m long, Pioneering Spirit is 124 m broad; 27 m is the deepest draught of the two."""

USUAL_L_B, USUAL_B_T = (2.0, 12.0), (1.5, 12.0)
"""Of ships in service, from tugs to inland ships of 135 m, and from sailing yachts to empty inland ships."""


def assemble_ship(content: ShipFile, file: str) -> Ship:
    """The ship that a validated file describes; `file` names it in messages.

    Raises ShipError when the inertia that comes out is not positive definite.
    """
    p = content.particulars
    estimated = list(content.estimated)

    def or_estimate(value: float | None, formula: str, otherwise: float) -> float:
        if value is None:
            estimated.append(formula)
            return otherwise
        return value

    L_oa = or_estimate(p.L_oa, "L_oa = L_pp", p.L_pp)
    k_yy = or_estimate(p.k_yy, "k_yy = 0.25 L_pp", 0.25 * p.L_pp)
    k_zz = or_estimate(p.k_zz, "k_zz = 0.25 L_pp", 0.25 * p.L_pp)
    r_bg, GM = _place_centre_of_gravity(content, estimated)

    def find_inertia(k_xx: float, notes: list[str]) -> tuple[Array, Array]:
        radii = np.array([k_xx, k_yy, k_zz])
        M_RB = rigid_body_inertia(p.mass, r_bg, radii)
        return M_RB, assemble_added_mass(content, p.mass * radii**2, notes, file)

    k_xx = p.k_xx
    if k_xx is None:
        k_xx, note = estimate_k_xx(p, GM, lambda k: np.add(*find_inertia(k, [])))
        estimated.append(note)
    M_RB, M_A = find_inertia(k_xx, estimated)
    M = M_RB + M_A
    if not is_positive_definite(M):
        raise ShipError(
            f"{file}: the inertia M_RB + M_A is not positive definite (diagonal {np.diag(M).tolist()}): check r_bg, "
            "the radii of gyration and [added_mass]"
        )
    for array in (r_bg, M_RB, M_A, M):
        array.flags.writeable = False
    ship = Ship(
        name=content.ship.name, kind=content.ship.kind, source=content.ship.source,
        L_pp=p.L_pp, L_oa=L_oa, B=p.B, T=p.T, mass=p.mass, rho=p.rho, r_bg=r_bg, M_RB=M_RB, M_A=M_A, M=M,
        GM_T=p.GM_T, GM_L=p.GM_L, hull=content.hull, manoeuvring=content.manoeuvring, propeller=content.propeller,
        rudder=content.rudder, engine=content.engine, seakeeping=content.seakeeping, wind=content.wind,
        estimated=tuple(estimated), suspicious=_list_suspicious(content),
    )  # fmt: skip
    return ship if ship.manoeuvring is None else replace(ship, estimated=(*estimated, *_list_sailing_estimates(ship)))


def _place_centre_of_gravity(content: ShipFile, estimated: list[str]) -> tuple[Array, float | None]:
    """CG from CO [m], and GM_T [m] where it is known then; adds to `estimated`."""
    p = content.particulars
    if p.r_bg is not None:
        C_b = p.mass / (p.rho * p.L_pp * p.B * p.T)
        water = compute_hydrostatics(p.L_pp, p.B, p.T, C_b, p.r_bg[2], GM_T=p.GM_T)
        return np.array(p.r_bg, dtype=float), water.GM_T if BLOCK[0] <= C_b <= BLOCK[1] else None
    stability = estimate_stability(p, content.wind.type or content.ship.kind, content.hull.depth)
    if stability is None:
        estimated.append("r_bg = (0, 0, 0)")
        return np.zeros(3), None
    estimated.append(stability.note)
    return np.array([0.0, 0.0, p.T - stability.KG]), stability.GM


def _list_suspicious(content: ShipFile) -> tuple[str, ...]:
    """What may be right, but looks like a number in another unit, or like a word that is misspelt."""
    notes = (_question_x_G(content), _question_kind(content), _question_size(content))
    return tuple(note for note in notes if note)


def _question_x_G(content: ShipFile) -> str:
    p = content.particulars
    x_G = p.r_bg[0] if p.r_bg is not None else 0.0
    if content.manoeuvring is None or not 0.0 < abs(x_G) <= 0.1 or p.L_pp < 20.0:
        return ""
    return (
        f"[particulars] r_bg: x = {x_G} m looks like x_G/L_pp, but CG is given in metres: leave it if it is meant so, "
        f"else give {x_G * p.L_pp:.4g}"
    )


def _question_kind(content: ShipFile) -> str:
    """A kind that names no type of ship, where hull or machinery are estimated by the type."""
    kind, words = content.wind.type or content.ship.kind, list_type_words()
    if names_a_type(kind) or not any(note.startswith(("[hull]", "[engine]")) for note in content.estimated):
        return ""
    near = next((said for word in kind.split() if (said := suggest(word, words))), "")
    return (
        f"[ship] kind = {kind!r} names no known type of ship, so its estimates are those of a {CARGO_VESSEL.name}:"
        f"{near or ' words for types: ' + ', '.join(words)}"
    )


def _question_size(content: ShipFile) -> str:
    """Main dimensions larger than of any ship, and proportions of few where manoeuvring is estimated from them."""
    p, wrong = content.particulars, list[str]()
    for key, largest in LARGEST.items():
        if getattr(p, key) > largest:
            wrong.append(f"{key} = {getattr(p, key):.6g} m is more than {largest:g} m, of any ship")
    if any(note.startswith("[manoeuvring]") for note in content.estimated):
        for name, ratio, (low, high) in (("L_pp/B", p.L_pp / p.B, USUAL_L_B), ("B/T", p.B / p.T, USUAL_B_T)):
            if not low <= ratio <= high:
                wrong.append(f"{name} = {ratio:.3g} is outside {low:g} to {high:g}, of nearly all ships")
    return f"[particulars] {', and '.join(wrong)}: leave it if it is meant so, else give metres" if wrong else ""


def _list_sailing_estimates(ship: Ship) -> tuple[str, ...]:
    """Notes on estimated values of heave, roll, pitch and wind, which a coasting ship does not use."""
    try:
        floating = compute_seakeeping(ship).estimated
    except ShipError:  # raised again for a run in 4 or 6 degrees of freedom
        floating = ()
    return (*floating, *compute_windage(ship).estimated)
