"""`[manoeuvring] estimate = true`: the regressions against values worked out from the published formulas."""

from __future__ import annotations

from math import pi
from pathlib import Path

import pytest

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.loading.library import load_ship
from shipcollision_fmu.ship.loading.mmg_estimate import (
    Dimensions,
    complete_tables,
    estimate_hull_derivatives,
)
from shipcollision_fmu.ship.loading.motora_charts import estimate_added_mass
from tests.ship_files import ship_toml

BULK = Dimensions(279.0, 44.0, 16.1, 0.84, 0.0, 1025.0)
CONTAINER = Dimensions(250.0, 32.2, 8.5, 0.60, 0.0, 1025.0)
MASSES = (0.02, 0.2)
KVLCC2 = Dimensions(320.0, 58.0, 20.8, 0.81, 11.2, 1025.0)

TABLE = {
    "m": (0.265, 0.155), "m_x": (0.018, 0.003), "m_y": (0.203, 0.111), "J_z": (0.0119, 0.0098),
    "X_vv": (-0.028, -0.091), "X_vr": (-0.030, -0.043), "X_rr": (-0.003, 0.001), "X_vvvv": (0.215, 0.584),
    "Y_v": (-0.367, -0.215), "Y_r": (0.085, 0.042), "Y_vvv": (-1.653, -1.916),
    "Y_vvr": (0.348, -0.75), "Y_vrr": (-0.374, -0.917), "Y_rrr": (-0.051, -0.051),
    "N_v": (-0.115, -0.068), "N_r": (-0.049, -0.032), "N_vvv": (-0.080, -0.246),
    "N_vvr": (-0.555, -0.640), "N_vrr": (0.022, -0.135), "N_rrr": (-0.023, -0.037),
}  # fmt: skip
"""A loaded Capesize bulk carrier and a 3 000 TEU container ship, to the digits of a table. Y_vvr of the bulk carrier is
Kijima's, 5.95 x 0.16 x 16.1/44: the other regression has no hull above C_b = 0.65."""


def primed_masses(d: Dimensions) -> dict[str, float]:
    m = 2 * d.C_b * d.B / d.L
    return dict(zip(("m", "m_x", "m_y", "J_z"), (m, *(f * m for f in estimate_added_mass(d))), strict=True))


@pytest.mark.parametrize(("column", "d"), [(0, BULK), (1, CONTAINER)], ids=["bulk carrier", "container ship"])
def test_coefficients(column: int, d: Dimensions) -> None:
    values = primed_masses(d)
    values |= estimate_hull_derivatives(d, values["m_x"], values["m_y"])
    assert set(values) == set(TABLE)
    for key, row in TABLE.items():
        digits = 4 if key == "J_z" else 3
        assert values[key] == pytest.approx(row[column], abs=0.51 * 10**-digits), key


def test_added_masses_of_kvlcc2() -> None:
    """0.023, 0.224, 0.0112, where Yasukawa & Yoshimura (2015) have 0.022, 0.223, 0.011."""
    m = primed_masses(KVLCC2)
    assert m["m_x"] == pytest.approx(0.023, abs=5e-4)
    assert m["m_y"] == pytest.approx(0.224, abs=5e-4)
    assert m["J_z"] == pytest.approx(0.0112, abs=5e-5)


def test_signs_are_those_of_v_and_r() -> None:
    """Drifting to starboard is braked, turning is braked; in the drift angle the signs of the first two would flip."""
    values = estimate_hull_derivatives(CONTAINER, 0.003, 0.111)
    for key in ("Y_v", "N_v", "Y_vvv", "N_vvv", "Y_vrr", "N_r", "N_rrr"):
        assert values[key] < 0.0, key


def test_propulsion_and_rudder_sizes() -> None:
    tables, _ = complete_tables(BULK, {}, MASSES)
    w = 0.5 * 0.84 - 0.05
    assert tables["propeller"]["w_P0"] == pytest.approx(w)
    assert tables["propeller"]["t_P"] == pytest.approx(0.6 * w)
    assert tables["propeller"]["D_p"] == 9.9
    rudder = tables["rudder"]
    assert rudder["H_R"] ** 2 / rudder["A_R"] == pytest.approx(1.8)
    assert rudder["a_H"] == pytest.approx(3.6 * 0.84 * 44 / 279)
    assert rudder["kappa"] * rudder["epsilon"] == pytest.approx(0.55)


def test_service_revolutions_balance_the_resistance() -> None:
    tables, _ = complete_tables(CONTAINER, {}, MASSES)
    p, R_0 = tables["propeller"], tables["manoeuvring"]["R_0"]
    n, D, U = p["service_rev_per_s"], p["D_p"], p["service_speed"]
    J = U * (1 - p["w_P0"]) / n / D
    thrust = (p["k_0"] + p["k_1"] * J + p["k_2"] * J**2) * n**2 * D**4
    assert (1 - p["t_P"]) * thrust == pytest.approx(0.5 * 250.0 * 8.5 * R_0 * U**2)


def test_resistance_of_kvlcc2_is_a_tenth_above_its_hand_calculation() -> None:
    """0.00785 at 15.5 kn with a form factor of 1.1 and without waves, in its file; Holtrop and Mennen's form factor is
    1.3."""
    tables, _ = complete_tables(KVLCC2, {"propeller": {"service_speed": 7.974}}, MASSES)
    assert 1.0 < tables["manoeuvring"]["R_0"] / 0.00785 < 1.2


BARGE = ship_toml(
    ship={"name": "Anything", "kind": "general cargo"}, particulars={"T": 6.0, "mass": 7.38e6}, hull={"depth": 9.0},
    manoeuvring={"estimate": True},
)  # fmt: skip


def load(folder: Path, text: str) -> object:
    path = folder / "anything.toml"
    path.write_text(text, encoding="utf-8")
    return load_ship(path)


def test_in_the_band_is_grade_B(tmp_path: Path) -> None:
    """C_b 0.60, L/B 5, T/B 0.30."""
    ship = load(tmp_path, BARGE)
    assert "[manoeuvring] Yoshimura & Masumoto (2012), grade B" in ship.estimated  # type: ignore[attr-defined]  # load gives an object


def test_outside_the_band_is_grade_C() -> None:
    assert "[manoeuvring] Yoshimura & Masumoto (2012), grade C: C_b = 0.84 outside 0.51 to 0.65" in load_ship(
        "guan2014_own_manoeuvring"
    ).estimated  # fmt: skip


def test_what_is_given_is_kept_and_takes_part(tmp_path: Path) -> None:
    own = "Y_v = -0.3\n[propeller]\nservice_speed = 6.0\nD_p = 4.0\n[rudder]\nA_R = 9.0\nH_R = 4.0\n"
    ship = load_ship(tmp_path / "anything.toml") if load(tmp_path, BARGE + own) else None
    assert ship is not None
    assert ship.manoeuvring is not None
    assert ship.propeller is not None
    assert ship.rudder is not None
    assert (ship.manoeuvring.Y_v, ship.propeller.D_p, ship.rudder.A_R) == (-0.3, 4.0, 9.0)
    aspect = 16.0 / 9.0
    assert ship.rudder.f_alpha == pytest.approx(6.13 * aspect / (aspect + 2.25))
    assert not any(text.startswith("[rudder]") and "A_R" in text for text in ship.estimated)
    plain = load_ship(str(_plain(tmp_path)))
    assert plain.propeller is not None
    assert plain.propeller.service_rev_per_s != ship.propeller.service_rev_per_s


def _plain(folder: Path) -> Path:
    path = folder / "plain.toml"
    path.write_text(BARGE, encoding="utf-8")
    return path


def test_a_ships_own_added_mass_is_the_one(tmp_path: Path) -> None:
    """One added mass: [added_mass] m_x, m_y, j_z stay, X_vr and Y_r follow them."""
    ship = load_ship(str(_plain(tmp_path)))
    (tmp_path / "own.toml").write_text(
        'extends = "plain"\n[added_mass]\nm_x = 0.06\nm_y = 0.9\nj_z = 0.5\n', encoding="utf-8"
    )
    own = load_ship(tmp_path / "own.toml")
    assert own.manoeuvring is not None
    assert ship.manoeuvring is not None
    assert own.M_A[1, 1] == pytest.approx(0.9 * own.mass)
    assert own.manoeuvring.m_y is None
    unit = 2 * 0.6 * 20 / 100
    assert own.manoeuvring.Y_r == pytest.approx(0.06 * unit + 0.5 * 0.6 * 20 / 100)
    assert own.manoeuvring.X_vr == pytest.approx(1.91 * 0.12 - 0.08 - 0.9 * unit)
    assert ship.M_A[1, 1] == pytest.approx(estimate_added_mass(Dimensions(100, 20, 6, 0.6, 0, 1025))[1] * ship.mass)


def test_sway_added_mass_sits_at_half_the_draught(tmp_path: Path) -> None:
    ship = load_ship(str(_plain(tmp_path)))
    assert "z_y = T/2" in ship.estimated
    assert ship.M_A[1, 3] == pytest.approx(-3.0 * ship.M_A[1, 1])


@pytest.mark.parametrize("C_b", [0.399, 0.901])
def test_out_of_reach_is_refused(C_b: float) -> None:
    with pytest.raises(ShipError, match=rf"estimate = true with C_b = .* = {C_b}: must be 0\.40 to 0\.90; give a mass"):
        complete_tables(BULK._replace(C_b=C_b), {}, MASSES)


def test_linear_derivatives_are_those_of_a_wing() -> None:
    """Y_v = -(pi k/2 + 1.4 c) and N_v = -k, k = 2 T/L: Jones' wing of low aspect ratio, and what thickness adds."""
    values = estimate_hull_derivatives(BULK, 0.0, 0.0)
    k = 2 * 16.1 / 279
    assert values["N_v"] == -k
    assert values["Y_v"] + 1.4 * 0.84 * 44 / 279 == pytest.approx(-pi * k / 2)
