"""Each mechanism of the collision model, switched off in turn: a named behaviour test must fail.

A mechanism that can be switched off unnoticed has no test, or is not needed. The behaviour tests run here in process,
unchanged, with the mechanism replaced. With the mechanism in place they run in their own files.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import pytest

from shipcollision_fmu.collision import conservative_advancement, exchange, model, responses
from shipcollision_fmu.collision.dynamics import impulse_ledger
from shipcollision_fmu.collision.dynamics.body_state import BodyState
from shipcollision_fmu.collision.dynamics.contact import Booked
from shipcollision_fmu.collision.dynamics.impulse_ledger import ImpulseLedger, Reading
from shipcollision_fmu.collision.geometry import detection, first_touch
from shipcollision_fmu.collision.geometry.narrow_phase import Closest
from shipcollision_fmu.collision.solvers import gauss_seidel, touching_pair, work_limit
from shipcollision_fmu.collision.solvers import held_motions as held_motions_solver
from shipcollision_fmu.collision.solvers.aitken import Aitken
from tests.collision import test_bounded_step as bounded
from tests.collision import test_coasting_ships as coasting_ships
from tests.collision import test_energy_split as energy_split
from tests.collision import test_first_touch as touches
from tests.collision import test_held_motions as held_motions
from tests.collision import test_mechanisms as mechanisms
from tests.collision import test_model as impacts
from tests.collision import test_one_step_delay as delay
from tests.collision import test_quay as quay
from tests.collision import test_random_encounters as encounters
from tests.collision import test_similarity as similarity
from tests.collision.geometry import test_compound_hull as compound
from tests.collision.geometry.test_compound_hull import pair, sailed
from tests.collision.solvers import test_gauss_seidel as patches
from tests.collision.test_bounded_step import box, last_resort
from tests.collision.test_first_touch import boat
from tests.collision.test_held_motions import WEST
from tests.collision.test_quay import berthed

__all__ = ["berthed", "boat", "box", "last_resort", "pair", "sailed"]

Fixture = Callable[[str], Any]
NOTHING = np.zeros(6)


class Ablation(NamedTuple):
    """What is replaced (owner, name), by what, and the behaviour test that fails then, given fixtures by name."""

    owner: object
    name: str
    replacement: object
    behaviour: Callable[[Fixture], None]


def without_in_readings(**fields: object) -> Any:
    """ImpulseLedger.read with fields of every reading replaced; nu=None: the twist as received, nothing pending."""
    read = ImpulseLedger.read

    def altered(self: ImpulseLedger, feedback: str, x: Any, R: Any, nu: Any, *rest: Any) -> Reading:
        new = fields if fields.get("nu", ...) is not None else {"nu": nu}
        return read(self, feedback, x, R, nu, *rest)._replace(**new)

    return altered


def without_in_forces(**fields: object) -> Any:
    """estimate_other_forces with fields of every estimate replaced."""
    estimate = exchange.estimate_other_forces

    def altered(*args: Any) -> Any:
        forces = estimate(*args)
        return None if forces is None else forces._replace(**fields)

    return altered


def bullets_normal(
    detector: detection.Detector, a: int, b: int, touching: Sequence[Closest], states: Sequence[BodyState]
) -> tuple[int, list[float]]:
    """In place of the normal of least overlap in plan: that of least overlap in space."""
    return 0, (touching[0].normal @ states[a].R).tolist()


def split_across_the_normal(booked: Sequence[Booked], *_: object) -> list[tuple[float, float]]:
    """In place of the split along the impact process: the parts of P.(v- + v+)/2 along and across the normal."""
    along = [-0.5 * float(b.impulse.P @ (n := b.impulse.contact.normal) * (b.before + b.after) @ n) for b in booked]
    return [(x, b.lost - x) for x, b in zip(along, booked, strict=True)]


class Forgetful(dict[Any, Any]):
    """A dictionary that keeps nothing."""

    def __setitem__(self, key: Any, value: Any) -> None: ...


class CachesWithoutNormals(model.ContactCaches):
    """Caches that forget the last normals."""

    def __init__(self) -> None:
        super().__init__()
        self.last_normals = Forgetful()


def two(test: Callable[..., None], *arguments: object) -> Callable[[Fixture], None]:
    """A behaviour test of the fixtures make_ship and world, and of arguments."""
    return lambda fixture: test(fixture("make_ship"), fixture("world"), *arguments)


def one(name: str, test: Callable[..., None], *arguments: object) -> Callable[[Fixture], None]:
    """A behaviour test of one fixture and of arguments."""
    return lambda fixture: test(fixture(name), *arguments)


ABLATIONS = {
    # -- solvers
    "held motions that yield to friction": Ablation(
        responses, "held_delassus", lambda *_: None,
        two(held_motions.test_a_struck_ship_rolls_in_four_degrees_of_freedom_as_in_six, "pgs", 3.0, 0.0, WEST, 2.0),
    ),
    "energy split along the impact process": Ablation(
        model, "split_losses", split_across_the_normal,
        two(energy_split.test_a_raked_stem_that_stops_sliding_on_a_side, 4),
    ),
    "slip of held motions at a sloping normal": Ablation(
        held_motions_solver, "ROUNDS", 0,
        two(held_motions.test_a_struck_ship_rolls_in_four_degrees_of_freedom_as_in_six, "pgs", 8.0, 30.0, WEST, 15.0),
    ),
    "Aitken's extrapolation": Ablation(
        Aitken, "extrapolate", lambda self, P, last: P,
        one("berthed", mechanisms.test_a_ship_that_slides_along_a_quay_costs_few_sweeps),
    ),
    "warm start": Ablation(
        responses, "guess_impulses", lambda *_: None,
        one("berthed", mechanisms.test_a_ship_at_rest_at_a_quay_costs_one_sweep_per_substep),
    ),
    "Alart-Curnier and ACLM": Ablation(
        gauss_seidel, "_solve_together", lambda W, v, mu, P, *rest: P,
        two(mechanisms.test_three_ships_abreast_at_a_quay_are_solved),
    ),
    "Alart-Curnier": Ablation(
        gauss_seidel, "solve_alart_curnier", lambda W, v, mu, P, *rest: P,
        lambda fixture: patches.test_wedges_are_solved_by_newtons_method_and_aclm_in_turns((9, 6, 4, 1.0)),
    ),
    "ACLM": Ablation(
        gauss_seidel, "solve_aclm", lambda W, v, mu, P, *rest: P,
        lambda fixture: patches.test_wedges_are_solved_by_newtons_method_and_aclm_in_turns((35, 3, 4, 1.0)),
    ),
    "resultant of a patch": Ablation(
        touching_pair, "reduce_to_resultant", lambda contacts, *_: contacts[0],
        one("berthed", quay.test_a_minute_at_the_quay, "gauss-seidel", "closed_form"),
    ),
    # -- dynamics
    "passivity": Ablation(
        model, "enforce_passivity", lambda impulses, states: (list(impulses), False),
        one("berthed", mechanisms.test_a_wind_that_dies_away_lets_no_contact_add_energy, "pgs", 1.0),
    ),
    "other forces": Ablation(
        exchange, "estimate_other_forces", lambda *_: None,
        one("berthed", quay.test_a_minute_at_the_quay, "gauss-seidel", "pgs"),
    ),
    "velocity gained before a delayed impulse": Ablation(
        exchange, "estimate_other_forces", without_in_forces(velocity_gain=NOTHING),
        one("berthed", quay.test_a_minute_at_the_quay, "jacobi", "pgs"),
    ),
    "error of the ship's integration scheme": Ablation(
        exchange, "estimate_other_forces", without_in_forces(scheme_error=None),
        one("berthed", quay.test_however_a_ship_model_integrates_she_stays, "gauss-seidel", 0.5, 1.0),
    ),
    "pending impulse": Ablation(
        ImpulseLedger, "read", without_in_readings(nu=None),
        two(impacts.test_head_on_equal_boxes_end_together, "jacobi"),
    ),
    "deficit": Ablation(
        ImpulseLedger, "read", without_in_readings(deficit=NOTHING),
        two(impacts.test_oblique_impact_balances_and_loses_energy, "jacobi", "pgs"),
    ),
    "one-step delay": Ablation(
        ImpulseLedger, "read", without_in_readings(one_step_delay=False),
        two(delay.test_a_ship_springs_between_two_walls_without_losing_or_gaining, 3, "straight", "jacobi"),
    ),
    "law of coasting": Ablation(
        exchange, "_follow", lambda *_: None,
        two(coasting_ships.test_both_models_find_the_same_motion, 3, True),
    ),
    "law of coasting of a ship with a one-step delay": Ablation(
        exchange, "_follow", lambda *_: None,
        two(delay.test_a_ship_springs_between_two_walls_without_losing_or_gaining, 3, "kirchhoff", "jacobi"),
    ),
    "no deficit for bodies out of range": Ablation(
        impulse_ledger, "_is_out_of_range", lambda *_: False,
        one("world", encounters.test_two_hundred_random_encounters, 0),
    ),
    "conservative advancement": Ablation(
        conservative_advancement.ConservativeAdvancement, "_free_substeps", lambda *_: 0,
        lambda fixture: mechanisms.test_ships_that_approach_are_examined_when_they_could_meet(
            fixture("make_ship"), fixture("world"), fixture("monkeypatch")
        ),
    ),
    "bound on the work of a step": Ablation(
        work_limit.StepWork, "renew", lambda *_: None,
        lambda fixture: bounded.test_an_early_end_keeps_momentum_and_moves_each_ship_by_its_impulse(
            fixture("world"), fixture("box"), fixture("last_resort"), fixture("monkeypatch"), 0.5
        ),
    ),
    "bound on the pairs examined at first touches": Ablation(
        conservative_advancement, "MOST_EXAMINED", 10**6,
        lambda fixture: bounded.test_boats_that_rattle_between_a_ship_and_a_quay(
            fixture("world"), fixture("tmp_path"), fixture("monkeypatch"), "pgs"
        ),
    ),
    # -- geometry
    "first touch": Ablation(
        detection.Detector, "first_touch", lambda *_: None,
        lambda fixture: touches.test_a_boat_stops_dead_at_a_thin_pole(
            fixture("world"), fixture("boat"), touches.FEW, touches.MOTOR_BOAT
        ),
    ),
    "touching on at another place": Ablation(
        first_touch._Parts, "_touch_on", lambda *_: None,
        lambda fixture: touches.test_a_log_that_was_hit_at_one_end_meets_with_the_other(
            fixture("world"), fixture("boat")
        ),
    ),
    "return to a missed first touch": Ablation(
        detection.Detector, "misses_first_touch", lambda *_: False,
        lambda fixture: touches.test_corners_that_graze_by_a_centimetre_meet_end_on(fixture("world"), fixture("boat")),
    ),
    "steep normals that follow the last": Ablation(
        detection, "STEEP", 2.0,
        lambda fixture: touches.test_a_ship_that_is_driven_on_does_not_pass_over_a_low_rock(
            fixture("world"), fixture("boat")
        ),
    ),
    "normals that follow a thin hull": Ablation(
        detection, "FOLLOWS", 2.0,
        lambda fixture: touches.test_a_ship_slides_along_a_pole_that_is_inside_it(fixture("world"), fixture("boat")),
    ),
    "overlap in plan": Ablation(
        detection.Detector, "_plan_normal", bullets_normal,
        two(mechanisms.test_a_ship_put_deep_inside_another_is_stopped_sideways, "pgs"),
    ),
    "last normals in deep overlap": Ablation(
        model, "ContactCaches", CachesWithoutNormals,
        two(mechanisms.test_the_side_that_was_struck_stays_the_side_in_deep_overlap),
    ),
    "contact points of a manifold": Ablation(
        detection, "contact_manifold", lambda *_: [],
        one("berthed", quay.test_a_minute_at_the_quay, "gauss-seidel", "pgs"),
    ),
    "corners that touch flush": Ablation(
        detection, "FLUSH", 0.0,
        two(mechanisms.test_ships_that_meet_flush_touch_with_all_corners),
    ),
    "compound hulls: supported points": Ablation(
        detection, "select_supported", lambda touching, *_: touching,
        one("pair", compound.test_a_stem_on_a_side_in_pieces_touches_it_as_on_one_box, -60.0, 0.3),
    ),
    "compound hulls: one contact of a face in pieces": Ablation(
        detection, "merge_coplanar", lambda contacts: contacts,
        one("pair", compound.test_side_on_side_gives_the_corners_of_the_common_area_only, 0.0),
    ),
    "lengths that shrink with small hulls": Ablation(
        detection.Detector, "_scale", lambda *_: 1.0,
        lambda fixture: similarity.test_a_scaled_impact_is_the_impact_scaled(
            fixture("world"), fixture("tmp_path"), "side on side", 0.022
        ),
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("mechanism", ABLATIONS)
def test_no_mechanism_can_be_switched_off_unnoticed(
    mechanism: str, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    ablation = ABLATIONS[mechanism]
    monkeypatch.setattr(ablation.owner, ablation.name, ablation.replacement)
    with pytest.raises(AssertionError):
        ablation.behaviour(request.getfixturevalue)
