"""impact(): beside the collision model, the laws of impact, and closed solutions."""

from __future__ import annotations

import ctypes
from concurrent.futures import ThreadPoolExecutor
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from shipcollision_fmu import collide, impact, load_ship
from shipcollision_fmu.batch.impact_columns import CASES, IMPACTS
from shipcollision_fmu.collision.model import ShipCollision
from shipcollision_fmu.encounters.plan_contact import cut_section, find_contact_height, find_contacts, locate_place
from shipcollision_fmu.errors import ScenarioError, ShipError
from shipcollision_fmu.ship.hull.hull import build_hull
from shipcollision_fmu.toolchain.load import load_library
from tests.native.native_collision import NativeCollision
from tests.ship_files import BARGE_ADDED_MASS, ship_tables

Rows = npt.NDArray[Any]

INSTANT = 1e-9
FREE = [0, 1, 5]


def draw_cases(count: int, seed: int = 1, **more: Any) -> dict[str, Any]:
    """Motions, angles and places at random."""
    rng = np.random.default_rng(seed)
    return {
        "angle_deg": rng.uniform(5.0, 175.0, count), "at": rng.uniform(-0.5, 0.5, count),
        "own_speed": rng.uniform(2.0, 9.0, count), "target_speed": rng.uniform(-1.0, 5.0, count),
        "own_sway": rng.normal(0.0, 0.3, count), "target_sway": rng.normal(0.0, 0.3, count),
        "own_yaw_rate": rng.normal(0.0, 3e-3, count), "target_yaw_rate": rng.normal(0.0, 3e-3, count),
        "heading_deg": rng.uniform(0.0, 360.0, count), "friction": rng.uniform(0.0, 0.8, count),
        "restitution": rng.uniform(0.0, 0.9, count), "side": rng.choice(["port", "starboard"], count), **more,
    }  # fmt: skip


def take(rows: Rows, least: int) -> Rows:
    """The rows with an impact, of which there are many."""
    done = rows[rows["status"] == 0]
    assert len(done) >= least
    return done


def turn(vectors: Any, headings: Any) -> Any:
    """Vectors (n, 3) from b to n."""
    c, s = np.cos(headings), np.sin(headings)
    x, y = vectors[:, 0], vectors[:, 1]
    return np.column_stack([c * x - s * y, s * x + c * y, vectors[:, 2]])


def is_close(a: Any, b: Any, relative: float = 1e-9) -> bool:
    """Whether no entry differs by more than this share of the largest in its row."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    scale = np.maximum(np.abs(a), np.abs(b))
    scale = scale.max(axis=-1, keepdims=True) if scale.ndim > 1 else scale
    return bool((np.abs(a - b) <= relative * (scale + 1e-3)).all())


@pytest.mark.parametrize(
    ("own", "degrees_of_freedom", "is_native"),
    [
        ("guan2014_own", 4, True),
        pytest.param("kcs", 3, False, marks=pytest.mark.needs("pybullet")),
        pytest.param("kvlcc2", 6, False, marks=[pytest.mark.needs("pybullet"), pytest.mark.slow]),
    ],
)  # fmt: skip
def test_an_impact_is_one_step_of_the_collision_model(own: str, degrees_of_freedom: int, is_native: bool) -> None:
    """The native model, given the same states, answers the same to the bit, the Python model to rounding."""
    arguments, relative = draw_cases(9), 0.0 if is_native else 1e-9
    rows = impact(own, "kcs", **arguments, degrees_of_freedom=degrees_of_freedom)
    names, is_done = ("own", "target"), rows["status"] == 0
    model: Any = NativeCollision(load_library(), names) if is_native else ShipCollision(names)
    assert is_done.sum() >= 6
    for parameters, ship in zip(model.parameters.ships, (own, "kcs"), strict=True):
        parameters.ship, parameters.degrees_of_freedom = ship, degrees_of_freedom
    first = None
    for i in np.flatnonzero(is_done):
        row = rows[i]
        model.parameters.friction = float(arguments["friction"][i])
        model.parameters.restitution = float(arguments["restitution"][i])
        for name, state in zip(names, model.inputs.ships, strict=True):
            state.position[:], state.attitude[:] = row[f"{name}_position"], [0.0, 0.0, row[f"{name}_heading"]]
            state.velocity[:], state.rate[:] = row[f"{name}_before"][:3], row[f"{name}_before"][3:]
        if first is None:
            model.initialise()
            first = model.get_state()
        model.set_state(first)
        model.step(0.0, INSTANT)
        out = model.outputs
        for name, post in zip(names, out.ships, strict=True):
            assert is_close(row[f"{name}_impulse"], post.impulse, relative)
            assert is_close(row[f"{name}_after"], [*post.velocity, *post.rate], relative)
        assert out.contact_count == row["contacts"]
        assert is_close(row["point"], out.impact.point, relative)
        assert is_close([row["closing_speed"], row["angle"]], [out.impact.closing_speed, out.impact.angle], relative)
        energies = [out.energy.dissipated, out.energy.normal, out.energy.tangential]
        assert is_close([row["energy"], row["energy_normal"], row["energy_tangential"]], energies, relative)
    model.close()


def test_ships_touch_at_the_place() -> None:
    """Where encounters have them, but for the overlap along the normal; the point is the place."""
    arguments = draw_cases(60, heading_deg=0.0)
    rows = impact("kvlcc2", "kcs", **arguments)
    ships = load_ship("kvlcc2"), load_ship("kcs")
    hulls = [build_hull(ship.L_oa, ship.B, ship.T, ship.hull) for ship in ships]
    deck = find_contact_height(*hulls)
    own, target = (cut_section(hull, deck) for hull in hulls)
    take(rows, 30)
    for i in np.flatnonzero(rows["status"] == 0):
        row, angle = rows[i], np.radians(arguments["angle_deg"][i])
        x = ships[1].hull.trim_x + arguments["at"][i] * ships[1].L_oa
        place = locate_place(target, x, arguments["side"][i])
        contact = find_contacts(place, own, -angle if arguments["side"][i] == "starboard" else angle)[0]
        overlap = contact.position - place.point - row["own_position"][:2]
        assert row["target_position"][:2] == pytest.approx(-place.point, abs=1e-9)
        depth = overlap @ contact.normals[0]
        assert overlap == pytest.approx(depth * contact.normals[0], abs=1e-9)
        assert 0.011 < depth < 0.15
    assert np.median(rows["offset"][rows["status"] == 0]) < 0.02


def test_momentum_and_energy() -> None:
    """Impulses are opposite, and of the same moment about any point; they are what the twists gain; energy is lost."""
    rows = take(impact("kvlcc2", "kcs", **draw_cases(200)), 150)
    totals, moments, lost = [], [], np.zeros(len(rows))
    for name, ship in (("own", load_ship("kvlcc2")), ("target", load_ship("kcs"))):
        M = ship.M[np.ix_(FREE, FREE)]
        before, after, impulse = (rows[f"{name}_{what}"][:, FREE] for what in ("before", "after", "impulse"))
        assert is_close((after - before) @ M, impulse, 1e-7)  # of differences of twists
        lost += 0.5 * np.einsum("ij,jk,ik->i", before, M, before) - 0.5 * np.einsum("ij,jk,ik->i", after, M, after)
        force = turn(rows[f"{name}_impulse"][:, :3], rows[f"{name}_heading"])
        totals.append(force)
        place = rows[f"{name}_position"]
        moments.append(rows[f"{name}_impulse"][:, 5] + place[:, 0] * force[:, 1] - place[:, 1] * force[:, 0])
    assert is_close(totals[0], -totals[1])
    assert is_close(totals[1][:, :2], rows["impulse"][:, :2])
    assert np.abs(moments[0] + moments[1]).max() <= 1e-9 * np.abs(moments[0]).max()
    assert np.abs(lost - rows["energy"]).max() <= 1e-7 * np.abs(lost).max()
    assert (rows["energy"] >= 0.0).all()
    assert is_close(rows["energy"], rows["energy_normal"] + rows["energy_tangential"])


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
def test_a_central_impact_has_the_closed_solution(restitution: float) -> None:
    """Boxes end to end, m_1 and m_2 with their added masses: J = (1 + e) m V, E = (1 - e^2) m V^2 / 2."""
    speeds = np.array([1.0, 4.0, 7.0])
    boxes = [ship_tables(particulars={"mass": mass}, added_mass=BARGE_ADDED_MASS) for mass in (8.2e6, 6e6)]
    rows = impact(*boxes, 180.0, 0.5, speeds, 2.0, restitution=restitution)
    m_1, m_2 = (load_ship(box).M[0, 0] for box in boxes)
    m, V = m_1 * m_2 / (m_1 + m_2), speeds + 2.0
    J = (1.0 + restitution) * m * V
    assert rows["closing_speed"] == pytest.approx(V, rel=1e-9)
    assert rows["impulse_normal"] == pytest.approx(J, rel=1e-9)
    assert rows["energy"] == pytest.approx(0.5 * (1.0 - restitution**2) * m * V**2, rel=1e-9, abs=1e-3)
    assert rows["own_after"][:, 0] == pytest.approx(speeds - J / m_1, rel=1e-9)
    assert rows["target_after"][:, 0] == pytest.approx(2.0 - J / m_2, rel=1e-9)


def test_symmetries() -> None:
    """Another heading, a common velocity and the mirror change nothing but the frame."""
    arguments = draw_cases(120)
    rows = impact("kvlcc2", "kvlcc2", **arguments)
    turned = impact("kvlcc2", "kvlcc2", **{**arguments, "heading_deg": arguments["heading_deg"] - 77.0})
    mirrored = impact("kvlcc2", "kvlcc2", **{
        **arguments, "side": np.where(arguments["side"] == "port", "starboard", "port"),
        **{name: -arguments[name] for name in ("own_sway", "target_sway", "own_yaw_rate", "target_yaw_rate")},
    })  # fmt: skip
    angle = np.radians(np.where(arguments["side"] == "port", 1.0, -1.0) * arguments["angle_deg"])
    drift, course = 3.0, 0.7  # of both ships, from the target's bow
    moved = impact("kvlcc2", "kvlcc2", **{
        **arguments,
        "own_speed": arguments["own_speed"] + drift * np.cos(course - angle),
        "own_sway": arguments["own_sway"] + drift * np.sin(course - angle),
        "target_speed": arguments["target_speed"] + drift * np.cos(course),
        "target_sway": arguments["target_sway"] + drift * np.sin(course),
    })  # fmt: skip
    assert (rows["status"] == 0).sum() > 90
    done = rows["status"] == 0
    for other, sign, share in ((turned, 1.0, 1e-6), (moved, 1.0, 1e-6), (mirrored, -1.0, 1e-5)):
        assert (other["status"] == rows["status"]).all()
        a, b = rows[done], other[done]
        alike = (a["contacts"] == 1) & (b["contacts"] == 1)  # rounding decides where sides meet along a line
        a, b = a[alike], b[alike]
        signs = np.array([1.0, sign, 1.0, sign, 1.0, sign])
        is_same = [
            is_close(p["own_impulse"], signs * q["own_impulse"], share) and is_close(p["energy"], q["energy"], share)
            for p, q in zip(a, b, strict=True)
        ]
        assert np.mean(is_same) > 0.99  # Where a bow touches a corner, rounding decides between its two sides.


def test_a_case_has_its_reason() -> None:
    """Of what is out of range and of ships that do not close; the rest of the batch goes on."""
    rows = impact(
        "kvlcc2", "kcs", [90.0, 200.0, 90.0, np.nan], own_speed=[5.0, 5.0, -1.0, 5.0], friction=[0.3, 0.3, 0.3, 0.3]
    )
    assert rows["status"].tolist() == [0, 1, 2, 1]
    assert [reason.decode() for reason in rows["reason"]] == [
        "", "angle_deg = 200 must be 0 to 180: 0 is overtaking, 180 head-on",
        "at the place they close at -1.00 m/s, at least 0.05 m/s is needed; change the angle, the speeds, the side or "
        "the place",
        "angle_deg = nan must be 0 to 180: 0 is overtaking, 180 head-on",
    ]  # fmt: skip
    assert (rows["energy"] > 0.0).tolist() == [True, False, False, False]


def test_hulls_that_part_along_the_normal_are_refused() -> None:
    """At the end of a section the normal of the contact may be another one than that of the place."""
    rows = impact("kcs", "buoy", np.linspace(27.5, 80.0, 40), -0.497, 3.2, 3.1, degrees_of_freedom=6)
    done, parting = rows["status"] == 0, rows["status"] == 2
    assert done.any()
    assert (rows["closing_speed"][done] > 0.0).all()
    assert {reason.decode() for reason in rows["reason"][parting]} == {
        "the hulls touch at the place along a normal on which they part: change the angle, the speeds, the side or the "
        "place"
    }


def test_a_row_depends_on_its_case_alone() -> None:
    """Not on the order, the shape or the thread."""
    arguments = draw_cases(120)
    rows = impact("kvlcc2", "kcs", **arguments)
    order = np.random.default_rng(2).permutation(120)
    shuffled = {name: values[order].reshape(4, 30) for name, values in arguments.items()}
    with ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda _: impact("kvlcc2", "kcs", **shuffled), range(2)))
    for run in runs:
        assert run.shape == (4, 30)
        assert run.ravel().tobytes() == rows[order].tobytes()
    assert impact(load_ship("kvlcc2"), "kcs", **{name: values[0] for name, values in arguments.items()}) == rows[0]


def test_arguments_that_do_not_fit_are_refused() -> None:
    for arguments, words in (
        ({"side": ["port", "left"]}, "side = 'left' must be port or starboard"),
        (
            {"at": [0.0, 0.1], "own_speed": [1.0, 2.0, 3.0]},
            r"do not broadcast to one: at \(2,\), own_speed \(3,\), side",
        ),
        ({"friction": 10**400}, "friction is no array of numbers: int too large"),
        ({"side": None}, "side = None must be port or starboard"),
        ({"degrees_of_freedom": 5}, "degrees_of_freedom = 5 must be 3"),
        ({"degrees_of_freedom": 3.0}, r"degrees_of_freedom = 3\.0 must be 3"),
        ({"degrees_of_freedom": np.array([3, 6])}, r"degrees_of_freedom = array\(\[3, 6\]\) must be 3"),
    ):
        with pytest.raises(ScenarioError, match=f"^impact: .*{words}"):
            impact("kvlcc2", "kcs", **arguments)
    with pytest.raises(ShipError, match="unknown ship 'kvlc'"):
        impact("kvlc", "kcs")
    with pytest.raises(ShipError, match=r"unknown ship 'x+'"):
        impact(5000 * "x", "kcs")


NO_NUMBERS = [
    ("slippery", r"friction = 'slippery' is no real number: give numbers, or an array of them$"),
    ("0.3", r"friction = '0\.3' is no real number"),
    (["0.3", "0.4"], r"friction\[0\] = '0\.3' is no real number"),
    (b"0.3", r"friction = b'0\.3' is no real number"),
    (0.3 + 0.1j, r"friction = \(0\.3\+0\.1j\) is no real number"),
    (np.array([[0.3, 0.4 + 0j]]), r"friction\[0, 0\] = \(0\.3\+0j\) is no real number"),
    (np.array([0.3, "0.4"], dtype=object), r"friction\[1\] = '0\.4' is no real number"),
    ([[0.3], [None]], r"friction\[1, 0\] = None is no real number"),
    (np.array(["2026-01-01"], dtype="M8[D]"), r"friction\[0\] = datetime\.date\(2026, 1, 1\) is no real number"),
    (np.zeros(2, [("mu", "f8")]), r"friction\[0\] = \(0\.0,\) is no real number"),
    ({0.3}, r"friction = \{0\.3\} is no real number"),
    ([[0.3], [0.3, 0.4]], r"friction is no array: setting an array element with a sequence"),
    (np.ma.masked_array([0.3, 0.4, 0.5], [False, True, True]), r"friction\[1\] is masked, and cases have no masks: "),
    (np.ma.masked_array([[0.3, 0.4]], [[False, True]]), r"friction\[0, 1\] is masked"),
    (np.ma.masked, r"friction is masked"),
]


@pytest.mark.parametrize(("friction", "words"), NO_NUMBERS)
@pytest.mark.parametrize("function", [impact, collide])
def test_what_is_no_number_is_refused_by_name_and_place(function: Any, friction: Any, words: str) -> None:
    """It was parsed, cut to its real part, taken without its mask or read as days."""
    with pytest.raises(ScenarioError, match=f"^{function.__name__}: {words}"):
        function("kvlcc2", "kcs", friction=friction)


def test_sides_that_are_masked_or_no_array_are_refused() -> None:
    for side, words in (
        (np.ma.masked_array(["port", "port"], [True, False]), r"side\[0\] is masked"),
        ([["port"], ["port", "port"]], "side is no array"), ([b"port"], "side = b'port' must be port or starboard"),
    ):  # fmt: skip
        with pytest.raises(ScenarioError, match=f"^impact: {words}"):
            impact("kvlcc2", "kcs", side=side)


def test_any_array_of_numbers_is_taken() -> None:
    """Strided, read-only, of another byte order or precision, of objects, masked in no place."""
    speeds = np.array([5.0, 6.0])
    expected = impact("kvlcc2", "kcs", own_speed=speeds)
    fixed = speeds.copy()
    fixed.flags.writeable = False
    for given in (
        [5, 6], np.array([5.0, 0.0, 6.0])[::2], fixed, speeds.astype(">f8"), speeds.astype("f4"),
        np.array([5, 6], "u1"),
        np.array([Decimal(5), Fraction(6)], dtype=object), np.ma.masked_array(speeds, [False, False]),
        np.ma.masked_array(speeds),
    ):  # fmt: skip
        assert impact("kvlcc2", "kcs", own_speed=given).tobytes() == expected.tobytes()
    assert impact("kvlcc2", "kcs", own_speed=np.array(5.0)).tobytes() == expected[0].tobytes()


@pytest.mark.parametrize("speeds", [[], np.zeros((0, 2))])
def test_no_cases_are_an_empty_table(speeds: Any) -> None:
    assert impact("kvlcc2", "kcs", own_speed=speeds).shape == np.shape(speeds)
    assert collide("kvlcc2", "kcs", own_speed=speeds).encounters.shape == (0,)


def test_the_tables_are_those_of_the_library() -> None:
    sizes = (ctypes.c_size_t * 2)()
    load_library().shipcollision_impact_sizes(sizes)
    assert list(sizes) == [CASES.itemsize, IMPACTS.itemsize]
