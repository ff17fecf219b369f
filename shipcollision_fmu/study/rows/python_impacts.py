"""PythonImpacts: the impacts of a pair of ships by the Python model; the twin of native/batch/impact.cpp.

The same steps with the same numbers: the ships are put where their sections touch, and the collision model answers one
step of an instant.
"""

from __future__ import annotations

from math import cos, hypot, inf, radians, sin
from typing import Any

import numpy as np
import numpy.typing as npt

from ...batch.impact_columns import IMPACTS, LONGEST_REASON, STATUS
from ...collision.model import ShipCollision
from ...encounters.encounter import GRAZING, SLOWEST_CLOSING
from ...encounters.plan_contact import cut_section, find_contact_height, find_contacts, locate_place
from ...encounters.targeting import OVERLAP
from ...errors import StepError
from ...ship.frames import Array, rotation
from ...ship.hull.hull import build_hull
from ..definition.variables import NUMBERS
from .fleet_ships import FleetShip
from .ship_folder import ShipFolder

__all__ = ["PythonImpacts"]

INSTANT = 1e-9
"""[s] Nothing moves by more than rounding in it. Longer, and the hulls turn meanwhile."""
DEEPER, DEEPEST = 0.002, 1.0
"""[m] What the second attempt adds to the gap that was left; an overlap beyond which the contact is elsewhere."""
ATTEMPTS = 12

ROLES = ("own", "target")


class PythonImpacts:
    """The impacts of own and target."""

    def __init__(self, own: FleetShip, target: FleetShip, degrees_of_freedom: int) -> None:
        ships = own.loaded, target.loaded
        hulls = [build_hull(ship.L_oa, ship.B, ship.T, ship.hull) for ship in ships]
        deck = find_contact_height(*hulls)
        self._own_section, self._target_section = (cut_section(hull, deck) for hull in hulls)
        self._L_oa, self._middle = ships[1].L_oa, ships[1].hull.trim_x
        self._model = ShipCollision(ROLES)
        with ShipFolder() as folder:
            for parameters, ship in zip(self._model.parameters.ships, (own, target), strict=True):
                parameters.ship, parameters.degrees_of_freedom = folder.write(ship), degrees_of_freedom
            self._give_state(0, np.array([-2e4, 0.0]), 0.0, np.zeros(3))
            self._give_state(1, np.array([2e4, 0.0]), 0.0, np.zeros(3))
            self._model.initialise()
        self._first_state = self._model.get_state()

    def run(self, cases: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """A row of IMPACTS for each of the cases (n,)."""
        rows = np.zeros(len(cases), IMPACTS)
        for given, row in zip(cases, rows, strict=True):
            status, reason = self._answer(given, row)
            row["status"] = STATUS.index(status)
            row["reason"] = reason.encode()[:LONGEST_REASON]
        return rows

    def close(self) -> None:
        """Leave the Bullet world."""
        self._model.close()

    def _answer(self, given: Any, row: Any) -> tuple[str, str]:
        for name, of in NUMBERS.items():
            if name in given.dtype.names and not of.least <= given[name] <= of.most:
                return "out of range", f"{name} = {given[name]:g} must be {of.least:g} to {of.most:g}: {of.hint}"
        angle = radians(-given["angle_deg"] if given["is_starboard"] else given["angle_deg"])
        place = locate_place(
            self._target_section, self._middle + float(given["at"]) * self._L_oa,
            "starboard" if given["is_starboard"] else "port",
        )  # fmt: skip
        contact = find_contacts(place, self._own_section, angle)[0]
        heading = radians(given["heading_deg"])
        own_motion = np.array([given["own_speed"], given["own_sway"], given["own_yaw_rate"]])
        motion = np.array([given["target_speed"], given["target_sway"], given["target_yaw_rate"]])
        own_point = _turn(place.point - contact.position, -angle)
        velocity = _turn(_velocity_at(own_motion, own_point), angle) - _velocity_at(motion, place.point)
        closing = min(float(-velocity @ normal) for normal in contact.normals)
        least = max(SLOWEST_CLOSING, GRAZING * float(np.linalg.norm(velocity)))
        if closing < least:
            return "not closing", (
                f"at the place they close at {round(closing, 2) + 0.0:.2f} m/s, at least {least:.2f} m/s is needed; "
                "change the angle, the speeds, the side or the place"
            )
        self._model.parameters.friction = float(given["friction"])
        self._model.parameters.restitution = float(given["restitution"])
        normal, own = _turn(contact.normals[0], heading), _turn(contact.position - place.point, heading)
        overlap, deeper, out = OVERLAP, DEEPER, self._model.outputs
        for _ in range(ATTEMPTS):
            if overlap >= DEEPEST:
                break
            self._give_state(0, own - overlap * normal, heading + angle, own_motion)
            self._give_state(1, -_turn(place.point, heading), heading, motion)
            try:
                self._model.set_state(self._first_state)
                self._model.step(0.0, INSTANT)
            except StepError as error:
                return "refused", str(error)
            if out.contact_count > 0:
                return self._finish(row)
            overlap += max(out.clearance, 0.0) + deeper
            deeper *= 2.0
        return "no contact", (
            "the collision model finds no contact at the place: change the angle by a degree or two, or the place"
        )

    def _finish(self, row: Any) -> tuple[str, str]:
        if self._model.outputs.impact.closing_speed > 0.0:
            self._fill(row)
            return "done", ""
        return "not closing", (
            "the hulls touch at the place along a normal on which they part: change the angle, the speeds, the side or "
            "the place"
        )

    def _give_state(self, ship: int, position: Array, heading: float, motion: Array) -> None:
        state = self._model.inputs.ships[ship]
        state.position[:], state.attitude[:] = [float(position[0]), float(position[1]), 0.0], [0.0, 0.0, heading]
        state.velocity[:], state.rate[:] = [float(motion[0]), float(motion[1]), 0.0], [0.0, 0.0, float(motion[2])]

    def _fill(self, row: Any) -> None:
        out, point, velocities = self._model.outputs, np.array(self._model.outputs.impact.point), []
        for role, state, post in zip(ROLES, self._model.inputs.ships, out.ships, strict=True):
            R, arm = rotation(state.attitude), point - state.position
            row[f"{role}_position"], row[f"{role}_heading"] = state.position, state.attitude[2]
            row[f"{role}_point"] = R.T @ arm
            row[f"{role}_before"] = [*state.velocity, *state.rate]
            row[f"{role}_after"], row[f"{role}_impulse"] = [*post.velocity, *post.rate], post.impulse
            velocities.append(R @ state.velocity + np.cross(R @ state.rate, arm))
        contacts, strongest = out.contacts[: out.contact_count], -inf
        for contact in contacts:
            row["impulse"] += contact.impulse
            row["impulse_normal"] += contact.impulse_normal
            row["impulse_tangential"] += contact.impulse_tangential
            if contact.impulse_normal > strongest:
                strongest, row["normal"] = contact.impulse_normal, contact.normal
        row["contacts"], row["point"] = out.contact_count, point
        row["relative_velocity"] = velocities[0] - velocities[1]
        row["closing_speed"], row["angle"] = out.impact.closing_speed, out.impact.angle
        row["energy"], row["energy_normal"] = out.energy.dissipated, out.energy.normal
        row["energy_tangential"] = out.energy.tangential
        row["offset"], row["residual"] = hypot(point[0], point[1]), out.solver.residual


def _turn(p: Array, angle: float) -> Array:
    c, s = cos(angle), sin(angle)
    return np.array([c * p[0] - s * p[1], s * p[0] + c * p[1]])


def _velocity_at(motion: Array, p: Array) -> Array:
    """Velocity of the point p of a ship in plan, both in b; motion: surge, sway, yaw rate."""
    return np.array([motion[0] - motion[2] * p[1], motion[1] + motion[2] * p[0]])
