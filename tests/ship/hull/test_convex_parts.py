"""A solid that is not convex is cut in a process of its own, once, and within bounds."""

from __future__ import annotations

import logging
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.errors import HostError, ShipError
from shipcollision_fmu.ship.hull import convex_parts
from shipcollision_fmu.ship.hull.convex_parts import Cut, cut_into_convex_parts

L_SHAPE = np.array([(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (0, 3)], dtype=float)
"""An angle bar in section: two convex parts hold it exactly."""


def bar() -> tuple[np.ndarray, np.ndarray]:
    """The angle bar, one unit long, as a closed mesh."""
    vertices = np.vstack([np.column_stack([L_SHAPE, np.full(6, z)]) for z in (0.0, 1.0)])
    cap = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)]
    sides = [f for i in range(6) for f in ((i, (i + 1) % 6, 6 + (i + 1) % 6), (i, 6 + (i + 1) % 6, 6 + i))]
    top = [(a + 6, b + 6, c + 6) for a, b, c in cap]
    return vertices, np.array([(c, b, a) for a, b, c in cap] + sides + top, dtype=np.int64)


BAR = bar()
Cutter = Callable[..., Cut]


@pytest.fixture
def cut(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Cutter]:
    """Cuts the bar, with a user's cache of its own, and nothing in memory."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))

    def go(**options: Any) -> Cut:
        convex_parts._cut_once.cache_clear()
        return cut_into_convex_parts("bar.obj", *BAR, **{"max_parts": 4, **options})

    yield go
    convex_parts._cut_once.cache_clear()


def refuse(*_: Any, **__: Any) -> Any:
    raise AssertionError("cut again")


def same(a: Cut, b: Cut) -> bool:
    parts = zip(a.parts, b.parts, strict=True)
    return (a.volume_error, a.bulge) == (b.volume_error, b.bulge) and all(
        np.array_equal(v, w) and np.array_equal(s, t) for (v, s), (w, t) in parts
    )


def test_the_bar_is_two_parts_that_add_nothing(cut: Cutter) -> None:
    """Up to a thousandth: CoACD places its planes to some 1e-5 of the size."""
    found = cut()
    assert len(found.parts) == 2
    assert found.volume_error == pytest.approx(0.0, abs=1e-3)
    assert found.bulge < 1e-3


def test_the_library_that_cuts_stays_out_of_this_process() -> None:
    code = (
        "import sys; from tests.ship.hull.test_convex_parts import BAR; "
        "from shipcollision_fmu.ship.hull.convex_parts import cut_into_convex_parts; "
        "print(len(cut_into_convex_parts('bar.obj', *BAR, 4).parts), 'coacd' in sys.modules)"
    )
    root = Path(__file__).parents[3]
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=root, capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.split() == ["2", "False"]


def test_it_is_said_once_and_kept(cut: Cutter, monkeypatch: pytest.MonkeyPatch, caplog: Any) -> None:
    first = cut()
    assert [record.getMessage() for record in caplog.records] == [
        "bar.obj: is cut into convex parts, once for this file: 20 faces, at most 300 s"
    ]
    monkeypatch.setattr(convex_parts, "_run_coacd", refuse)
    assert same(cut(), first)
    with pytest.raises(AssertionError, match="cut again"):
        cut(max_parts=3)
    assert len(caplog.records) == 2  # of the second solid


@pytest.mark.slow
@pytest.mark.parametrize("content", [b"", b"junk", b"PK\x03\x04junk"])
def test_a_kept_file_that_is_broken_is_made_again(cut: Cutter, tmp_path: Path, content: bytes) -> None:
    first = cut()
    (kept,) = (tmp_path / "cache").rglob("*.npz")
    whole = kept.read_bytes()
    kept.write_bytes(content or whole[: len(whole) // 2])
    assert same(cut(), first)
    assert kept.read_bytes() == whole


def test_without_a_place_for_the_parts_they_are_cut_all_the_same(
    cut: Cutter, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "cache").write_text("a file, where a folder should be")
    assert len(cut().parts) == 2
    said = caplog.records[-1]
    assert said.levelno == logging.WARNING
    assert said.getMessage().startswith("bar.obj: cannot write to ")
    assert said.getMessage().endswith("its parts are cut again in every process until it is writable")


def test_cutting_ends_in_time(cut: Cutter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(convex_parts, "LONGEST_CUTTING", 0.001)
    with pytest.raises(
        ShipError,
        match=r"^bar.obj: is not cut into convex parts within 0.001 s: give parts that pass through each other as one",
    ):
        cut()
    assert not list(tmp_path.rglob("*.npz"))


def test_a_failure_of_the_library_is_one_line(cut: Cutter, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(convex_parts, "SEED", "no number")
    with pytest.raises(HostError, match=r"^bar.obj: cannot be cut into convex parts: coacd failed \(ValueError: .*\)$"):
        cut()


@pytest.mark.parametrize("program", ["", "/opt/simulator/bridge"])
def test_a_simulator_that_embeds_python_is_not_started_again(
    cut: Cutter, monkeypatch: pytest.MonkeyPatch, program: str
) -> None:
    monkeypatch.setattr(sys, "executable", program)
    assert len(cut().parts) == 2


def test_where_no_python_program_is_found_the_remedy_is_said(
    cut: Cutter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cut()
    for name in ("prefix", "exec_prefix", "base_exec_prefix"):
        monkeypatch.setattr(sys, name, str(tmp_path))
    monkeypatch.setattr(sys, "executable", "")
    cut()  # kept: the remedy of the message
    with pytest.raises(HostError, match=r"^no Python program is found below .*: load the ship once with `shipcoll"):
        cut(max_parts=3)
