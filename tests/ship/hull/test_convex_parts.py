"""A solid that is not convex is cut in a process of its own, once, and within bounds."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.errors import HostError, ShipError
from shipcollision_fmu.ship.hull import convex_parts
from shipcollision_fmu.ship.hull.convex_parts import Cut, cut_into_convex_parts
from tests.ship.hull.mesh_files import BAR, BOX, together

Cutter = Callable[..., Cut]


@pytest.fixture
def cut() -> Cutter:
    def go(**options: Any) -> Cut:
        return cut_into_convex_parts("bar.obj", *BAR, **{"max_parts": 4, **options})

    return go


def test_the_bar_is_two_parts_that_add_nothing(cut: Cutter) -> None:
    """Up to a thousandth: CoACD places its planes to some 1e-5 of the size."""
    found = cut()
    assert len(found.parts) == 2
    assert found.volume_error == pytest.approx(0.0, abs=1e-3)
    assert found.bulge < 1e-3


def test_the_library_that_cuts_stays_out_of_this_process() -> None:
    code = (
        "import sys; from tests.ship.hull.mesh_files import BAR; "
        "from shipcollision_fmu.ship.hull.convex_parts import cut_into_convex_parts; "
        "print(len(cut_into_convex_parts('bar.obj', *BAR, 4).parts), 'coacd' in sys.modules)"
    )
    root = Path(__file__).parents[3]
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=root, capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.split() == ["2", "False"]


@pytest.mark.slow
def test_progress_is_said(cut: Cutter, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture) -> None:
    monkeypatch.setattr(convex_parts, "BULGE_GOAL", -1.0)
    cut()
    first, second = (record.getMessage() for record in caplog.records)
    assert first == "bar.obj is cut into convex parts, once for this file: 20 faces, at most 180 s"
    assert re.match(
        r"bar.obj: its 2 parts bulge by \S+ m, more than -3 m: it is cut more finely, for at most 1", second
    )


def test_convex_pieces_are_parts_as_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two boxes and an angle bar, apart: the bar alone is cut. With one part for all, all is cut."""
    boxes = [(BOX.vertices * 0.01 + [0.0, 10.0 * k, 0.0], BOX.triangles) for k in (1, 2)]
    solid = together(boxes[0], BAR, boxes[1])
    given = []

    def note(name: str, rest: Any, max_parts: int, *_: Any) -> Cut:
        given.append((len(rest[1]), max_parts))
        return Cut((rest,), 0.02)

    monkeypatch.setattr(convex_parts, "_cut_solid", note)
    found = cut_into_convex_parts("bar.obj", *solid, 4)
    assert [len(faces) for _, faces in found.parts] == [12, 12, 20]
    assert found.volume_error == pytest.approx(0.02 * 6.0 / (6.0 + 2 * 0.01**3 * 200 * 30 * 20))
    cut_into_convex_parts("bar.obj", *solid, 2)
    assert given == [(20, 2), (44, 2)]
    assert len(cut_into_convex_parts("bar.obj", *together(*boxes), 4).parts) == 2
    assert len(given) == 2


@pytest.mark.parametrize(("faces", "times"), [(20, 2), (19, 1)])
def test_a_solid_of_many_faces_is_cut_once(monkeypatch: pytest.MonkeyPatch, faces: int, times: int) -> None:
    """The bar has 20 faces."""
    runs = []

    def run(program: str, arguments: tuple[float, ...], *_: Any) -> dict[str, Any]:
        runs.append(arguments[0])
        return {"count": np.array(1), "v0": BAR[0], "t0": BAR[1]}

    monkeypatch.setattr(convex_parts, "FINE_FACES", faces)
    monkeypatch.setattr(convex_parts, "BULGE_GOAL", -1.0)
    monkeypatch.setattr(convex_parts, "run_program", run)
    cut_into_convex_parts("bar.obj", *BAR, 4)
    assert runs == list(convex_parts.CONCAVITIES[:times])


@pytest.mark.parametrize(("parts", "remedy"), [(4, "raise max_parts = 4, or leave out what"), (3, "leave out what")])
def test_more_parts_are_offered_where_all_are_used(
    cut: Cutter, monkeypatch: pytest.MonkeyPatch, parts: int, remedy: str
) -> None:
    monkeypatch.setattr(convex_parts, "_cut_solid", lambda *_: Cut((BAR,) * parts, 0.2))
    with pytest.raises(ShipError, match=rf"^bar.obj: its {parts} convex parts hold 20.0% more .* at most 5%: {remedy}"):
        cut()


def test_a_missing_package_is_named(cut: Cutter, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "coacd", None)
    with pytest.raises(HostError, match=r"coacd cannot be imported .*pip install 'shipcollision-fmu\[mesh\]'"):
        cut()


def test_cutting_ends_in_time(cut: Cutter, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(convex_parts, "LONGEST_CUTTING", 0.001)
    with pytest.raises(
        ShipError,
        match=r"^bar.obj: is not cut into convex parts within 0.001 s: simplify the mesh, leave out what does",
    ):
        cut()


def test_a_failure_of_the_library_is_one_line(cut: Cutter, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(convex_parts, "SEED", "no number")
    with pytest.raises(HostError, match=r"^bar.obj: cannot be cut into convex parts: coacd failed \(ValueError: .*\)$"):
        cut()


@pytest.mark.slow
@pytest.mark.parametrize("program", ["", "/opt/simulator/bridge"])
def test_a_simulator_that_embeds_python_is_not_started_again(
    cut: Cutter, monkeypatch: pytest.MonkeyPatch, program: str
) -> None:
    monkeypatch.setattr(sys, "executable", program)
    assert len(cut().parts) == 2


def test_where_no_python_program_is_found_the_remedy_is_said(
    cut: Cutter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("prefix", "exec_prefix", "base_exec_prefix"):
        monkeypatch.setattr(sys, name, str(tmp_path))
    monkeypatch.setattr(sys, "executable", "")
    with pytest.raises(HostError, match=r"^no Python program is found below .*: load the ship once with `shipcoll"):
        cut()
