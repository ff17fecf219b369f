"""What the live pages say of who is in command."""

from __future__ import annotations

from typing import Any

import pytest

from .javascript import run_javascript


@pytest.mark.parametrize(
    ("info", "holder", "said"),
    [
        ({"limits": {}, "recorded": False}, None, "Nobody is in command."),
        ({"limits": {}, "recorded": False}, "bridge-1", "You are in command."),
        ({"limits": {}, "recorded": False}, "bridge-2", "bridge-2 is in command."),
        ({"limits": None, "recorded": True}, None, "This ship follows a recorded track."),
        ({"limits": None, "recorded": False}, None, "This ship takes no orders."),
    ],
)
def test_a_ship_that_nobody_can_steer_waits_for_nobody(info: dict[str, Any], holder: str | None, said: str) -> None:
    body = "return commandWords(data[0], data[1], 'bridge-1');"
    assert run_javascript("live/conning.js", "commandWords", body, [info, holder]) == said
