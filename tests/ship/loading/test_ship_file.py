"""A ship file is accepted whole or refused with one line that says what to do."""

from __future__ import annotations

import math
from typing import Any

import pytest

from shipcollision_fmu.errors import ShipError
from shipcollision_fmu.ship.loading.ship_file import validate_ship_file
from shipcollision_fmu.ship.tables.manoeuvring import ManoeuvringTable
from tests.ship_files import ship_tables

BARE = ship_tables()
MMG = {key: 0.01 for key, field in ManoeuvringTable.model_fields.items() if field.is_required()}
PARAMETRIC = {"shape": "parametric", "depth": 8.0, "bow_length": 15.0, "stern_length": 20.0}


def test_least_file_is_accepted() -> None:
    content = validate_ship_file(BARE, "barge.toml")
    assert content.particulars.mass == 8.2e6
    assert content.particulars.rho == 1025.0
    assert content.manoeuvring is None


def test_integers_are_numbers() -> None:
    assert validate_ship_file(ship_tables(particulars={"B": 20}), "barge.toml").particulars.B == 20.0


# C_b from the mass: 1025 x 100 x 20 x 5 = 10.25e6 kg fill the box.
REFUSED: list[tuple[dict[str, Any], str]] = [
    (ship_tables(particulars={"mass": -2.0}), r"\[particulars\] mass = -2\.0 must be greater than 0: it is the displ"),
    (ship_tables(particulars={"mass": 0.0}), r"mass = 0\.0 must be greater than 0"),
    (ship_tables(particulars={"mass": math.nan}), r"mass = nan must be a finite number: it is the displacement \[kg\]"),
    (ship_tables(particulars={"B": math.inf}), r"B = inf must be a finite number: it is the breadth \[m\]"),
    (ship_tables(particulars={"T": "5"}), r"T = '5' must be a number: it is the draught"),
    ({**ship_tables(), "ship": 5}, r"\[ship\] = 5 must be a table: it is the table \[ship\]"),
    ({**ship_tables(), "ship": {"name": 5}}, r"\[ship\] name = 5 must be text in quotes"),
    (ship_tables(particulars={"T": True}), r"T = True must be a number"),
    (
        ship_tables(particulars={"mass": 10.3e6}),
        r"mass = 1\.03e\+07 kg is more than rho L_pp B T = 1\.025e\+07 kg.*allow",
    ),
    (ship_tables(particulars={"mass": 3.0e6}), r"means C_b = mass / \(rho L_pp B T\) = 0\.293, outside 0\.40 to 0\.90"),
    (ship_tables(particulars={"mass": 9.9e6}), r"C_b = mass / \(rho L_pp B T\) = 0\.966, outside"),
    (ship_tables(particulars={"C_b": 0.7}), r"C_b = 0\.7 contradicts mass / \(rho L_pp B T\) = 0\.800 by more than 2%"),
    (ship_tables(particulars={"L_pp": None}), r"\[particulars\] L_pp is missing: give the length between perp"),
    (
        ship_tables(particulars={"L_pp": None, "Lpp": 1.0}),
        r"Lpp is not a known key: did you mean L_pp\?",
    ),
    (ship_tables(particulars={"colour": "red"}), r"\[particulars\] colour is not a known key: known: L_pp"),
    (
        ship_tables(particulars={"r_bg": [0.0, 0.0]}),
        r"r_bg = \[0\.0, 0\.0\] must have at least 3 values, it has 2: .*centre of gravity",
    ),
    (
        ship_tables(particulars={"r_bg": [0.0, math.nan, 0.0]}),
        r"\[particulars\] r_bg\[1\] = nan must be a finite number",
    ),
    (
        ship_tables(particulars={"r_bg": [60.0, 0.0, 0.0]}),
        r"r_bg: x = 60\.0 m puts CG outside the ship: at most 50\.0 m",
    ),
    (
        ship_tables(particulars={"k_xx": 0.0}),
        r"k_xx = 0\.0 must be greater than 0: it is the radius of gyration in roll",
    ),
    (
        ship_tables(particulars={"allow_inconsistent": ""}),
        r"allow_inconsistent = '' must not be empty: it is the reason",
    ),
    (
        ship_tables(added_mass={"m_y": -0.1}),
        r"\[added_mass\] m_y = -0\.1 must be greater than or equal to 0: it is the sw",
    ),
    (
        ship_tables(added_mass={"m_y": 0.8, "M_A": [[0.0] * 6] * 6}),
        r"gives m_y beside M_A, which is the whole matrix: remove",
    ),
    (
        ship_tables(added_mass={"M_A": [[0.0] * 6] * 5}),
        r"\[added_mass\] M_A = .* must have at least 6 values, it has 5",
    ),
    (ship_tables(hull={"depth": 4.0}), r"\[hull\] depth = 4\.0 m must be greater than the draught T = 5\.0 m"),
    (ship_tables(hull={"shape": "mesh"}), r'\[hull\] file is missing: shape = "mesh" needs the name'),
    (ship_tables(hull={"shape": "round"}), r"\[hull\] shape = 'round' must be 'parametric', 'box' or 'mesh'"),
    (ship_tables(hull={"bilge": 1.0}), r'\[hull\] shape = "box" has no bilge: give depth only'),
    (ship_tables(hull={**PARAMETRIC, "bow_length": 0.0}), r"\[hull\] bow_length = 0\.0 m must be greater than 0"),
    (ship_tables(hull={**PARAMETRIC, "bow_length": 80.0}), r"= 100\.0 m leave no parallel midbody in 100\.0 m"),
    (
        ship_tables(hull={**PARAMETRIC, "bilge": 6.0}),
        r"\[hull\] bilge = 6\.0 m must be less than T = 5\.0 m and B/2 = 10",
    ),
    ({**ship_tables(), "hull": 5}, r"\[hull\] = 5 must be a table: it is the table \[hull\]"),
    (ship_tables(particulars={"mass": None}), r"\[particulars\] mass is missing: give the displacement .*; or C_b"),
    (
        ship_tables(manoeuvring=MMG, engine={"rate": 0.1, "max_rev_per_s": 1.0}),
        r"\[manoeuvring\] needs \[propeller\], \[rudder\] as well: propeller, rudder and engine work together",
    ),
    (
        ship_tables(manoeuvring={**MMG, "m_x": 0.02}),
        r"\[manoeuvring\] gives m_x of m_x, m_y, J_z: give all three or none",
    ),
    (
        ship_tables(particulars={"GM_T": -0.4}),
        r"\[particulars\] GM_T = -0\.4 must be greater than 0: it is the transverse",
    ),
    (
        ship_tables(particulars={"mass": 3.0e6, "allow_inconsistent": "a test"}, manoeuvring={"estimate": True}),
        r"\[manoeuvring\] estimate = true with C_b = mass / \(rho L_pp B T\) = 0\.293: must be 0\.40 to 0\.90; give",
    ),
    (
        ship_tables(manoeuvring={"estimate": True}, rudder={"A_R": "big"}),
        r"\[rudder\] A_R = 'big' must be a number",
    ),
    (ship_tables(manoeuvring={"estimate": True}, rudder={"area": 2.0}), r"\[rudder\] area is not a known key: .* A_R"),
    (
        ship_tables(manoeuvring={"estimate": True}, propeller={"D_p": 0.0}),
        r"\[propeller\] D_p = 0\.0 must be greater than 0",
    ),
    (
        ship_tables(manoeuvring={"estimate": "yes"}),
        r"\[manoeuvring\] estimate = 'yes' must be true or false: it is true:",
    ),
    (ship_tables(manoeuvring={"estimate": False}), r"\[manoeuvring\] R_0 is missing: give the resistance coefficient"),
    (
        ship_tables(seakeeping={"zeta_roll": -0.1}),
        r"\[seakeeping\] zeta_roll = -0\.1 must be greater than or equal to 0",
    ),
    (ship_tables(wind={"type": "gondola"}), r"\[wind\] type = 'gondola' must be 'car carrier', .* or 'tender'"),
    (ship_tables(wind={"A_L": 100.0}), r"\[wind\] A_L is not a known key: did you mean A_Lw\?"),
    (ship_tables(sails={"area": 3.0}), r"\[sails\] is not a known key: known: ship, particulars"),
]


@pytest.mark.parametrize(("data", "message"), REFUSED, ids=[message[:40] for _, message in REFUSED])
def test_refused(data: dict[str, Any], message: str) -> None:
    with pytest.raises(ShipError, match=message) as raised:
        validate_ship_file(data, "barge.toml")
    line = str(raised.value)
    assert line.startswith("barge.toml: ")
    assert "\n" not in line


AT_ONCE: list[tuple[dict[str, Any], tuple[str, ...]]] = [
    (
        ship_tables(particulars={"C_b": 1.7, "mass": None}, hull={"depth": 4.0, "bow": 3.0}),
        ("[hull] bow is not a known key", "C_b = 1.7 must be 0.40 to 0.90", "depth = 4.0 m must be"),
    ),
    (
        ship_tables(particulars={"mass": -1.0, "B": -1.0, "T": -1.0}),
        ("B = -1.0 must be", "T = -1.0 must be", "mass = -1.0 must be"),
    ),
    (
        ship_tables(hull={"shape": "parametric", "bow_length": 0.0, "stern_length": 0.0}),
        ("[hull] bow_length = 0.0 m must be", "[hull] stern_length = 0.0 m must be"),
    ),
    (
        ship_tables(particulars={"r_bg": [60.0, 0.0, 0.0]}, hull={"depth": 4.0}),
        ("x = 60.0 m puts CG outside", "depth = 4.0 m must be"),
    ),
    (
        ship_tables(particulars={"mass": 3e6}, hull={"depth": 4.0}, wind={"type": "gondola"}),
        ("C_b = mass / (rho L_pp B T) = 0.293", "depth = 4.0 m must be", "type = 'gondola' must be"),
    ),
    (
        ship_tables(hull={"depth": 4.0}, manoeuvring={"estimate": True}, rudder={"A_R": "big"}, propeller={"D": 1.0}),
        ("depth = 4.0 m must be", "A_R = 'big' must be", "[propeller] D is not a known key"),
    ),
]


@pytest.mark.parametrize(("data", "messages"), AT_ONCE, ids=[messages[0] for _, messages in AT_ONCE])
def test_all_problems_are_shown_at_once(data: dict[str, Any], messages: tuple[str, ...]) -> None:
    with pytest.raises(ShipError) as raised:
        validate_ship_file(data, "barge.toml")
    line = str(raised.value)
    assert line.startswith(f"barge.toml: {len(messages)} problems: (1) ")
    assert "\n" not in line
    for message in messages:
        assert message in line


def test_a_file_of_another_kind_is_refused_in_a_line_of_bounded_length() -> None:
    data = ship_tables(particulars={f"x{i}": 1.0 for i in range(50)})
    with pytest.raises(ShipError, match=r"50 problems: \(1\) .*\(12\) .*; and 38 more$"):
        validate_ship_file(data, "barge.toml")


REMEDIES: list[tuple[dict[str, Any], str, dict[str, dict[str, Any] | None]]] = [
    # what is refused; its remedy as the message has it; the remedy, done
    (ship_tables(particulars={"mass": 10.3e6}), "give the displacement", {"particulars": {"mass": 8e6}}),
    (ship_tables(particulars={"mass": 10.3e6}), "allow_inconsistent", {"particulars": {"allow_inconsistent": "why"}}),
    (ship_tables(particulars={"mass": 3e6}), "and its draught", {"particulars": {"T": 2.0}}),
    (ship_tables(particulars={"mass": 3e6}), "allow_inconsistent", {"particulars": {"allow_inconsistent": "why"}}),
    (ship_tables(particulars={"mass": None, "C_b": 1.7}), "C_b = 1.7 must be", {"particulars": {"C_b": 0.9}}),
    (
        ship_tables(particulars={"mass": None, "C_b": 0.3}),
        "allow_inconsistent",
        {"particulars": {"allow_inconsistent": "why"}},
    ),
    (ship_tables(particulars={"C_b": 0.7}), "remove C_b", {"particulars": {"C_b": None}}),
    (ship_tables(particulars={"mass": None}), "or C_b instead", {"particulars": {"C_b": 0.7}}),
    (
        ship_tables(particulars={"r_bg": [60.0, 0.0, 0.0]}),
        "at most 50.0 m",
        {"particulars": {"r_bg": [50.0, 0.0, 0.0]}},
    ),
    (ship_tables(hull={"depth": 4.0}), "greater than the draught T = 5.0 m", {"hull": {"depth": 5.1}}),
    (ship_tables(hull={**PARAMETRIC, "bow_length": 0.0}), "without the key", {"hull": {"bow_length": None}}),
    (ship_tables(hull={**PARAMETRIC, "stern_length": 0.0}), "without the key", {"hull": {"stern_length": None}}),
    (ship_tables(hull={**PARAMETRIC, "bow_length": 80.0}), "shorten them", {"hull": {"bow_length": 50.0}}),
    (ship_tables(hull={**PARAMETRIC, "bilge": 6.0}), "give at most 2.519", {"hull": {"bilge": 2.519}}),
    (
        ship_tables(hull={**PARAMETRIC, "bow_length": 50.0, "flare_deg": 50.0}),
        "flare_deg at most 9.461",
        {"hull": {"flare_deg": 9.461}},
    ),
    (ship_tables(hull={"bilge": 1.0}), "give depth only", {"hull": {"bilge": None}}),
    (ship_tables(hull={"bilge": 1.0}), 'or shape = "parametric"', {"hull": {"shape": "parametric"}}),
    (ship_tables(hull={"unit": "mm"}), 'only "mesh" has', {"hull": {"unit": None}}),
    (ship_tables(added_mass={"m_y": 0.8, "M_A": [[0.0] * 6] * 6}), "remove", {"added_mass": {"m_y": None}}),
    (
        ship_tables(manoeuvring={**MMG, "m_x": 0.02, "m_y": 0.2, "J_z": 0.01}, added_mass={"m_x": 0.1}),
        "remove one of the two sets",
        {"added_mass": {"m_x": None}},
    ),
    (
        ship_tables(manoeuvring={**MMG, "m_x": 0.02, "m_y": 0.2, "J_z": 0.01}, added_mass={"m_x": 0.1}),
        "remove one of the two sets",
        {"manoeuvring": {"m_x": None, "m_y": None, "J_z": None}},
    ),
    (
        ship_tables(manoeuvring={**MMG, "m_x": 0.02}),
        "give all three or none",
        {"manoeuvring": {"m_x": None}},
    ),
    (
        ship_tables(manoeuvring={**MMG, "m_x": 0.02}),
        "give all three or none",
        {"manoeuvring": {"m_y": 0.2, "J_z": 0.01}},
    ),
    (
        ship_tables(manoeuvring=MMG, engine={"rate": 0.1, "max_rev_per_s": 1.0}),
        "or remove all three and the ship can only drift",
        {"engine": None},
    ),
    (
        ship_tables(particulars={"r_bg": [20.0, 0.0, 0.0]}, manoeuvring=MMG),
        "at most 0.15 either way",
        {"particulars": {"r_bg": [15.0, 0.0, 0.0]}},
    ),
    (
        ship_tables(manoeuvring={**MMG, "m_x": 0.02 * 25.6e6, "m_y": 0.2, "J_z": 0.01}),
        "give it over 1/2 rho L_pp^2 T = 2.562e+07",
        {"manoeuvring": {"m_x": 0.02}},
    ),
    (
        ship_tables(particulars={"mass": 3.0e6, "allow_inconsistent": "a test"}, manoeuvring={"estimate": True}),
        "give a mass that fits the draught",
        {"particulars": {"mass": 8e6}},
    ),
    (
        ship_tables(particulars={"mass": 3.0e6, "allow_inconsistent": "a test"}, manoeuvring={"estimate": True}),
        "or remove the table: the ship coasts",
        {"manoeuvring": None},
    ),
]


@pytest.mark.parametrize(
    ("data", "remedy", "done"), REMEDIES, ids=[f"{r}, {i}" for i, (_, r, _) in enumerate(REMEDIES)]
)
def test_remedies_are_remedies(data: dict[str, Any], remedy: str, done: dict[str, dict[str, Any] | None]) -> None:
    with pytest.raises(ShipError) as raised:
        validate_ship_file(data, "barge.toml")
    assert remedy in str(raised.value)
    for name, keys in done.items():
        both = {**data.get(name, {}), **(keys or {})}
        data = {**data, name: None if keys is None else {k: v for k, v in both.items() if v is not None}}
    validate_ship_file({name: table for name, table in data.items() if table is not None}, "barge.toml")


@pytest.mark.parametrize("key", ["m_x", "m_y", "j_z", "M_A"])
def test_two_added_masses_are_refused(key: str) -> None:
    value: Any = [[0.0] * 6] * 6 if key == "M_A" else 0.1
    data = ship_tables(manoeuvring={**MMG, "m_x": 0.02, "m_y": 0.2, "J_z": 0.01}, added_mass={key: value})
    with pytest.raises(ShipError, match=rf"\[added_mass\] {key} and \[manoeuvring\] m_x, m_y, J_z are two"):
        validate_ship_file(data, "barge.toml")


@pytest.mark.parametrize("particulars", [{"mass": 12e6}, {"mass": 3e6}, {"C_b": 0.5}])
def test_inconsistent_mass_is_let_through_with_a_reason(particulars: dict[str, Any]) -> None:
    reason = "the paper prints dead-weights"
    content = validate_ship_file(ship_tables(particulars={**particulars, "allow_inconsistent": reason}), "barge.toml")
    assert content.particulars.allow_inconsistent == reason


def test_fresh_water_has_its_own_limit() -> None:
    """10.3e6 kg fit into 10 000 m3 of the Dead Sea, and 9.1e6 kg are too much for fresh water's 0.90."""
    assert (
        validate_ship_file(ship_tables(particulars={"mass": 10.3e6, "rho": 1240.0}), "barge.toml").particulars.rho
        == 1240.0
    )
    with pytest.raises(ShipError, match=r"outside 0\.40 to 0\.90"):
        validate_ship_file(ship_tables(particulars={"mass": 9.1e6, "rho": 1000.0}), "barge.toml")
