"""The curves of a run: speeds, yaw rate, roll, heading, energy, impulse, clearance.

    speed       of CO over ground, horizontal      surge, sway   its parts along and across the ship   [m/s]
    yaw_rate    rate of turn in b [rad/s]          roll, heading [rad], the heading unwrapped
    kinetic     energy of the ship and the water it carries (ship/kinetic_energy.py) [J]
    dissipated  in contact [J]
    normal, tangential    impulses of all contact points, summed up to then [N s]
    clearance   least distance between hulls, capped [m]

Thinned, see resample.py, to within CURVE_ERROR of each curve's own range; the times are the same for all.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...fmi.names import STATE
from ...ship.frames import Array
from ...ship.kinetic_energy import kinetic_energy
from .resample import choose_samples
from .run_folder import RunFolder

__all__ = ["CURVE_ERROR", "Signal", "Signals", "signals_of"]

CURVE_ERROR = 1e-3
"""Of a curve's range: less than the width of a line in a plot."""


@dataclass(frozen=True, eq=False)
class Signal:
    """A curve: what of, of which ship (None: of all), its SI unit, values (k,)."""

    quantity: str
    ship: str | None
    unit: str
    values: Array


@dataclass(frozen=True, eq=False)
class Signals:
    """Curves over common times (k,) [s]."""

    times: Array
    curves: tuple[Signal, ...]

    def of(self, quantity: str) -> tuple[Signal, ...]:
        """All curves of a quantity."""
        return tuple(curve for curve in self.curves if curve.quantity == quantity)


def signals_of(run: RunFolder) -> Signals:
    """The thinned curves of a run."""
    curves = [curve for i, name in enumerate(run.bodies.ships) for curve in _of_ship(run, i, name)]
    curves.append(Signal("dissipated", None, "J", run.signals["energy.dissipated"]))
    for part in ("normal", "tangential"):
        curves.append(Signal(part, None, "N s", _summed(run, f"impulse_{part}")))
    curves.append(Signal("clearance", None, "m", run.signals["clearance"]))
    values = np.column_stack([curve.values for curve in curves])
    scale = np.maximum(np.ptp(values, axis=0), 1e-9 * np.abs(values).max(axis=0))
    scale[scale == 0.0] = 1.0
    rows = choose_samples(run.times, values / scale, CURVE_ERROR)
    return Signals(run.times[rows], tuple(Signal(c.quantity, c.ship, c.unit, c.values[rows]) for c in curves))


def _of_ship(run: RunFolder, i: int, name: str) -> list[Signal]:
    states = run.states[:, i]
    eta, nu = dict(zip(STATE[:6], states[:, :6].T, strict=True)), states[:, 6:]
    body = run.bodies.ships[name]
    energy = kinetic_energy(np.array(body.inertia), states[:, 3:6], nu, body.degrees_of_freedom)
    return [
        Signal("speed", name, "m/s", _speed(eta, nu)),
        Signal("surge", name, "m/s", nu[:, 0]),
        Signal("sway", name, "m/s", nu[:, 1]),
        Signal("yaw_rate", name, "rad/s", nu[:, 5]),
        Signal("roll", name, "rad", eta["attitude.roll"]),
        Signal("heading", name, "rad", eta["attitude.yaw"]),
        Signal("kinetic", name, "J", energy),
    ]


def _speed(eta: dict[str, Array], nu: Array) -> Array:
    """Horizontal speed [m/s]: what is left of |v_b| without its vertical part in n."""
    roll, pitch = eta["attitude.roll"], eta["attitude.pitch"]
    u, v, w = nu[:, 0], nu[:, 1], nu[:, 2]
    down = -np.sin(pitch) * u + np.cos(pitch) * (np.sin(roll) * v + np.cos(roll) * w)
    result: Array = np.sqrt(np.maximum(u * u + v * v + w * w - down * down, 0.0))
    return result


def _summed(run: RunFolder, column: str) -> Array:
    """Running sum of a column of contacts.csv at the times of states.csv."""
    order = np.argsort(run.contacts["time"], kind="stable")
    total = np.concatenate([[0.0], np.cumsum(run.contacts[column][order])])
    result: Array = total[np.searchsorted(run.contacts["time"][order], run.times + 1e-9, side="right")]
    return result
