"""compute_rows(): rows depend on their numbers alone, and are those of direct calls of impact()."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu import impact
from shipcollision_fmu.errors import StudyError
from shipcollision_fmu.study.definition.study import Study, parse_study, read_study
from shipcollision_fmu.study.rows.columns import COLLISIONS, ENCOUNTERS
from shipcollision_fmu.study.rows.compute import compute_rows

IMPACTS = """
[study]
name = "impacts"
level = "impact"
rows = 240
sampler = "{sampler}"
[own]
ships = {{ kvlcc2 = 1.0, kcs = 2.0 }}
[target]
ships = ["kcs", "guan2014_own"]
[encounter]
angle_deg = {{ distribution = "uniform", least = 20.0, most = 160.0 }}
at = {{ distribution = "triangular", least = -0.5, mode = 0.1, most = 0.5 }}
side = {{ distribution = "discrete", values = ["port", "starboard"] }}
own_speed = {{ distribution = "normal", mean = 6.0, sd = 2.0, least = 1.0, most = 12.0 }}
target_speed = {{ distribution = "lognormal", median = 3.0, sigma = 0.3, most = 12.0 }}
friction = 0.25
restitution = 0.1
own_yaw_rate = {{ distribution = "normal", mean = 0.0, sd = 0.002, least = -0.01, most = 0.01 }}
"""


def read_impacts(sampler: str = "latin-hypercube") -> Study:
    return parse_study(IMPACTS.format(sampler=sampler))


def as_bytes(tables: Any) -> list[list[Any]]:
    """Values by row; repr tells -0.0 from 0.0 and has all digits."""
    return [[repr(line) for line in table.to_pylist()] for table in tables]


@pytest.mark.parametrize("sampler", ["latin-hypercube", "random", "sobol"])
def test_rows_do_not_depend_on_batches(sampler: str) -> None:
    study = read_impacts(sampler)
    whole = as_bytes(compute_rows(study, 0, study.rows))
    assert len(whole[0]) == study.rows
    for size in (240, 64, 37):
        firsts = list(range(0, study.rows, size))[::-1]  # in another order, with other pairs open before
        parts = {first: as_bytes(compute_rows(study, first, min(size, study.rows - first))) for first in firsts}
        for table in (0, 1):
            assert [line for first in sorted(parts) for line in parts[first][table]] == whole[table]


def test_rows_are_those_of_impact() -> None:
    """A direct call with the numbers in the row gives the numbers in the row."""
    tables = compute_rows(read_impacts(), 0, 240)
    encounters, collisions = tables.encounters.to_pylist(), tables.collisions.to_pylist()
    done = [line for line in encounters if line["status"] == "done"]
    assert len(done) > 200
    assert {(line["own_ship"], line["target_ship"]) for line in done} == {
        (own, target) for own in ("kvlcc2", "kcs") for target in ("kcs", "guan2014_own")
    }
    for line, collision in list(zip(done, collisions, strict=True))[::7]:
        given = {
            name: line[name] for name in (
                "angle_deg", "at", "side", "own_speed", "target_speed", "friction", "restitution", "own_yaw_rate",
            )
        }  # fmt: skip
        row = impact(line["own_ship"], line["target_ship"], **given)
        assert row["status"] == 0
        assert line["row"] == collision["row"]
        for name in ("energy", "energy_normal", "energy_tangential", "closing_speed", "residual"):
            assert line[name] == row[name]
        for role, letter in (("own", "a"), ("target", "b")):
            assert [line[f"{role}_{axis}"] for axis in "xyz"] == row[f"{role}_point"].tolist()
            assert [collision[f"{letter}_{axis}"] for axis in "xyz"] == row[f"{role}_point"].tolist()
            for name, i in (("surge", 0), ("sway", 1), ("yaw_rate", 5)):
                assert line[f"{role}_{name}_after"] == row[f"{role}_after"][i]
                assert collision[f"{letter}_{name}_before"] == row[f"{role}_before"][i]
        assert line["impulse"] == np.hypot(*row["impulse"][:2])
        assert line["collision_angle_deg"] == pytest.approx(line["angle_deg"], abs=1e-9)


def test_a_refused_case_is_a_row_with_its_reason() -> None:
    text = IMPACTS.format(sampler="random").replace("least = 1.0, most = 12.0", "least = -12.0, most = 12.0")
    tables = compute_rows(parse_study(text.replace("mean = 6.0", "mean = 0.0")), 0, 100)
    lines = tables.encounters.to_pylist()
    refused = [line for line in lines if line["status"] == "refused"]
    assert len(lines) == 100
    assert 10 < len(refused) < 90
    assert {line["row"] for line in refused}.isdisjoint(tables.collisions.column("row").to_pylist())
    for line in refused:
        assert "change the angle, the speeds, the side or the place" in line["reason"]
        assert line["energy"] is None
        assert line["own_speed"] is not None


def test_columns_have_units_and_meanings() -> None:
    tables = compute_rows(read_study("quick"), 1000, 3)
    for table, columns in zip(tables, (ENCOUNTERS, COLLISIONS), strict=True):
        assert table.column_names == [column.name for column in columns]
        for column in columns:
            metadata = table.schema.field(column.name).metadata
            assert metadata == {b"unit": column.unit.encode(), b"meaning": column.meaning.encode()}
            assert column.meaning


def test_a_study_travels_to_a_worker() -> None:
    study = read_impacts()
    there = pickle.loads(pickle.dumps(study))
    assert there.fingerprint == study.fingerprint
    assert as_bytes(compute_rows(there, 5, 20)) == as_bytes(compute_rows(study, 5, 20))


@pytest.mark.parametrize(("first", "count"), [(-1, 2), (0, 0), (239, 2)])
def test_rows_beyond_the_study_are_refused(first: int, count: int) -> None:
    with pytest.raises(
        StudyError, match=r"first = .* are no rows of the study: give whole numbers, it has rows 0 to 239"
    ):
        compute_rows(read_impacts(), first, count)
