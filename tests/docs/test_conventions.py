"""The conventions page against the converters in the code, and its figure against the script that draws it."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from math import pi, radians, sqrt
from pathlib import Path

import numpy as np
import pytest

from docs.generate.frames import FIGURE, GLTF_FROM_N, svg
from shipcollision_fmu.encounters.units import KNOT
from shipcollision_fmu.results.published import paper_quantities
from shipcollision_fmu.scenario.tables.environment import Environment
from shipcollision_fmu.scenario.tables.ship_start import ShipStart
from shipcollision_fmu.ship.frames import SWAP, Array, quaternion, quaternion_w, rotation, swap_axes
from shipcollision_fmu.ship.ship_state import ShipState
from shipcollision_fmu.show.osg.zup import convert_quaternions, convert_vectors

PAGE = Path(__file__).parents[2] / "docs" / "conventions.md"
POINT = (3.0, 5.0, -7.0)


def evaluated(cell: str, names: str, values: tuple[float, ...]) -> tuple[float, ...]:
    """A cell such as `(E, N, -D)` with numbers put in for its names."""
    parts = cell.strip("`() ").split(", ")
    known = dict(zip(names.split(), values, strict=True))
    return tuple(-known[part[1:]] if part.startswith("-") else known[part] for part in parts)


def rows() -> dict[str, tuple[tuple[float, ...], tuple[float, ...]]]:
    """By convention: POINT as a vector in n and as a vector in b, as the page converts them."""
    lines = re.findall(
        r"^\| (.+?) \| .+? \| (`\(.+?\)`) \| .+? \| (`\(.+?\)`) \|", PAGE.read_text("utf-8"), re.MULTILINE
    )
    return {
        name: (evaluated(world, "N E D", POINT), evaluated(body, "x y z", POINT)) for name, world, body in lines
    }  # fmt: skip


def bullet(v: tuple[float, ...]) -> tuple[float, ...]:
    assert tuple(SWAP @ v) == swap_axes(v)
    return swap_axes(v)


def osg(v: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(convert_vectors(np.array(v)))


def paper(v: tuple[float, ...]) -> tuple[float, ...]:
    """The position of a ship at v in n, upright, with CG at CO."""
    state = paper_quantities(ShipState(*v, *[0.0] * 9), np.zeros(3))
    return state["x"], state["y"], state["z"]


def same(v: tuple[float, ...]) -> tuple[float, ...]:
    return v


def gltf(v: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(np.round(GLTF_FROM_N @ v, 12))


CONVERTERS: dict[str, tuple[Callable[..., object], Callable[..., object]]] = {
    "**n, b** (Fossen, SNAME, FMI, files)": (same, same),
    "**w** (Bullet)": (bullet, bullet),
    "OpenSceneGraph": (osg, osg),
    "Guan et al. (2014)": (paper, bullet),
    "glTF, replay page": (gltf, same),
    "MMG (Yasukawa and Yoshimura 2015)": (same, same),
}


@pytest.mark.parametrize("name", CONVERTERS)
def test_a_row_is_what_the_code_converts(name: str) -> None:
    world, body = rows()[name]
    to_world, to_body = CONVERTERS[name]
    assert to_world(POINT) == world
    assert to_body(POINT) == body


def test_every_row_has_a_converter() -> None:
    assert set(rows()) == set(CONVERTERS)


def test_both_sides_of_a_rotation_are_swapped() -> None:
    """R_w = S R_nb S, and its quaternion, as the page has it, Bullet's and OpenSceneGraph's."""
    R = rotation([0.1, -0.2, 2.0])
    x, y, z, w = quaternion(R)
    expected = evaluated("(q_y, q_x, -q_z, q_w)", "q_x q_y q_z q_w", (x, y, z, w))
    assert "q_w  = (q_y, q_x, -q_z, q_w)" in PAGE.read_text("utf-8")
    assert quaternion_w(R) == pytest.approx(expected, abs=1e-15)
    assert convert_quaternions(quaternion(R)) == pytest.approx(expected, abs=1e-15)
    assert quaternion(SWAP @ R @ SWAP) == pytest.approx(expected, abs=1e-12)


def test_the_papers_quaternion_and_rates() -> None:
    """phi, theta, psi go with r, p, -h; and u, v, w with v_y, v_x, -v_z of a ship that heads north."""
    for i, quantity, sign in ((0, "r", 1), (1, "p", 1), (2, "h", -1)):
        attitude = [0.2 if i == k else 0.0 for k in range(3)]
        heeled = paper_quantities(ShipState(0.0, 0.0, 0.0, *attitude, *[0.0] * 6), np.zeros(3))
        assert heeled[quantity] == pytest.approx(sign * np.sin(0.1))  # type: ignore[index]  # a quantity by its name
    state = paper_quantities(ShipState(*[0.0] * 6, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0), np.zeros(3))
    assert (state["v_y"], state["v_x"], -state["v_z"]) == (1.0, 2.0, 3.0)
    assert (state["w_y"], state["w_x"], -state["w_z"]) == (4.0, 5.0, 6.0)


def test_the_root_of_a_glb_turns_n_into_gltf(gltf_root: Array) -> None:
    np.testing.assert_allclose(gltf_root, [sqrt(0.5), 0.0, 0.0, sqrt(0.5)], atol=1e-15)


@pytest.fixture(scope="module")
def gltf_root(tmp_path_factory: pytest.TempPathFactory) -> Array:
    """Rotation of the root node in scene.glb of the published run."""
    from shipcollision_fmu import load_scenario, simulate
    from shipcollision_fmu.show.gltf.gltf import build_glb
    from shipcollision_fmu.show.scene.scene import load_scene

    run = tmp_path_factory.mktemp("run")
    simulate(load_scenario("guan2014_added_mass"), in_process=True, out=run)
    data = build_glb(load_scene(run))
    content = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    root = content["nodes"][content["scenes"][content["scene"]]["nodes"][0]]
    assert root["name"] == "n"
    return np.array(root["rotation"])


def test_the_navigators_angles_and_units() -> None:
    """East is 90 degrees; the current goes to its direction, the wind comes from its own; a knot."""
    start = ShipStart(ship="kvlcc2", position=[0.0, 0.0], heading_deg=90.0, speed=1.0).start
    assert start.attitude[2] == pi / 2
    assert rotation(start.attitude) @ start.velocity == pytest.approx([0.0, 1.0, 0.0], abs=1e-15)
    current = Environment.model_validate({"current": {"speed": 1.0, "towards_deg": 90.0}}).current
    assert current == pytest.approx([0.0, 1.0], abs=1e-15)
    assert pytest.approx(0.514444, abs=1e-6) == KNOT
    assert radians(1.0) / 60.0 == pytest.approx(2.909e-4, rel=1e-3)


def test_the_figure_is_what_the_script_draws() -> None:
    assert FIGURE.read_text("utf-8") == svg()
