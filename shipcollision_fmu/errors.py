"""Every exception that this package raises on purpose.

    ShipCollisionError
    ├── InputError          input of a user is refused; the message has the key, its value, the limit and the remedy
    │   ├── ShipError       a ship file or a ship's particulars
    │   ├── ScenarioError   a scenario file or an option of a run
    │   └── StudyError      a study file or an option of a study
    ├── StepError           a model cannot make a step; its state before the step stays valid
    └── HostError           the surroundings fail: a missing package, an unwritable folder, a broken FMU

`exit_status` is the exit status of the command line: 2 for a user's input, 1 for everything else.
"""

from __future__ import annotations

import sys

__all__ = [
    "HostError",
    "InputError",
    "ScenarioError",
    "ShipCollisionError",
    "ShipError",
    "StepError",
    "StudyError",
    "describe_installation",
]


class ShipCollisionError(Exception):
    """Base of all errors of this package."""

    exit_status = 1


class InputError(ShipCollisionError):
    """Input of a user that is refused."""

    exit_status = 2


class ShipError(InputError):
    """A ship file, or a particular in it, is refused."""


class ScenarioError(InputError):
    """A scenario file, or an option of a run, is refused."""


class StudyError(InputError):
    """A study file, or an option of a study, is refused."""


class StepError(ShipCollisionError):
    """A model cannot make a step; the state before the step is kept."""


class HostError(ShipCollisionError):
    """The machine or an installed package fails: a missing package, an unwritable folder, a broken FMU."""


def describe_installation(extra: str = "") -> str:
    """The remedy for a missing package: the command that installs an extra of this package, or the package alone."""
    bracket = f"[{extra}]" if extra else ""
    python = sys.executable or "python"  # a host that embeds Python may have no executable
    return f"run `{python} -m pip install 'shipcollision-fmu{bracket}'` (in a clone: '.{bracket}')"
