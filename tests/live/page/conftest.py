"""Two tankers, served, and the bridge of one of them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from selenium.webdriver import Chrome

from shipcollision_fmu.live.session.commands import Back
from shipcollision_fmu.live.session.pacer import Pacer
from tests.live.page.live_server import PATIENCE, BridgePage, LiveServer, serve_live
from tests.live.page.two_tankers import write_apart


@pytest.fixture(scope="module")
def apart(browser: Chrome, tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveServer]:
    """Two tankers, a mile and a half apart, four times as fast as the clock. That a busy machine does not keep up is
    never said, as no page here is about it: it would be an alarm."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Pacer, "is_paced", lambda pacer, now: True)
        with serve_live(browser, write_apart(tmp_path_factory.mktemp("apart")), rate=4.0) as served:
            yield served


@pytest.fixture
def server(apart: LiveServer) -> LiveServer:
    """The two tankers where they began: after minutes at the wheel, on a busy machine, they could meet."""
    apart.pause()
    apart.session.submit(Back("start")).result(PATIENCE)
    apart.pause(False)
    return apart


@pytest.fixture
def bridge(browser: Chrome, server: LiveServer) -> BridgePage:
    """The bridge of own, in command of it, and up to date."""
    page = BridgePage(browser, server.address())
    server.pause()
    page.wait_for(server.session.snapshot.step_count)
    page.wait("return live.state.command.own === live.client")
    server.pause(False)
    page.wait("return !live.state.paused")
    return page
