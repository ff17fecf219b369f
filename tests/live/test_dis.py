"""DIS: opendis, which we did not write, reads our PDUs; places and attitudes are checked by formulae of their own."""

from __future__ import annotations

import struct
from datetime import datetime, timezone
from math import cos, pi, radians, sin, sqrt
from typing import Any

import numpy as np
import pytest

from shipcollision_fmu.live.protocols.dis import COLLISION_PDU, ENTITY_STATE_PDU, find_entity
from shipcollision_fmu.live.protocols.feeds import DisFeed, Fleet
from shipcollision_fmu.live.protocols.identity import Hull, make_identity
from shipcollision_fmu.live.protocols.sample import CollisionSample, Sample, ShipSample
from shipcollision_fmu.scenario.tracks.tangent_plane import TangentPlane
from shipcollision_fmu.ship.ship_state import ShipState

LATITUDE, LONGITUDE = 54.0, 8.0
PLANE = TangentPlane(LATITUDE, LONGITUDE)
NAMES = ("own", "target")
TANKER = Hull("tanker", 320.0, 58.0, 20.8, 3.2e8)


def fleet() -> Fleet:
    identities = {name: make_identity(i, name, TANKER, {}, None) for i, name in enumerate(NAMES)}
    return Fleet("own", identities, PLANE, datetime(2026, 1, 1, tzinfo=timezone.utc))


def sample(time: float, own: ShipState, target: ShipState | None = None, collisions: Any = ()) -> Sample:
    other = ShipState.upright(500.0, 900.0, 1.0) if target is None else target
    return Sample(time, {"own": ShipSample(own), "target": ShipSample(other)}, None, tuple(collisions))


def ecef(latitude: float, longitude: float) -> np.ndarray[Any, Any]:
    """Textbook coordinates on the ellipsoid."""
    a, f = 6378137.0, 1 / 298.257223563
    e2, phi, lam = f * (2 - f), radians(latitude), radians(longitude)
    N = a / sqrt(1 - e2 * sin(phi) ** 2)
    return np.array([N * cos(phi) * cos(lam), N * cos(phi) * sin(lam), N * (1 - e2) * sin(phi)])


@pytest.mark.needs("opendis")
def test_opendis_reads_an_entity_state() -> None:
    from opendis.PduFactory import createPdu

    state = ShipState(0.0, 0.0, 0.0, 0.0, 0.0, 0.5 * pi, 6.0, 0.5, 0.0, 0.001, 0.002, 0.01)
    raw, other = DisFeed(fleet()).take(sample(1800.0, state))
    pdu: Any = createPdu(raw)
    assert (pdu.protocolVersion, pdu.pduType, pdu.protocolFamily, pdu.length) == (7, ENTITY_STATE_PDU, 1, len(raw))
    assert pdu.timestamp >> 1 == 2**30  # half an hour
    assert (pdu.entityID.siteID, pdu.entityID.applicationID, pdu.entityID.entityID) == (1, 1, 1)
    kind = pdu.entityType
    assert (kind.entityKind, kind.domain, kind.category) == (1, 3, 82)
    place = pdu.entityLocation
    np.testing.assert_allclose((place.x, place.y, place.z), ecef(LATITUDE, LONGITUDE), atol=1e-6)
    velocity = pdu.entityLinearVelocity  # heading east: surge goes east, sway goes south
    phi, lam = radians(LATITUDE), radians(LONGITUDE)
    east, north = np.array([-sin(lam), cos(lam), 0.0]), np.array([-sin(phi) * cos(lam), -sin(phi) * sin(lam), cos(phi)])
    np.testing.assert_allclose((velocity.x, velocity.y, velocity.z), 6.0 * east - 0.5 * north, atol=1e-5)
    psi, theta, roll = pdu.entityOrientation.psi, pdu.entityOrientation.theta, pdu.entityOrientation.phi
    ahead = np.array([cos(theta) * cos(psi), cos(theta) * sin(psi), -sin(theta)])
    np.testing.assert_allclose(ahead, east, atol=1e-6)
    starboard_z = sin(roll) * cos(theta)
    assert starboard_z == pytest.approx(-north[2], abs=1e-6)
    assert pdu.deadReckoningParameters.deadReckoningAlgorithm == 3
    turning = pdu.deadReckoningParameters.entityAngularVelocity
    np.testing.assert_allclose((turning.x, turning.y, turning.z), state.rate, rtol=1e-6)
    assert bytes(pdu.marking.characters).rstrip(b"\0") == b"OWN"
    assert createPdu(other).entityID.entityID == 2


@pytest.mark.needs("opendis")
def test_opendis_reads_a_collision() -> None:
    """own's bow, 160 m ahead, in target's side: 29 m to starboard of target, 10 m ahead of its midship."""
    from opendis.dis7 import CollisionPdu
    from opendis.PduFactory import createPdu

    own = ShipState.upright(0.0, 0.0, 0.0, surge=5.0)
    target = ShipState.upright(189.0, -10.0, -0.5 * pi, surge=2.0)  # heads west, its starboard side is north
    hit = CollisionSample(1, 9.9, "own", "target", (160.0, -20.0, -3.0))
    feed = DisFeed(fleet())
    feed.take(sample(9.0, own, target))
    pdus = [createPdu(raw) for raw in feed.take(sample(10.0, own, target, [hit]))]
    first, second = (pdu for pdu in pdus if isinstance(pdu, CollisionPdu))
    assert first.pduType == COLLISION_PDU
    assert (first.issuingEntityID.entityID, first.collidingEntityID.entityID) == (1, 2)
    assert (second.issuingEntityID.entityID, second.collidingEntityID.entityID) == (2, 1)
    assert (first.eventID.eventNumber, second.eventID.eventNumber) == (1, 1)
    assert first.mass == pytest.approx(3.2e8)
    assert sqrt(first.velocity.x**2 + first.velocity.y**2 + first.velocity.z**2) == pytest.approx(5.0, abs=1e-5)
    np.testing.assert_allclose((first.location.x, first.location.y, first.location.z), (10.0, -29.0, -3.0), atol=1e-4)
    np.testing.assert_allclose((second.location.x, second.location.y, second.location.z), (160, -20, -3), atol=1e-4)
    assert not [raw for raw in feed.take(sample(11.0, own, target, [hit])) if raw[2] == COLLISION_PDU]


def test_layouts_have_the_lengths_of_the_standard() -> None:
    """144 bytes without articulation, 60 for a collision; the header says so."""
    own = ShipState.upright(0.0, 0.0, 0.0)
    hit = CollisionSample(1, 0.0, "own", "target", (0.0, 0.0, 0.0))
    lengths = {raw[2]: (len(raw), struct.unpack(">H", raw[8:10])[0]) for raw in DisFeed(fleet()).take(
        sample(0.0, own, collisions=[hit])
    )}  # fmt: skip
    assert lengths == {ENTITY_STATE_PDU: (144, 144), COLLISION_PDU: (60, 60)}


def test_obstacles_are_no_entities() -> None:
    hit = CollisionSample(1, 0.0, "own", "pier", (0.0, 0.0, 0.0))
    pdus = DisFeed(fleet()).take(sample(0.0, ShipState.upright(0.0, 0.0, 0.0), collisions=[hit]))
    assert [raw[2] for raw in pdus] == [ENTITY_STATE_PDU] * 2


def test_a_ship_far_from_the_origin_floats_on_the_ellipsoid() -> None:
    """30 km east: 70 m above the ellipsoid it would be on the plane; its heading refers to its own north."""
    entity = find_entity(ShipState.upright(0.0, 30_000.0, 0.0, surge=5.0), PLANE)
    assert np.linalg.norm(entity.place - ecef(*PLANE.geographic(0.0, 30_000.0))) < 1e-6
    next_place = find_entity(ShipState.upright(1.0, 30_000.0, 0.0, surge=5.0), PLANE).place
    np.testing.assert_allclose((next_place - entity.place) * 5.0, entity.velocity, atol=0.001)


def count_sent(states: list[ShipState], step: float) -> int:
    feed = DisFeed(fleet())
    return sum(raw[17] == 1 for k, state in enumerate(states) for raw in feed.take(sample(step * k, state)))


def test_dead_reckoning_saves_pdus() -> None:
    """A straight course needs heartbeats alone, each 5 s. A turn of 1 deg/s at 5 m/s leaves the tangent by 1 m after
    4.8 s, and keeps its rate of turn; one that began after the last PDU turns by 3 deg in 3 s."""
    straight = [ShipState.upright(0.5 * k, 0.0, 0.0, surge=5.0) for k in range(301)]
    assert count_sent(straight, 0.1) == 7
    rate, speed = radians(1.0), 5.0
    circle = [
        ShipState.upright(
            speed / rate * sin(rate * 0.1 * k), speed / rate * (1 - cos(rate * 0.1 * k)), rate * 0.1 * k,
            surge=speed, yaw_rate=rate,
        )
        for k in range(301)
    ]  # fmt: skip
    assert count_sent(circle, 0.1) == 1 + int(30.0 / (sqrt(2.0 * 1.0 / (speed * rate)) + 0.1))
    silent = [state._replace(yaw_rate=0.0) for state in circle]
    assert 9 <= count_sent(silent, 0.1) <= 11


def test_the_place_is_three_doubles_from_byte_48() -> None:
    raw = DisFeed(fleet()).take(sample(0.0, ShipState.upright(0.0, 0.0, 0.0)))[0]
    np.testing.assert_allclose(struct.unpack(">ddd", raw[48:72]), ecef(LATITUDE, LONGITUDE), atol=1e-6)
