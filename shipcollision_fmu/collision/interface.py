"""What the collision model takes and gives, as plain lists and attributes.

Reals are lists of stable identity: they are filled, never replaced, so that a caller may hold on to them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = [
    "CollisionInputs", "CollisionOutputs", "CollisionParameters", "ContactOutput", "ShipParameters", "ShipPost",
    "ShipState", "contact_point_count",
]  # fmt: skip

LEAST_SLOTS, SLOTS_PER_SHIP, MOST_SLOTS = 8, 4, 64


def zeros(n: int) -> list[float]:
    """n zeros, as a field of its own."""
    return [0.0] * n


def contact_point_count(ships: int) -> int:
    """Contact points that are output per communication step, for so many ships."""
    return min(max(LEAST_SLOTS, SLOTS_PER_SHIP * ships), MOST_SLOTS)


@dataclass
class ShipParameters:
    """Which ship it is: a name or a file; degrees_of_freedom 3 (surge, sway, yaw), 4 (and roll) or 6, as its model
    has; fender around its hull: stiffness [N/m], damping [N s/m], thickness [m], all 0 for none."""

    ship: str = "kvlcc2"
    degrees_of_freedom: int = 6
    fender: list[float] = field(default_factory=lambda: zeros(3))


@dataclass
class CollisionParameters:
    """Fixed parameters. numbers: friction, restitution, substep [s], minimum_separation_time [s], clearance_range
    [m]. obstacles: TOML text or the path of a TOML file, see obstacles.py; empty: none."""

    ships: list[ShipParameters]
    numbers: list[float] = field(default_factory=lambda: [0.3, 0.0, 0.01, 10.0, 200.0])
    response: str = "pgs"
    feedback: str = "ledger"
    obstacles: str = ""

    @property
    def friction(self) -> float:
        """Coulomb's coefficient of the pair."""
        return self.numbers[0]

    @property
    def restitution(self) -> float:
        """Normal velocity after over before, 0 to 1."""
        return self.numbers[1]

    @property
    def substep(self) -> float:
        """Length of an internal step [s]."""
        return self.numbers[2]

    @property
    def minimum_separation_time(self) -> float:
        """Time apart [s] after which the next contact is a new collision."""
        return self.numbers[3]

    @property
    def clearance_range(self) -> float:
        """Cap [m] of the clearance: farther apart is not measured."""
        return self.numbers[4]


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
    """A contact point of the step. point, normal in n; r_a, r_b its places in the ships' b [m]; impulse (3) on ship_b
    in n [N s]; values: gap [m], normal and tangential impulse [N s], energy dissipated [J]. Ships from 1, 0: unused;
    ship_b beyond the number of ships is an obstacle, the first one being the number of ships plus 1."""

    point: list[float] = field(default_factory=lambda: zeros(3))
    normal: list[float] = field(default_factory=lambda: zeros(3))
    r_a: list[float] = field(default_factory=lambda: zeros(3))
    r_b: list[float] = field(default_factory=lambda: zeros(3))
    impulse: list[float] = field(default_factory=lambda: zeros(3))
    values: list[float] = field(default_factory=lambda: zeros(4))
    ship_a: int = 0
    ship_b: int = 0
    impact: int = 0
    scratch: int = 0


@dataclass
class CollisionOutputs:
    """energy: dissipated, normal, tangential [J]; impact: time [s], closing speed [m/s], angle [rad] of the latest
    collision, impact_point its first contact point in n; fender: energy stored in fenders now and dissipated by them
    so far [J]; clearance [m] (one entry), nearest_ship_a and _b its pair. Of the solver: by how much the law of contact
    is missed in the step, as a share of the approach, at worst (one entry); its sweeps, at most; and how many answers
    so far missed it by more than 1e-9, or had to be scaled back so as not to add energy."""

    ships: list[ShipPost]
    contacts: list[ContactOutput] = field(default_factory=list)
    contact_active: bool = False
    contact_count: int = 0
    impact_count: int = 0
    impact_ship_a: int = 0
    impact_ship_b: int = 0
    impact: list[float] = field(default_factory=lambda: zeros(3))
    impact_point: list[float] = field(default_factory=lambda: zeros(3))
    scratch_id: int = 0
    energy: list[float] = field(default_factory=lambda: zeros(3))
    fender: list[float] = field(default_factory=lambda: zeros(2))
    clearance: list[float] = field(default_factory=lambda: zeros(1))
    nearest_ship_a: int = 0
    nearest_ship_b: int = 0
    solver: list[float] = field(default_factory=lambda: zeros(1))
    solver_sweeps: int = 0
    solver_unconverged: int = 0
    solver_scaled: int = 0

    def __post_init__(self) -> None:
        self.contacts = self.contacts or [ContactOutput() for _ in range(contact_point_count(len(self.ships)))]
