"""Scene: everything visible of a run, from which page, glTF, OpenSceneGraph, films and figures are made.

    Scene
    ├── ships       hull and fittings in b about CO, z down; a track: poses of b in n over time
    ├── obstacles   surface in their b, position and heading of b in n
    ├── scratches   lines on a hull in the b of its ship, a time per point; one on each ship
    ├── effects     explosion, debris, fire, smoke, at a point of a ship, in its b
    ├── dents       opened sides and crushed bows, at a point of a ship, in its b
    ├── events      the collisions, to which a viewer can jump
    └── signals     curves over time

Everything is in SI units and in the project's frames: n is north, east, down; b forward, starboard, down. Quaternions
are (x, y, z, w) of R_nb, with a continuous sign. Colours and drawing are elsewhere.

Tracks and signals are thinned by resample.py. Between two poses of a track position is linear and attitude slerp; at
the time of any row of states.csv, no point of a hull is then farther than POSE_ERROR from its position by that row.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from ...fmi.names import ATTITUDE, POSITION, STATE
from ...ship.frames import Array
from .dents import Dent, make_dents
from .effects import Effect, make_effects
from .fittings import Fitting
from .lights import Light
from .looks import make_looks
from .machinery import read_wind
from .resample import choose_samples
from .run_folder import CollisionEvent, RunFolder, ShipBody, read_run_folder
from .scratches import Scratch, lay_scratches
from .signals import Signals, signals_of
from .solids import Shape
from .surface import Surface, drop_flat_triangles

__all__ = [
    "POSE_ERROR", "Dent", "Effect", "Event", "Obstacle", "Scene", "Scratch", "Ship", "Track", "build_scene",
    "load_scene",
]  # fmt: skip

POSE_ERROR = 0.005
"""[m] Largest error of any point of a hull by thinning. Smaller makes files larger, larger becomes visible."""


@dataclass(frozen=True, eq=False)
class Track:
    """Poses over time: times (k,) [s], position of b's origin in n (k, 3) [m], quaternion of R_nb (k, 4)."""

    times: Array
    position: Array
    quaternion: Array

    def at(self, time: float) -> tuple[Array, Array]:
        """Position (3,) and quaternion (4,) at a time [s], held before the first and after the last."""
        i = int(np.clip(np.searchsorted(self.times, time, side="right") - 1, 0, max(len(self.times) - 2, 0)))
        j = min(i + 1, len(self.times) - 1)
        span = self.times[j] - self.times[i]
        share = float(np.clip((time - self.times[i]) / span, 0.0, 1.0)) if span > 0.0 else 0.0
        position = self.position[i] + share * (self.position[j] - self.position[i])
        return position, slerp(self.quaternion[i], self.quaternion[j], share)


@dataclass(frozen=True, eq=False)
class Ship:
    """A ship: its name in the scenario, the model's name and kind, dimensions [m], track, and in b:

    hull       the surface that touches
    plating    the hull's outside as drawn, on which scratches lie: between the ends it is that surface
    shell      the hull as drawn, by paint (hull_shell.py)
    fittings   all that stands on deck; contact ignores it
    lights     of rule 21
    """

    name: str
    model: str
    kind: str
    L_pp: float
    L_oa: float
    B: float
    T: float
    hull: Surface
    plating: Surface
    shell: tuple[Shape, ...]
    fittings: tuple[Fitting, ...]
    lights: tuple[Light, ...]
    track: Track


@dataclass(frozen=True, eq=False)
class Obstacle:
    """An obstacle: surface in its b, position of b in n (3,) [m], heading [rad]."""

    name: str
    kind: str
    surface: Surface
    position: Array
    heading: float


@dataclass(frozen=True, eq=False)
class Event:
    """A collision: time and end [s], first point in n (3,) [m], impulse [N s], energy [J].

    closing_speed [m/s] and angle [rad] are None where the run has none.
    """

    kind: Literal["collision"]
    id: int
    time: float
    end: float
    ship_a: str
    ship_b: str
    point: Array
    closing_speed: float | None
    angle: float | None
    impulse: float
    energy: float


@dataclass(frozen=True, eq=False)
class Scene:
    """A scene. `wind` (2,) is the air's mean velocity, north and east [m/s].

    `origin` (3,) in n [m] is a round place near its middle, for formats in single precision.
    """

    name: str
    description: str
    is_native: bool  # its FMUs ran without Python
    start: float
    end: float
    origin: Array
    ships: tuple[Ship, ...]
    obstacles: tuple[Obstacle, ...]
    scratches: tuple[Scratch, ...]
    effects: tuple[Effect, ...]
    dents: tuple[Dent, ...]
    events: tuple[Event, ...]
    signals: Signals
    wind: Array

    def ship(self, name: str) -> Ship:
        """The ship of that name; KeyError if there is none."""
        for ship in self.ships:
            if ship.name == name:
                return ship
        raise KeyError(name)


def load_scene(folder: str | Path) -> Scene:
    """The scene of the run in a folder. Raises InputError when it is not the folder of a complete run."""
    return build_scene(read_run_folder(folder))


def build_scene(run: RunFolder) -> Scene:
    """The scene of a run."""
    ships = tuple(
        _build_ship(name, body, run.times, run.states[:, i]) for i, (name, body) in enumerate(run.bodies.ships.items())
    )
    obstacles = tuple(
        Obstacle(
            name, body.kind, drop_flat_triangles(_build_surface(body.vertices, body.triangles)),
            np.array(body.position), body.heading,
        )
        for name, body in run.bodies.obstacles.items()
    )  # fmt: skip
    scratches = lay_scratches(run.events.scratches, {ship.name: ship.plating for ship in ships})
    return Scene(
        name=run.summary.scenario,
        description=run.summary.description,
        is_native=run.summary.engine == "native",
        start=float(run.times[0]),
        end=float(run.times[-1]),
        origin=_choose_origin(run),
        ships=ships,
        obstacles=obstacles,
        scratches=scratches,
        effects=make_effects(run, scratches),
        dents=make_dents(run, scratches),
        events=tuple(map(_build_event, run.events.collisions)),
        signals=signals_of(run),
        wind=_find_wind(run),
    )


def slerp(q: Array, r: Array, share: float) -> Array:
    """The quaternion `share` of the way from q to r, both of length 1. Shoemake (1985)."""
    cosine = float(q @ r)
    if cosine < 0.0:
        r, cosine = -r, -cosine
    angle = np.arccos(min(1.0, cosine))
    if angle < 1e-6:
        mixed = q + share * (r - q)
    else:
        mixed = (np.sin((1 - share) * angle) * q + np.sin(share * angle) * r) / np.sin(angle)
    result: Array = mixed / np.linalg.norm(mixed)
    return result


def _build_ship(name: str, body: ShipBody, times: Array, states: Array) -> Ship:
    hull = drop_flat_triangles(_build_surface(body.vertices, body.triangles))
    reach = float(np.linalg.norm(hull.vertices, axis=1).max())
    looks = make_looks(name, body, hull)
    return Ship(
        name=name, model=body.ship, kind=body.kind, L_pp=body.L_pp, L_oa=body.L_oa, B=body.B, T=body.T,
        hull=hull, plating=looks.plating, shell=looks.shell, fittings=looks.fittings, lights=looks.lights,
        track=_build_track(times, states, reach),
    )  # fmt: skip


def _build_surface(vertices: list[tuple[float, float, float]], triangles: list[tuple[int, int, int]]) -> Surface:
    return Surface(np.array(vertices, dtype=float), np.array(triangles, dtype=np.int64))


def _build_track(times: Array, states: Array, reach: float) -> Track:
    """The thinned track. A quaternion that is off by dq turns the hull by 2 |dq|, and moves it by 2 |dq| reach."""
    position = states[:, [STATE.index(variable) for variable in POSITION]]
    quaternion = convert_attitudes(states[:, [STATE.index(variable) for variable in ATTITUDE]])
    rows = choose_samples(times, np.hstack([position, 2.0 * reach * quaternion]), POSE_ERROR / np.sqrt(2.0))
    return Track(times[rows], position[rows], quaternion[rows])


def convert_attitudes(attitude: Array) -> Array:
    """Quaternions (k, 4) of attitudes (k, 3) = (roll, pitch, yaw) [rad], with a continuous sign."""
    (cx, cy, cz), (sx, sy, sz) = np.cos(0.5 * attitude.T), np.sin(0.5 * attitude.T)
    q = np.column_stack([
        sx * cy * cz - cx * sy * sz, cx * sy * cz + sx * cy * sz, cx * cy * sz - sx * sy * cz,
        cx * cy * cz + sx * sy * sz,
    ])  # fmt: skip
    turned = np.einsum("ij,ij->i", q[1:], q[:-1]) < 0.0
    q[1:] *= np.where(np.cumsum(turned) % 2 == 1, -1.0, 1.0)[:, None]
    return q


def _choose_origin(run: RunFolder) -> Array:
    """The first point of contact, else the middle of all tracks; on the water, in whole tens of metres."""
    if run.events.collisions:
        place = np.array(run.events.collisions[0].first_point.n)
    else:
        tracks = run.states[:, :, :3].reshape(-1, 3)
        place = 0.5 * (tracks.min(axis=0) + tracks.max(axis=0))
    return np.array([*np.round(place[:2], -1), 0.0]) + 0.0  # no negative zero


def _find_wind(run: RunFolder) -> Array:
    """Mean velocity (2,) of the air in n [m/s], to where it blows; zero of a run that does not tell."""
    wind = read_wind(run)
    if wind is None:
        return np.zeros(2)
    velocity = -wind[:, :1] * np.column_stack([np.cos(wind[:, 1]), np.sin(wind[:, 1])])
    mean: Array = velocity.mean(axis=0)
    return mean


def _build_event(collision: CollisionEvent) -> Event:
    return Event(
        kind="collision", id=collision.id, time=collision.start, end=collision.end,
        ship_a=collision.ship_a, ship_b=collision.ship_b, point=np.array(collision.first_point.n),
        closing_speed=collision.closing_speed, angle=collision.angle,
        impulse=collision.impulse.magnitude, energy=collision.energy,
    )  # fmt: skip
