"""Every name that a module exports is there."""

from __future__ import annotations

from importlib import import_module
from pkgutil import walk_packages

import pytest

import shipcollision_fmu

MODULES = [
    "shipcollision_fmu",
    *(found.name for found in walk_packages(shipcollision_fmu.__path__, "shipcollision_fmu.")),
]


@pytest.mark.parametrize("name", [name for name in MODULES if not name.endswith("__main__")])
def test_exported_names_exist(name: str) -> None:
    module = import_module(name)
    exported = getattr(module, "__all__", [])
    assert [public for public in exported if not hasattr(module, public)] == []
    assert len(exported) == len(set(exported))
