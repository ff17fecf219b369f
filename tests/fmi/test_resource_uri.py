"""The URI of an FMU's resources is one that its wrapper can read."""

from __future__ import annotations

from pathlib import Path

import pytest

from shipcollision_fmu.errors import HostError
from shipcollision_fmu.fmi.builder.resource_uri import locate_resources


def test_a_foreign_fmu_gets_what_the_standard_demands() -> None:
    assert locate_resources(Path("/tmp/a (1)")) == "file:///tmp/a%20%281%29/resources"


@pytest.mark.parametrize("name", ["a b", "a(1)", "a+b,c#d?", "über", "50%"])
def test_the_wrapper_of_pythonfmu_gets_what_it_decodes(tmp_path: Path, name: str) -> None:
    (tmp_path / name / "resources").mkdir(parents=True)
    (tmp_path / name / "resources" / "slavemodule.txt").touch()
    uri = locate_resources(tmp_path / name)
    assert uri.removeprefix("file://").replace("%20", " ") == str(tmp_path / name / "resources")
    assert " " not in uri


def test_a_folder_that_it_cannot_read_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a%20b" / "resources").mkdir(parents=True)
    (tmp_path / "a%20b" / "resources" / "slavemodule.txt").touch()
    with pytest.raises(HostError, match=r"a%20b: an FMU cannot be loaded .* set the environment variable TMPDIR to an"):
        locate_resources(tmp_path / "a%20b")
