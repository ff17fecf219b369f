"""What a response is given, and what it gives: the contact problem of one substep, and the impulses that solve it."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass, field
from typing import Any

from .dynamics.body_state import BodyState
from .dynamics.contact import Impulse
from .geometry.bullet import BulletBody
from .geometry.detection import Detector, LastNormals
from .solvers.warm_start import WarmStarts
from .solvers.work_limit import StepWork

__all__ = ["ContactCaches", "ContactProblem", "ContactSolution"]


@dataclass(frozen=True)
class ContactProblem:
    """Bodies within reach of each other, at one substep.

    pairs: indices (a, b) of bodies near each other; states: of all bodies; bullet_bodies: the bodies as Bullet's own
    dynamics takes them; friction, restitution: of every pair; h: length of the substep [s].
    """

    pairs: Sequence[tuple[int, int]]
    states: Sequence[BodyState]
    detector: Detector
    bullet_bodies: Sequence[BulletBody]
    friction: float
    restitution: float
    h: float


@dataclass(frozen=True)
class ContactSolution:
    """Impulses of a substep; residual: by how much the law of contact is missed, as a share of the approach; sweeps."""

    impulses: list[Impulse]
    residual: float = 0.0
    sweeps: int = 0

    @property
    def moves_nothing(self) -> bool:
        """Whether the contacts part, or rest since an earlier substep: nothing was solved."""
        return self.sweeps == 0 and self.residual == 0.0 and not any(impulse.P.any() for impulse in self.impulses)


@dataclass
class ContactCaches:
    """What is carried from substep to substep, and updated by the responses.

    last_normals: normals of the last shallow contacts, used in deep overlap (detection.py); warm_starts: impulses of
    the substep before, from which the solver starts (warm_start.py); work: what the solver may still do in this
    communication step (work_limit.py), renewed by every step and no part of the state.
    """

    last_normals: LastNormals = field(default_factory=dict)
    warm_starts: WarmStarts = field(default_factory=dict)
    work: StepWork = field(default_factory=StepWork)

    def forget_parted(self, near: Container[tuple[int, int]]) -> None:
        """Drop the impulses of the pairs that are not near each other in this communication step.

        Impulses of an earlier visit are no guess for an elastic impact at the same place. The solver would stop at its
        tolerance: 5e-12 of the energy a bounce, instead of 3e-15.
        """
        if self.warm_starts:
            self.warm_starts = {pair: rows for pair, rows in self.warm_starts.items() if pair in near}

    def get_state(self) -> dict[str, Any]:
        """All of it as plain data."""
        return {
            "last_normals": [[a, b, carrier, list(normal)] for (a, b), (carrier, normal) in self.last_normals.items()],
            "warm_starts": [[a, b, [[*row] for row in rows]] for (a, b), rows in self.warm_starts.items()],
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        self.last_normals = {(a, b): (carrier, list(normal)) for a, b, carrier, normal in state["last_normals"]}
        self.warm_starts = {(a, b): [(place, P) for place, P in rows] for a, b, rows in state["warm_starts"]}
