"""OSG's text format: order, sharing, quoting; the z-up conversion; the sprite."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from shipcollision_fmu.ship.frames import rotation, rotation_from_quaternion
from shipcollision_fmu.show.osg import zup
from shipcollision_fmu.show.osg.osg_effects import build_sprites
from shipcollision_fmu.show.osg.osgt import Item, Raw, format_document, format_numbers, quote
from shipcollision_fmu.show.scene.scene import convert_attitudes

from . import osgt_reader


def read(root: Item, folder: Path) -> osgt_reader.Node:
    (folder / "a.osgt").write_text(format_document(root))
    return osgt_reader.read(folder / "a.osgt")


def test_properties_stand_in_the_order_in_which_osg_reads_them() -> None:
    text = format_document(
        Item("osg::Sequence", Mode=Raw("START"), TimeList=Raw("1 {\n2\n}"), Children=[], Name=quote("s"))
    )
    words = text.split()
    assert [words.index(word) for word in ("Name", "Children", "TimeList", "Mode")] == sorted(
        words.index(word) for word in ("Name", "Children", "TimeList", "Mode")
    )


def test_a_property_that_osg_would_skip_is_refused() -> None:
    with pytest.raises(ValueError, match=r"osg::Geode has no property \['Children'\]"):
        Item("osg::Geode", Children=[])


def test_an_object_that_occurs_twice_is_written_once(tmp_path: Path) -> None:
    shared = Item("osg::Geode", Name=quote("shared"))
    first, second = read(Item("osg::Group", Children=[shared, shared]), tmp_path)["Children"]
    assert first is second
    assert osgt_reader.name(first) == "shared"


@pytest.mark.parametrize("name", ["<script>", 'a "b" \\ c', "} Children 1 {", "два", "line\nbreak"])
def test_a_name_stays_a_name(name: str, tmp_path: Path) -> None:
    node = read(Item("osg::Group", Name=quote(name), Children=[Item("osg::Group")]), tmp_path)
    assert osgt_reader.name(node) == name.replace("\n", " ")
    assert len(node["Children"]) == 1


def test_numbers_keep_a_tenth_of_a_millimetre_far_away() -> None:
    assert float(format_numbers([123456.7891])) == pytest.approx(123456.7891, abs=1e-4)


def test_z_up_conversion_of_places_and_attitudes_agrees() -> None:
    """A point carried by a ship arrives at the same place whether it is converted before or after."""
    rng = np.random.default_rng(3)
    attitude, point, position = rng.uniform(-1.0, 1.0, 3), rng.normal(size=3), rng.normal(size=3)
    turned = zup.convert_quaternions(convert_attitudes(attitude[None]))[0]
    before = zup.convert_vectors(position) + rotation_from_quaternion(turned) @ zup.convert_vectors(point)
    np.testing.assert_allclose(before, zup.convert_vectors(position + rotation(attitude) @ point), atol=1e-12)


def test_z_up_axes() -> None:
    """East, north and up are x, y and z; so are starboard, forward and up of a ship that heads north."""
    np.testing.assert_array_equal(zup.convert_vectors(np.eye(3)), [[0, 1, 0], [1, 0, 0], [0, 0, -1]])
    np.testing.assert_allclose(zup.convert_quaternions(convert_attitudes(np.zeros((1, 3)))), [[0, 0, 0, 1]], atol=0)
    east = rotation_from_quaternion(zup.convert_quaternions(convert_attitudes(np.array([[0.0, 0.0, np.pi / 2]])))[0])
    np.testing.assert_allclose(east @ [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], atol=1e-12)  # forward points east
    np.testing.assert_allclose(east @ [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], atol=1e-12)  # starboard points south


def test_the_sprite_is_round_and_soft_in_both_formats() -> None:
    """Pillow reads both; the opacity falls from the middle to nothing at the edge."""
    for name, data in build_sprites().items():
        pixels = np.asarray(Image.open(io.BytesIO(data)).convert("RGBA")).astype(int)
        assert pixels.shape == (64, 64, 4), name
        opacity = pixels[..., 3]
        assert opacity[32, 32] > 140, name
        assert max(opacity[0].max(), opacity[:, 0].max()) == 0, name
        assert (np.diff(opacity[32, 32:]) <= 0).all(), name
        assert np.ptp(pixels[..., :3]) == 0, name
