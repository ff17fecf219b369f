"""A ship as the models use it: numbers and matrices. loading/assembly.py makes it from a ship file."""

from __future__ import annotations

from dataclasses import dataclass

from .frames import Array
from .tables.hull import HullTable
from .tables.manoeuvring import EngineTable, ManoeuvringTable, PropellerTable, RudderTable
from .tables.particulars import SeakeepingTable, WindTable

__all__ = ["Ship"]


@dataclass(frozen=True, eq=False, repr=False)
class Ship:
    """A ship: main dimensions [m], mass [kg], inertia matrices (6, 6) about CO in b (read-only), and its tables.

    `estimated` lists each value that the file leaves out, with the formula used instead; `suspicious` each value that
    is accepted, but looks like one in another unit. GM_T and GM_L [m] are those of the file, None where it has none:
    compute_seakeeping (seakeeping.py) has the estimates.
    """

    name: str
    kind: str
    source: str
    L_pp: float
    L_oa: float
    B: float
    T: float
    mass: float
    rho: float
    r_bg: Array
    M_RB: Array
    M_A: Array
    M: Array
    GM_T: float | None
    GM_L: float | None
    hull: HullTable
    manoeuvring: ManoeuvringTable | None
    propeller: PropellerTable | None
    rudder: RudderTable | None
    engine: EngineTable | None
    seakeeping: SeakeepingTable
    wind: WindTable
    estimated: tuple[str, ...]
    suspicious: tuple[str, ...] = ()

    def __repr__(self) -> str:
        """Three lines: the ship and its size, what is estimated, where to look next."""
        name, kind = ("".join(c if c.isprintable() else " " for c in text) for text in (self.name, self.kind))
        under_way = "coasts" if self.manoeuvring is None else "manoeuvres"
        return (
            f"{name}, {kind}: L_pp = {self.L_pp:.6g} m, B = {self.B:.6g} m, T = {self.T:.6g} m, "
            f"{self.mass / 1e3:.6g} t, {under_way}\n"
            f"{len(self.estimated)} estimates and {len(self.suspicious)} warnings: .estimated, .suspicious\n"
            "next: .M_RB, .M_A, .r_bg, .hull, .manoeuvring, .propeller, .rudder, .engine, .seakeeping, .wind"
        )

    @property
    def C_b(self) -> float:
        """Block coefficient mass / (rho L_pp B T)."""
        return self.mass / (self.rho * self.L_pp * self.B * self.T)
