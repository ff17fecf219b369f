"""The motion of one ship: orders, current, impulses and forces in; pose and velocity out.

A communication step [t, t + h]:

    check            the inputs; a step that is refused changes nothing
    apply pending    impulses issued since the last step, at once: nu += M^-1 (impulse - impulse_applied)
    advance          hydrodynamics: the MMG model in 3, 4 or 6 degrees of freedom, external force on its right-hand side
                     otherwise: coasting (ship/coasting_law.py), half of the force's momentum before it, half after
    publish          the new state

The impulse ledger: `impulse` is cumulative, the sum of all that the collision model has issued. A lost or repeated
sample loses and repeats nothing. Only the free degrees of freedom respond: M's other rows and columns are deleted
before the inversion, in level axes (ship/degrees_of_freedom.py). All six components count as applied.

An impulse P changes M nu by exactly P; a force F held over h changes M nu by F h. The model is plain Python and does
not depend on FMI.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import fields
from math import ceil, cos, isfinite, sin
from pathlib import Path
from typing import Any, NamedTuple

from ..errors import InputError, ScenarioError, StepError
from ..ship.coasting_law import CoastingLaw, make_coasting
from ..ship.degrees_of_freedom import free_inverse, tilted_inverse
from ..ship.frames import Array
from ..ship.loading.library import Ship, load_ship
from ..ship.ship_checksum import compute_checksum
from .actuators import NEUTRAL, Gear
from .held_motions import project_start
from .interface import ShipInputs, ShipOutputs, ShipParameters
from .mmg import Forces, Machines, Mmg, Orders, Six, Surroundings
from .mmg_3dof import Mmg3Dof
from .mmg_6dof import Mmg6Dof

__all__ = ["ShipManoeuvring"]

ABSURD_SPEED = 1e3
"""Speeds [m/s] from here on, at midship or at the ship's ends, are refused: the signal is broken."""

MAXIMUM_SUBSTEPS = 100_000
"""Most substeps of a communication step: an hour and a half at 0.05 s. A longer step has another unit."""

STEEPEST = 1.4
"""Pitch angle [rad], 80 degrees, from which steps are refused: Euler angles are singular at 90 degrees."""

_ZERO: Six = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class State(NamedTuple):
    """The whole state: pose eta (n), twist nu (b, over ground), ledger, machines, forces by origin. Never changed."""

    eta: Six
    nu: Six
    impulse_applied: Six
    rudder_angle: float
    propeller_speed: float
    gear: Gear
    hull: Six
    propeller: Six
    rudder: Six
    wind: Six


class _SetUp(NamedTuple):
    """Everything that follows from the parameters, computed once."""

    parameters: tuple[object, ...]
    ship: Ship
    checksum: int  # of the ship
    free: int  # degrees of freedom
    upright: Array  # (6, 6) inverse of the free block of M
    M_inverse: list[list[float]]  # the same as lists
    mmg: Mmg | None
    coasting: CoastingLaw | None  # of a ship without mmg
    substep: float

    def apply_impulse(self, eta: Six, nu: Six, impulse: Sequence[float]) -> Six:
        """nu + M^-1 impulse, in the motions that are free at that attitude."""
        upright = self.free == 6 or not (eta[3] or eta[4])
        rows = self.M_inverse if upright else tilted_inverse(self.upright, self.free, eta[3:]).tolist()
        X, Y, Z, K, M, N = impulse  # written out: sum() rounds otherwise from Python 3.12 on
        return _six(
            x + (m[0] * X + m[1] * Y + m[2] * Z + m[3] * K + m[4] * M + m[5] * N) for x, m in zip(nu, rows, strict=True)
        )


class ShipManoeuvring:
    """Motion of one ship. Fill parameters and inputs, then initialise(), then step(t, h) again and again."""

    def __init__(self) -> None:
        self.directory: Path | None = None  # where ship files are looked for before the current folder
        self.parameters = ShipParameters()
        self.inputs = ShipInputs()
        self.outputs = ShipOutputs()
        self.warning = ""  # what was not as it should be at the start, until the first step
        self._set_up: _SetUp | None = None
        self._state: State | None = None

    # -- set-up ---------------------------------------------------------------------------------------------------

    def initialise(self) -> None:
        """Read the parameters, load the ship, set state and outputs of time 0; may be called again.

        At the start the rudder is amidships and the propeller turns as ordered: a ship under way, helm not yet moved.
        Raises ShipError or ScenarioError on a bad parameter or start value; the model is then as it was.
        """
        p = self.parameters
        start_values = {name: value for name, value in _reals(p).items() if name != "substep"}
        _refuse_not_finite(start_values, ScenarioError, "must be finite")
        _refuse_not_finite(_reals(self.inputs), ScenarioError, "at the start must be finite")
        set_up = self._prepare()
        eta = _six(map(float, [*p.initial_position, *p.initial_attitude]))
        nu = _six(map(float, [*p.initial_velocity, *p.initial_rate]))
        if _is_absurd(nu, set_up.ship):
            raise ScenarioError(f"initial {_too_fast(nu)}")
        machines, warning = Machines(0.0, 0.0, NEUTRAL), ""
        if set_up.mmg is not None:
            eta, nu, warning = project_start(eta, nu, p.degrees_of_freedom)
            _refuse_steep_start(eta)
            self._refuse_orders(set_up, ScenarioError, "at the start")
            propeller_speed = set_up.mmg.engine.limit(self.inputs.propeller_order)
            propeller_speed = set_up.mmg.limit_revolutions(eta, nu, propeller_speed, self._surroundings())
            machines = Machines(0.0, propeller_speed, set_up.mmg.engine.find_gear(propeller_speed))
        forces = self._compute_forces(set_up.mmg, eta, nu, machines)
        self._set_up, self.warning = set_up, "; ".join(filter(None, (warning, *set_up.ship.suspicious)))
        self._publish(State(eta, nu, _ZERO, *machines, *forces))

    def _prepare(self) -> _SetUp:
        """The set-up for the parameters, kept while they are unchanged."""
        p = self.parameters
        parameters = (p.ship, p.degrees_of_freedom, p.hydrodynamics, p.coasting, p.substep)
        if self._set_up is not None and self._set_up.parameters == parameters:
            return self._set_up
        substep = p.substep
        if not (isfinite(substep) and substep > 0.0):
            raise ScenarioError(f"substep = {substep} s must be finite and greater than 0, e.g. 0.05")
        ship = load_ship(p.ship, self.directory)
        upright = free_inverse(ship.M, p.degrees_of_freedom)
        mmg: Mmg | None = None
        coasting = None if p.hydrodynamics else make_coasting(ship, p.degrees_of_freedom, p.coasting)
        if p.hydrodynamics:
            mmg = Mmg3Dof(ship) if p.degrees_of_freedom == 3 else Mmg6Dof(ship, p.degrees_of_freedom)
            if substep > mmg.shortest_time:
                raise ScenarioError(
                    f"substep = {substep} s is too long for the heave, roll or pitch of ship {ship.name!r}: must be at "
                    f"most {mmg.shortest_time:.3g} s, a sixth of its shortest period"
                )
        return _SetUp(
            parameters, ship, compute_checksum(ship), p.degrees_of_freedom, upright, upright.tolist(), mmg, coasting,
            substep,
        )  # fmt: skip

    # -- a step ---------------------------------------------------------------------------------------------------

    def step(self, t: float, h: float) -> None:
        """Advance from t [s] by h [s]. Raises StepError and leaves everything as it was when that is not possible."""
        if self._state is None or self._set_up is None:
            raise StepError("step before initialise: call initialise() first")
        before, set_up = self._state, self._set_up
        substeps = self._check(t, h, set_up)
        nu, applied = self._apply_pending(before, set_up)
        if set_up.coasting is not None:
            after = self._coast(before, nu, applied, set_up, set_up.coasting, t, h)
        elif set_up.mmg is not None:
            after = self._advance(before, nu, applied, set_up, set_up.mmg, t, h, substeps)
        self.warning = ""
        self._publish(after)

    def _check(self, t: float, h: float, set_up: _SetUp) -> int:
        """Number of substeps. Raises StepError on a step or an input that cannot be used."""
        if not (isfinite(t) and isfinite(h) and h > 0.0):
            raise StepError(f"step from t = {t} s over h = {h} s: t must be finite and h greater than 0")
        i = self.inputs
        # A sum passes NaN on.
        numbers = i.rudder_order + i.propeller_order + i.wind_speed + i.wind_direction
        if not isfinite(numbers + sum(i.current) + sum(i.impulse) + sum(i.force)):
            _refuse_not_finite(_reals(i), StepError, f"at t = {t:g} s must be finite")
        if max(abs(i.current[0]), abs(i.current[1])) >= ABSURD_SPEED:
            raise StepError(f"current = {i.current} m/s at t = {t:g} s must be below {ABSURD_SPEED:g} m/s")
        if abs(i.wind_speed) >= ABSURD_SPEED:
            raise StepError(f"wind speed = {i.wind_speed} m/s at t = {t:g} s must be below {ABSURD_SPEED:g} m/s")
        self._refuse_orders(set_up, StepError, f"at t = {t:g} s")
        ratio = h / set_up.substep
        if ratio > MAXIMUM_SUBSTEPS:
            raise StepError(
                f"h = {h:g} s takes {ratio:.3g} substeps of {set_up.substep} s, at most {MAXIMUM_SUBSTEPS}: take "
                "shorter steps"
            )
        return max(1, ceil(ratio - 1e-9))

    def _refuse_orders(self, set_up: _SetUp, refusal: type[InputError | StepError], when: str) -> None:
        """Refuse orders to a ship without propeller, rudder and engine."""
        if set_up.mmg is None or set_up.mmg.propelled:
            return
        for name, order in (("rudder", self.inputs.rudder_order), ("propeller", self.inputs.propeller_order)):
            if order != 0.0:
                raise refusal(
                    f"{name}_order = {order} {when}, but ship {set_up.ship.name!r} has no [{name}]: order 0, or add "
                    "the tables [propeller], [rudder] and [engine] to its file"
                )

    def _apply_pending(self, before: State, set_up: _SetUp) -> tuple[Six, Six]:
        """Twist and ledger after the pending impulses."""
        impulse = _six(map(float, self.inputs.impulse))
        pending = [issued - applied for issued, applied in zip(impulse, before.impulse_applied, strict=True)]
        return (set_up.apply_impulse(before.eta, before.nu, pending) if any(pending) else before.nu), impulse

    def _coast(
        self, before: State, nu: Six, applied: Six, set_up: _SetUp, coasting: CoastingLaw, t: float, h: float
    ) -> State:
        """Kick, drift, kick: of second order in h, and exact for a force along a straight course."""
        half = [0.5 * h * F for F in self.inputs.force]
        pushed = any(half)
        if pushed:
            nu = set_up.apply_impulse(before.eta, nu, half)
        _refuse_absurd(nu, set_up.ship, t)
        start = nu
        try:
            position, attitude, velocity, rate = coasting.coast(before.eta[:3], before.eta[3:], nu[:3], nu[3:], h)
            eta, nu = _six([*position, *attitude]), _six([*velocity, *rate])
            diverges = not isfinite(sum(eta)) or _is_absurd(nu, set_up.ship)
        except (OverflowError, ValueError, ZeroDivisionError):  # the sine of infinity
            diverges = True
        if diverges:
            raise StepError(
                f"the motion diverges in the step at t = {t:g} s: shorten h = {h:g} s, or look at velocity "
                f"{list(start[:3])} m/s and force {self.inputs.force}"
            )
        if pushed:
            nu = set_up.apply_impulse(eta, nu, half)
            _refuse_absurd(nu, set_up.ship, t)
        return before._replace(eta=eta, nu=nu, impulse_applied=applied)

    def _advance(
        self, before: State, nu: Six, applied: Six, set_up: _SetUp, mmg: Mmg, t: float, h: float, substeps: int
    ) -> State:
        """The MMG model, in the degrees of freedom that are free."""
        i = self.inputs
        _refuse_absurd(set_up.apply_impulse(before.eta, nu, [h * F for F in i.force]), set_up.ship, t)
        machines = Machines(before.rudder_angle, before.propeller_speed, before.gear)
        start = nu
        try:
            eta, nu, machines = mmg.advance(
                before.eta, nu, machines, Orders(i.rudder_order, i.propeller_order), self._surroundings(), h, substeps
            )  # fmt: skip
            is_finite = isfinite(sum(eta) + sum(nu))
        except (OverflowError, ValueError, ZeroDivisionError):  # the cosine of infinity
            is_finite = False
        if not is_finite:
            raise StepError(
                f"the motion diverges in the step at t = {t:g} s: shorten substep = {set_up.substep} s, or look at "
                f"velocity {list(start[:3])} m/s and force {i.force}"
            )
        _refuse_absurd(nu, set_up.ship, t)
        if abs(eta[4]) > STEEPEST:
            raise StepError(
                f"in the step at t = {t:g} s the pitch angle comes to {eta[4]:.3g} rad, must stay below {STEEPEST} "
                "rad; look at impulse and force"
            )
        return State(eta, nu, applied, *machines, *self._compute_forces(mmg, eta, nu, machines))

    def _surroundings(self) -> Surroundings:
        i = self.inputs
        speed, direction = i.wind_speed, i.wind_direction
        wind = (-speed * cos(direction), -speed * sin(direction)) if speed else (0.0, 0.0)  # where it blows to
        return Surroundings(i.current[0], i.current[1], *wind, *i.force)

    def _compute_forces(self, mmg: Mmg | None, eta: Six, nu: Six, machines: Machines) -> Forces:
        """Forces by origin; zero when coasting."""
        if mmg is None:
            return Forces(_ZERO, _ZERO, _ZERO, _ZERO)
        return mmg.compute_forces(eta, nu, machines, self._surroundings())

    # -- outputs and state ----------------------------------------------------------------------------------------

    def _publish(self, state: State) -> None:
        self._state, o = state, self.outputs
        o.position[:], o.attitude[:] = state.eta[:3], state.eta[3:]
        o.velocity[:], o.rate[:] = state.nu[:3], state.nu[3:]
        o.rudder_angle, o.propeller_speed = state.rudder_angle, state.propeller_speed
        o.impulse_applied[:] = state.impulse_applied
        o.hull[:], o.propeller[:], o.rudder[:], o.wind[:] = state.hull, state.propeller, state.rudder, state.wind

    def get_state(self) -> dict[str, Any]:
        """The whole state as JSON-able data, a fresh copy; empty before initialise()."""
        if self._state is None:
            return {}
        return {key: list(value) if isinstance(value, tuple) else value for key, value in self._state._asdict().items()}

    def list_files(self) -> dict[str, int]:
        """Checksums of what was read, by the parameter that names its file; empty before initialise()."""
        return {} if self._set_up is None else {"ship": self._set_up.checksum}

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore what get_state gave, and the outputs, to the bit. The parameters must be those it was taken with.

        Raises StepError for another dict.
        """
        if not state:
            self._state = None
            return
        if set(state) != set(State._fields):
            raise StepError("the state is not of ShipManoeuvring: give what get_state() returned")
        self._set_up = self._prepare()
        values: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in state.items()}
        self._publish(State(**values))


def _six(values: Iterable[float]) -> Six:
    a, b, c, d, e, f = values
    return a, b, c, d, e, f


def _reals(of: ShipParameters | ShipInputs) -> dict[str, float | list[float]]:
    """The real numbers and vectors among the fields, by name."""
    return {f.name: value for f in fields(of) if isinstance(value := getattr(of, f.name), float | list)}


def _refuse_not_finite(named: dict[str, float | list[float]], refusal: type[InputError | StepError], rule: str) -> None:
    for name, value in named.items():
        if not all(map(isfinite, value if isinstance(value, list) else [value])):
            raise refusal(
                f"{name} = {value} {rule}: look at what feeds it; where it has failed, its message has the cause"
            )


def _refuse_steep_start(eta: Six) -> None:
    if abs(eta[4]) > STEEPEST:
        raise ScenarioError(
            f"initial pitch angle = {eta[4]} rad must be below {STEEPEST} rad with hydrodynamics = true"
        )


def _is_absurd(nu: Six, ship: Ship) -> bool:
    u, v, w, p, q, r = nu
    fastest = max(abs(u), abs(v), abs(w), 0.5 * ship.L_pp * max(abs(p), abs(q), abs(r)))
    return not (isfinite(u + v + w + p + q + r) and fastest < ABSURD_SPEED)


def _too_fast(nu: Six) -> str:
    return (
        f"velocity {list(nu[:3])} m/s, rate {list(nu[3:])} rad/s: the speed of midship and of the ship's ends must be "
        f"below {ABSURD_SPEED:g} m/s"
    )


def _refuse_absurd(nu: Six, ship: Ship, t: float) -> None:
    if _is_absurd(nu, ship):
        raise StepError(f"in the step at t = {t:g} s {_too_fast(nu)}; look at impulse and force")
