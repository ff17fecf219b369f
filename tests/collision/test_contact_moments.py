"""Impulses and places that are shown of contact points make up the ledger: its impulse and its moment."""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.collision.contact_points import ContactPoint, fill_contacts, fit_contact_points, merge_impulses
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import Impulse, make_contact
from shipcollision_fmu.collision.interface import ContactOutput
from shipcollision_fmu.ship.frames import rotation
from tests.collision.conftest import BOX, World
from tests.ship_files import ship_toml

MakeWorld = Callable[..., World]

AT_REST = {"position": [0.0, 0.0, 0.0], "nu": [0.0] * 6}
ON_THE_BEAM = [{"position": [-116.0, 10.0, 0.0], "attitude": (0.02, 0.01, 0.0), "nu": [4.0, 0.1, 0, 0, 0, 0.01]},
               {"position": [0.0, 0.0, 0.0], "attitude": (0, 0, pi / 2), "nu": [1.0, 0, 0, 0, 0, 0]}]  # fmt: skip
FLUSH = [{"position": [20.0, -31.0, 0.0], "nu": [2.0, 1.5, 0, 0, 0, 0.002]}, AT_REST]
GLANCING = [{"position": [-130.0, -31.0, 0.0], "attitude": (0, 0, 0.1), "nu": [8.0, 0, 0, 0, 0, 0.02]}, AT_REST]


def shown_wrench(w: World, ship: int) -> np.ndarray:
    """Impulse and its moment about the origin of n (6,) that the contact points of the step gave to a ship."""
    total, out = np.zeros(6), w.model.outputs
    for slot in out.contacts[: out.contact_count]:
        sign = {slot.ship_b: 1.0, slot.ship_a: -1.0}.get(ship + 1, 0.0)
        total[:3] += sign * np.array(slot.impulse)
        total[3:] += sign * (np.cross(slot.point, slot.impulse) + slot.couple)
    return total


def booked_wrench(w: World, ship: int, issued_before: np.ndarray, x: np.ndarray, R: np.ndarray) -> np.ndarray:
    """The same of the ledger; x, R: pose received, at which a sequential master applies the impulse."""
    J = np.array(w.model.outputs.ships[ship].impulse) - issued_before
    return np.concatenate([R @ J[:3], R @ J[3:] + np.cross(x, R @ J[:3])])


@pytest.mark.parametrize(
    ("start", "H", "response"),
    [(ON_THE_BEAM, 0.1, "pgs"), (FLUSH, 0.5, "pgs"), (FLUSH, 0.2, "closed_form"), (GLANCING, 0.25, "pgs")],
)
def test_moments_of_the_points_are_those_of_the_ledger(
    make_ship: Callable[..., str], world: MakeWorld, start: list[dict], H: float, response: str
) -> None:
    hulls = [make_ship("a"), make_ship("b", mass=25e6)] if start is ON_THE_BEAM else [make_ship("box", BOX)] * 2
    w, touched = world(hulls, start, response=response, restitution=0.3), 0
    for _ in range(round(2.0 / H)):
        before = [np.array(ship.impulse) for ship in w.model.outputs.ships]
        w.send()
        poses = [(np.array(s.position), rotation(s.attitude)) for s in w.model.inputs.ships]
        w.step(H)
        for i in range(2):
            booked = booked_wrench(w, i, before[i], *poses[i])
            size = np.abs(booked[:3]).max()
            touched += size > 0.0
            np.testing.assert_allclose(shown_wrench(w, i), booked, rtol=0, atol=1e-11 * size * 300.0 + 1e-2)
    assert touched >= 2


def test_line_contact_of_a_boat_is_shown_where_it_presses(
    tmp_path: Path, make_ship: Callable[..., str], world: MakeWorld
) -> None:
    """A box of 4 m drives its bow square into a ship's side: four corners touch, 1.2 m apart in height and 1.6 m in
    breadth. The centre of the shown impulses lies on the line of action of the ledger."""
    boat = tmp_path / "boat.toml"
    particulars = {"L_pp": 4.0, "B": 1.6, "T": 0.4, "mass": 1800.0, "r_bg": [0.0, 0.0, 0.0]}
    boat.write_text(ship_toml(particulars=particulars, hull={"depth": 1.2}))
    start = [{"position": [-17.02, 3.0, 0.0], "nu": [2.0, 0, 0, 0, 0, 0]},
             {"position": [0.0, 0.0, 0.0], "attitude": (0, 0, pi / 2), "nu": [0.0] * 6}]  # fmt: skip
    w = world([str(boat), make_ship("box", BOX)], start, friction=0.0)
    w.step(0.05)
    out = w.model.outputs
    slots = out.contacts[: out.contact_count]
    assert len(slots) == 4
    heights = {round(slot.r_a[2], 2) for slot in slots}
    assert len(heights) == 2
    J = out.ships[0].impulse
    P_n = np.array([slot.impulse_normal for slot in slots])
    centre = P_n @ np.array([slot.r_a for slot in slots]) / P_n.sum()
    assert centre[2] == pytest.approx(J[4] / J[0], abs=1e-6)
    assert centre[1] == pytest.approx(-J[5] / J[0], abs=1e-6)


def random_impulses(rng: np.random.Generator, states: list[BodyState], contacts: int) -> list[Impulse]:
    impulses = []
    for _ in range(contacts):
        normal = rng.normal(size=3) * [1, 1, 0.2]
        normal /= np.linalg.norm(normal)
        contact = make_contact(0, 1, states, rng.uniform(-3, 3, 3), normal, -0.01)
        N = rng.uniform(0, 1e6) * (rng.random() < 0.8)
        impulses.append(Impulse(contact, N * normal + 0.3 * N * np.cross(normal, rng.normal(size=3))))
    return impulses


@pytest.mark.parametrize("contacts", [1, 2, 3, 7, 20])
@pytest.mark.parametrize("substeps", [1, 2, 10])
def test_any_number_of_contacts_and_substeps(contacts: int, substeps: int) -> None:
    """Sums of impulse, moment and energy are kept, and no place leaves the box around what was merged."""
    rng = np.random.default_rng(100 * contacts + substeps)
    states = [BodyState.at(rng.normal(size=3), 0.1 * rng.normal(size=3), np.zeros(6), np.eye(6)) for _ in range(2)]
    points: list[ContactPoint] = []
    given: list[Impulse] = []
    for _ in range(substeps):
        for state in states:
            state.x = state.x + 0.1 * rng.normal(size=3)  # predicted poses move on, those of application stay
        impulses = random_impulses(rng, states, contacts)
        points = merge_impulses(points, impulses, [(1.0, 0.5)] * contacts, {(0, 1): (1, 1)})
        assert len(points) >= contacts
        given += impulses
    fitted = fit_contact_points(points, 8)
    slots = [ContactOutput() for _ in range(8)]
    fill_contacts(fitted, slots)
    total = np.concatenate([sum(i.P for i in given), sum(np.cross(i.contact.at, i.P) for i in given)])
    shown = sum(np.concatenate([s.impulse, np.cross(s.point, s.impulse) + s.couple]) for s in slots)
    np.testing.assert_allclose(shown, total, rtol=0, atol=1e-9 * max(1.0, np.abs(total).max()))
    assert sum(s.energy for s in slots) == pytest.approx(1.5 * len(given))
    for slot, point in zip(slots, fitted, strict=False):
        for shown_at, places in ((slot.point, "point"), (slot.r_a, "r_a"), (slot.r_b, "r_b")):
            corners = np.array([getattr(part.contact, places) for part in point.parts])
            assert (corners.min(axis=0) - 1e-9 <= shown_at).all()
            assert (shown_at <= corners.max(axis=0) + 1e-9).all()


def test_place_of_parallel_impulses_carries_their_moment() -> None:
    """Impulses along one normal have a centre: about it there is no couple."""
    states = [BodyState.at(np.zeros(3), np.zeros(3), np.zeros(6), np.eye(6)) for _ in range(2)]
    points: list[ContactPoint] = []
    for place, N in ((0.0, 3e6), (0.5, 1e6), (0.9, 4e6)):
        contact = make_contact(0, 1, states, np.array([place, 0.3 * place, -place]), np.array([0.0, 1.0, 0.0]), 0.0)
        points = merge_impulses(points, [Impulse(contact, N * contact.normal)], [(0.0, 0.0)], {(0, 1): (1, 1)})
    slot = ContactOutput()
    fill_contacts(points, [slot])
    assert slot.point[0] == pytest.approx((0.5 * 1e6 + 0.9 * 4e6) / 8e6)
    np.testing.assert_allclose(slot.couple, 0.0, atol=1e-8)
