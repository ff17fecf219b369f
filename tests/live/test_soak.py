"""A live run of hours, with people at it: its memory must not grow.

The command as people start it, at 20 times real time, with NMEA, AIS and DIS going out, and three who watch: one
steers, one only looks, one never reads. .ci/run takes the ten minutes; the eight hours take 24 minutes by hand:

    python -m pytest -m soak tests/live/test_soak.py --log-cli-level=INFO
"""

from __future__ import annotations

import json
import logging
import threading
import time
from contextlib import ExitStack
from pathlib import Path

import psutil
import pytest
from websockets.sync.client import ClientConnection, connect

from .live_command import live_command
from .live_server import PATIENCE, receive

pytestmark = pytest.mark.soak

GROWTH = 6e6
"""Bytes: what lists of some thousand orders may take, and the allocator's own play."""


def steer(client: ClientConnection, ended: threading.Event) -> None:
    """Takes the ship and turns its rudder from side to side, so that it goes in curves for hours."""
    client.send(json.dumps({"type": "command", "id": 0, "ship": "own", "take": True}))
    side, turn = 20.0, 0
    while (message := receive(client))["type"] != "end":
        if message["type"] == "state" and (now := int(message["time"] // 120.0)) > turn:
            turn, side = now, -side
            client.send(json.dumps({"type": "order", "id": turn, "ship": "own", "rudder_deg": side}))
    ended.set()


@pytest.mark.parametrize(
    "duration", [pytest.param(12_000.0, id="ten_minutes"), pytest.param(28_800.0, id="eight_hours")]
)
def test_memory_stays_flat(tmp_path: Path, duration: float) -> None:
    """At 20 times real time, after a tenth and before the end."""
    ended = threading.Event()
    outgoing = "--nmea", "udp://127.0.0.1:9", "--dis", "udp://127.0.0.1:9"
    options = "--rate", "20", "--duration", str(duration), *outgoing
    with live_command(tmp_path, *options) as live, ExitStack() as clients:
        own, looker, _silent = (
            clients.enter_context(connect(live.socket, open_timeout=PATIENCE, ping_interval=None, close_timeout=1))
            for _ in range(3)
        )
        threading.Thread(target=steer, args=(own, ended), daemon=True).start()
        server, early, last = psutil.Process(live.process.pid), 0, 0
        while (message := receive(looker))["type"] != "end":
            if message["type"] != "state" or not 0.1 < message["time"] / duration < 0.98:
                continue  # to store the run is no matter of its length: results are copied from file to file
            last = server.memory_info().rss
            if not early:
                early, begun, time_then = last, time.monotonic(), message["time"]
        rate = (0.98 * duration - time_then) / (time.monotonic() - begun)
        figures = early / 1e6, last / 1e6, rate
        logging.info("%.1f MB after a tenth, %.1f MB before the end, at %.1f times real time", *figures)
        assert ended.wait(PATIENCE)
        assert live.process.wait(600.0) == 0, (tmp_path / "errors.txt").read_text()
    assert 0 < last < early + GROWTH
    assert json.loads((tmp_path / "run" / "timing.json").read_bytes())["mode"] == "live"
