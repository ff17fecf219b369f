"""Running totals of a run: energy lost to contact, and how well contact was solved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .contact_problem import ContactSolution
from .interface import CollisionOutputs

__all__ = ["Totals"]

CONVERGED = 1e-9
"""Residual of the solver, as a share of the approach, above which a solution counts as not converged. The solver stops
at 1e-11; a larger limit would hide inexact impulses from the user."""


NOTICEABLE = 1e-4
"""Velocity [m/s] of a ship, taken off an impulse by passivity.py, from which it counts as scaled. A ship that wind
holds at a quay loses less by the fluctuation of the wind, in thousands of substeps. With a larger limit a gust that
ends, and leaves 80 J in a ship of 40 000 t, would not be counted."""


_OF_THE_STEP = ("residual", "sweeps", "unconverged_in_step")


@dataclass
class Totals:
    """Energies [J] and counts since the start; residual (worst) and sweeps (most) of the current step."""

    energy: float = 0.0
    energy_normal: float = 0.0
    energy_tangential: float = 0.0
    unconverged: int = 0
    scaled: int = 0
    residual: float = 0.0
    sweeps: int = 0
    unconverged_in_step: int = 0

    def add(self, solution: ContactSolution, taken_off: float, energies: Sequence[tuple[float, float]]) -> None:
        """Count a solved substep. taken_off: velocity [m/s], by passivity.py; energies: lost at each contact [J], along
        and across the normal."""
        self.residual, self.sweeps = max(self.residual, solution.residual), max(self.sweeps, solution.sweeps)
        missed = solution.residual > CONVERGED
        self.unconverged_in_step += missed
        self.unconverged += missed
        self.scaled += taken_off > NOTICEABLE
        for along, across in energies:
            self.energy += along + across
            self.energy_normal += along
            self.energy_tangential += across

    def describe_unconverged(self, t: float, H: float) -> str:
        """The warning of the step from t by H [s] if contact was not solved exactly in it for the first time, or
        nothing. The count goes on in solver.unconverged."""
        if not self.unconverged_in_step or self.unconverged > self.unconverged_in_step:
            return ""
        return (
            f"contact was not solved to {CONVERGED:g} of the approach {self.unconverged_in_step} times in the step "
            f"from t = {t:g} s by {H:g} s, at worst to {self.residual:.2g}: its impulses are less exact "
            "(solver.residual); later ones are counted in solver.unconverged"
        )

    def fill(self, out: CollisionOutputs) -> None:
        """Write the totals to the outputs, and begin to count the next step."""
        energy, solver = out.energy, out.solver
        energy.dissipated, energy.normal, energy.tangential = self.energy, self.energy_normal, self.energy_tangential
        solver.residual, solver.sweeps = self.residual, self.sweeps
        solver.unconverged, solver.scaled = self.unconverged, self.scaled
        self.residual, self.sweeps, self.unconverged_in_step = 0.0, 0, 0

    def get_state(self) -> dict[str, Any]:
        """The totals as plain data; what belongs to one step is in the outputs."""
        return {name: value for name, value in vars(self).items() if name not in _OF_THE_STEP}

    def set_state(self, state: dict[str, Any]) -> None:
        """Back to a state of get_state, exact to the bit."""
        vars(self).update(state, residual=0.0, sweeps=0, unconverged_in_step=0)
