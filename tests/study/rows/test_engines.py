"""The same rows from the native library and from the Python models, at each level of detail."""

from __future__ import annotations

from typing import Any

import pytest

from shipcollision_fmu.errors import HostError, StudyError
from shipcollision_fmu.study.definition.study import Study, parse_study
from shipcollision_fmu.study.rows import compute
from shipcollision_fmu.study.rows.compute import choose_engine, compute_rows
from shipcollision_fmu.study.rows.tables import RowTables

TEXT = """
[study]
name = "twins"
level = "{level}"
rows = 1000
[own]
ships = ["kcs", "guan2014_own"]
[[own.sampled]]
kind = "tanker"
weight = 1.0
L_pp = 200.0
L_over_B = 6.0
B_over_T = 2.6
C_b = 0.8
[target]
ships = ["kvlcc2"]
[run]
after = 20.0
separation = {separation}
[encounter]
angle_deg = {{distribution = "uniform", least = 0.0, most = 150.0}}
at = {{distribution = "uniform", least = -0.4, most = 0.4}}
friction = {{distribution = "uniform", least = 0.1, most = 0.6}}
restitution = 0.1
side = {{distribution = "discrete", values = ["port", "starboard"]}}
{more}
"""
SLOW = 'own_speed = {distribution = "uniform", least = 0.0, most = 8.0}'
"""Own is often too slow to reach the target, and refused."""


def read_twins(level: str, more: str = "", separation: float = 100.0) -> Study:
    text = TEXT.format(level=level, more=more, separation=separation)
    return parse_study(text if level != "sailed" else text.replace("guan2014_own", "kvlcc2"))


def compare(native: RowTables, python: RowTables, relative: float) -> None:
    """Numbers to a share of the largest in their column, all else alike but for the engine."""
    for a, b in zip(native, python, strict=True):
        assert a.num_rows == b.num_rows > 0
        for name in a.column_names:
            x, y = a.column(name).to_pylist(), b.column(name).to_pylist()
            if name == "engine":
                assert (set(x), set(y)) == ({"native"}, {"python"})
            elif any(isinstance(value, float) for value in x):
                largest = max(abs(value) for value in x if value is not None)
                assert [value is None for value in x] == [value is None for value in y]
                for p, q in zip(x, y, strict=True):
                    assert p is None or abs(p - q) <= relative * largest + 1e-12, name
            else:
                assert x == y, name


@pytest.mark.needs("pybullet")
def test_impacts() -> None:
    study = read_twins("impact", "own_yaw_rate = 0.001\nown_sway = 0.2\nheading_deg = 30.0\n" + SLOW)
    native, python = compute_rows(study, 100, 40, "native"), compute_rows(study, 100, 40, "python")
    assert {"done", "refused"} == set(native.encounters.column("status").to_pylist())
    compare(native, python, 1e-7)


@pytest.mark.needs("pybullet")
def test_a_drift_beyond_the_limit_is_refused_alike() -> None:
    """Sway and drift are each within their limits, their sum is not."""
    study = read_twins("impact", 'kind = "drifting-target"\ntarget_sway = 30.0\ndrift_speed = 40.0')
    for engine in ("native", "python"):
        lines = compute_rows(study, 0, 3, engine).encounters.to_pylist()
        assert {line["reason"] for line in lines} == {"target_sway = 70 must be -50 to 50: give metres per second"}


@pytest.mark.one_in(2)
@pytest.mark.needs("pybullet")
@pytest.mark.parametrize("separation", [2.0, 100.0])
def test_coasting_encounters(separation: float) -> None:
    study = read_twins("encounter", "target_sway = 0.3\n" + SLOW, separation)
    native, python = compute_rows(study, 0, 6, "native"), compute_rows(study, 0, 6, "python")
    assert {"done", "refused"} == set(native.encounters.column("status").to_pylist())
    compare(native, python, 1e-5)


@pytest.mark.slow
@pytest.mark.needs("pybullet")
def test_sailed_encounters() -> None:
    study = read_twins("sailed", 'kind = "t-bone"\nown_speed = 3.0')
    native, python = compute_rows(study, 12, 2, "native"), compute_rows(study, 12, 2, "python")
    compare(native, python, 1e-4)


def test_python_takes_the_place_of_a_missing_library(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse() -> Any:
        raise HostError("no compiler")

    compute._find_engine.cache_clear()
    monkeypatch.setattr(compute, "load_library", refuse)
    assert choose_engine("auto") == "python"
    with pytest.raises(HostError, match="no compiler"):
        choose_engine("native")
    compute._find_engine.cache_clear()


def test_an_unknown_engine_is_refused() -> None:
    with pytest.raises(StudyError, match="engine = 'fortran' is unknown: take one of auto, native, python"):
        choose_engine("fortran")
