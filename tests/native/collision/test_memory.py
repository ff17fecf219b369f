"""native/collision: after its first contact a model asks for no memory in a step."""

from __future__ import annotations

import ctypes
import platform

import pytest

from tests.native.collision.kernels import load_kernels
from tests.native.native_collision import NativeCollision

pytestmark = [
    pytest.mark.needs("pybullet"),
    pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="requests are counted in glibc"),
]

H = 0.05
BESIDE = [0.0, 58.001, 0.0, 0.0, 0.0, 0.0]
CASES = {
    "alongside": ([[0.0, 0.0, 0.0, 2.0, 0.05, 0.001], BESIDE], [0.0, 0.002], 4),
    "pressed": ([[0.0, 0.0, 0.0, 0.0, 0.05, 0.0], BESIDE], [0.0, 0.002], 4),
    "bow into side": ([[0.0, 0.0, 0.0, 3.0, 0.0, 0.0], [190.0, 20.0, 1.6, 3.0, 0.0, 0.0]], [0.01, 0.0], 2),
}
"""Of each ship north, east, heading, surge, sway and rate of turn; what is added to surge and sway of the first ship in
each step; and the most contacts that come of it."""


@pytest.mark.parametrize("case", CASES)
def test_no_step_after_the_first_contact_asks_for_memory(case: str) -> None:
    """Not for more contacts, and not for friction that sticks for the first time. Before, the count does grow."""
    motions, push, most = CASES[case]
    library = load_kernels()
    count = library.shipcollision_count_requests
    count.restype = ctypes.c_long
    model = NativeCollision(library)
    for ship, given, (north, east, heading, *twist) in zip(
        model.parameters.ships, model.inputs.ships, motions, strict=True
    ):
        ship.ship = "kvlcc2"
        given.position[:2], given.attitude[2], given.velocity[:2], given.rate[2] = (
            [north, east], heading, twist[:2], twist[2]
        )  # fmt: skip
    model.initialise()
    asked, contacts = [], []
    for k in range(160):
        before = count()
        model.step(k * H, H)
        asked.append(count() - before)
        contacts.append(model.outputs.contact_count)
        for given, post in zip(model.inputs.ships, model.outputs.ships, strict=True):
            given.position[:], given.attitude[:], given.impulse_applied[:] = post.position, post.attitude, post.impulse
            given.velocity[:], given.rate[:] = post.velocity, post.rate
        for i in range(2):
            model.inputs.ships[0].velocity[i] += push[i]
    first = next(k for k, found in enumerate(contacts) if found)
    assert max(contacts) == most
    assert max(contacts[first + 1 :]) >= max(contacts[first], 2)
    assert asked[first] > 0
    assert sum(asked[first + 1 :]) == 0
