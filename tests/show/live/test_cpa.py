"""CPA and TCPA of the live page, by the closed form, against a search for the least distance that knows no formula."""

from __future__ import annotations

from math import hypot
from typing import Any

import numpy as np
import pytest

from .javascript import run_javascript

NAUTICAL_MILE, KNOT = 1852.0, 1852.0 / 3600.0
LIMITS = {"cpa": 500.0, "tcpa": 600.0}
Case = tuple[dict[str, list[float]], dict[str, list[float]]]


def approaches(cases: list[Case]) -> list[Any]:
    """What the page's module says of cases."""
    body = """return data.cases.map(([own, other]) => (
        { ...closestApproach(own, other), close: isTooClose(own, other, data.limits) }));"""
    found: list[Any] = run_javascript(
        "live/cpa.js", "closestApproach, isTooClose", body, {"cases": cases, "limits": LIMITS}
    )
    return found


def body(position: list[float], velocity: list[float]) -> dict[str, list[float]]:
    return {"position": position, "velocity": velocity}


def search_least(case: Case) -> tuple[float, float]:
    """Time and distance of the least distance in 2 h before and after, by bracketing: each round takes the best of 2001
    times and looks between its neighbours."""
    (p, v), (q, w) = ((np.array(one["position"]), np.array(one["velocity"])) for one in case)
    low, high = -7200.0, 7200.0
    for _ in range(5):
        times = np.linspace(low, high, 2001)
        distance = np.linalg.norm((q + np.outer(times, w)) - (p + np.outer(times, v)), axis=1)
        best = int(distance.argmin())
        low, high = times[max(best - 1, 0)], times[min(best + 1, 2000)]
    return float(times[best]), float(distance[best])


def test_cpa_by_formula_is_the_least_distance_found_by_search() -> None:
    rng = np.random.default_rng(18)
    cases: list[Case] = []
    while len(cases) < 200:
        places, speeds = rng.uniform(-4000.0, 4000.0, (2, 2)), rng.uniform(-10.0, 10.0, (2, 2))
        if hypot(*(speeds[0] - speeds[1])) > 2.0:  # the CPA is then within 2 h
            cases.append(
                (body(*np.array([places[0], speeds[0]]).tolist()), body(*[places[1].tolist(), speeds[1].tolist()]))
            )
    for case, found in zip(cases, approaches(cases), strict=True):
        time, distance = search_least(case)
        assert found["cpa"] == pytest.approx(distance, abs=1e-6)
        assert found["tcpa"] == pytest.approx(time, abs=1e-2)
        gap = np.array(found["other"]) - np.array(found["own"])
        assert hypot(*gap) == pytest.approx(found["cpa"], rel=1e-12)
        own = np.array(case[0]["position"]) + found["tcpa"] * np.array(case[0]["velocity"])
        assert found["own"] == pytest.approx(own.tolist(), rel=1e-12)


def test_cases_that_are_worked_out_by_hand() -> None:
    """Two ships at 10 kn meet head on, 0.2 nautical miles to the side of each other and 2 apart: the CPA is 0.2 miles,
    in 6 min. One that is overtaken the same way; a crossing; no motion; a CPA that is past."""
    knots = 10.0 * KNOT
    own = body([0.0, 0.0], [knots, 0.0])
    meeting = body([2.0 * NAUTICAL_MILE, 0.2 * NAUTICAL_MILE], [-knots, 0.0])
    crossing = body([1000.0, 1000.0], [0.0, -knots])
    beside = body([0.0, 700.0], [knots, 0.0])
    past = body([-1000.0, 0.0], [-knots, 0.0])
    found = approaches([(own, meeting), (own, crossing), (own, beside), (own, past)])
    assert [one["cpa"] for one in found] == pytest.approx([0.2 * NAUTICAL_MILE, 0.0, 700.0, 0.0], abs=1e-9)
    assert [one["tcpa"] for one in found] == pytest.approx([360.0, 1000.0 / knots, 0.0, -500.0 / knots], rel=1e-12)
    assert found[2]["own"] == [0.0, 0.0]
    assert [one["close"] for one in found] == [True, True, False, False]


@pytest.mark.parametrize(("tcpa", "is_close"), [(599.0, True), (601.0, False)])
def test_a_cpa_beyond_the_limit_in_time_alarms_nobody(tcpa: float, is_close: bool) -> None:
    """The other lies ahead, still, off the course by 499 m or by 501 m; or 400 m away on the same course."""
    own = body([0.0, 0.0], [5.0, 0.0])
    ahead, off, beside = (
        body([5.0 * tcpa, 499.0], [0.0, 0.0]),
        body([5.0 * tcpa, 501.0], [0.0, 0.0]),
        body([0.0, 400.0], [5.0, 0.0]),
    )
    assert [one["close"] for one in approaches([(own, ahead), (own, off), (own, beside)])] == [is_close, False, True]


def test_a_cpa_that_is_past_alarms_nobody_however_near_the_other_is() -> None:
    own, astern = body([0.0, 0.0], [5.0, 0.0]), body([-400.0, 0.0], [0.0, 0.0])
    (found,) = approaches([(own, astern)])
    assert found["tcpa"] == pytest.approx(-80.0)
    assert not found["close"]
