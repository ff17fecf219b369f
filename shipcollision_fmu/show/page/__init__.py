"""replay.html: the scene in one file that any browser plays, without a network and from a file: address.

It contains the bundle of src/ (three.js, uPlot and our modules), which the package's build makes; scene.glb, packed by
gzip, in base64; and the scene's curves, events and effects as JSON. The page shows all text of the run as text; `<`
is escaped, so that no name can end its element. A content security policy forbids the page every address.
"""

from __future__ import annotations

import base64
import gzip
import html
import json
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from ... import __version__
from ...errors import HostError
from ...files import IN_PLACE, write_file
from ...ship.frames import Array
from ..gltf.gltf import build_glb, collect_extras
from ..scene.palette import choose_topsides, find_paint
from ..scene.plan import find_convex_hull, find_plan
from ..scene.scene import Scene, Ship, load_scene
from ..scene.signals import Signals
from ..scene.wheelhouse import find_wheelhouse

__all__ = ["COMPARISON", "PAGE", "build_comparison", "build_page", "describe_ship", "write_page"]

PAGE = "replay.html"
COMPARISON = "compare.html"

_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
    "connect-src blob:; base-uri 'none'; form-action 'none'"
)
_TEMPLATE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<title>{title}</title>
<link rel="icon" href="data:,">
<style>{style}</style>
</head>
<body>
<script type="application/json" id="scene-data">{data}</script>
<script type="text/plain" id="scene-glb">{glb}</script>
{other}<script>{script}</script>
</body>
</html>
"""


def write_page(folder: Path) -> Path:
    """Write the page of the run in a folder into it; the page's path. Raises InputError, HostError."""
    return write_file(folder / PAGE, build_page(load_scene(folder)), IN_PLACE)


def build_page(scene: Scene) -> str:
    """The page of a scene; the same text for the same scene. Raises HostError when the bundle has not been built."""
    return _fill_template(scene.name, _collect_data(scene), scene)


def build_comparison(scene: Scene, label: str, other: Scene, other_label: str) -> str:
    """The page of two scenes on one clock: the ships of the other are outlines. Raises HostError like `build_page`."""
    data = _collect_data(scene) | {"label": label, "other": _collect_data(other) | {"label": other_label}}
    return _fill_template(f"{label}, {other_label}", data, scene, other)


def _fill_template(title: str, data: dict[str, Any], scene: Scene, other: Scene | None = None) -> str:
    more = "" if other is None else f'<script type="text/plain" id="other-glb">{_encode_glb(other)}</script>\n'
    return _TEMPLATE.format(
        policy=_POLICY,
        title=html.escape(title),
        style=_read_bundle("page.css"),
        data=json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c"),
        glb=_encode_glb(scene),
        other=more,
        script=_read_bundle("page.js"),
    )


def _encode_glb(scene: Scene) -> str:
    return base64.b64encode(gzip.compress(build_glb(scene), mtime=0)).decode()


def _read_bundle(name: str) -> str:
    file = files(__package__) / "bundle" / name
    if not file.is_file():
        raise HostError(
            "the page's bundle is missing, which is made when the package is installed: run `python -m pip install .` "
            "(or `-e .`) in the project's folder"
        )
    return file.read_text(encoding="utf-8")


def _collect_data(scene: Scene) -> dict[str, Any]:
    clearance = scene.signals.of("clearance")
    return {
        **collect_extras(scene),
        "name": scene.name,
        "version": __version__,
        "is_native": scene.is_native,
        "ships": [describe_ship(i, ship) for i, ship in enumerate(scene.ships)],
        "outlines": {ship.name: _round(find_convex_hull(ship.hull.vertices[:, :2])) for ship in scene.ships},
        "obstacles": [_round(find_plan(obstacle) - scene.origin[:2]) for obstacle in scene.obstacles],
        "scratches": [
            {"id": s.id, "ship": s.ship, "other": s.other, "times": s.times.tolist()} for s in scene.scratches
        ],
        "wind": scene.wind.round(2).tolist(),
        "dents": [
            {
                "kind": dent.kind,
                "ship": dent.ship,
                "point": dent.point.tolist(),
                "outwards": dent.outwards.tolist(),
                "time": dent.time,
                "duration": dent.duration,
                "depth": dent.depth,
                "half_width": dent.half_width,
            }
            for dent in scene.dents
        ],
        "least_clearance": min((float(curve.values.min()) for curve in clearance), default=None),
        "signals": _encode_signals(scene.signals),
    }


def describe_ship(index: int, ship: Ship) -> dict[str, Any]:
    """Names, colour and sizes of a ship; `hull`: colour of its topsides; `height` of the deck above the waterline,
    `bridge`: eye and wing in b [m]."""
    is_grey = any(paint == "naval" for paint, _ in ship.shell)
    return {
        "name": ship.name,
        "model": ship.model,
        "kind": ship.kind,
        "L_oa": ship.L_oa,
        "colour": choose_topsides(index).colour,
        "hull": (find_paint("naval") if is_grey else choose_topsides(index)).colour,
        "height": -float(ship.hull.vertices[:, 2].min()),
        "bridge": find_wheelhouse(ship),
    }


def _round(points: Array) -> list[list[float]]:
    """Points in centimetres, which is less than a track plot shows."""
    rounded: list[list[float]] = np.round(points, 2).tolist()
    return rounded


def _encode_signals(signals: Signals) -> dict[str, Any]:
    """Times and curves, one after the other, in single precision, in base64."""
    numbers = np.concatenate([signals.times, *(curve.values for curve in signals.curves)]).astype("<f4")
    return {
        "rows": len(signals.times),
        "curves": [{"quantity": c.quantity, "ship": c.ship, "unit": c.unit} for c in signals.curves],
        "values": base64.b64encode(numbers.tobytes()).decode(),
    }
