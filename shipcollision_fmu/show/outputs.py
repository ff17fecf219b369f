"""Pictures of a run by kind, as `shipcollision show` offers them, and the files of each kind."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..errors import InputError
from ..files import IN_PLACE, write_file
from .film import animation
from .gltf.gltf import build_glb
from .osg import osg
from .page import COMPARISON, PAGE, build_comparison, build_page
from .plots import FOLDER, write_plots
from .scene.scene import Scene, load_scene

__all__ = ["PAGE", "PICTURES", "describe", "load_scene", "remove", "write", "write_comparison", "write_page"]

PICTURES = {
    PAGE: "the page: open it in a browser",
    COMPARISON: "this run and another, --compare OTHER",
    "scene.glb": "glTF 2.0, --glb",
    "scene.osgt": "OpenSceneGraph, --osg",
    FOLDER: "figures, --plots",
    "impact.gif": "film, --gif",
    "impact.mp4": "film, --mp4",
    "still.png": "picture, --still S",
}
"""Pictures in the folder of a run, and what they are."""


def write_page(scene: Scene, folder: Path) -> Path:
    """Write the page; returns its path."""
    return write_file(folder / PAGE, build_page(scene), IN_PLACE)


def write_comparison(folder: Path, other: Path) -> Path:
    """Write the page of the runs in two folders into the first; returns its path.

    Raises InputError when they are the same folder or one is not that of a complete run, HostError.
    """
    if folder.resolve() == other.resolve():
        raise InputError(f"{other} is the run itself: give --compare the folder of another run")
    labels = (folder.resolve().name, other.resolve().name)
    if labels[0] == labels[1]:
        labels = ("/".join(folder.resolve().parts[-2:]), "/".join(other.resolve().parts[-2:]))
    text = build_comparison(load_scene(folder), labels[0], load_scene(other), labels[1])
    return write_file(folder / COMPARISON, text, IN_PLACE)


def write(
    kind: str, scene: Scene, folder: Path, still: float | None, progress: Callable[[int, int], None]
) -> list[str]:
    """Write the pictures of a kind into `folder`; returns lines with their paths. still: the time of a still [s].

    Raises HostError when a file cannot be written or a package is missing, InputError for a time outside the run.
    """
    if kind == "page":
        return [str(write_page(scene, folder))]
    if kind == "glb":
        return [str(write_file(folder / "scene.glb", build_glb(scene), IN_PLACE))]
    if kind == "osg":
        paths = osg.write_osg(scene, folder)
        return [
            str(paths[-1]),
            "to see it (Debian: apt install openscenegraph):",
            f"  {osg.format_viewer_command(folder)}",
        ]
    if kind == "plots":
        return [str(path) for path in write_plots(scene, folder)]
    if kind == "gif":
        return [str(animation.write_gif(scene, folder, progress))]
    if kind == "mp4":
        return [str(animation.write_mp4(scene, folder, progress))]
    return [str(animation.write_still(scene, folder, scene.start if still is None else still))]


def remove(folder: Path) -> None:
    """Remove all pictures from the folder; other files stay."""
    for name in PICTURES:
        place = folder / name
        for file in sorted(place.iterdir()) if place.is_dir() else [place]:
            if file.suffix in (".html", ".glb", ".osgt", ".png", ".svg", ".gif", ".mp4"):
                file.unlink(missing_ok=True)


def describe(scene: Scene, folder: Path) -> list[str]:
    """Lines on the run and on the pictures of it in the folder."""
    ships = ", ".join(_replace_unprintable(ship.name) for ship in scene.ships)
    count = len(scene.events)
    collisions = f"{count or 'no'} collision{'' if count == 1 else 's'}"
    kind = ", native run" if scene.is_native else ""
    lines = [f"{_replace_unprintable(scene.name)}: {scene.end - scene.start:g} s{kind}, {collisions}, ships {ships}"]
    for name, what in PICTURES.items():
        there = "" if (folder / name).exists() else " (not written yet)"
        lines.append(f"  {name:<12} {what}{there}")
    return lines


def _replace_unprintable(name: str) -> str:
    return "".join(c if c.isprintable() else " " for c in name)
