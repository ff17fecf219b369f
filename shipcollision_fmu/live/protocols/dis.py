"""PDUs of DIS, IEEE 1278.1-2012 (version 7): entity state and collision, written by struct.

The package opendis is not taken: its only release asks for NumPy below 2, which FMPy and CPython 3.13 do not go with.
The tests decode with it. Big-endian throughout.

    entity state   5.2.5 of the standard's tables: identifiers, type of entity, velocity, place and attitude in the
                   geocentric frame of WGS 84 (x to 0 N 0 E, z to the north pole), dead reckoning RPW (algorithm 3:
                   constant velocity and angular velocity), marking
    collision      both entities, mass and velocity of the issuing one, the point in the body frame of the other

A ship's body frame is that of DIS: x forward, y to starboard, z down. Its place is CO on the ellipsoid.
"""

from __future__ import annotations

import struct
from math import asin, atan2, cos, radians, sin

import numpy as np

from ...scenario.tracks.tangent_plane import TangentPlane
from ...ship.frames import Array, rotation
from ...ship.ship_state import ShipState
from .identity import Identity

__all__ = ["COLLISION_PDU", "ENTITY_STATE_PDU", "Entity", "collision_pdu", "entity_state_pdu", "find_entity"]

VERSION = 7
ENTITY_STATE_PDU, COLLISION_PDU, ENTITY_FAMILY = 1, 4, 1
SITE, APPLICATION = 1, 1
PLATFORM, SURFACE, OTHER_COUNTRY = 1, 3, 0
FORCE_OTHER, INELASTIC, RPW, ASCII = 0, 0, 3, 1
HOUR_STEPS = 2**31
"""Steps of a time stamp in an hour; the last bit says whether it is absolute, which simulated time is not."""
MARKING = 11
"""Characters of a marking."""
_CATEGORIES = {6: 80, 7: 81, 8: 82}
"""Category of a surface platform (SISO-REF-010) by the first digit of the AIS type: passenger, dry cargo, tanker."""
_SINGLE_CATEGORIES = {30: 86, 36: 85, 37: 84, 34: 83, 52: 83, 53: 83}
OTHER_VESSEL = 87

_HEADER = struct.Struct(">BBBBIHBB")
_ID = struct.Struct(">HHH")
_ENTITY_TYPE = struct.Struct(">BBHBBBB")
_MOTION = struct.Struct(">fff ddd fff")
_DEAD_RECKONING = struct.Struct(">B15x fff fff")


class Entity:
    """A ship on earth: place (3,) [m], velocity (3,) [m/s] and rotation to body axes (3, 3), all geocentric."""

    def __init__(self, place: Array, velocity: Array, R_be: Array, rate: tuple[float, float, float]) -> None:
        self.place, self.velocity, self.R_be, self.rate = place, velocity, R_be, rate

    @property
    def angles(self) -> tuple[float, float, float]:
        """Psi, theta, phi [rad] from geocentric to body axes."""
        R = self.R_be
        return (
            atan2(R[0, 1], R[0, 0]), asin(max(-1.0, min(1.0, -float(R[0, 2])))), atan2(R[1, 2], R[2, 2]),
        )  # fmt: skip


def find_entity(state: ShipState, plane: TangentPlane) -> Entity:
    """A ship's place and motion on earth; heading and velocity refer to north where it is."""
    latitude, longitude = plane.geographic(state.north, state.east)
    turned = plane.true_course(latitude, longitude, 0.0)  # of n's north against the north there
    phi, lam = radians(latitude), radians(longitude)
    north = np.array([-sin(phi) * cos(lam), -sin(phi) * sin(lam), cos(phi)])
    east, down = np.array([-sin(lam), cos(lam), 0.0]), -np.array([cos(phi) * cos(lam), cos(phi) * sin(lam), sin(phi)])
    R_en = np.column_stack([north, east, down]) @ rotation([0.0, 0.0, turned])
    R_nb = rotation(state.attitude)
    place = TangentPlane.geocentric(latitude, longitude) + state.down * down
    return Entity(place, R_en @ R_nb @ np.array(state.velocity), (R_en @ R_nb).T, state.rate)


def entity_state_pdu(number: int, identity: Identity, entity: Entity, time: float, exercise: int = 1) -> bytes:
    """The entity state of the ship of that number, from 1, at a time [s] since the start."""
    category = _SINGLE_CATEGORIES.get(identity.ship_type, _CATEGORIES.get(identity.ship_type // 10, OTHER_VESSEL))
    kind = _ENTITY_TYPE.pack(PLATFORM, SURFACE, OTHER_COUNTRY, category, 0, 0, 0)
    body = b"".join((
        _ID.pack(SITE, APPLICATION, number), struct.pack(">BB", FORCE_OTHER, 0), kind, kind,
        _MOTION.pack(*entity.velocity, *entity.place, *entity.angles), struct.pack(">I", 0),
        _DEAD_RECKONING.pack(RPW, 0.0, 0.0, 0.0, *entity.rate),
        struct.pack(f">B{MARKING}s", ASCII, identity.name.encode("ascii", "replace")[:MARKING]), struct.pack(">I", 0),
    ))  # fmt: skip
    return _add_header(ENTITY_STATE_PDU, body, time, exercise)


def collision_pdu(
    issuing: int, hit: int, event: int, identity: Identity, entity: Entity, point_in_hit: Array, time: float,
    exercise: int = 1,
) -> bytes:  # fmt: skip
    """A collision as the ship of number `issuing` reports it. point_in_hit: the first point in b of the other (3,) [m];
    identity and entity are of the issuing ship."""
    body = b"".join((
        _ID.pack(SITE, APPLICATION, issuing), _ID.pack(SITE, APPLICATION, hit), _ID.pack(SITE, APPLICATION, event),
        struct.pack(">Bx", INELASTIC), struct.pack(">fff", *entity.velocity), struct.pack(">f", identity.mass),
        struct.pack(">fff", *point_in_hit),
    ))  # fmt: skip
    return _add_header(COLLISION_PDU, body, time, exercise)


def _add_header(kind: int, body: bytes, time: float, exercise: int) -> bytes:
    stamp = int((time % 3600.0) / 3600.0 * HOUR_STEPS) % HOUR_STEPS << 1
    return _HEADER.pack(VERSION, exercise, kind, ENTITY_FAMILY, stamp, _HEADER.size + len(body), 0, 0) + body
