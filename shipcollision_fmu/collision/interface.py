"""Inputs, parameters and outputs of the collision model, with a name for every scalar and a list for every vector.

The objects and lists are filled and never replaced: the access layer of fmi/ keeps references to them. Scalars are
plain floats and ints.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from ..ship.coasting_law import COASTING

__all__ = [
    "NO_IMPACT", "CollisionInputs", "CollisionOutputs", "CollisionParameters", "ContactOutput", "DiagnosisOutput",
    "EnergyOutput", "FenderOutput", "FenderParameters", "Impact", "ShipParameters", "ShipPost", "ShipState",
    "SolverOutput", "contact_point_count",
]  # fmt: skip

LEAST_POINTS, POINTS_PER_SHIP, MOST_POINTS = 8, 4, 64
"""Contact points in the outputs. More points are more variables of the FMU; with fewer, points of a pair are merged."""


def zeros(n: int) -> list[float]:
    """n zeros, as a field of its own."""
    return [0.0] * n


def contact_point_count(ships: int) -> int:
    """Number of contact points in the outputs of a model of so many ships."""
    return min(max(LEAST_POINTS, POINTS_PER_SHIP * ships), MOST_POINTS)


@dataclass
class FenderParameters:
    """A fender around a hull: stiffness [N/m], damping [N s/m], thickness [m]; all zero for none."""

    stiffness: float = 0.0
    damping: float = 0.0
    thickness: float = 0.0


@dataclass
class ShipParameters:
    """Which ship it is: a name or a file; degrees_of_freedom 3 (surge, sway, yaw), 4 (and roll) or 6, as its model
    has; the law by which it is expected to move between impulses (ship/coasting_law.py); the fender around its hull;
    its feedback (feedback.py), and the same as text, empty where the other one holds."""

    ship: str = "kvlcc2"
    degrees_of_freedom: int = 6
    coasting: str = COASTING[0]
    fender: FenderParameters = field(default_factory=FenderParameters)
    feedback: str = "common"
    feedback_name: str = ""


@dataclass
class CollisionParameters:
    """Fixed parameters, the same for all pairs.

    friction: Coulomb's coefficient; restitution: normal velocity after over before, 0 to 1; substep: length of an
    internal step [s]; minimum_separation_time: time apart [s] after which the next contact is a new collision;
    clearance_range: cap of the clearance [m]; obstacles: TOML text or the path of a TOML file, see obstacles.py; empty:
    none.
    """

    ships: list[ShipParameters]
    friction: float = 0.3
    restitution: float = 0.0
    substep: float = 0.01
    minimum_separation_time: float = 10.0
    clearance_range: float = 200.0
    response: str = "pgs"
    feedback: str = "ledger"
    obstacles: str = ""


@dataclass
class ShipState:
    """A ship as received at the start of a step: n [m], rad, b [m/s], [rad/s]; impulse_applied (6) cumulative in b."""

    position: list[float] = field(default_factory=lambda: zeros(3))
    attitude: list[float] = field(default_factory=lambda: zeros(3))
    velocity: list[float] = field(default_factory=lambda: zeros(3))
    rate: list[float] = field(default_factory=lambda: zeros(3))
    impulse_applied: list[float] = field(default_factory=lambda: zeros(6))


@dataclass
class CollisionInputs:
    """One state per ship."""

    ships: list[ShipState]


@dataclass
class ShipPost:
    """A ship at the end of a step, impulse (6) cumulative and mean force (6) of the step, both in b about CO."""

    position: list[float] = field(default_factory=lambda: zeros(3))
    attitude: list[float] = field(default_factory=lambda: zeros(3))
    velocity: list[float] = field(default_factory=lambda: zeros(3))
    rate: list[float] = field(default_factory=lambda: zeros(3))
    impulse: list[float] = field(default_factory=lambda: zeros(6))
    force: list[float] = field(default_factory=lambda: zeros(6))


@dataclass
class ContactOutput:
    """A contact point of the step.

    point, normal: in n [m], [1]; r_a, r_b: the point in b of either ship [m]; impulse: on ship_b in n [N s]; couple:
    moment of the impulses on ship_b about the point, in n [N m s]; gap [m]; impulse_normal, impulse_tangential [N s];
    energy: dissipated [J]; ship_a, ship_b: from 1, 0: unused, an obstacle is numbered on from the ships; collision,
    scratch: their numbers; start, first, closing_speed, angle: the impact with which its collision began (Impact).
    """

    point: list[float] = field(default_factory=lambda: zeros(3))
    normal: list[float] = field(default_factory=lambda: zeros(3))
    r_a: list[float] = field(default_factory=lambda: zeros(3))
    r_b: list[float] = field(default_factory=lambda: zeros(3))
    impulse: list[float] = field(default_factory=lambda: zeros(3))
    couple: list[float] = field(default_factory=lambda: zeros(3))
    gap: float = 0.0
    impulse_normal: float = 0.0
    impulse_tangential: float = 0.0
    energy: float = 0.0
    ship_a: int = 0
    ship_b: int = 0
    collision: int = 0
    scratch: int = 0
    start: float = 0.0
    first: list[float] = field(default_factory=lambda: zeros(3))
    closing_speed: float = 0.0
    angle: float = 0.0


@dataclass
class Impact:
    """The latest impact, with which a collision began: time [s], first contact point in n [m], closing speed along the
    normal [m/s], angle between the headings [rad], ships from 1."""

    time: float = 0.0
    point: list[float] = field(default_factory=lambda: zeros(3))
    closing_speed: float = 0.0
    angle: float = 0.0
    ship_a: int = 0
    ship_b: int = 0


NO_IMPACT = Impact()
"""Before a collision begins, and where a fender acts."""


@dataclass
class EnergyOutput:
    """Kinetic energy lost to contact since the start [J]: all, along the normals, by friction."""

    dissipated: float = 0.0
    normal: float = 0.0
    tangential: float = 0.0


@dataclass
class FenderOutput:
    """Energy that fenders hold now, and have dissipated since the start [J]."""

    stored: float = 0.0
    dissipated: float = 0.0


@dataclass
class SolverOutput:
    """How well contact was solved. residual: by how much the law of contact was missed in the step, at worst, as a
    share of the approach, or of 1 mm/s if that is more; sweeps: most of a substep; unconverged: substeps so far with a
    residual above 1e-9; scaled: substeps so far whose impulses were scaled back so as not to add energy, by more than
    0.1 mm/s of a ship."""

    residual: float = 0.0
    sweeps: int = 0
    unconverged: int = 0
    scaled: int = 0


@dataclass
class DiagnosisOutput:
    """What was found wrong with the wiring (findings.py). code, text: of the first finding, 0 and empty: none; ship:
    of which it is, from 1; count: findings so far."""

    code: int = 0
    ship: int = 0
    count: int = 0
    text: str = ""


@dataclass
class CollisionOutputs:
    """Outputs of a step. collision_count: collisions so far; scratch_id: the scratch being drawn, 0: none; clearance:
    least distance [m] between hulls, capped; nearest_ship_a, nearest_ship_b: its pair, from 1."""

    ships: list[ShipPost]
    contacts: list[ContactOutput] = field(default_factory=list)
    contact_active: bool = False
    contact_count: int = 0
    collision_count: int = 0
    impact: Impact = field(default_factory=Impact)
    scratch_id: int = 0
    energy: EnergyOutput = field(default_factory=EnergyOutput)
    fender: FenderOutput = field(default_factory=FenderOutput)
    clearance: float = 0.0
    nearest_ship_a: int = 0
    nearest_ship_b: int = 0
    solver: SolverOutput = field(default_factory=SolverOutput)
    diagnosis: DiagnosisOutput = field(default_factory=DiagnosisOutput)

    def __post_init__(self) -> None:
        self.contacts = self.contacts or [ContactOutput() for _ in range(contact_point_count(len(self.ships)))]
