"""Settings of the whole suite."""

from __future__ import annotations

from hypothesis import settings

# Examples vary in cost by orders of magnitude, and machines in speed: time is not what these tests are about.
# The same examples every time, so that red means a change; `--hypothesis-profile=search` looks for new ones.
settings.register_profile("shipcollision", deadline=None, max_examples=25, derandomize=True)
# CI's slow stage takes more of them for the laws of contact: `--hypothesis-profile=thorough`.
settings.register_profile("thorough", deadline=None, max_examples=250, derandomize=True)
settings.register_profile("search", deadline=None, max_examples=400)
settings.load_profile("shipcollision")
