"""A whole encounter has the same bits on each platform that can be run here: outputs and saved state of each step."""

from __future__ import annotations

from pathlib import Path

import pytest

from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from tests.native.collision.geometry.test_platforms import run

pytestmark = [pytest.mark.slow, *(pytest.mark.needs(name) for name in ("pybullet", "wine", "qemu-aarch64"))]
HERE = Path(__file__).parent


def test_an_encounter_has_the_same_bits_on_each_platform(tmp_path: Path) -> None:
    arguments = ["300"]
    for name in ("kvlcc2", "guan2014_target_added_mass", "kcs", "buoy"):
        place = tmp_path / f"{name}.ship"
        place.write_bytes(prepare_ship(name))
        arguments.append(str(place))
    digest = run("linux64", "collide", arguments, "", tmp_path, HERE)
    in_contact, collisions = (int(part.split()[0]) for part in digest[17:].split(", "))
    assert in_contact > 20
    assert collisions > 1
    for platform in ("win64", "aarch64-linux"):
        assert run(platform, "collide", arguments, "", tmp_path, HERE) == digest
