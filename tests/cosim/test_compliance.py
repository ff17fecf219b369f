"""The FMI check behind `shipcollision validate`."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from shipcollision_fmu.cosim.compliance import problems
from shipcollision_fmu.cosim.fmu_files import ready_fmus
from shipcollision_fmu.errors import InputError


def test_our_fmus_have_no_problem() -> None:
    assert [problems(path) for path in ready_fmus().values()] == [[], []]


def test_a_problem_is_one_line(tmp_path: Path) -> None:
    path = tmp_path / "spoilt.fmu"
    with zipfile.ZipFile(ready_fmus()["ShipManoeuvring"]) as good, zipfile.ZipFile(path, "w") as bad:
        text = good.read("modelDescription.xml").decode()
        bad.writestr("modelDescription.xml", text.replace('unit="m/s"', 'unit="knots"'))
    found = problems(path)
    assert any("knots" in line for line in found)
    assert all(line == " ".join(line.split()) for line in found)


def test_what_is_no_fmu_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"nothing.fmu does not exist: build the FMUs with `shipcollision build`"):
        problems(tmp_path / "nothing.fmu")
    (tmp_path / "text.fmu").write_text("text")
    with pytest.raises(InputError, match=r"text.fmu is not a zip archive: give the path of a .fmu file"):
        problems(tmp_path / "text.fmu")
