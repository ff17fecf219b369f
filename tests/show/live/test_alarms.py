"""Alarms of the live page: raised, silent, over (IEC 62923)."""

from __future__ import annotations

from typing import Any

from .javascript import run_javascript

BODY = """
const alarms = new Alarms();
return data.map((step) => {
  if (step === "acknowledge") alarms.acknowledge();
  else alarms.set(step[0], step[1], step[2], () => step[3] ?? step[0], step[4] && (() => step[4]));
  return { words: [...alarms.list.values()].map(({ words }) => words()),
           states: Object.fromEntries([...alarms.list].map(([key, { state }]) => [key, state])),
           sounding: alarms.sounding, order: alarms.sorted.map(({ key }) => key) };
});
"""


def play(*steps: Any) -> list[Any]:
    found: list[Any] = run_javascript("live/alarms.js", "Alarms", BODY, list(steps))
    return found


def test_an_alarm_sounds_until_it_is_acknowledged_and_stays_until_its_cause_is_gone() -> None:
    here, gone = ("contact", True, "alarm"), ("contact", False, "alarm")
    raised, again, silent, still, over = play(here, here, "acknowledge", here, gone)
    assert raised["states"] == again["states"] == {"contact": "raised"}
    assert raised["sounding"] == "alarm"
    assert silent["states"] == still["states"] == {"contact": "silent"}
    assert silent["sounding"] is None
    assert over["states"] == {}


def test_one_that_nobody_saw_is_kept_and_comes_back_raised() -> None:
    here, gone = ("cpa", True, "alarm"), ("cpa", False, "alarm")
    _, over, back, _, _ = play(here, gone, here, gone, "acknowledge")
    assert over["states"] == {"cpa": "over"}
    assert over["sounding"] is None
    assert back["states"] == {"cpa": "raised"}
    assert play(here, gone, "acknowledge")[-1]["states"] == {}


def test_an_alarm_that_is_over_shows_no_number_of_before() -> None:
    """It would be old; the number that runs on is that of the cause."""
    steps = [("cpa", is_there, "alarm", f"CPA {cpa}", "over") for is_there, cpa in ((True, 3), (True, 2), (False, 1))]
    assert [step["words"] for step in play(*steps)] == [["CPA 3"], ["CPA 2"], ["over"]]


def test_a_caution_makes_no_sound_and_goes_by_itself() -> None:
    there, away = play(("slow", True, "caution"), ("slow", False, "caution"))
    assert there["sounding"] is None
    assert away["states"] == {}


def test_the_most_urgent_to_acknowledge_comes_first_then_the_others_by_priority() -> None:
    *_, last = play(("cpa", True, "alarm"), "acknowledge", ("slow", True, "caution"), ("lost", True, "warning"))
    assert last["order"] == ["lost", "cpa", "slow"]
    assert last["sounding"] == "warning"
