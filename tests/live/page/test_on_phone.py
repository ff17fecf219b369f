"""Both pages on a phone."""

from __future__ import annotations

import pytest
from selenium.webdriver import Chrome

from tests.live.page.live_server import BridgePage, LiveServer
from tests.live.page.on_phone import PHONE, TOUCH, as_phone


@pytest.mark.parametrize("role", ["bridge", "instructor"])
def test_on_a_phone_nothing_is_cut_off_and_fingers_hit(browser: Chrome, server: LiveServer, role: str) -> None:
    with as_phone(browser):
        page = BridgePage(browser, server.address(role))
        page.wait("return live.state")
        assert page.run("return innerWidth") == PHONE[0]
        assert page.run("return document.documentElement.scrollWidth") <= PHONE[0]
        small = page.run(
            """return [...document.querySelectorAll('button, select, input, a, [role=slider]')]
            .map((one) => [one.id || one.textContent, one.getBoundingClientRect()])
            .filter(([, box]) => box.width && Math.min(box.width, box.height) < arguments[0] - 0.01)
            .map(([name]) => name)""",
            TOUCH,
        )
        assert small == []
        if role == "bridge":  # however many alarms there are, they are one bar over the picture
            page.run(
                "for (const key of 'abcd') live.session.alarms.set(key, true, 'alarm', () => 'Words of alarm ' + key)"
            )
            page.wait("return document.querySelectorAll('#alarms li').length >= 4")
            bar = page.run("return document.querySelector('.alarm-bar').getBoundingClientRect()")
            assert bar["right"] <= PHONE[0]
            assert bar["height"] < 1.2 * TOUCH
        browser.get("about:blank")


def test_on_a_phone_the_tools_of_the_large_chart_can_be_tapped(browser: Chrome, server: LiveServer) -> None:
    with as_phone(browser):
        page = BridgePage(browser, server.address())
        page.wait("return live.state && document.body.dataset.ready")
        page.run("document.getElementById('chart-large').click()")
        hidden = page.run("""
            return [...document.querySelectorAll('.chart-tools button, .stage-tools button, .stage-tools select')]
                .filter((one) => {
                    const { left, right, top, bottom } = one.getBoundingClientRect();
                    return [[left + 4, top + 4], [right - 4, bottom - 4], [(left + right) / 2, (top + bottom) / 2]]
                        .some(([x, y]) => !one.contains(document.elementFromPoint(x, y)));
                }).map((one) => one.id || one.textContent)""")
        browser.get("about:blank")
    assert hidden == []


def test_on_a_phone_the_most_urgent_alarm_is_seen_first(browser: Chrome, server: LiveServer) -> None:
    """A collision, whatever else has been raised, acknowledged or is over before it; of others the newest."""
    with as_phone(browser):
        page = BridgePage(browser, server.address())
        page.wait("return live.state && document.body.dataset.ready")
        seen = page.run("""
            const { alarms } = live.session;
            alarms.list.clear();
            const raise = (key, priority = 'alarm', isThere = true) =>
                alarms.set(key, isThere, priority, () => 'Words of alarm ' + key);
            const first = () => {
                live.session.hear('event', {});
                const list = document.getElementById('alarms').getBoundingClientRect();
                return document.elementFromPoint(list.left + 20, list.top + list.height / 2).dataset.alarm;
            };
            const found = [];
            for (const key of ['one', 'two', 'three']) raise(key);
            found.push(first());
            raise('two', 'alarm', false);
            raise('contact');
            document.getElementById('alarms').scrollLeft = 400;
            raise('four');
            found.push(first());
            alarms.acknowledge();
            raise('five');
            raise('five', 'alarm', false);
            found.push(first());
            raise('careful', 'caution');
            found.push(first());
            return found;
        """)
        browser.get("about:blank")
    assert seen == ["three", "contact", "contact", "contact"]
