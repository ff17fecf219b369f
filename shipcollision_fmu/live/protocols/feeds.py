"""NmeaFeed and DisFeed: samples go in, the sentences or PDUs that are due come out."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime, timedelta
from typing import NamedTuple

import numpy as np

from ...scenario.tracks.tangent_plane import TangentPlane
from . import ais, nmea
from .dis import collision_pdu, entity_state_pdu, find_entity
from .fix import Fix, find_fix
from .identity import Identity
from .sample import CollisionSample, Sample, ShipSample
from .schedule import AisSchedule, DeadReckoning, Every

__all__ = ["DisFeed", "Fleet", "NmeaFeed"]

RATES = {"RMC": 1.0, "GGA": 1.0, "VTG": 1.0, "HDT": 0.1, "ROT": 0.1, "RSA": 0.5, "RPM": 1.0, "MWV": 1.0}
"""Seconds between two sentences of a kind."""
STATIC = 360.0
"""Seconds between two messages of type 5."""


class Fleet(NamedTuple):
    """The ships of a run, by name, and where and when they are: the plane of n, and the time at time 0."""

    own: str
    identities: Mapping[str, Identity]
    plane: TangentPlane
    start: datetime

    def time(self, seconds: float) -> datetime:
        """UTC at simulated seconds."""
        return self.start + timedelta(seconds=seconds)


class NmeaFeed:
    """NMEA 0183 of own ship, and AIS of all."""

    def __init__(self, fleet: Fleet) -> None:
        self._fleet = fleet
        self._due = {kind: Every(period) for kind, period in RATES.items()}
        self._reports = {name: AisSchedule() for name in fleet.identities}
        self._static = Every(STATIC)
        self._number = 0

    def take(self, sample: Sample) -> list[bytes]:
        """The sentences that are due, each with its end of line."""
        fleet, time = self._fleet, self._fleet.time(sample.time)
        fixes = {name: find_fix(sample.ships[name].state, fleet.plane) for name in fleet.identities}
        sentences = self._take_own(sample, fixes[fleet.own], time)
        for name, fix in fixes.items():
            if self._reports[name].is_due(sample.time, fix):
                disabled = sample.ships[name].is_disabled
                sentences += ais.position_report(
                    fleet.identities[name], fix, time, own=name == fleet.own, disabled=disabled
                )
        if self._static.is_due(sample.time):
            for name, identity in fleet.identities.items():
                sentences += ais.static_report(identity, own=name == fleet.own, number=self._number)
                self._number += 1
        return sentences

    def _take_own(self, sample: Sample, fix: Fix, time: datetime) -> list[bytes]:
        ship: ShipSample = sample.ships[self._fleet.own]
        due = {kind for kind, every in self._due.items() if every.is_due(sample.time)}
        sentences = []
        if "RMC" in due:
            sentences.append(nmea.rmc(fix, time))
        if "GGA" in due:
            sentences.append(nmea.gga(fix, time))
        sentences += [write(fix) for kind, write in _OF_FIX.items() if kind in due]
        if "RSA" in due and ship.rudder is not None:
            sentences.append(nmea.rsa(ship.rudder))
        if "RPM" in due and ship.rev_per_s is not None:
            sentences.append(nmea.rpm(ship.rev_per_s))
        if "MWV" in due and sample.wind is not None:
            sentences += nmea.mwv(ship, sample.wind)
        return sentences


_OF_FIX = {"VTG": nmea.vtg, "HDT": nmea.hdt, "ROT": nmea.rot}


class DisFeed:
    """DIS of all ships: numbers of entities are those of the ships, from 1. Obstacles are no entities."""

    def __init__(self, fleet: Fleet) -> None:
        self._fleet = fleet
        self._numbers = {name: i for i, name in enumerate(fleet.identities, 1)}
        self._due = {name: DeadReckoning() for name in fleet.identities}
        self._told: set[int] = set()

    def take(self, sample: Sample) -> list[bytes]:
        """The PDUs that are due."""
        plane, identities = self._fleet.plane, self._fleet.identities
        entities = {name: find_entity(sample.ships[name].state, plane) for name in identities}
        pdus = [
            entity_state_pdu(self._numbers[name], identities[name], entity, sample.time)
            for name, entity in entities.items()
            if self._due[name].is_due(sample.time, entity)
        ]
        begun = {collision.number for collision in sample.collisions}
        for collision in sample.collisions:
            if collision.number not in self._told:
                for issuing, hit in ((collision.ship_a, collision.ship_b), (collision.ship_b, collision.ship_a)):
                    if issuing in entities and hit in entities:
                        pdus.append(self._report(collision, issuing, hit, sample))
        self._told = begun  # a time that goes back forgets what has not happened yet
        return pdus

    def _report(self, collision: CollisionSample, issuing: str, hit: str, sample: Sample) -> bytes:
        other = sample.ships[hit].state
        point = other.R_nb.T @ (np.array(collision.point) - np.array(other.position))
        entity = find_entity(sample.ships[issuing].state, self._fleet.plane)
        return collision_pdu(
            self._numbers[issuing], self._numbers[hit], collision.number, self._fleet.identities[issuing], entity,
            point, sample.time,
        )  # fmt: skip
