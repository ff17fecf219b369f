"""Which adapter gives closest points, and what is said where one is missing."""

from __future__ import annotations

import sys
from collections.abc import Callable

import pytest

from shipcollision_fmu.collision.geometry import adapter
from shipcollision_fmu.collision.geometry.adapter import CHOICE, open_narrow_phase
from shipcollision_fmu.collision.geometry.bullet import BulletAdapter
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.errors import HostError, InputError


class Library:
    """In the place of the adapter of our library."""

    def __init__(self, hulls: object) -> None:
        self.close = list  # nothing to close


def no_library() -> None:
    """In the place of the library, on a machine without compiler."""
    raise HostError("there is no C++ compiler for native code: install g++")


@pytest.fixture(autouse=True)
def _library(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adapter, "PlacedHulls", Library)
    monkeypatch.setattr(adapter, "open_library", list)
    monkeypatch.delenv(CHOICE, raising=False)


@pytest.fixture
def without_pybullet(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if it were not installed."""
    monkeypatch.setitem(sys.modules, "pybullet", None)


@pytest.mark.needs("pybullet")
def test_pybullet_is_taken_where_it_is() -> None:
    assert isinstance(open_narrow_phase([]), BulletAdapter)


@pytest.mark.usefixtures("without_pybullet")
def test_elsewhere_the_library_is_taken() -> None:
    assert isinstance(open_narrow_phase([]), Library)


@pytest.mark.needs("pybullet")
def test_either_can_be_forced(monkeypatch: pytest.MonkeyPatch) -> None:
    assert isinstance(open_narrow_phase([], "library"), Library)
    monkeypatch.setenv(CHOICE, "library")
    assert isinstance(open_narrow_phase([]), Library)
    assert isinstance(open_narrow_phase([], "pybullet"), BulletAdapter)


def test_another_choice_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(CHOICE, "ode")
    with pytest.raises(InputError, match=r"^SHIPCOLLISION_NARROW_PHASE = 'ode' must be 'pybullet' or 'library'; leave"):
        open_narrow_phase([])


@pytest.mark.usefixtures("without_pybullet")
def test_without_both_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adapter, "open_library", no_library)
    with pytest.raises(HostError) as refused:
        open_narrow_phase([])
    assert str(refused.value) == (
        "contacts cannot be detected: pybullet, with wheels for CPython 3.10 and 3.11 on Linux (x86-64), is not "
        "installed, and this package's own library is missing: there is no C++ compiler for native code: install g++"
    )


@pytest.mark.usefixtures("without_pybullet")
def test_bullets_own_dynamics_are_refused_without_pybullet(make_ship: Callable[..., str]) -> None:
    model = ShipCollision(("own", "target"))
    for slot in model.parameters.ships:
        slot.ship = make_ship("bare", added_mass="m_x = 0.0\nm_y = 0.0\nm_z = 0.0\nj_x = 0.0\nj_y = 0.0\nj_z = 0.0")
    model.parameters.response = "bullet"
    with pytest.raises(HostError) as refused:
        model.initialise()
    said = str(refused.value)
    assert said.startswith("response 'bullet' is PyBullet's own dynamics, and pybullet cannot be imported (")
    assert "CPython 3.10 and 3.11 on Linux (x86-64)" in said
    assert said.endswith("; or take response 'pgs' or 'closed_form', as the shipped scenario guan2014_added_mass does")
    assert "\n" not in said
    model.parameters.response = "pgs"  # the remedy
    model.initialise()
    model.close()
