"""Packages without the cost of their FMUs."""

from __future__ import annotations

import pytest

from shipcollision_fmu.packaging import instance as instance_module


@pytest.fixture
def empty_fmus(monkeypatch: pytest.MonkeyPatch) -> None:
    """For tests of what is around the FMUs, which take a third of a second each."""
    monkeypatch.setattr(instance_module, "instance_fmu", lambda *a: b"no FMU")
