"""[scenario]: name, duration, communication step and master algorithm."""

from __future__ import annotations

import re
from math import ceil, isclose
from typing import Literal

from pydantic import Field, field_validator, model_validator

from ...ship.tables.table import Table

__all__ = ["MAXIMUM_STEPS", "Algorithm", "Header"]

Algorithm = Literal["gauss-seidel", "jacobi"]

MAXIMUM_STEPS = 1_000_000
"""Steps of the longest run: 14 h at 0.05 s, some 500 MB of states. More were meant as another `step`."""


class Header(Table):
    """[scenario]: the name of the run, its duration and its steps."""

    name: str = Field(description='the name of the run\'s folder, e.g. "head_on"')
    description: str = Field(default="", description="text for people; no effect")
    duration: float = Field(gt=0, description="a whole number of steps [s], e.g. 120.0")
    step: float = Field(default=0.05, gt=0, description="the communication step [s], e.g. 0.05")
    algorithm: Algorithm = Field(
        default="gauss-seidel",
        description="the master algorithm: gauss-seidel (collision first, then ships) or jacobi (all at once)",
    )

    @property
    def steps(self) -> int:
        """Number of communication steps in the run."""
        return round(self.duration / self.step)

    @field_validator("name")
    @classmethod
    def _check_name(cls, name: str) -> str:
        if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_.-]*", name):
            raise ValueError(f"[scenario] name = {name!r} cannot name a folder: take letters, digits, '_', '-' and '.'")
        return name

    @model_validator(mode="after")
    def _check_steps(self) -> Header:
        ratio = self.duration / self.step
        if ratio > MAXIMUM_STEPS:
            raise ValueError(
                f"[scenario] step = {self.step:g} s makes {ratio:.3g} steps of {self.duration:g} s, "
                f"the limit is {MAXIMUM_STEPS}: take a longer step"
            )
        if round(ratio) < 1 or not isclose(ratio, round(ratio), rel_tol=1e-9):
            whole = [n * self.step for n in (int(ratio), ceil(ratio)) if n > 0]
            raise ValueError(
                f"[scenario] duration = {self.duration:g} s is {ratio:.6g} steps of {self.step:g} s, must be a whole "
                f"number: take duration = {' or '.join(f'{d:g}' for d in whole)}, or a step that divides it"
            )
        return self
