"""Ten minutes on the wall clock with three browsers, one of them stuck: time holds, and states come 20 times a second.

By hand, as three browsers without a graphics card take all of two cores:

    python -m pytest -m soak tests/live/page/test_ten_minutes.py --log-cli-level=INFO
"""

from __future__ import annotations

import logging
from contextlib import ExitStack
from itertools import count
from pathlib import Path
from time import monotonic

import pytest
from websockets.sync.client import connect

from tests.live.live_command import live_command
from tests.live.live_server import receive
from tests.show.browser import chromium

from .live_server import BridgePage

pytestmark = pytest.mark.soak

MINUTES = 10.0
RATE = 20.0
"""States per second of the wall clock."""
SMALL = (500, 440)
"""Size of the windows [pixels]: three browsers share the processor."""
COUNT = """
    const connection = live.session.connection;
    const hear = connection.hear;
    window.heard = 0;
    connection.hear = (type, message) => {
        window.heard += type === "state";
        hear(type, message);
    };
"""
STICK = "setInterval(() => { const end = performance.now() + 4000; while (performance.now() < end); }, 4100);"
"""A page that hardly ever comes to read."""


def test_time_holds_with_three_browsers(tmp_path: Path) -> None:
    """To 1 %, as a client without a page sees it and as the two pages show it that are not stuck."""
    minutes = "--duration", str(60 * MINUTES + 120)
    with live_command(tmp_path, "--rate", "1", *minutes) as live, ExitStack() as opened:
        pages = []
        for name in ("first", "second", "stuck"):
            pages.append(BridgePage(opened.enter_context(chromium(tmp_path / name)), live.page, SMALL))
            pages[-1].run(STICK if name == "stuck" else COUNT)
        stuck = pages.pop()
        client = opened.enter_context(connect(live.socket, ping_interval=None, close_timeout=1))
        states = (message for _ in count() if (message := receive(client))["type"] == "state")
        before = [page.run("return [live.state.time, heard, performance.now() / 1000]") for page in pages]
        first = next(states)
        begun = last = monotonic()
        came, longest = 0, 0.0
        for state in states:  # noqa: B007 - the last one is asked for its time
            now = monotonic()
            came, longest, last = came + 1, max(longest, now - last), now
            if now - begun > 60 * MINUTES:
                break
        after = [page.run("return [live.state.time, heard, performance.now() / 1000]") for page in pages]
        passed, took = state["time"] - first["time"], last - begun
        figures = passed, took, came / took, longest
        logging.info("%.2f s of the model in %.2f s; %.2f states a second, %.2f s apart at most", *figures)
        seen = [[b - a for a, b in zip(*both, strict=True)] for both in zip(before, after, strict=True)]
        for showed, heard, wall in seen:
            logging.info("a page showed %.2f s in %.2f s and heard %.2f states a second", showed, wall, heard / wall)
        assert stuck.run("return performance.now()") > 1e3 * took
    assert passed == pytest.approx(took, rel=0.01)
    assert came / took == pytest.approx(RATE, rel=0.05)
    for showed, heard, wall in seen:
        assert showed == pytest.approx(wall, rel=0.01)
        assert heard / wall > 0.5 * RATE
