"""An FMU for tests: every type of variable, and a step that depends on a state which no variable shows."""

from dataclasses import dataclass, field
from typing import Any

from shipcollision_fmu.errors import InputError, StepError
from shipcollision_fmu.fmi.interface import Interface
from shipcollision_fmu.fmi.names import AXES, named
from shipcollision_fmu.fmi.slave import ModelSlave
from shipcollision_fmu.fmi.variables import boolean, enumeration, integer, real, string, vector


@dataclass
class Parameters:
    gain: list[float] = field(default_factory=lambda: [0.1, 1.0 / 3.0])
    name: str = "good"
    count: int = 3
    quick: bool = True
    method: str = "pgs"


@dataclass
class Inputs:
    push: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    number: int = 7
    open: bool = False
    word: str = "start"


@dataclass
class Outputs:
    place: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    steps: int = 0
    moving: bool = False
    said: str = ""
    phase: str = "rest"


class Model:
    """x <- x + h (gain[0] + push + 1e-3 hidden), hidden <- 1.1 hidden + h: a step repeats only from the whole state."""

    def __init__(self) -> None:
        self.parameters, self.inputs, self.outputs = Parameters(), Inputs(), Outputs()
        self.hidden: list[float] = []
        self.warning = ""
        self.events: list[str] = []
        self.initialised = 0

    def initialise(self) -> None:
        if self.parameters.name == "bad":
            raise InputError("name = 'bad' is 100% wrong; call it 'good'")
        self.initialised += 1
        self.hidden = [0.1 + self.parameters.gain[1]]
        self.outputs.place[:] = [self.parameters.gain[0]] * 3
        self.outputs.steps, self.outputs.moving = self.parameters.count, False
        self.outputs.said, self.outputs.phase = self.inputs.word, "rest"

    def step(self, t: float, h: float) -> None:
        push = self.inputs.push
        if not all(abs(p) < 1e30 for p in push):
            raise StepError(f"push = {push} is not finite at t = {t} s; check what is connected to it")
        if self.inputs.word == "divide":
            self.outputs.place[0] = 1e9
            self.outputs.place[0] /= self.outputs.steps - self.outputs.steps
        self.events = [f"100% happened at t = {t} s"] if self.inputs.word == "bang" else []
        self.warning = f"only 90% right at t = {t} s" if self.inputs.word == "doubt" else ""
        if self.inputs.word == "exit":
            raise SystemExit(3)
        (hidden,) = self.hidden
        place = self.outputs.place
        place[:] = [x + h * (self.parameters.gain[0] + p + 1e-3 * hidden) for x, p in zip(place, push, strict=True)]
        self.hidden[0] = 1.1 * hidden + h
        self.outputs.steps += 1
        self.outputs.moving, self.outputs.said = True, f"{self.inputs.word} {t}"
        self.outputs.phase = "slide" if self.inputs.open else "roll"

    def get_state(self) -> dict[str, Any]:
        return {"hidden": list(self.hidden)}

    def set_state(self, state: dict[str, Any]) -> None:
        self.hidden = list(state["hidden"])


TABLE = (
    *vector("output", named("place", AXES), "m", "outputs.place", "Place", depends_on=("gain",)),
    integer("output", "steps", "outputs.steps", "Steps made", depends_on=("count",)),
    boolean("output", "moving", "outputs.moving", "Whether it has moved", depends_on=()),
    string("output", "said", "outputs.said", "What it says"),
    enumeration("output", "phase", ("rest", "roll", "slide"), "outputs.phase", "How it moves"),
    *vector("input", named("push", AXES), "m/s", "inputs.push", "Push"),
    integer("input", "number", "inputs.number", "A number"),
    boolean("input", "open", "inputs.open", "Open"),
    string("input", "word", "inputs.word", "A word & more"),
    real("parameter", "gain.first", "rad/s", "parameters.gain", 0, "Gain", minimum=-1e300, nominal=0.1),
    real("parameter", "gain.second", "1", "parameters.gain", 1, "Other gain"),
    string("parameter", "name", "parameters.name", "Name"),
    integer("parameter", "count", "parameters.count", "Where the steps start", minimum=0, maximum=99),
    boolean("parameter", "quick", "parameters.quick", "Quick"),
    enumeration("parameter", "method", ("pgs", "closed_form", "bullet"), "parameters.method", "Method"),
)

INTERFACE = Interface("Dummy", "For tests only.", lambda ships: TABLE, lambda ships: Model())


class Dummy(ModelSlave):
    """The model as a slave."""

    interface = INTERFACE
