"""Ctrl-C during a run: raised between two steps, whatever Python code it hit."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.cosim.interrupt import delay_interrupts
from tests.conftest import Write


@pytest.fixture(autouse=True)
def _interrupts_are_raised() -> Iterator[None]:
    """As in a terminal. A shell that starts the tests in the background lets them ignore Ctrl-C."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("in_process", [True, False])
def test_an_interrupt_inside_a_model_ends_the_run_as_an_interrupt(
    scenario_file: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, in_process: bool
) -> None:
    original = ShipCollision.step

    def hit(model: ShipCollision, t: float, h: float) -> None:
        if t > 0.2:
            signal.raise_signal(signal.SIGINT)
        original(model, t, h)

    monkeypatch.setattr(ShipCollision, "step", hit)
    seen: list[int] = []
    with pytest.raises(KeyboardInterrupt):
        simulate(
            load_scenario(scenario_file()), in_process=in_process, out=tmp_path / "run",
            progress=lambda done, _: seen.append(done),
        )  # fmt: skip
    assert seen[-1] == 6  # the step from 0.25 s, finished
    assert not (tmp_path / "run").exists()


def test_the_handler_from_before_is_put_back() -> None:
    before = signal.getsignal(signal.SIGINT)
    with delay_interrupts() as check:
        check()
        assert signal.getsignal(signal.SIGINT) is not before
    assert signal.getsignal(signal.SIGINT) is before


def test_where_interrupts_are_ignored_they_stay_ignored() -> None:
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with delay_interrupts() as check:
            signal.raise_signal(signal.SIGINT)
            check()
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_order_to_end_is_delayed_and_given_to_the_handler_from_before() -> None:
    given: list[int] = []
    before = signal.signal(signal.SIGTERM, lambda number, _: given.append(number))
    try:
        with delay_interrupts() as check:
            check()
            signal.raise_signal(signal.SIGTERM)
            assert given == []
            with pytest.raises(SystemExit) as ended:
                check()
        assert (given, ended.value.code) == ([signal.SIGTERM], 143)
    finally:
        signal.signal(signal.SIGTERM, before)
