"""list_state(): a state of the Python collision model as the native one writes it, so that both step from it."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, islice
from math import isfinite, isnan, nan
from typing import Any, NamedTuple

from shipcollision_fmu.collision.findings import FINDINGS

__all__ = ["ModelState", "list_state"]

DELAYS = (None, False, True)
"""Delay in impulse_ledger.hpp."""

WARM_START = 56
"""Bytes of one in warm_start.hpp."""


class Part(NamedTuple):
    """Kind of its values as `struct` has it, the values, and whether they are energies [J]."""

    kind: str
    values: tuple[float, ...]
    are_energies: bool = False


@dataclass(frozen=True)
class ModelState:
    """Parts of a state in the order of get_state() of native/: what is before the impulses of the substep before
    (warm starts), these, and what is after them. A number that nothing reads is nan."""

    before: list[Part]
    warm_starts: list[Part]
    after: list[Part]

    def write(self) -> bytes:
        """What ShipCollision::set_state reads."""
        parts = [*self.before, *self.warm_starts, *self.after]
        return struct.pack(_lay_out(parts), *chain.from_iterable(part.values for part in parts))

    def compare(self, data: bytes, least_energy: float = 1.0) -> float:
        """Largest difference from a native state, as a share of the largest number of its part; 1 where whole numbers
        or sizes differ. How contacts share what their pair gives is not unique, so that warm starts are left out.

        least_energy: [J] by which lesser energies are judged."""
        before, after = _lay_out(self.before), _lay_out(self.after)
        at = struct.calcsize(before)
        rest = at + 4 + WARM_START * struct.unpack_from("<i", data, at)[0]
        if len(data) != rest + struct.calcsize(after):
            return 1.0
        found = chain(struct.unpack_from(before, data), struct.unpack_from(after, data, rest))
        return max(
            _compare(part, found, least_energy if part.are_energies else 1.0) for part in (*self.before, *self.after)
        )


def _lay_out(parts: Sequence[Part]) -> str:
    """Kinds of all values as `struct` has them."""
    return "<" + "".join(part.kind * len(part.values) for part in parts)


def _compare(part: Part, found: Iterator[float], least: float) -> float:
    worst, scale = 0.0, max((abs(value) for value in part.values if isfinite(value)), default=0.0)
    for value, other in zip(part.values, islice(found, len(part.values)), strict=True):
        if value != other and not isnan(value):
            is_near = part.kind == "d" and isfinite(value) and isfinite(other)
            worst = max(worst, abs(value - other) / max(scale, least) if is_near else 1.0)
    return worst


def list_state(state: Mapping[str, Any]) -> ModelState:
    """What get_state() of the Python model returned, as the native model has it."""
    exchange, fenders, caches = state["exchange"], state["fenders"], state["caches"]
    return ModelState(
        [*_write_exchange(exchange), *_write_fenders(fenders), *_write_normals(caches["last_normals"])],
        [*_write_warm_starts(caches["warm_starts"])],
        [*_write_collisions(state["collisions"]), *_write_totals(state["totals"]),
         *_write_diagnosis(state["diagnosis"])],
    )  # fmt: skip


def _flatten(values: Iterable[Any]) -> Iterator[float]:
    for value in values:
        if isinstance(value, Iterable):
            yield from _flatten(value)
        else:
            yield value


def _numbers(*values: Any) -> Part:
    return Part("d", tuple(_flatten(values)))


def _energies(*values: Any) -> Part:
    return Part("d", tuple(_flatten(values)), are_energies=True)


def _integers(*values: int) -> Part:
    return Part("i", values)


def _flags(*values: bool) -> Part:
    return Part("?", values)


def _write_exchange(state: Mapping[str, Any]) -> Iterable[Part]:
    for ledger, last in zip(state["ledgers"], state["last_received"], strict=True):
        yield _numbers(*(ledger[name] for name in ("issued", "last_issued", "_nu", "_applied", "_x", "_R", "_issued_n",
                                                   "_applied_n", "_size")))  # fmt: skip
        yield _integers(DELAYS.index(ledger["one_step_delay"]))
        yield _flags(ledger["is_settled"], last is not None)
        if last is not None:
            yield _numbers(*last)


def _write_fenders(state: Mapping[str, Any]) -> Iterable[Part]:
    yield _integers(len(state["stored"]))
    for a, b, stored in state["stored"]:
        yield _integers(a, b)
        yield _energies(stored)
    yield _energies(state["dissipated"])


def _write_normals(rows: Sequence[Any]) -> Iterable[Part]:
    yield _integers(len(rows))
    for a, b, carrier, normal in rows:
        yield _integers(a, b, carrier)
        yield _numbers(normal)


def _write_warm_starts(state: Sequence[Any]) -> Iterable[Part]:
    rows = [(a, b, place, P) for a, b, rows in state for place, P in rows]
    yield _integers(len(rows))
    for a, b, place, P in rows:
        yield _integers(a, b)
        yield _numbers(place, P)


def _write_impact(impact: Mapping[str, Any]) -> Iterable[Part]:
    yield _numbers(impact["time"], impact["point"], impact["closing_speed"], impact["angle"])
    yield _integers(impact["ship_a"], impact["ship_b"])


def _write_collisions(state: Mapping[str, Any]) -> Iterable[Part]:
    yield _integers(state["count"], state["scratches"])
    yield from _write_impact(state["latest"])
    yield _integers(len(state["pairs"]))
    for a, b, collision, scratch, last_contact, impact in state["pairs"]:
        yield _integers(a, b, collision, scratch)
        yield _numbers(last_contact)
        yield from _write_impact(impact)


def _write_totals(state: Mapping[str, Any]) -> Iterable[Part]:
    yield _energies(state["energy"], state["energy_normal"], state["energy_tangential"])
    yield _integers(state["unconverged"], state["scaled"])


def _write_diagnosis(state: Sequence[Any]) -> Iterable[Part]:
    step, due, motions, answers = state
    yield _integers(step)
    yield _numbers(due)
    for next_, stride, pause, start, position, changes, idle, still, suspicion, windows, speed, rate, done in motions:
        code = FINDINGS[suspicion][0] if suspicion else 0
        yield _numbers(next_, still, start or [nan] * 13, position or [nan] * 3)
        yield _flags(start is not None, bool(position), speed, rate, done)
        yield _integers(stride, pause, changes, idle, windows, code)
    for t, steps, nu, applied, issued, known, share, counts, doubts, done in answers:
        yield _numbers(nan if t is None else t, share, *(six or [nan] * 6 for six in (nu, applied, issued, known)))
        yield _flags(t is not None, counts, done)
        yield _integers(steps, doubts)
