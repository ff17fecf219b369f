"""Two tankers that never meet."""

from __future__ import annotations

from pathlib import Path

APART = """
[scenario]
name = "apart"
duration = 600.0
step = 0.1

[ships.own]
ship = "kvlcc2"
position = [0.0, 0.0]
heading_deg = 350.0
speed = 6.0
hydrodynamics = true
orders = [{ time = 0.0, rev_per_s = 0.9 }]

[ships.target]
ship = "kvlcc2"
position = [{north}, {east}]
heading_deg = 90.0
speed = {speed}
hydrodynamics = true
"""


def write_apart(folder: Path, north: float = 3000.0, east: float = 1000.0, speed: float = 1.0) -> Path:
    """A scenario of two tankers; with these numbers they never meet."""
    path = folder / "apart.toml"
    numbers = {"north": north, "east": east, "speed": speed}
    text = APART
    for name, value in numbers.items():
        text = text.replace(f"{{{name}}}", str(value))
    path.write_text(text, encoding="utf-8")
    return path
