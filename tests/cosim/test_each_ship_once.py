"""A run reads each ship file once and builds each hull once, through FMUs as well: they share the process's modules."""

from __future__ import annotations

from collections import Counter

import pytest

from shipcollision_fmu import load_scenario, simulate
from tests.ship.loading.test_same_content import counts

__all__ = ["counts"]


@pytest.mark.parametrize("in_process", [True, False])
def test_each_ship_file_is_read_once(counts: Counter[str], in_process: bool) -> None:
    simulate(load_scenario("guan2014_added_mass").changed(step=0.5), in_process=in_process)
    names = ("own", "target", "own_added_mass", "target_added_mass")
    assert counts == {**{f"guan2014_{name}.toml": 1 for name in names}, "hulls": 2}
