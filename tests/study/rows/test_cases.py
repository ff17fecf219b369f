"""draw_cases(): grids, tables of data, fleets, pools, loading, and what a kind of encounter adds."""

from __future__ import annotations

import pickle
from math import cos, radians, sin
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from shipcollision_fmu import load_ship
from shipcollision_fmu.study.definition.partial_loading import find_block_coefficient
from shipcollision_fmu.study.definition.study import Study, parse_study
from shipcollision_fmu.study.rows.cases import draw_cases
from shipcollision_fmu.study.rows.compute import compute_rows
from shipcollision_fmu.study.rows.fleet_ships import find_ship

HEAD = """
[study]
name = "s"
level = "impact"
rows = {rows}
sampler = "{sampler}"
[own]
ships = ["kcs"]
"""


def read(more: str, rows: int = 1200, sampler: str = "latin-hypercube", folder: Path | str = ".") -> Study:
    return parse_study(HEAD.format(rows=rows, sampler=sampler) + more, "s.toml", folder)


def test_a_grid_combines_all_its_values_in_order() -> None:
    """The last axis varies fastest; the whole is repeated, and other variables go on being drawn."""
    study = read(
        '[grid]\nangle_deg = {least = 30, most = 90, count = 3}\nside = ["port", "starboard"]\n'
        '[encounter]\nown_speed = {distribution = "uniform", least = 2.0, most = 8.0}'
    )
    cases = draw_cases(study, 0, 12)
    assert cases.numbers["angle_deg"].tolist() == [30.0, 30.0, 60.0, 60.0, 90.0, 90.0] * 2
    assert cases.side.tolist() == ["port", "starboard"] * 6
    assert len(set(cases.numbers["own_speed"].tolist())) == 12
    assert parse_study(study.text.replace("rows = 1200", ""), "s.toml").rows == 6


def write_data(folder: Path, n: int = 500) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Two correlated columns and a weight, as CSV and as Parquet."""
    rng = np.random.default_rng(3)
    v = rng.uniform(2.0, 9.0, n)
    angle, weight = 10.0 * v + rng.normal(0.0, 8.0, n) + 40.0, rng.uniform(0.0, 1.0, n)
    ship = np.where(v > 5.0, "kcs", "kvlcc2")
    lines = ["v,angle,weight,ship", *(f"{a!r},{b!r},{c!r},{d}" for a, b, c, d in zip(
        v.tolist(), angle.tolist(), weight.tolist(), ship.tolist(), strict=True))]  # fmt: skip
    (folder / "data.csv").write_text("\n".join(lines))
    pq.write_table(pa.table({"v": v, "angle": angle, "weight": weight, "ship": ship}), folder / "data.parquet")
    return v, angle, weight


FROM_TABLE = """
[target]
ships = {{table = "traffic", column = "ship"}}
[encounter]
own_speed = {{table = "traffic", column = "v"}}
angle_deg = {{distribution = "table", table = "traffic", column = "angle"}}
[tables.traffic]
file = "{file}"
weight = "weight"
"""


@pytest.mark.parametrize("sampler", ["random", "latin-hypercube", "sobol"])
def test_a_table_keeps_its_correlation_line_by_line(sampler: str, tmp_path: Path) -> None:
    v, angle, weight = write_data(tmp_path)
    study = read(FROM_TABLE.format(file="data.csv"), 4096, sampler, tmp_path)
    cases = draw_cases(study, 0, study.rows)
    speeds, angles = cases.numbers["own_speed"], cases.numbers["angle_deg"]
    place = {value: i for i, value in enumerate(v.tolist())}
    lines = np.array([place[value] for value in speeds.tolist()])
    assert (angle[lines] == angles).all()
    ships = [find_ship(study, "target", number).label for number in cases.ships["target"]]
    assert ships == np.where(speeds > 5.0, "kcs", "kvlcc2").tolist()
    expected = np.cov(v, angle, aweights=weight, ddof=0)[0, 1]
    assert np.cov(speeds, angles)[0, 1] == pytest.approx(expected, rel=0.1 if sampler == "random" else 0.02)
    shares = np.bincount(lines, minlength=len(v)) / study.rows
    if sampler != "random":  # each line has its share, to the strata at its ends
        assert np.abs(shares - weight / weight.sum()).max() <= 2.0 / study.rows


def test_parquet_and_csv_are_read_alike(tmp_path: Path) -> None:
    write_data(tmp_path)
    csv, parquet = (read(FROM_TABLE.format(file=f"data.{end}"), folder=tmp_path) for end in ("csv", "parquet"))
    for name in ("own_speed", "angle_deg"):
        assert (draw_cases(csv, 0, 100).numbers[name] == draw_cases(parquet, 0, 100).numbers[name]).all()
    assert (draw_cases(csv, 0, 100).ships["target"] == draw_cases(parquet, 0, 100).ships["target"]).all()


def test_the_fingerprint_changes_with_the_data(tmp_path: Path) -> None:
    write_data(tmp_path)
    first = read(FROM_TABLE.format(file="data.csv"), folder=tmp_path)
    assert read(FROM_TABLE.format(file="data.csv"), folder=tmp_path).fingerprint == first.fingerprint
    text = (tmp_path / "data.csv").read_text()
    (tmp_path / "data.csv").write_text(text.replace(text.splitlines()[1].split(",")[0], "3.125"))
    assert read(FROM_TABLE.format(file="data.csv"), folder=tmp_path).fingerprint != first.fingerprint


def test_the_fingerprint_changes_with_a_ship_file(tmp_path: Path) -> None:
    text = '[particulars]\nL_pp = 120.0\nB = 20.0\nT = 7.0\nC_b = 0.7\n[ship]\nkind = "cargo"'
    prints = []
    for T in ("7.0", "7.0", "6.5"):
        (tmp_path / "my.toml").write_text(text.replace("T = 7.0", f"T = {T}"))
        study = parse_study(HEAD.format(rows=9, sampler="random").replace("kcs", "my.toml"), "s.toml", tmp_path)
        prints.append(study.fingerprint)
        assert float(T) == find_ship(study, "own", 0).loaded.T
    assert prints[0] == prints[1] != prints[2]


MESH_SHIP = """[ship]
kind = "cargo"
[particulars]
L_pp = 80.0
L_oa = 80.0
B = 16.0
T = 6.0
C_b = 0.75
[hull]
shape = "mesh"
file = "box.obj"
depth = 9.0
convex_hull = true
"""


def write_mesh_ship(folder: Path) -> None:
    """my.toml, a ship with the mesh box.obj beside it."""
    corners = [(x, y, z) for x in (-40.0, 40.0) for y in (-8.0, 8.0) for z in (-6.0, 3.0)]
    faces = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"]
    lines = [*(f"v {x} {y} {z}" for x, y, z in corners), *(f"f {face}" for face in faces)]
    (folder / "box.obj").write_text("\n".join(lines))
    (folder / "my.toml").write_text(MESH_SHIP)


def test_a_mesh_travels_with_its_study(tmp_path: Path) -> None:
    """A worker has neither the ship file nor the mesh file."""
    write_mesh_ship(tmp_path)
    study = parse_study(HEAD.format(rows=9, sampler="random").replace("kcs", "my.toml"), "s.toml", tmp_path)
    sent = pickle.dumps(study)
    for file in ("box.obj", "my.toml"):
        (tmp_path / file).unlink()
    tables = compute_rows(pickle.loads(sent), 0, 3)
    assert tables.encounters.column("status").to_pylist() == ["done"] * 3


FLEET = """[target]
ships = {kvlcc2 = 3.0, kcs = 1.0}
loading = {distribution = "discrete", values = [1.0, 0.6], weights = [3.0, 1.0]}
[[target.sampled]]
kind = "bulk carrier"
count = 40
weight = 4.0
L_pp = {distribution = "uniform", least = 100.0, most = 250.0}
L_over_B = 6.0
B_over_T = 2.6
C_b = 0.8
loading = {distribution = "uniform", least = 0.5, most = 0.99}
"""


def test_ships_are_chosen_by_their_weights() -> None:
    """Shares to the strata at their ends; each ship of a pool alike."""
    study = read(FLEET, 8000)
    numbers = draw_cases(study, 0, 8000).ships["target"]
    shares = np.bincount(numbers, minlength=study.target.size) / 8000
    expected = [3.0 * 0.75, 3.0 * 0.25, 1.0 * 0.75, 1.0 * 0.25, *[4.0 / 40] * 40]
    assert shares == pytest.approx(np.array(expected) / 8.0, abs=2.0 / 8000)
    labels = [find_ship(study, "target", i).label for i in range(6)]
    assert labels == ["kvlcc2", "kvlcc2 at 0.6 T", "kcs", "kcs at 0.6 T", "bulk carrier 1", "bulk carrier 2"]


def test_sampled_ships_have_the_dimensions_drawn_for_them() -> None:
    study = read(FLEET)
    ships = [find_ship(study, "target", number).loaded for number in range(4, 44)]
    lengths = np.array([ship.L_pp for ship in ships])
    assert len(set(lengths)) == 40
    assert 100.0 < lengths.min() < 130.0
    assert 220.0 < lengths.max() < 250.0
    for ship in ships:
        assert pytest.approx(ship.L_pp / 6.0) == ship.B
        share = ship.T / (ship.B / 2.6)
        assert 0.5 <= share <= 0.99
        assert ship.C_b == pytest.approx(find_block_coefficient(0.8, share))


def test_pools_of_one_kind_have_ships_of_their_own_names() -> None:
    pool = '[[target.sampled]]\nkind = "tanker"\ncount = 2\nL_pp = {}\nL_over_B = 6.0\nB_over_T = 2.6\nC_b = 0.8\n'
    study = read(pool.format(200.0) + pool.format(100.0))
    ships = [find_ship(study, "target", number) for number in range(4)]
    assert [ship.label for ship in ships] == [f"tanker, pool {i}: {k}" for i in (1, 2) for k in (1, 2)]
    assert [ship.loaded.L_pp for ship in ships] == [200.0, 200.0, 100.0, 100.0]


def test_a_lesser_draught_keeps_the_deck_where_it_is() -> None:
    """Mass by T' and C_b'; the deck rises by what the ship rises, and keeps its outline."""
    study, whole = read(FLEET), load_ship("kcs")
    light = find_ship(study, "target", 3).loaded
    assert pytest.approx(0.6 * whole.T) == light.T
    assert light.C_b == pytest.approx(1.0 - (1.0 - whole.C_b) * 0.6 ** (-1.0 / 3.0))
    assert light.mass == pytest.approx(light.C_b * light.rho * light.L_pp * light.B * light.T)
    assert light.hull.depth == whole.hull.depth
    overhang = [(ship.hull.depth - ship.T) * np.tan(np.radians(ship.hull.flare_deg)) for ship in (whole, light)]
    assert overhang[0] == pytest.approx(overhang[1])


def test_a_target_without_a_table_is_of_the_fleet_of_own() -> None:
    study = read("")
    assert study.target is study.own
    assert study.dimensions == []  # one ship and no variable: nothing is drawn


def test_what_a_kind_adds() -> None:
    """Angle, place and speeds of the kind where the file gives none; a drift is the target's own motion."""
    kinds = ["crossing", "t-bone", "drifting-target"]
    study = read(f"[grid]\nkind = {kinds}\n[encounter]\ndrift_deg = 60.0\nown_speed = 4.5".replace("'", '"'))
    numbers = draw_cases(study, 0, 3).numbers
    assert numbers["own_speed"].tolist() == [4.5] * 3
    assert numbers["angle_deg"].tolist() == [90.0] * 3
    assert numbers["target_speed"] == pytest.approx([5.0, 0.0, cos(radians(60.0))])
    assert numbers["target_sway"] == pytest.approx([0.0, 0.0, sin(radians(60.0))])
    assert np.isnan(numbers["drift_speed"]).tolist() == [True, True, False]
    assert numbers["friction"].tolist() == [0.3] * 3


def test_the_place_of_a_variable_does_not_depend_on_others_but_for_sobol() -> None:
    """A study to which a variable is added keeps its numbers."""
    one = '[encounter]\nown_speed = {distribution = "uniform", least = 2.0, most = 8.0}'
    two = one + '\nfriction = {distribution = "uniform", least = 0.0, most = 1.0}'
    a, b = (draw_cases(read(text), 0, 50).numbers["own_speed"] for text in (one, two))
    assert (a == b).all()
