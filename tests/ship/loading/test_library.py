"""Ships by name and by path, variants, and what is estimated."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.frames import Array
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.ship.loading.library import find_models, list_ship_names, load_ship
from shipcollision_fmu.ship.loading.motora_charts import Dimensions, estimate_added_mass
from tests.ship_files import ship_toml

BARGE = ship_toml()


def written(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_what_is_missing_is_estimated_and_said(tmp_path: Path) -> None:
    """CG and roll radius are given: their estimates are tested in test_is_code_2008.py."""
    ship = load_ship(written(tmp_path, "barge.toml", ship_toml(particulars={"k_xx": 7.4})))
    m, I_xx, I_zz = 8.2e6, 8.2e6 * (0.37 * 20) ** 2, 8.2e6 * 25.0**2
    np.testing.assert_allclose(np.diag(ship.M_RB), [m, m, m, I_xx, I_zz, I_zz], rtol=1e-14)
    m_x, m_y, J_z = estimate_added_mass(Dimensions(100.0, 20.0, 5.0, 0.8, 0.0, 1025.0))  # tested by its table
    roll = 0.2 * I_xx + m_y * m * 2.5**2
    np.testing.assert_allclose(np.diag(ship.M_A), [m_x * m, m_y * m, m, roll, I_zz, J_z * m * 100.0**2], rtol=1e-14)
    np.testing.assert_array_equal(ship.M, ship.M_RB + ship.M_A)
    assert ship.L_oa == 100.0
    assert ship.C_b == pytest.approx(0.8)
    assert ship.estimated == (
        "L_oa = L_pp", "k_yy = 0.25 L_pp", "k_zz = 0.25 L_pp",
        "m_x = 0.06668 mass (Motora charts, Zhou)", "m_y = 0.5889 mass (Motora charts, Zhou)", "m_z = 1 mass",
        "j_x = 0.2 I_xx", "j_y = 1 I_yy", "j_z = 0.5527 I_zz (Motora charts, Zhou)", "z_y = T/2",
    )  # fmt: skip


def test_what_is_given_is_not_estimated(tmp_path: Path) -> None:
    added = "[added_mass]\nm_x = 0.1\nm_y = 0.4\nm_z = 0.9\nj_x = 0.3\nj_y = 0.8\nj_z = 0.5\nz_y = 2.5\n"
    size = "[particulars]\nL_oa = 104.0\nr_bg = [1.0, 0.0, 0.5]\nk_xx = 7.0\nk_yy = 26.0\nk_zz = 24.0\n"
    written(tmp_path, "barge.toml", BARGE)
    ship = load_ship(written(tmp_path, "given.toml", f'extends = "barge"\n{size}{added}'))
    m = 8.2e6
    assert ship.estimated == ()
    assert ship.L_oa == 104.0
    assert ship.M_A[3, 3] == pytest.approx(0.3 * m * 7.0**2 + 0.4 * m * 2.5**2)
    assert ship.M_A[1, 3] == pytest.approx(-0.4 * m * 2.5)
    assert ship.M_RB[1, 5] == pytest.approx(m * 1.0)  # CG 1 m forward
    assert ship.M_RB[0, 4] == pytest.approx(m * 0.5)  # CG 0.5 m down


def full_M_A(M_A: Array) -> str:
    return BARGE + f"[added_mass]\nM_A = {M_A.tolist()}\n"


def test_full_added_mass_matrix(tmp_path: Path) -> None:
    M_A = np.diag([4e5, 7e6, 8e6, 0.0, 5e9, 1e9])  # no added roll inertia: semi-definite is enough
    M_A[1, 5] = M_A[5, 1] = 2e7
    ship = load_ship(written(tmp_path, "barge.toml", full_M_A(M_A)))
    np.testing.assert_array_equal(ship.M_A, M_A)
    assert not any(text.startswith(("m_", "j_", "z_")) for text in ship.estimated)


def test_added_mass_that_is_none(tmp_path: Path) -> None:
    ship = load_ship(written(tmp_path, "barge.toml", full_M_A(np.zeros((6, 6)))))
    np.testing.assert_array_equal(ship.M, ship.M_RB)


def test_added_mass_must_be_symmetric(tmp_path: Path) -> None:
    M_A = np.diag([4e5, 7e6, 8e6, 4e7, 5e9, 1e9])
    M_A[1, 5] = 2e7
    with pytest.raises(ShipError, match=r"M_A is not symmetric: M_A\[1\]\[5\] = 2e\+07 and M_A\[5\]\[1\] = 0"):
        load_ship(written(tmp_path, "barge.toml", full_M_A(M_A)))


@pytest.mark.parametrize("coupling", [1.0, None], ids=["too large a coupling", "negative diagonal"])
def test_added_mass_must_not_give_energy(tmp_path: Path, coupling: float | None) -> None:
    M_A = np.diag([4e5, 7e6, 8e6, 4e7, 5e9, 1e9])
    if coupling is None:
        M_A[0, 0] = -1e7  # M itself is then not positive definite
    else:
        M_A[1, 5] = M_A[5, 1] = 1.1 * np.sqrt(7e6 * 1e9)
    with pytest.raises(ShipError, match=r"M_A is not positive semi-definite \(least eigenvalue -.*at least 0\)"):
        load_ship(written(tmp_path, "barge.toml", full_M_A(M_A)))


def test_inertia_that_leaves_a_motion_without_any_is_refused(tmp_path: Path) -> None:
    """All mass on one line below CO, and no water: swaying and rolling about it, the ship could turn without effort."""
    line = full_M_A(np.zeros((6, 6))).replace("r_bg = [0.0, 0.0, 0.0]", "r_bg = [0.0, 0.0, 4.0]\nk_xx = 1e-6")
    with pytest.raises(
        ShipError,
        match=r"the inertia M_RB \+ M_A is not positive definite \(diagonal \[8200000.0, .*\]\): check r_bg, "
        r"the radii of gyration and \[added_mass\]",
    ):
        load_ship(written(tmp_path, "barge.toml", line))


def test_matrices_cannot_be_changed() -> None:
    ship = load_ship("kvlcc2")
    with pytest.raises(ValueError, match="read-only"):
        ship.M[0, 0] = 1.0


def test_mmg_set_is_the_added_mass() -> None:
    """The planar block is the matrix of Yasukawa & Yoshimura (2015), equation of motion about midship."""
    ship = load_ship("kvlcc2")
    L, d, rho, m, x_G = 320.0, 20.8, 1025.0, ship.mass, 11.2
    m_x, m_y, J_z = 0.022 * 0.5 * rho * L**2 * d, 0.223 * 0.5 * rho * L**2 * d, 0.011 * 0.5 * rho * L**4 * d
    I_zG = m * (0.25 * L) ** 2
    planar = [[m + m_x, 0.0, 0.0], [0.0, m + m_y, x_G * m], [0.0, x_G * m, I_zG + x_G**2 * m + J_z]]
    np.testing.assert_allclose(ship.M[np.ix_([0, 1, 5], [0, 1, 5])], planar, rtol=1e-14)
    assert m == pytest.approx(1025.0 * 312_600.0)


@pytest.mark.parametrize("name", list_ship_names())
def test_shipped_ship_loads(name: str) -> None:
    ship = load_ship(name)
    assert ship.name
    assert ship.source
    assert np.linalg.eigvalsh(ship.M)[0] > 0.0
    if ship.hull.shape != "mesh":
        assert build_hull(ship.L_oa, ship.B, ship.T, ship.hull).volume > ship.mass / ship.rho  # it can float


def test_unknown_ship_names_a_near_one_or_all(tmp_path: Path) -> None:
    with pytest.raises(ShipError, match=r"unknown ship 'kvlc2': did you mean kvlcc2\? Else give the path"):
        load_ship("kvlc2")
    with pytest.raises(ShipError, match=r"unknown ship 'x': known: buoy, .*, kcs, .*; or give the path of a TOML file"):
        load_ship("x")
    (tmp_path / "scenario.toml").write_text("[scenario]\n[ships.own]\n", encoding="utf-8")
    with pytest.raises(ShipError, match=r"^scenario.toml is a scenario, not a ship: name one of the ship files in it"):
        load_ship(tmp_path / "scenario.toml")


def test_missing_file() -> None:
    with pytest.raises(ShipError, match=r"ship file no/such/ship\.toml does not exist: give the path of a TOML file"):
        load_ship("no/such/ship.toml")


def test_a_missing_file_says_where_it_was_looked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ShipError, match=rf" \(looked for in {tmp_path}/a and {tmp_path}\)$"):
        load_ship("ferry.toml", tmp_path / "a")
    with pytest.raises(ShipError, match=r"kvlcc2_l7, mesh_example$"):
        load_ship(tmp_path / "ferry.toml")


def test_broken_toml(tmp_path: Path) -> None:
    with pytest.raises(ShipError, match=r"^broken\.toml: is not valid TOML: .*line 1"):
        load_ship(written(tmp_path, "broken.toml", "[ship\n"))


def test_not_text(tmp_path: Path) -> None:
    (tmp_path / "photo.toml").write_bytes(b"name = \xff")
    with pytest.raises(ShipError, match=r"^photo\.toml: is not UTF-8 text \(byte 7\): save it as UTF-8"):
        load_ship(tmp_path / "photo.toml")


def test_extends_overlays_key_by_key(tmp_path: Path) -> None:
    written(tmp_path, "barge.toml", BARGE)
    text = 'extends = "barge"\n[ship]\nname = "Light barge"\n[particulars]\nmass = 6.0e6\n[added_mass]\nm_y = 0.4\n'
    ship = load_ship(written(tmp_path, "light.toml", text))
    assert (ship.name, ship.kind, ship.mass, ship.B) == ("Light barge", "barge", 6.0e6, 20.0)
    assert ship.M_A[1, 1] == pytest.approx(0.4 * 6.0e6)


def test_extends_a_shipped_ship_and_a_path(tmp_path: Path) -> None:
    ship = load_ship(written(tmp_path, "mine.toml", 'extends = "kvlcc2"\n[ship]\nname = "Mine"\n'))
    assert (ship.name, ship.L_pp) == ("Mine", 320.0)
    (tmp_path / "base").mkdir()
    shutil.copy(find_models() / "ships" / "kvlcc2.toml", tmp_path / "base" / "kvlcc2.toml")
    by_path = load_ship(written(tmp_path, "by_path.toml", 'extends = "base/kvlcc2.toml"\n'))
    np.testing.assert_array_equal(by_path.M, ship.M)


def test_extends_prefers_the_file_beside_it(tmp_path: Path) -> None:
    written(tmp_path, "kvlcc2.toml", BARGE)
    assert load_ship(written(tmp_path, "mine.toml", 'extends = "kvlcc2"\n')).name == "Barge"


def test_extends_in_a_circle(tmp_path: Path) -> None:
    written(tmp_path, "one.toml", 'extends = "two"\n')
    written(tmp_path, "two.toml", 'extends = "one"\n')
    with pytest.raises(ShipError, match=r"one\.toml: extends goes round in a circle \(one extends two extends one\)"):
        load_ship(tmp_path / "one.toml")


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("extends = 3", r"mine\.toml: extends = 3 must be a ship's name or path in quotes"),
        ('extends = "kvlc2"', r"mine\.toml: extends: unknown ship 'kvlc2': did you mean kvlcc2\?"),
        ('extends = "not/there.toml"', r"mine\.toml: extends: ship file not/there\.toml does not exist"),
    ],
)
def test_extends_refused(tmp_path: Path, line: str, message: str) -> None:
    with pytest.raises(ShipError, match=message):
        load_ship(written(tmp_path, "mine.toml", line + "\n"))


@pytest.mark.parametrize("source", [None, 5, [1], ""])
def test_what_is_no_ship_is_refused_in_one_line(source: Any) -> None:
    line = rf"^ship = {re.escape(repr(source))} is no ship: give a name, a path or the tables as a dict$"
    with pytest.raises(ShipError, match=line):
        load_ship(source)
    with pytest.raises(ShipError, match=line):
        load_ship(source, Path())
