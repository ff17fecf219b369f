"""Standard trials: published turning circles, plausible zigzags, mirror images, limits, refusals."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from shipcollision_fmu.cli.trial_table import format_track_csv
from shipcollision_fmu.errors import ScenarioError, ShipError, StepError
from shipcollision_fmu.manoeuvring.trials.steady_course import find_self_propulsion, find_steady_course
from shipcollision_fmu.manoeuvring.trials.trial import Figure, Trial
from shipcollision_fmu.manoeuvring.trials.trials import sail_crash_stop, sail_turning_circle, sail_zigzag


@cache
def circle(ship: str, port: bool) -> Trial:
    return sail_turning_circle(find_steady_course(ship), 35.0, port=port)


@pytest.mark.parametrize(
    ("ship", "port", "advance", "diameter"),
    [
        # Yasukawa & Yoshimura (2015), J. Mar. Sci. Technol. 20:37-52: table 6, computed; L7 also table 4, measured
        ("kvlcc2", False, 3.62, 3.71), pytest.param("kvlcc2", True, 3.56, 3.59, marks=pytest.mark.slow),
        ("kvlcc2_l7", False, 3.31, 3.36), ("kvlcc2_l7", True, 3.26, 3.26),
        ("kvlcc2_l7", False, 3.25, 3.34), ("kvlcc2_l7", True, 3.11, 3.08),
    ],
)  # fmt: skip
def test_turning_circles_of_yasukawa_and_yoshimura_2015(ship: str, port: bool, advance: float, diameter: float) -> None:
    sailed = circle(ship, port)
    assert (sailed["advance"], sailed["tactical diameter"]) == pytest.approx((advance, diameter), rel=0.10)


def test_a_steady_turn_is_a_circle_of_its_radius() -> None:
    """Its radius is U/r, and smaller than half the tactical diameter: the ship has lost speed and drifts."""
    sailed = circle("kvlcc2", False)
    end = sailed.track[-1]
    assert sailed["steady radius"] == pytest.approx(end.speed / end.yaw_rate / 320.0)
    assert 2 * sailed["steady radius"] < sailed["tactical diameter"]
    assert 5.0 < sailed["drift angle"] < 30.0
    assert 0.2 < sailed["speed kept"] < 0.5


def test_limits_are_those_of_the_resolution_at_35_degrees() -> None:
    limits = {name: figure.limit for name, figure in circle("kvlcc2", False).figures.items() if figure.limit}
    assert limits == {"advance": 4.5, "tactical diameter": 5.0}
    assert all(f.within is (None if f.limit is None else True) for f in circle("kvlcc2", False).figures.values())
    assert circle("kvlcc2", False).doubt == ""
    gentle = sail_turning_circle(find_steady_course("kvlcc2"), 20.0)
    assert {figure.limit for figure in gentle.figures.values()} == {None}
    assert gentle["tactical diameter"] > circle("kvlcc2", False)["tactical diameter"]
    assert Figure("x", 2.0, "L", 1.0).within is False


@pytest.mark.slow
@pytest.mark.parametrize("port", [False, True])
def test_zigzag_overshoots_are_plausible(port: bool) -> None:
    """A full tanker: the first 10/10 overshoot 3 to 12 deg, the second larger to starboard first, 20/20 below 20."""
    ten = sail_zigzag(find_steady_course("kvlcc2"), 10.0, 10.0, port=port)
    assert 3.0 < ten["first overshoot"] < 12.0
    assert ten["first overshoot"] < ten["second overshoot"] < 30.0
    assert ten.figures["first overshoot"].limit == 20.0  # L/V = 40 s
    assert ten.figures["second overshoot"].limit == 40.0
    assert 1.0 < ten["initial turning"] < ten.figures["initial turning"].limit == 2.5
    twenty = sail_zigzag(find_steady_course("kvlcc2"), 20.0, 20.0, port=port)
    assert 8.0 < twenty["first overshoot"] < 20.0
    assert twenty.figures["first overshoot"].limit == 25.0
    assert twenty["second execute"] < twenty["third execute"]


@pytest.mark.parametrize(("speed", "first", "second"), [(1.179, 10.0, 25.0), (0.35, 15.0, 32.5)])
def test_overshoot_limits_follow_length_over_speed(speed: float, first: float, second: float) -> None:
    """L7: 5.9 s is below 10 s; 20 s lies between 10 and 30 s."""
    sailed = sail_zigzag(find_steady_course("kvlcc2_l7", speed=speed), 10.0, 10.0)
    assert sailed.figures["first overshoot"].limit == pytest.approx(first, abs=1e-9)
    assert sailed.figures["second overshoot"].limit == pytest.approx(second, abs=1e-9)


SYMMETRIC = """
extends = "kvlcc2"
[propeller]
C_2_plus = 1.4
C_2_minus = 1.4
[rudder]
gamma_R_plus = 0.5
gamma_R_minus = 0.5
"""


@pytest.mark.slow
def test_a_symmetric_ship_sails_mirror_images(tmp_path: Path) -> None:
    path = tmp_path / "symmetric.toml"
    path.write_text(SYMMETRIC, encoding="utf-8")
    start = find_steady_course(str(path))
    for starboard, port in (
        (sail_turning_circle(start, 35.0), sail_turning_circle(start, 35.0, port=True)),
        (sail_zigzag(start, 20.0, 20.0), sail_zigzag(start, 20.0, 20.0, port=True)),
    ):
        assert {name: f.value for name, f in starboard.figures.items()} == {n: f.value for n, f in port.figures.items()}
        a, b = starboard.track[-1], port.track[-1]
        assert (a.x, a.y, a.heading, a.yaw_rate) == (b.x, -b.y, -b.heading, -b.yaw_rate)


def test_a_crash_stop_ends_with_no_way_on() -> None:
    sailed = sail_crash_stop(find_steady_course("kvlcc2"))
    assert sailed.track[-1].surge <= 0.0 < sailed.track[-2].surge
    reach = sailed.figures["track reach"]
    assert (reach.limit, reach.waived, reach.within) == (15.0, 20.0, False)
    assert 12.0 < sailed["head reach"] <= reach.value < 20.0  # loaded VLCCs: 12 to 20 lengths
    assert sail_crash_stop(find_steady_course("kcs")).figures["track reach"].within
    slower = sail_crash_stop(find_steady_course("kvlcc2", speed=4.0))
    assert slower["track reach"] < sailed["track reach"]


def test_self_propulsion_is_the_service_point_or_the_balance(tmp_path: Path) -> None:
    """KVLCC2's file gives the balance itself, so both ways agree to its digits."""
    path = tmp_path / "silent.toml"
    text = Path("models/ships/kvlcc2.toml").read_text(encoding="utf-8")
    path.write_text("\n".join(line for line in text.splitlines() if not line.startswith("service_")), encoding="utf-8")
    assert find_self_propulsion("kvlcc2", 7.974) == 1.2268
    assert find_self_propulsion(str(path), 7.974) == pytest.approx(1.2268, rel=1e-3)
    assert find_self_propulsion(str(path), 4.0) == pytest.approx(find_self_propulsion("kvlcc2", 4.0), rel=1e-3)
    with pytest.raises(
        ScenarioError, match=r"silent.toml' gives no service_speed in \[propeller\]: give --speed in m/s"
    ):
        find_steady_course(str(path))
    with pytest.raises(ScenarioError, match=r"does not reach 20 m/s with its engine's 1.6 rev/s: go slower"):
        find_steady_course(str(path), speed=20.0)


def test_the_track_reads_back_as_the_same_doubles() -> None:
    sailed = sail_crash_stop(find_steady_course("kvlcc2_l7"))
    header, *rows = format_track_csv(sailed).splitlines()
    assert header.split(",")[:4] == ["time", "x", "y", "heading"]
    assert [float(cell) for cell in rows[7].split(",")] == list(vars(sailed.track[7]).values())
    assert len(rows) == len(sailed.track)


def test_what_cannot_be_sailed_is_refused_in_one_line() -> None:
    start = find_steady_course("kvlcc2")
    for bad in (0.0, -10.0, 36.0, float("nan")):
        with pytest.raises(
            ScenarioError, match=r"rudder_deg = .* at most the rudder's max_angle_deg = 35 of ship 'kvlcc2'"
        ):
            sail_turning_circle(start, bad)
    with pytest.raises(ScenarioError, match=r"heading_deg = 90 must be greater than 0 and at most 60: e.g. 10 or 20"):
        sail_zigzag(start, 10.0, 90.0)
    with pytest.raises(ShipError, match=r"unknown ship 'kvlc2': did you mean kvlcc2\?"):
        find_steady_course("kvlc2")
    with pytest.raises(
        ScenarioError, match=r"ship 'guan2014_own' has no \[manoeuvring\].* so it can only coast: take one"
    ):
        find_steady_course("guan2014_own")
    for speed in (0.0, -5.0, 55.0, float("inf")):
        with pytest.raises(
            ScenarioError, match=r"speed = .* m/s must be above 0 and at most 50: give metres per second"
        ):
            find_steady_course("kvlcc2", speed=speed)
    with pytest.raises(ScenarioError, match=r"needs 1.846 rev/s for 12 m/s; .* its engine's 1.6: take a lower speed"):
        find_steady_course("kvlcc2", speed=12.0)
    with pytest.raises(ScenarioError, match=r"cannot stop with 2 rev/s astern: .* max_astern_rev_per_s = 1"):
        sail_crash_stop(start, rev_per_s=2.0)


def test_a_trial_that_does_not_end_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shipcollision_fmu.manoeuvring.trials.trial.PATIENCE", 2.0)
    with pytest.raises(StepError, match=r"ship 'kvlcc2': the crash stop has not ended after 2 lengths at 7.974 m/s"):
        sail_crash_stop(find_steady_course("kvlcc2"))
