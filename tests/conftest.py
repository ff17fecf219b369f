"""Settings of the whole suite."""

from __future__ import annotations

from hypothesis import settings

# Examples vary in cost by orders of magnitude, and machines in speed: time is not what these tests are about.
settings.register_profile("shipcollision", deadline=None, max_examples=100)
settings.load_profile("shipcollision")
