"""What the collision model can find wrong with the wiring of a ship: the table of findings.

The outputs `diagnosis.*`, the warnings in the log and the page "Wired wrongly?" of the documentation are made from it.
diagnosis.py looks for the findings, with motion_watch.py and answer_watch.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

__all__ = ["FINDINGS", "Finding", "Found"]

Found = tuple[str, Mapping[str, float | str]]
"""The key of a finding about a ship, and what was measured."""


@dataclass(frozen=True)
class Finding:
    """A wrong wiring. key: its name in the code; symptom: what a user notices; message: what was measured, a format
    with `ship` and the names that diagnosis.py fills in; remedy: what mends it."""

    key: str
    symptom: str
    message: str
    remedy: str

    def describe(self, **measured: object) -> str:
        """The warning in one line."""
        return f"{self.message.format(**measured)}: {self.remedy.format(**measured)}"


_TABLE = (
    Finding(
        "not connected", "a ship is hit by nothing, and hits nothing",
        "no state of {ship!r} was ever set, so that it takes part in no collision",
        "connect {ship}.position, {ship}.attitude, {ship}.velocity and {ship}.rate, or build the FMU without {ship!r}",
    ),
    Finding(
        "no velocity", "ships pass through each other without an impulse",
        "{ship!r} moves by {moved:.3g} m/s, but {ship}.velocity is {given:.3g} m/s",
        "connect {ship}.velocity: metres per second over ground, in b",
    ),
    Finding(
        "unit of the velocity", "impulses and energies are too large, the energy by 3.8 for knots",
        "{ship!r} moves by {moved:.3g} m/s, but {ship}.velocity is {given:.3g} m/s, as if it were in {unit}",
        "give {ship}.velocity in metres per second",
    ),
    Finding(
        "frame of the velocity", "impulses have the wrong direction on all headings but north",
        "{ship}.velocity of {given:.3g} m/s has the direction of the motion in n",
        "give {ship}.velocity in b: surge forward, sway to starboard",
    ),
    Finding(
        "other velocity", "impulses have the wrong size or direction",
        "{ship!r} moves by {moved:.3g} m/s, and {ship}.velocity, of {given:.3g} m/s, differs from it by {off:.3g} m/s",
        "give {ship}.velocity over ground, not through the water, in b at CO, and {ship}.position as north and east in "
        "metres, and connect {ship}.attitude",
    ),
    Finding(
        "attitude in degrees", "ships collide where they should pass, or with the wrong side",
        "{ship}.attitude.yaw = {yaw:.4g} fits the motion of {ship!r} only as degrees",
        "give {ship}.attitude in radians",
    ),
    Finding(
        "no rate", "a turning ship is hit as if it did not turn",
        "the heading of {ship!r} turns by {moved:.3g} rad/s, but {ship}.rate.yaw is {given:.3g} rad/s",
        "connect {ship}.rate: radians per second, in b",
    ),
    Finding(
        "rate in degrees", "a turning ship strikes with its ends far too fast",
        "the heading of {ship!r} turns by {moved:.3g} rad/s, but {ship}.rate.yaw is {given:.3g} rad/s, as if it were "
        "in degrees per second",
        "give {ship}.rate in radians per second",
    ),
    Finding(
        "other rate", "a turning ship is hit with a wrong velocity",
        "the heading of {ship!r} turns by {moved:.3g} rad/s, but {ship}.rate.yaw is {given:.3g} rad/s",
        "give {ship}.rate in b, in radians per second, positive to starboard",
    ),
    Finding(
        "overlap at the start", "a collision at time zero, with large impulses",
        "{ship!r} and {other!r} overlap by {overlap:.3g} m in the first step",
        "move one of them, and look whether {ship}.position and {ship}.attitude are connected, at their unit and their "
        "origin",
    ),
    Finding(
        "impulse not applied", "a ship is hit and sails on",
        "{ship!r} has not applied any impulse for {duration:.3g} s after one was issued ({ship}.impulse_applied stays "
        "as it was, and so does its motion)",
        'connect {ship}.impulse to the ship model, or set {ship}.feedback = "prescribed" for a ship that cannot answer',
    ),
    Finding(
        "impulse_applied not returned", "a ship answers the first impact, and is then hit by nothing",
        "{ship!r} moves as if it had applied its impulse, but {ship}.impulse_applied has stayed as it was for "
        "{duration:.3g} s",
        'connect impulse_applied of the ship model to {ship}.impulse_applied, or choose feedback = "force" for a model '
        "that has none",
    ),
    Finding(
        "force without effect", "a ship is hit and sails on, and the sum of its impulses grows without bound",
        "{ship!r} has not answered for {duration:.3g} s: its velocity shows {share:.2g} of the impulse issued",
        'connect {ship}.force and {ship}.moment to the ship model (for feedback = "state" adopt {ship}.post); if '
        "they are connected, give the model the mass and the inertia of {ship}.ship; or set {ship}.feedback = "
        '"prescribed" for a ship that cannot answer',
    ),
    Finding(
        "other mass", "a ship leaves an impact far too fast, or as if it were a wall",
        "an impulse changed the velocity of {ship!r} by {share:.4g} times what was predicted, as if its mass were "
        "{mass:.4g} times that of {ship}.ship",
        "give {ship}.ship the file of the ship that sails, look at the unit of its mass (kg), and apply the impulse in "
        "b about CO",
    ),
    Finding(
        "no motion", "a ship is hit by nothing, or is hit where it does not lie",
        "{ship}.velocity is {given:.3g} m/s, but {ship}.position has not changed for {duration:.3g} s",
        "connect {ship}.position, {ship}.attitude, {ship}.velocity and {ship}.rate (start values are not enough), or "
        "give a ship that lies still the velocity 0",
    ),
)  # fmt: skip

FINDINGS: dict[str, tuple[int, Finding]] = {finding.key: (code, finding) for code, finding in enumerate(_TABLE, 1)}
"""(code, finding) by its key. The code is the value of diagnosis.code: new findings go to the end."""
