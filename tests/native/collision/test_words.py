"""native/collision: refusals, warnings and findings word for word as the Python model has them."""

from __future__ import annotations

import ctypes
from math import inf, nan, pi
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.collision.bodies import Body
from shipcollision_fmu.collision.checks import check_parameters, check_step
from shipcollision_fmu.collision.contact_problem import ContactSolution
from shipcollision_fmu.collision.delayed_impulses import describe_delayed_impulses
from shipcollision_fmu.collision.diagnosis import Diagnosis
from shipcollision_fmu.collision.dynamics.impulse_ledger import ImpulseLedger
from shipcollision_fmu.collision.feedback import COMMON_FEEDBACKS, SHIP_FEEDBACKS, choose_feedbacks
from shipcollision_fmu.collision.findings import FINDINGS
from shipcollision_fmu.collision.interface import (
    CollisionParameters,
    DiagnosisOutput,
    ShipParameters,
    ShipState,
)
from shipcollision_fmu.collision.proximity import NearPair
from shipcollision_fmu.collision.ship_names import RESERVED, check_ship_names
from shipcollision_fmu.collision.totals import Totals
from shipcollision_fmu.errors import InputError, StepError
from shipcollision_fmu.ship.frames import Array, rotation
from tests.native.collision.kernels import load_kernels
from tests.native.collision.test_bodies import SHIPS, prepare_both

SHIP_COUNT = len(SHIPS)


def say(function: str, *arguments: object) -> list[str]:
    """Lines of a function of kernels_books.cpp."""
    words = ctypes.create_string_buffer(1 << 20)
    function_of_library = load_kernels()[f"shipcollision_{function}"]
    function_of_library.restype = None
    given = [
        ctypes.c_double(a)
        if isinstance(a, float)
        else a.encode()
        if isinstance(a, str)
        else ctypes.c_void_p(a.ctypes.data)
        if isinstance(a, np.ndarray)
        else a
        for a in arguments
    ]
    function_of_library(*given, words)
    return words.value.decode().splitlines()


def refuse(call: object, *arguments: object) -> str:
    """What a call is refused with, or nothing."""
    assert callable(call)
    try:
        call(*arguments)
    except (InputError, StepError) as error:
        return str(error)
    return ""


def pack(numbers: object) -> Array:
    """Numbers as a function of the library takes them."""
    return np.ascontiguousarray(numbers, dtype=float)


def test_numbers_with_decimals() -> None:
    """As Python's format, exactly rounded."""
    random = np.random.default_rng(1)
    numbers = [*(random.normal(0.0, 1.0, 200) * 10.0 ** random.integers(-6, 9, 200)), 0.0, -0.0, 0.5, 1.5, 2.5, 0.05]
    numbers += [0.125, 9.995, 99.5, 0.0004999, 0.0005, -0.5, inf, -inf, nan, 180.0]
    for number in map(float, numbers):
        for decimals in (0, 1, 2, 3):
            assert say("fixed_number", number, decimals) == [f"{number:.{decimals}f}"]


def test_names_of_ships() -> None:
    cases: list[tuple[str, ...]] = [(name,) for name in sorted(RESERVED)]
    cases += [(), ("own", "target"), ("own", "own"), ("own", "2nd"), ("a b",), ("",), ("Å",), ("a-b",), ("_a1", "B")]
    for names in cases:
        words = (ctypes.c_char_p * len(names))(*(name.encode() for name in names))
        assert say("say_names", words, len(names)) == [refuse(check_ship_names, names)]


def test_feedbacks() -> None:
    for own in SHIP_FEEDBACKS:
        for name in ("", "  ", " force ", "prescribed", "common", "ledgers"):
            for common in COMMON_FEEDBACKS:
                parameters = CollisionParameters([ShipParameters(feedback=own, feedback_name=name)], feedback=common)
                expected = refuse(choose_feedbacks, ["own"], parameters)
                if not expected:
                    (expected,) = choose_feedbacks(["own"], parameters)
                number = SHIP_FEEDBACKS.index(own), name, COMMON_FEEDBACKS.index(common)
                assert say("say_feedback", "own", *number) == [expected]


@pytest.mark.parametrize("code", range(1, len(FINDINGS) + 1))
def test_findings(code: int) -> None:
    (finding,) = (finding for number, finding in FINDINGS.values() if number == code)
    for number in (0.0, 0.123456789, -12345.678, inf):
        measured = dict.fromkeys(("moved", "given", "off", "yaw", "overlap", "duration", "share", "mass"), number)
        expected = finding.describe(ship="o'wn", other="other", unit="knots", **measured)
        assert say("say_finding", code, "o'wn", number) == [expected]


def test_warnings_of_delay_and_residual() -> None:
    for t, H, speed, thin in ((12.345678, 0.05, 8.0, 20.0), (1.0, 5.0, 8.1, 20.0), (1e6, 0.1, 123.0, 1e-3)):
        expected = describe_delayed_impulses(t, H, {1: speed}, [(0, 1)], ["own", "target"], lambda a, b, h=thin: h)
        assert say("say_delay", t, H, speed, thin) == [expected]
    for residual in (1e-10, 2.345e-8, 0.5):
        totals = Totals()
        totals.add(ContactSolution([], residual, 3), 0.0, [])
        assert say("say_unconverged", 1.25, 0.05, residual) == [totals.describe_unconverged(1.25, 0.05)]


@pytest.fixture
def bodies(tmp_path: Path) -> list[Body]:
    return prepare_both(tmp_path, "")[:SHIP_COUNT]


@pytest.mark.needs("pybullet")
def test_refusals_of_parameters_and_states(bodies: list[Body]) -> None:
    good = [0.3, 0.0, 0.01, 10.0, 200.0, 0.0, 12.5, 0.05, *[1.0] * 18 * SHIP_COUNT]
    wrong = [(0, -1.0), (0, 11.0), (0, nan), (1, 1.5), (2, 0.0), (3, inf), (4, -2.0), (6, nan), (7, 0.0), (7, inf)]
    wrong += [(8 + 18 * i + k, value) for i, k, value in (
        (0, 0, nan), (1, 4, inf), (2, 6, -1500.0), (3, 11, 700.0), (4, 1, 2e9), (0, 17, nan), (2, 9, 1e200),
    )]  # fmt: skip
    for place, value in [(0, 0.3), *wrong]:
        numbers = list(good)
        numbers[place] = value
        parameters = CollisionParameters([], *numbers[:5])
        states = [
            ShipState(*(row[k : k + 3] for k in range(0, 12, 3)), row[12:])
            for row in (numbers[8 + 18 * i : 26 + 18 * i] for i in range(SHIP_COUNT))
        ]
        expected = [refuse(check_parameters, parameters), refuse(check_step, *numbers[6:8], bodies, states)]
        assert say("say_checks", pack(numbers)) == expected
    for response, name in ((1.0, "closed_form"), (2.0, "bullet")):
        remedy = f"response = {name!r} needs Python: take response 'pgs', or the FMU that runs Python"
        assert say("say_checks", pack([*good[:5], response, *good[6:]])) == [remedy, ""]


SPOILED = {
    "as it should be": lambda ship, k: ship,
    "knots": lambda ship, k: [*ship[:6], *(3600.0 / 1852.0 * v for v in ship[6:9]), *ship[9:]],
    "km/h": lambda ship, k: [*ship[:6], *(3.6 * v for v in ship[6:9]), *ship[9:]],
    "in n": lambda ship, k: [*ship[:6], *(rotation(ship[3:6]) @ ship[6:9]).tolist(), *ship[9:]],
    "no velocity": lambda ship, k: [*ship[:6], 0.0, 0.0, 0.0, *ship[9:]],
    "other": lambda ship, k: [*ship[:6], -ship[6], *ship[7:]],
    "degrees": lambda ship, k: [*ship[:3], *(180.0 / pi * angle for angle in ship[3:6]), *ship[6:]],
    "no rate": lambda ship, k: [*ship[:9], 0.0, 0.0, 0.0, *ship[12:]],
    "rate in degrees": lambda ship, k: [*ship[:9], *(180.0 / pi * rate for rate in ship[9:12]), *ship[12:]],
    "other rate": lambda ship, k: [*ship[:9], *(-2.0 * rate for rate in ship[9:12]), *ship[12:]],
    "no motion": lambda ship, k: [0.0] * 6 + ship[6:],
    "at rest": lambda ship, k: [1.0] * 6 + [0.0] * 12,
    "stays": lambda ship, k: [*ship[:12], *[0.0] * 6],
    "jumps": lambda ship, k: [*(x + (k == 300) * 100.0 for x in ship[:3]), *ship[3:]],
}
"""What a ship model gives wrongly: of position, attitude, velocity, rate and impulse_applied at step k."""


@pytest.mark.slow
@pytest.mark.needs("pybullet")
@pytest.mark.parametrize("answered", [1.0, 0.0, 5.0])
@pytest.mark.parametrize("wrong", SPOILED)
def test_diagnosis(wrong: str, answered: float, bodies: list[Body]) -> None:
    """Ships that turn, of which each is pushed twice and shows `answered` of it: what is said, step by step."""
    steps, H, spoil = 500, 0.05, SPOILED[wrong]
    applied = [np.zeros(6) for _ in bodies]
    velocities = [np.array([4.0 + i, 0.5, 0.0, 0.0, 0.0, 0.02]) for i in range(SHIP_COUNT)]
    poses = [np.array([300.0 * i, 10.0, 0.0, 0.0, 0.0, 0.8 * i]) for i in range(SHIP_COUNT)]
    rows = []
    for k in range(steps):
        row = [k * H, H, float(k in (200, 201, 350))]
        for i, body in enumerate(bodies):
            J = np.array([1.0, -0.5, 0.0, 0.0, 0.0, 10.0]) * 1e-1 * body.bullet.mass * (k in (200, 350))
            row += spoil([*poses[i], *velocities[i], *applied[i]], k) + J.tolist()
            R, nu = rotation(poses[i][3:]), velocities[i]
            poses[i] = poses[i] + H * np.array([*(R @ nu[:3]), 0.0, 0.0, nu[5]])
            applied[i] = applied[i] + J * (answered > 0.0)
            velocities[i] = nu + answered * body.inverse_at([0.0, 0.0, 0.0]) @ J
        rows.append(row)
    gap, absent = (-0.7 if wrong == "jumps" else 1.0), [float(i == 3) for i in range(SHIP_COUNT)]
    assert say("say_diagnosis", steps, pack(rows), pack(absent), gap) == diagnose(rows, bodies, gap)


def diagnose(rows: list[list[float]], bodies: list[Body], gap: float) -> list[str]:
    """What the Python model says."""
    ledgers, inputs, out = [ImpulseLedger() for _ in bodies], [ShipState() for _ in bodies], DiagnosisOutput()
    diagnosis = Diagnosis(bodies, [body.feedback for body in bodies], ledgers, inputs, out)
    lines = []
    for step, (t, H, touched, *rest) in enumerate(rows):
        for i, (ship, body, ledger) in enumerate(zip(inputs, bodies, ledgers, strict=True)):
            row = rest[24 * i : 24 * i + 24]
            ship.position[:], ship.attitude[:], ship.velocity[:], ship.rate[:] = (row[k : k + 3] for k in (0, 3, 6, 9))
            ship.impulse_applied[:] = row[12:18]
            nu, R = np.array(row[6:12]), rotation(ship.attitude)
            reading = ledger.read(
                body.feedback, np.array(row[:3]), R, nu, np.array(row[12:18]), body.inverse_at(ship.attitude), 100.0, H
            )
            ledger.close(reading, np.array(row[18:]), reading.nu, reading.x, reading.R)
        if t >= diagnosis.due or touched:
            said = diagnosis.examine(t, H, {3}, {(0, 1): NearPair(gap, 0.0)}, bool(touched))
            lines += [f"{step} {said}"] if said else []
    return [*lines, f"{out.code} {out.ship} {out.count} {out.text}"]
