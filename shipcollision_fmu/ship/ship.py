"""A ship as the models use it: numbers and matrices. loading/assembly.py makes it from a ship file."""

from __future__ import annotations

from dataclasses import dataclass

from .frames import Array
from .tables.hull import HullTable
from .tables.manoeuvring import EngineTable, ManoeuvringTable, PropellerTable, RudderTable
from .tables.particulars import SeakeepingTable, WindTable

__all__ = ["Ship"]


@dataclass(frozen=True, eq=False)
class Ship:
    """A ship: main dimensions [m], mass [kg], inertia matrices (6, 6) about CO in b (read-only), and its tables.

    `estimated` lists each value that the file leaves out, with the formula used instead; `suspicious` each value that
    is accepted, but looks like one in another unit.
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

    @property
    def C_b(self) -> float:
        """Block coefficient mass / (rho L_pp B T)."""
        return self.mass / (self.rho * self.L_pp * self.B * self.T)
