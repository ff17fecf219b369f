"""Impulses that come too late: under a parallel master a ship moves on for a step after the impact.

A sequential master applies the impulse predicted for a step at its start. Hulls then overlap only where the impulse
turns a body that touches late in the step: its other end has turned the other way from the start on. Under a parallel
master a ship that an impulse stops from the speed V moves V H past the first touch. It is stopped there, with the right
impulse. Where V H exceeds the thinner hull, the ship then stands on the far side of what it hit. No model can put it
back: poses belong to the ship model.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from .geometry.broad_phase import Pair

__all__ = ["describe_delayed_impulses"]


def describe_delayed_impulses(
    t: float, H: float, delayed_speeds: Mapping[int, float], colliding: Iterable[Pair], names: Sequence[str],
    thickness: Callable[[int, int], float],
) -> str:  # fmt: skip
    """The warning of the step from t by H [s] if impulses come later than hulls are thick, or nothing.

    delayed_speeds: by body, the speed [m/s] that a pending impulse takes; colliding: pairs in an open collision;
    thickness: of the thinner of two hulls [m].
    """
    for a, b in colliding:
        way, thin = H * max(delayed_speeds.get(a, 0.0), delayed_speeds.get(b, 0.0)), thickness(a, b)
        if way > thin:
            return (
                f"an impulse between {names[a]!r} and {names[b]!r} was applied one step late, at t = {t:g} s: they "
                f"moved {way:.4g} m on, and the thinner of them is {thin:.2g} m thick, so that one may have passed the "
                f"other; take steps below {H * thin / way:.1g} s, or a master that steps the collision model first"
            )
    return ""
