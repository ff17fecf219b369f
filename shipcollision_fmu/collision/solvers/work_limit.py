"""The work of a communication step on contact is bounded: a host that waits for a step cannot wait for ever.

Work is counted in nominal microseconds, by formulas and never by a clock: the same inputs give the same impulses on
every machine. Each solve may take a share of what the step has left. A solver that has spent its share ends with the
best impulses so far, and the residual counts them as not converged (totals.py).
"""

from __future__ import annotations

from math import inf

__all__ = ["StepWork", "WorkLimit"]

FOUR_SHIPS = 30_000.0
"""Work [us, nominal] of all solves in a step of 0.1 s with up to four ships. The rest of such a step takes up to some
30 ms. Larger: steps of more than 100 ms. Smaller: hard patches, as of wedged ships, end before they are solved."""

FURTHER_SHIP = 15_000.0
"""Work [us, nominal] for each ship beyond four."""

SHARE = 0.4
"""Share of the work left in a step that one solve may take. With 1, one hard substep leaves the later ones with
LEAST_SWEEPS (gauss_seidel.py). With 0.25, a third more of the substeps of jammed rafts end before they are solved, and
work is left over."""

STEP = 0.1
"""Length of a step [s] for which the bounds are; a longer step has as much more work, a shorter one not less."""


class WorkLimit:
    """Work that one solve may still do [us, nominal]."""

    __slots__ = ("left",)

    def __init__(self, left: float = inf) -> None:
        self.left = left

    @property
    def is_spent(self) -> bool:
        """Whether nothing is left."""
        return self.left <= 0.0

    def spend_sweep(self, contacts: int) -> None:
        """A Gauss-Seidel sweep over so many contacts."""
        self.left -= contacts * (5.0 + 0.05 * contacts)

    def spend_newton_step(self, contacts: int, closed: int) -> None:
        """A step of Newton's method with a linear system of 3 rows for every closed contact."""
        self.left -= self._newton_step(contacts, closed)

    def spend_residual(self, contacts: int) -> None:
        """The residual of the law of contact, and what goes with it."""
        self.left -= 20.0 + 0.5 * contacts

    def reserve_newton_steps(self, steps: int, contacts: int) -> None:
        """Allow so many steps of Newton's method, though the work be spent."""
        self.left = max(self.left, steps * self._newton_step(contacts, contacts))

    @staticmethod
    def _newton_step(contacts: int, closed: int) -> float:
        return 90.0 + 2.0 * contacts + 0.15 * closed**2 + 0.001 * closed**3

    def spend_gradient_step(self, contacts: int) -> None:
        """A step of the projected gradient method."""
        self.left -= 30.0 + 0.006 * contacts**2

    def spend_impact_process(self, stretches: int) -> None:
        """The impact process of one contact, with its operator, and so many stretches of its slip."""
        self.left -= 300.0 + 50.0 * stretches


class StepWork:
    """Work that all solves of a communication step may still do."""

    def __init__(self) -> None:
        self._left = inf

    def renew(self, ships: int, H: float) -> None:
        """Begin a step of H [s] in which so many ships are near others."""
        self._left = (FOUR_SHIPS + FURTHER_SHIP * max(0, ships - 4)) * max(1.0, H / STEP)

    def lend(self) -> WorkLimit:
        """The share of the next solve."""
        return WorkLimit(SHARE * self._left)

    def settle(self, lent: WorkLimit) -> None:
        """Take off what the solve has spent."""
        if self._left < inf:
            self._left = max(0.0, self._left - max(0.0, SHARE * self._left - lent.left))
