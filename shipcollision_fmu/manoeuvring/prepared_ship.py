"""A prepared ship: all numbers that the native ship model needs of a ship, as a small file of text.

    shipcollision prepared ship 2
    name "'kvlcc2'"                   as messages show it
    warning ""                        what is suspicious, joined by "; "
    size 0x1.4p+8 ...                 L_pp L_oa B T [m] mass [kg] rho [kg/m3]
    r_bg, M, M_A                      CG [m]; inertia (6, 6) row by row
    inverse_3, inverse_4, inverse_6   inverses of the free block of M (6, 6)
    windage, seakeeping               in the order of WINDAGE, SEAKEEPING
    manoeuvring, propeller            tables of the ship file, in the order of MANOEUVRING, PROPELLER
    series                            thrust of the propeller in four quadrants (propeller.py)
    torque, most, least               root and per_speed of the torque limit, and its tables (torque_limit.py)
    rudder, engine                    tables of the ship file, in the order of RUDDER, ENGINE
    hull 2 0x1.5p+7 0x1.4p+4          number of convex parts, reach and least extent [m]; then for each part
    part, planes                      its vertices (k, 3) [m] and half-spaces (m, 4)
    crc32 0f1e2d3c                    of all before

A line is a key and its values (ship/prepared_lines.py). `none` stands for a table that the ship does not have. Where
the Python model would refuse to make something of the ship, `refused` and the text of the refusal stand in its place.
native/ship/prepared_ship.cpp reads such files; what is computed here is not computed there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ..errors import HostError, ShipError
from ..ship.degrees_of_freedom import FREE, free_inverse
from ..ship.hull.hull import build_hull
from ..ship.loading.library import load_ship
from ..ship.prepared_lines import describe_hull, quote, reals, seal
from ..ship.seakeeping import compute_seakeeping
from ..ship.ship import Ship
from ..ship.windage import compute_windage
from .propeller import Propeller

__all__ = ["FORMAT", "SUFFIX", "VERSION", "describe_ship", "prepare_ship"]

FORMAT = "shipcollision prepared ship"
"""Begin of the first line."""
VERSION = 2
"""Version of the format. A reader refuses every other, so it rises with each change of a line or of an order."""

SUFFIX = ".ship"
"""Suffix of the files. A native FMU takes a ship with this suffix for a path."""

SIZE = ("L_pp", "L_oa", "B", "T", "mass", "rho")
MANOEUVRING = (
    "R_0", "X_vv", "X_vr", "X_rr", "X_vvvv", "Y_v", "Y_r", "Y_vvv", "Y_vvr", "Y_vrr", "Y_rrr",
    "N_v", "N_r", "N_vvv", "N_vvr", "N_vrr", "N_rrr",
)  # fmt: skip
PROPELLER = (
    "D_p", "t_P", "w_P0", "x_P", "C_1", "C_2_plus", "C_2_minus", "k_0", "k_1", "k_2", "astern_factor",
)  # fmt: skip
RUDDER = (
    "A_R", "H_R", "f_alpha", "t_R", "a_H", "x_H", "x_R", "l_R", "gamma_R_minus", "gamma_R_plus", "epsilon", "kappa",
    "max_angle_deg", "rate_deg_per_s",
)  # fmt: skip
ENGINE = ("rate", "max_rev_per_s", "max_astern_rev_per_s", "reversal_delay")
WINDAGE = ("A_Fw", "A_Lw", "s_L", "s_H", "C_Dt", "C_Dl_bow", "C_Dl_stern", "delta", "kappa")
SEAKEEPING = (
    "K_33", "K_44", "K_55", "D_33", "D_44", "D_44q", "D_55", "GM_T", "GM_L", "BM_T", "tan_deck", "x_F", "z_H", "z_R",
    "z_P",
)  # fmt: skip


def prepare_ship(
    source: str | Path | Mapping[str, Any], directory: Path | None = None, *, needs_hull: bool = False
) -> bytes:
    """The content of the prepared file of a ship, which load_ship finds by `source` and `directory`.

    The same ship gives the same bytes. Raises ShipError when the ship is refused. When its hull cannot be made, the
    file says so in its place, since the ship model does not need it; with needs_hull, ShipError or HostError is raised.
    """
    return describe_ship(load_ship(source, directory), needs_hull=needs_hull)


def describe_ship(ship: Ship, *, needs_hull: bool = False) -> bytes:
    """The content of the prepared file of a loaded ship: see prepare_ship."""
    hull = _describe_hull(ship, needs_hull)
    return seal([f"{FORMAT} {VERSION}", *_describe_body(ship), *_describe_machines(ship), *hull])


def _describe_body(ship: Ship) -> list[str]:
    return [
        f"name {quote(repr(ship.name))}",
        f"warning {quote('; '.join(ship.suspicious))}",
        _table("size", ship, SIZE),
        reals("r_bg", ship.r_bg),
        reals("M", ship.M.ravel()),
        reals("M_A", ship.M_A.ravel()),
        *(reals(f"inverse_{free}", free_inverse(ship.M, free).ravel()) for free in FREE),
        _table("windage", compute_windage(ship), WINDAGE),
        _or_refusal("seakeeping", lambda: _table("seakeeping", compute_seakeeping(ship), SEAKEEPING)),
    ]


def _describe_machines(ship: Ship) -> list[str]:
    return [
        _table("manoeuvring", ship.manoeuvring, MANOEUVRING),
        _table("propeller", ship.propeller, PROPELLER),
        _or_refusal("series", lambda: _describe_series(ship)),
        _table("rudder", ship.rudder, RUDDER),
        _table("engine", ship.engine, ENGINE),
    ]


def _describe_series(ship: Ship) -> str:
    """The lines of what is tabulated of a propeller and of its engine."""
    if ship.propeller is None:
        return "series none\ntorque none"
    propeller = Propeller(ship, ship.propeller)
    series = reals("series", propeller.series)
    limit = propeller.limit_torque(ship.engine) if ship.engine is not None else None
    if limit is None:
        return f"{series}\ntorque none"
    torque = reals("torque", (limit.root, limit.per_speed))
    return "\n".join([series, torque, reals("most", limit.most), reals("least", limit.least)])


def _describe_hull(ship: Ship, needed: bool) -> list[str]:
    try:
        hull = build_hull(ship.L_oa, ship.B, ship.T, ship.hull)
    except (ShipError, HostError) as error:
        if needed:
            raise
        return [f"hull refused {quote(_explain_refusal(ship, error))}"]
    return describe_hull(hull)


def _explain_refusal(ship: Ship, error: ShipError | HostError) -> str:
    """Why there is no hull, without a path of this machine."""
    if ship.hull.file is not None and not Path(ship.hull.file).is_file():
        return "the mesh file was missing when the ship was prepared: put it in its place, and prepare the ship again"
    if isinstance(error, HostError):
        return (
            "a package that reads meshes was missing when the ship was prepared: install shipcollision-fmu[mesh], and "
            "prepare the ship or build the FMU again"
        )
    return str(error)


def _or_refusal(key: str, describe: Callable[[], str]) -> str:
    """What is described, or the key with the text of the refusal."""
    try:
        return describe()
    except ShipError as error:
        return f"{key} refused {quote(str(error))}"


def _table(key: str, table: object, names: tuple[str, ...]) -> str:
    """A line of named numbers."""
    return f"{key} none" if table is None else reals(key, (getattr(table, name) for name in names))
