"""Fenders: the textbook's mass on a spring, the energy to absorb, and that none is ever gained."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, exp, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shipcollision_fmu.collision.fender import Fender, combine_in_series, compress_fender, solve_friction
from shipcollision_fmu.collision.interface import FenderParameters
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.errors import InputError
from tests.collision.conftest import BOX, World

Make = Callable[..., str]
MakeWorld = Callable[..., World]

K, V, H = 4e7, 0.3, 0.01
MASS = 1.05 * 40e6  # of the test ship in surge, water included
OMEGA = sqrt(K / MASS)


def wall(stiffness: float = K, damping: float = 0.0, thickness: float = 2.0) -> str:
    """A quay across the bow of a 200 m box whose stem is at 100 m; the fender begins at 100 m."""
    return (
        f'[wall]\nkind = "quay"\nshape = "box"\nlength = 300.0\nbreadth = 20.0\nheading_deg = 90.0\n'
        f"position = [{110.0 + thickness}, 0.0]\n"
        f"fender = {{stiffness = {stiffness}, damping = {damping}, thickness = {thickness}}}\n"
    )


def head_on(world: MakeWorld, ship: str, text: str, **more: object) -> World:
    return world([ship], [{"position": [-0.05, 0.0, 0.0], "nu": [V, 0, 0, 0, 0, 0]}], obstacles=text,
                 degrees_of_freedom=3, **more)  # fmt: skip


def test_mass_on_a_spring_is_a_half_sine(make_ship: Make, world: MakeWorld) -> None:
    """F(t) = k (v/omega) sin(omega t), back with the same speed after pi/omega; 1/2 m v^2 is stored in between."""
    w = head_on(world, make_ship("box", BOX), wall())
    forces, stored = [], []
    for _ in range(round(6.0 / H)):
        w.step(H)
        forces.append(-w.model.outputs.ships[0].force[0])
        stored.append(w.model.outputs.fender.stored)
    begin = 0.05 / V
    t = (np.arange(len(forces)) + 0.5) * H - begin  # mean forces: of the middle of a step
    exact = np.where((t > 0) & (t < pi / OMEGA), K * V / OMEGA * np.sin(OMEGA * t), 0.0)
    assert np.abs(np.array(forces) - exact).max() < 0.02 * exact.max()
    assert max(stored) == pytest.approx(0.5 * MASS * V**2, rel=0.01)
    assert w.nu[0][0] == pytest.approx(-V, rel=(OMEGA * H) ** 2)
    assert abs(w.nu[0][0]) <= V
    assert w.model.outputs.fender.stored == 0.0
    assert w.model.outputs.fender.dissipated == pytest.approx(0.5 * MASS * (V**2 - w.nu[0][0] ** 2), rel=1e-6)
    assert not w.model.outputs.contact_active
    assert w.model.outputs.collision_count == 0


@pytest.mark.parametrize("step", [0.05, 0.2])
def test_a_longer_communication_step_damps(make_ship: Make, world: MakeWorld, step: float) -> None:
    """By exp(-pi omega (H - h)/4): the impulse of a step is applied at its start."""
    w = head_on(world, make_ship("box", BOX), wall()).run(6.0, step)
    assert w.nu[0][0] == pytest.approx(-V * exp(-pi * OMEGA * (step - 0.01) / 4), rel=0.005)


def test_the_speed_comes_back_to_second_order_in_the_substep() -> None:
    """One mass, one spring, steps of h: what is missing of the speed is below (omega h)^2 / 4."""
    for h in (0.08, 0.04, 0.02, 0.01):
        x, v, stored = -0.013, V, 0.0
        for _ in range(round(6.0 / h)):
            x += h * v
            if x > 0.0:
                compressed = compress_fender(Fender(K, 0.0, 2.0), x, v, 1.0 / MASS, stored, h)
                v, stored = v - compressed.P / MASS, compressed.stored
        assert x < 0.0
        assert -1e-12 <= 1.0 + v / V <= (OMEGA * h) ** 2 / 4


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [0.1, 0.5])
def test_a_damped_fender_restores_what_the_textbook_says(make_ship: Make, world: MakeWorld, ratio: float) -> None:
    """m x'' + c x' + k x = 0 until the force, not the compression, is back at zero: a fender does not pull."""
    c = 2.0 * ratio * sqrt(K * MASS)
    w = head_on(world, make_ship("box", BOX), wall(damping=c), substep=0.005).run(8.0, 0.005)
    decay, own = ratio * OMEGA, OMEGA * sqrt(1 - ratio**2)
    end = atan2(2 * ratio * sqrt(1 - ratio**2), 2 * ratio**2 - 1) / own  # k x + c x' = 0
    speed = V * exp(-decay * end) * (cos(own * end) - decay / own * sin(own * end))
    assert speed < 0.0
    assert w.nu[0][0] == pytest.approx(speed, rel=0.03)
    assert w.model.outputs.fender.dissipated == pytest.approx(0.5 * MASS * (V**2 - w.nu[0][0] ** 2), rel=1e-6)


def test_berthing_energy_is_that_of_pianc(make_ship: Make, world: MakeWorld) -> None:
    """Broadside at a quarter length: E = 1/2 M v^2 C_M C_E, C_E = k^2/(k^2 + R^2), all of it stored at the turn."""
    ship = make_ship("box", BOX, "m_x = 0.0\nm_y = 0.8\nj_z = 0.8")
    quay = (
        '[dolphin]\nkind = "dolphin"\nshape = "cylinder"\ndiameter = 4.0\nposition = [50.0, 19.0]\n'
        "fender = {stiffness = 2e7, thickness = 1.9}\n"
    )
    w = world([ship], [{"position": [0.0, 0.0, 0.0], "nu": [0, 0.2, 0, 0, 0, 0]}], obstacles=quay, friction=0.0,
              degrees_of_freedom=3)  # fmt: skip
    most = 0.0
    for _ in range(400):
        w.step(0.02)
        most = max(most, w.model.outputs.fender.stored)
    M, k = 1.8 * 40e6, 0.25 * 200.0
    assert most == pytest.approx(0.5 * M * 0.2**2 * k**2 / (k**2 + 50.0**2), rel=0.02)
    assert w.model.outputs.collision_count == 0


def test_a_fender_that_bottoms_out_leaves_the_rest_to_the_wall(make_ship: Make, world: MakeWorld) -> None:
    w = head_on(world, make_ship("box", BOX), wall(stiffness=1e6, thickness=0.3)).run(5.0, 0.05)
    out = w.model.outputs
    assert out.collision_count == 1
    assert out.energy.dissipated == pytest.approx(0.5 * MASS * V**2, rel=0.1)
    assert out.fender.stored <= 0.5 * 1e6 * 0.31**2
    assert max(np.cumsum(w.work)) <= 0.0


def test_books_of_ships_and_fender_agree(make_ship: Make, world: MakeWorld) -> None:
    """What the ships lost is what contact and fender dissipated and what the fender still holds, at every step."""
    w = world(
        [make_ship("a")], [{"position": [-0.05, 3.0, 0.0], "attitude": (0, 0, 0.3), "nu": [2.0, 0.4, 0, 0, 0, 0.002]}],
        obstacles=wall(stiffness=2e7, damping=1e6, thickness=1.5),
    )  # fmt: skip
    for _ in range(400):
        w.step(0.02)
        energy, fender = w.model.outputs.energy.dissipated, w.model.outputs.fender
        assert -sum(w.work) == pytest.approx(energy + fender.stored + fender.dissipated, rel=1e-9, abs=1.0)
        assert fender.stored >= 0.0
    assert w.model.outputs.fender.dissipated > 1e6


@pytest.mark.slow
@pytest.mark.parametrize("algorithm", ["gauss-seidel", "jacobi"])
@pytest.mark.parametrize("step", [0.05, 0.5])
@pytest.mark.parametrize("stiffness", [1e6, pytest.param(1e9, marks=pytest.mark.slow), 1e13])
def test_no_step_delay_or_stiffness_gives_energy(
    make_ship: Make, world: MakeWorld, algorithm: str, step: float, stiffness: float
) -> None:
    w = world(
        [make_ship("a")], [{"position": [-0.05, 3.0, 0.0], "attitude": (0, 0, 0.2), "nu": [2.0, 0.2, 0, 0, 0, 0]}],
        obstacles=wall(stiffness=stiffness, damping=0.02 * stiffness, thickness=1.0), algorithm=algorithm,
        degrees_of_freedom=3,
    ).run(10.0, step)  # fmt: skip
    initial = 0.5 * np.array([2.0, 0.2, 0, 0, 0, 0]) @ w.M[0] @ np.array([2.0, 0.2, 0, 0, 0, 0])
    assert max(np.cumsum(w.work)) <= 1e-9 * initial
    assert -initial < sum(w.work) < 0.0


def test_fenders_of_a_ship_and_of_a_quay_are_in_series(make_ship: Make, world: MakeWorld) -> None:
    assert combine_in_series(Fender(2.0, 3.0, 1.0), Fender(2.0, 6.0, 0.5)) == Fender(1.0, 2.0, 1.5)
    assert combine_in_series(None, Fender(2.0, 0.0, 1.0)) == Fender(2.0, 0.0, 1.0)
    assert combine_in_series(None, None) is None
    ship = make_ship("box", BOX)
    one = head_on(world, ship, wall()).run(6.0, H)
    both = head_on(world, ship, wall(2 * K, 0.0, 1.0).replace("position = [111.0", "position = [112.0"))
    both.model.parameters.ships[0].fender = FenderParameters(2 * K, 0.0, 1.0)
    both.model.initialise()
    both.run(6.0, H)
    np.testing.assert_allclose(both.nu[0], one.nu[0], atol=1e-12)


@pytest.mark.parametrize("values", [[1e6, 0.0, 0.0], [0.0, 1e5, 1.0], [1e6, -1.0, 1.0], [float("nan"), 0.0, 1.0]])
def test_what_is_no_fender_is_refused(make_ship: Make, values: list[float]) -> None:
    model = ShipCollision(("one", "two"))
    for slot in model.parameters.ships:
        slot.ship = make_ship("a")
    model.parameters.ships[1].fender = FenderParameters(*values)
    with pytest.raises(InputError, match=r"two.fender: stiffness = .* is no fender: stiffness and thickness must be"):
        model.initialise()


@given(
    k=st.floats(1e3, 1e12), c=st.floats(0.0, 1e12), x=st.floats(1e-6, 5.0), rate=st.floats(-5.0, 5.0),
    W=st.floats(1e-10, 1e-3), stored=st.floats(0.0, 1e9), h=st.floats(1e-4, 1.0),
)  # fmt: skip
def test_a_substep_returns_no_more_than_was_stored(
    k: float, c: float, x: float, rate: float, W: float, stored: float, h: float
) -> None:
    compressed = compress_fender(Fender(k, c, 10.0), x, rate, W, stored, h)
    taken = compressed.P * (rate - 0.5 * W * compressed.P)
    scale = 1e-200 + stored + abs(compressed.P * rate) + 0.5 * W * compressed.P**2
    assert compressed.P >= 0.0
    assert 0.0 <= compressed.stored <= 0.5 * k * x * (x + h * abs(rate)) * (1 + 1e-9)
    assert compressed.dissipated >= -1e-9 * scale
    assert taken + stored == pytest.approx(compressed.stored + compressed.dissipated, rel=1e-9, abs=1e-9 * scale)


@given(
    a=st.floats(1e-9, 1e-3), b=st.floats(1e-9, 1e-3), share=st.floats(-0.99, 0.99),
    s=st.tuples(*[st.floats(-5, 5)] * 2),
    limit=st.floats(0.0, 1e9),
)  # fmt: skip
def test_rubbing_stays_in_the_cone_and_loses_energy(
    a: float, b: float, share: float, s: tuple[float, float], limit: float
) -> None:
    W, slip = np.array([[a, share * sqrt(a * b)], [share * sqrt(a * b), b]]), np.array(s)
    P = solve_friction(W, slip, 0.5, limit)
    assert np.hypot(*P) <= 0.5 * limit * (1 + 1e-12) + 1e-300
    assert P @ (slip + 0.5 * W @ P) <= 1e-9 * abs(P @ slip)
