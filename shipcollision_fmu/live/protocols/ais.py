"""AIS messages of class A, written by pyais: type 1 (position) and type 5 (static and voyage), as VDM or VDO.

pyais cuts numbers off; they are rounded here, to the steps of the messages: 1/10 000 of a minute, 0.1 kn, 0.1 deg, and
whole degrees of heading. The rate of turn is that of a rate-of-turn indicator, 4.733 sqrt(deg/min).
"""

from __future__ import annotations

from datetime import datetime, timedelta
from math import copysign, floor

from ...ship.ship_type import KNOT
from .fix import Fix
from .identity import Identity

__all__ = ["position_report", "static_report"]

POSITION, SPEED, COURSE, DRAUGHT = 600_000, 10, 10, 10
"""Steps to a degree, a knot, a degree and a metre."""
NO_COURSE, FASTEST = 360.0, 102.2
FASTEST_TURN = 708.0
"""[deg/min] The largest rate of turn of a message."""
UNDER_WAY, NOT_UNDER_COMMAND = 0, 2
GNSS = 1


def position_report(
    identity: Identity, fix: Fix, time: datetime, *, own: bool, disabled: bool = False
) -> list[bytes]:  # fmt: skip
    """Message 1, as VDO of own ship or as VDM of another. disabled: navigational status "not under command"."""
    from pyais import encode_msg
    from pyais.messages import MessageType1

    turn = max(-FASTEST_TURN, min(FASTEST_TURN, 60.0 * fix.rate_of_turn))
    course = NO_COURSE if fix.cog is None else _round(fix.cog % 360.0, COURSE, 3600)
    message = MessageType1.create(
        mmsi=identity.mmsi, status=NOT_UNDER_COMMAND if disabled else UNDER_WAY, turn=_round_turn(turn),
        speed=_round(min(FASTEST, fix.sog / KNOT), SPEED), accuracy=1, lon=_round(fix.longitude, POSITION),
        lat=_round(fix.latitude, POSITION), course=course,
        heading=round(fix.heading) % 360, second=(time + timedelta(milliseconds=500)).second, maneuver=0, raim=0,
    )  # fmt: skip
    lines = encode_msg(message, talker_id="AI", sentence_type="VDO" if own else "VDM", radio_channel="A")
    return [f"{line}\r\n".encode() for line in lines]


def static_report(identity: Identity, *, own: bool, number: int = 0) -> list[bytes]:
    """Message 5, which takes two sentences; `number`, 0 to 9, ties them together."""
    from pyais import encode_msg
    from pyais.messages import MessageType5

    message = MessageType5.create(
        mmsi=identity.mmsi, ais_version=0, imo=0, callsign=identity.call_sign, shipname=identity.name,
        ship_type=identity.ship_type, to_bow=identity.to_bow, to_stern=identity.to_stern, to_port=identity.to_port,
        to_starboard=identity.to_starboard, epfd=GNSS, month=0, day=0, hour=24, minute=60,
        draught=_round(min(25.5, identity.draught), DRAUGHT), destination=identity.destination, dte=0,
    )  # fmt: skip
    lines = encode_msg(
        message, talker_id="AI", sentence_type="VDO" if own else "VDM", radio_channel="A", seq_id=number % 10
    )
    return [f"{line}\r\n".encode() for line in lines]


def _round(value: float, steps: int, turn: int | None = None) -> float:
    """The value at the nearest step, a little beyond it, since pyais cuts off; steps beyond a `turn` begin anew."""
    whole = floor(abs(value) * steps + 0.5)
    if turn is not None:
        whole %= turn
    return copysign((whole + 0.25) / steps, value) if whole else 0.0


def _round_turn(rate: float) -> float:
    """A rate of turn [deg/min] which pyais writes as the nearest step of 4.733 sqrt(rate)."""
    step = floor(4.733 * abs(rate) ** 0.5 + 0.5)
    return copysign(((step + 0.25) / 4.733) ** 2, rate) if step else 0.0
