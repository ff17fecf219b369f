"""run_encounters(): scenarios by the thousand, each a whole run in one call of the native library.

The native library holds the master's loop, the ship models, the collision model and the helms. Its numbers are those of
simulate(): the same models in the same order. It keeps no tables over time unless tracks are asked for.
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import closing
from math import isfinite
from numbers import Real
from pathlib import Path

from ..errors import InputError, ScenarioError
from ..scenario.scenario import Scenario, load_scenario
from .encounter_case import make_case
from .encounter_tables import EncounterBook, Encounters
from .native_encounters import NativeEncounters
from .prepared_ships import PreparedShips

__all__ = ["check_separation", "run_encounters"]


def run_encounters(
    scenarios: Iterable[Scenario | str | Path],
    *,
    algorithm: str | None = None,
    step: float | None = None,
    separation: float | None = None,
    tracks: bool = False,
) -> Encounters:
    """The encounters of scenarios, of their names or of their paths.

    algorithm, step   replace those of the scenarios, as in simulate()
    separation        time [s] without contact after a collision, after which an encounter ends; None: at its duration
    tracks            whether the states at all communication points are kept

    A scenario that is refused, or whose models refuse a step, is a row with a status other than zero and the reason.
    Raises ScenarioError for a separation that is no time, and for what is no list; HostError when there is no native
    library and no compiler.
    """
    check_separation("run_encounters", separation)
    if isinstance(scenarios, str | Scenario) or not isinstance(scenarios, Iterable):
        named = "a Scenario" if isinstance(scenarios, Scenario) else repr(scenarios)
        raise ScenarioError(f"run_encounters: {named} is no list of scenarios: give [scenario], or more of them")
    book = EncounterBook(tracks)
    with PreparedShips() as files, closing(NativeEncounters()) as native:
        for given in scenarios:
            try:
                scenario = given if isinstance(given, Scenario) else load_scenario(given)
                scenario = scenario.changed(algorithm=algorithm, step=step)
                case = make_case(scenario, files, separation)
            except InputError as error:
                book.refuse(str(error))
                continue
            book.add(native.run(case, has_track=tracks), [*scenario.ships, *scenario.obstacles])
    return book.build_tables()


def check_separation(caller: str, separation: float | None) -> None:
    """Raises ScenarioError for a separation that is no time [s]."""
    if separation is not None and not (isinstance(separation, Real) and isfinite(separation) and separation >= 0.0):
        raise ScenarioError(f"{caller}: separation = {separation!r} must be seconds, at least 0, e.g. 10.0")
