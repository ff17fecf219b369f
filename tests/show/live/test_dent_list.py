"""Dents of a run that goes on: the largest of all collisions so far."""

from __future__ import annotations

from typing import Any

from .javascript import run_javascript

LIST = """
    const shown = [];
    const log = [];
    const list = new DentList((dents) => {
      shown.push(...dents);
      log.push(`+${dents.map(({ ship }) => ship)}`);
      return () => {
        log.push(`-${dents.map(({ ship }) => ship)}`);
        for (const dent of dents) shown.splice(shown.indexOf(dent), 1);
      };
    });
    const infos = (...names) => names.map((name) => ({ name, L_pp: 100 }));
    return data.map((step) => {
      log.length = 0;
      if (step === "clear") list.clear();
      else {
        const [id, energy, ship_a, ship_b, x] = step;
        list.meet(`${id}`, { id, time: id, energy, ship_a, ship_b, a: [x, 5, 0], b: [0, 5, 0] }, infos(ship_a, ship_b));
      }
      return {
        energies: shown.map(({ energy }) => energy / 1e6).sort((a, b) => b - a),
        bows: shown.filter(({ kind }) => kind === "bow").map(({ ship, energy }) => `${ship} ${energy / 1e6}`),
        same: shown.length === list.dents.length, log: [...log],
      };
    });
"""


def play(*steps: Any) -> list[Any]:
    found: list[Any] = run_javascript("live/dent_list.js", "DentList", LIST, list(steps))
    assert all(step["same"] for step in found)
    return found


def hit(number: int, megajoules: float, ships: str = "ab", x: float = 0.0) -> list[Any]:
    """Side to side amidships, or with a bow of the first ship: `x` [m] of 100 m."""
    return [number, megajoules * 1e6, *ships, x]


def test_a_picture_has_the_eight_of_the_greatest_energies() -> None:
    """Two dents a collision; the fifth is smaller than three others, the sixth the greatest, the seventh the least."""
    found = play(*(hit(k, energy) for k, energy in enumerate([50.0, 40.0, 30.0, 20.0, 25.0, 90.0, 5.0])))
    assert [len(step["energies"]) for step in found] == [2, 4, 6, 8, 8, 8, 8]
    assert found[4]["energies"] == [50.0, 50.0, 40.0, 40.0, 30.0, 30.0, 25.0, 25.0]
    assert found[5]["energies"] == found[6]["energies"] == [90.0, 90.0, 50.0, 50.0, 40.0, 40.0, 30.0, 30.0]
    assert found[6]["log"] == []  # nothing is made for what is too small


def test_dents_are_made_anew_with_half_as_much_energy_again() -> None:
    found = play(hit(1, 10.0), hit(1, 14.0), hit(1, 16.0), hit(2, 0.001))
    assert [step["energies"] for step in found] == [[10.0, 10.0], [10.0, 10.0], [16.0, 16.0], [16.0, 16.0]]
    assert [step["log"] for step in found] == [["+a,b"], [], ["-a,b", "+a,b"], []]


def test_a_bow_is_crushed_once_by_the_greatest_energy() -> None:
    found = play(hit(1, 10.0, "ab", 49.0), hit(2, 5.0, "ac", 49.0), hit(3, 30.0, "ad", 49.0))
    assert [step["bows"] for step in found] == [["a 10"], ["a 10"], ["a 30"]]
    assert found[1]["log"] == ["+c"]
    assert found[2]["log"] == ["-a,b", "+b", "+a,d"]  # it is whole before it is crushed anew


def test_going_back_takes_all_away_and_they_come_again() -> None:
    found = play(hit(1, 10.0), "clear", hit(1, 10.0))
    assert [len(step["energies"]) for step in found] == [2, 0, 2]
