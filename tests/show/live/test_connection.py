"""When the live page takes its connection for lost."""

from __future__ import annotations

import pytest

from .javascript import run_javascript

PAGE = """
    let look;
    globalThis.setInterval = (listener) => (look = listener);
    globalThis.setTimeout = () => 0;
    globalThis.location = { protocol: "http:", host: "here" };
    globalThis.WebSocket = class { close() {} };
    let now = 0;
    Object.defineProperty(globalThis, "performance", { value: { now: () => now } });
    const heard = [];
    const connection = new Connection("bridge", "token", (type) => heard.push(type));
    connection.socket.onopen();
    for (const step of data) {
      if (step === "look") (now += 500), look();
      else if (step === "busy") now += 10000;
      else connection.socket.onmessage({ data: JSON.stringify({ type: "state" }) });
    }
    return heard;
"""


@pytest.mark.parametrize(
    ("steps", "wanted"),
    [
        (["busy", "look", "message", "look"], ["open", "state"]),  # a large picture was read meanwhile
        (["message", *["look"] * 6], ["open", "state"]),
        (["message", *["look"] * 7], ["open", "state", "lost"]),
        ([*["look"] * 5, "message", *["look"] * 5], ["open", "state"]),
    ],
)
def test_silence_counts_only_while_the_page_listens(steps: list[str], wanted: list[str]) -> None:
    assert run_javascript("live/connection.js", "Connection", PAGE, steps) == wanted
