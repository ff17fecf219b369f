"""Scripts for play.c: KVLCC2 with its helm over, in wind and current, struck, saved and restored; and two ships that
collide, saved and restored."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree

__all__ = ["STEP", "Script", "write_encounter", "write_voyage"]

STEP = 0.1


class Script:
    """Lines for play.c; variables by name, of FMI 2.0 or of the arrays of FMI 3.0."""

    def __init__(self, unpacked: Path) -> None:
        root = ElementTree.parse(unpacked / "modelDescription.xml").getroot()
        self.fmi = 3 if root.get("fmiVersion", "").startswith("3") else 2
        self.token = root.get("guid") or root.get("instantiationToken") or ""
        listed = root.iter("ScalarVariable") if self.fmi == 2 else root.find("ModelVariables") or []
        self.references = {line.get("name"): line.get("valueReference") for line in listed}
        self.lines: list[str] = []

    def set(self, kind: str, name: str, *values: float | str) -> None:
        """A variable, or each element of a vector in a version without arrays."""
        words = [bits(value) if kind == "real" and not isinstance(value, str) else str(value) for value in values]
        if name in self.references:
            self.lines.append(f"{kind} {self.references[name]} {' '.join(words)}")
            return
        within = [full for full in self.references if full is not None and full.rpartition(".")[0] == name]
        for full, word in zip(within, words, strict=True):
            self.lines.append(f"{kind} {self.references[full]} {word}")

    def get(self, name: str, count: int) -> None:
        """Prints a vector in one line, or each of its elements in a line of its own."""
        if name in self.references:
            self.lines.append(f"get {self.references[name]} {count}")
        else:
            for full in self.references:
                if full is not None and full.rpartition(".")[0] == name:
                    self.lines.append(f"get {self.references[full]} 1")

    def step(self, t: float) -> None:
        self.lines.append(f"step {bits(t)} {bits(STEP)}")

    def say(self, line: str) -> None:
        self.lines.append(line)

    @property
    def text(self) -> str:
        return "".join(f"{line}\n" for line in self.lines)


def bits(value: float) -> str:
    """The 16 hexadecimal digits of a double."""
    return struct.pack(">d", value).hex()


def from_bits(digits: str) -> float:
    return float(struct.unpack(">d", bytes.fromhex(digits))[0])


def write_voyage(unpacked: Path, degrees_of_freedom: int = 6, steps: int = 400, tail: Sequence[str] = ()) -> Script:
    """The script; it prints the digest of the state ten times on the way, then position, attitude, velocity, rate.

    After half of the way the last fifth is sailed, taken back and sailed again.
    """
    script = Script(unpacked)
    script.set("boolean", "hydrodynamics", "1")
    script.set("integer", "degrees_of_freedom", str(degrees_of_freedom))
    script.set("real", "initial.velocity", 7.0, 0.0, 0.0)
    script.set("real", "initial.attitude", 0.0, 0.0, 0.3)
    script.set("real", "propeller_order", 1.2)
    script.set("real", "current", 0.4, -0.7)
    script.set("real", "wind.speed", 14.0)
    script.set("real", "wind.direction", 2.1)
    script.say(f"begin {bits(0.0)}")
    for k in range(steps):
        script.set("real", "rudder_order", 0.5 if k % 200 < 120 else -0.4)
        if k == steps // 4:
            linear, angular = (-3e8, 1.5e8, 1e6), (2e8, -3e8, 4e10)
            if script.fmi == 3 and "impulse.linear" in script.references:
                script.set("real", "impulse.linear", *linear)
                script.set("real", "impulse.angular", *angular)
            else:
                script.set("real", "impulse", *linear, *angular)
        if k == steps // 2:
            script.say("save")
            for again in range(k, k + steps // 5):
                script.step(again * STEP)
            script.say("restore")
        script.step(k * STEP)
        if (k + 1) % (steps // 10) == 0:
            script.say("state")
    for name in ("position", "attitude", "velocity", "rate"):
        script.get(name, 3)
    script.lines.extend(tail)
    return script


def write_encounter(
    unpacked: Path, ships: Mapping[str, str], received: Sequence[Mapping[str, Sequence[float]]], outputs: Iterable[str]
) -> Script:
    """The script of a collision of ships that adopt their states after it. It prints the digest of the state four times
    on the way, then the outputs, vectors by their names.

    ships: their files by name. received: by step the values of inputs, vectors by their names. The second half is made
    twice.
    """
    script = Script(unpacked)
    for name, ship in ships.items():
        script.set("string", f"{name}.ship", ship)
        script.set("string", f"{name}.feedback_name", "state")

    def step(k: int, says_state: bool = True) -> None:
        for name, values in received[k].items():
            script.set("real", name, *values)
        if k == 0:
            script.say(f"begin {bits(0.0)}")
        script.step(k * STEP)
        if says_state and (k + 1) % (len(received) // 4) == 0:
            script.say("state")  # in place of the state that was saved

    half = len(received) // 2
    for k in range(half):
        step(k)
    script.say("save")
    for k in range(half, len(received)):
        step(k, says_state=False)
    script.say("restore")
    for k in range(half, len(received)):
        step(k)
    for name in outputs:
        script.get(name, 3)
    return script
