"""Velocities and forces in n: the same collision, described in another frame."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from shipcollision_fmu.errors import InputError
from shipcollision_fmu.fmi.names import ATTITUDE, FORCE, MOMENT, POSITION, RATE, VELOCITY, named
from shipcollision_fmu.fmi.ship_collision import INTERFACE
from shipcollision_fmu.fmi.variable_access import VariableAccess
from shipcollision_fmu.ship.frames import rotation

HEELED = (0.05, -0.02, pi / 2 - 0.3)


def strike(frame: str) -> VariableAccess:
    """own, heeled and heading nearly east, strikes the side of target; its velocity and rate are given in `frame`."""
    access = INTERFACE.make_access()

    def put(group: str, names: tuple[str, ...], values: object) -> None:
        access.set_real(access.references(named(group, names)), [float(x) for x in values])  # type: ignore[attr-defined]  # numbers of any kind

    for name in ("own", "target"):
        access.set_string(access.references([f"{name}.ship"]), ["guan2014_own"])
    access.set_string(access.references(["own.velocity_frame", "own.force_frame"]), [frame, frame])
    turn = rotation(HEELED) if frame == "n" else np.eye(3)
    put("own", POSITION, (0.0, -170.0, 0.0))
    put("own", ATTITUDE, HEELED)
    put("own", VELOCITY, turn @ np.array([5.0, 0.5, 0.0]))
    put("own", RATE, turn @ np.array([0.001, 0.002, 0.01]))
    put("target", POSITION, (0.0, 0.0, 0.0))
    access.initialise()
    for k in range(40):
        access.do_step(0.25 * k, 0.25)
        if access.get_integer(access.references(["impact.count"])) == [1]:
            return access
        own = access.get_real(access.references(named("own.post", (*POSITION, *ATTITUDE, *VELOCITY, *RATE))))
        turn = rotation(own[3:6]) if frame == "n" else np.eye(3)
        put("own", POSITION, own[:3])
        put("own", ATTITUDE, own[3:6])
        put("own", VELOCITY, turn @ own[6:9])
        put("own", RATE, turn @ own[9:])
    raise AssertionError("no collision")


def test_a_collision_is_the_same_in_both_frames() -> None:
    """f_n = R f_b and v_n = R v_b, so that everything without a frame agrees, and forces differ by a rotation."""
    b, n = strike("b"), strike("n")
    both = [[access.get_real(access.references(named("own", (*FORCE, *MOMENT)))) for access in (b, n)]]
    attitude = b.get_real(b.references(named("own.post", ATTITUDE)))
    for in_b, in_n in both:
        size = np.abs(in_b).max()
        assert size > 1e5
        R = rotation(attitude)
        np.testing.assert_allclose(in_n[:3], R @ in_b[:3], atol=1e-9 * size)
        np.testing.assert_allclose(in_n[3:], R @ in_b[3:], atol=1e-9 * size)
    for name in ("impact.time", "impact.closing_speed", "energy.dissipated", "own.post.velocity.surge"):
        (x,), (y,) = (access.get_real(access.references([name])) for access in (b, n))
        assert x == pytest.approx(y, rel=1e-9)
    put = n.get_real(n.references(named("own", VELOCITY)))
    assert put[0] < 3.0 < put[1]  # as the host has set it: east


def test_another_frame_is_refused() -> None:
    access = INTERFACE.make_access()
    access.set_string(access.references(["target.force_frame"]), ["ned"])
    with pytest.raises(InputError, match=r"target.force_frame = 'ned' must be 'b' \(body\) or 'n'"):
        access.initialise()
