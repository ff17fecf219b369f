"""The response to contact: the same bits on each platform that can be run here, and no memory once there was enough."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.native.collision.geometry.test_platforms import run

pytestmark = [pytest.mark.slow, pytest.mark.needs("pybullet")]
HERE = Path(__file__).parent


@pytest.mark.parametrize(
    "platform",
    [
        pytest.param("win64", marks=pytest.mark.needs("wine")),
        pytest.param("aarch64-linux", marks=pytest.mark.needs("qemu-aarch64")),
    ],
)
def test_bits_are_the_same(platform: str, tmp_path: Path) -> None:
    digest = run("linux64", "answer", ["3000"], "", tmp_path, HERE)
    assert run(platform, "answer", ["3000"], "", tmp_path, HERE) == digest
    answered, together = (int(part.split()[0]) for part in digest[17:].split(", "))
    assert answered > 1000
    assert together > 500


def test_memory_ends_at_every_request(tmp_path: Path) -> None:
    """The step is then refused; once there was enough, none is asked for."""
    said = run("linux64", "scarce", [], "", tmp_path, HERE)
    needed, later = (int(part.split()[0]) for part in said.split(", "))
    assert needed > 40
    assert later == 0
