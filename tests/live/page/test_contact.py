"""Ships touch: what is seen and heard of it, and the run that is left."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import time
from typing import Any

import pytest
from selenium.webdriver import Chrome, Keys
from selenium.webdriver.common.by import By

from shipcollision_fmu import load_scenario, simulate
from shipcollision_fmu.live.session.commands import Back, End, Pause
from tests.conftest import Write
from tests.live.page.live_server import PATIENCE, SMALL, BridgePage, press, serve_live
from tests.live.page.two_tankers import write_apart

TOLD = """
    const { connection } = live.session;
    const { hear } = connection;
    let isNews = true;
    window.told = [];
    connection.hear = (type, message) => {
        const isOfContact = type === "state" ? message.contact.count > 0 : message.kind === "collision begins";
        const before = live.session.contacts.length;
        hear(type, message);
        if (message.kind === "back") isNews = true;
        if (!isNews || !isOfContact) return;
        isNews = false;
        const alarm = document.querySelector("[data-alarm=contact]");
        told.push([live.session.contacts.length - before, alarm?.className, live.session.alarms.sounding]);
    };
"""
"""Writes down what the first message of each contact has done once it is read: contacts that are new, the alarm that is
shown, and the one that is heard."""


@pytest.mark.slow
def test_contact_is_seen_and_heard_with_the_first_message_of_it(browser: Chrome, scenario_file: Write) -> None:
    """That the message waits for no other is test_hub.py's."""
    with contact_three_times(browser, scenario_file) as (page, _):
        assert page.run("return told") == [[1, "alarm raised", "alarm"]] * 3


@pytest.mark.soak
def test_contact_is_seen_within_a_fifth_of_a_second(browser: Chrome, scenario_file: Write) -> None:
    """The least of three, on a machine that does nothing else."""
    with contact_three_times(browser, scenario_file) as (page, began):
        seen = page.run("return live.contacts.map(({ wall }) => wall / 1000)")
    delays = [there - here for here, there in zip(began, seen, strict=False)]
    assert len(delays) >= 3
    assert min(delays) > -0.002  # the page counts whole milliseconds
    assert min(delays) < 0.2


@contextmanager
def contact_three_times(browser: Chrome, scenario_file: Write) -> Iterator[tuple[BridgePage, list[float]]]:
    """A page after three times the same contact, by going back to the start, and when each began in the model [s]. Time
    stops with the contact, which would be over before a busy machine has looked."""
    began: list[float] = []
    with serve_live(browser, scenario_file(("duration = 3.0", "duration = 30.0")), paused=True) as served:

        def stop(event: dict[str, Any]) -> None:
            if event["kind"] == "collision begins":
                began.append(time())
                served.session.submit(Pause(True))

        served.session.listen(stop)
        page = BridgePage(browser, served.address(), SMALL)
        page.run(TOLD)
        for turn in range(3):
            press(page, "p")
            page.wait(f"return live.contacts.length > {turn}")
            assert page.run("return document.querySelector('[data-alarm=contact]').className") == "alarm raised"
            assert "own" in page.run("return document.querySelector('[data-alarm=contact]').textContent")
            press(page, Keys.ENTER)
            page.wait("return document.querySelector('[data-alarm=contact]').className === 'alarm silent'")
            page.wait("return Object.values(live.drawn().scratches).every((places) => places.length > 0)")
            served.session.submit(Back("start")).result(PATIENCE)
            page.wait("return live.state.contact.count === 0")
            page.wait("return Object.values(live.drawn().scratches).every((places) => places.length === 0)")
            page.wait("return !document.querySelector('[data-alarm=contact]')")
        assert page.complaints() == []
        yield page, began


@pytest.mark.slow
def test_a_page_opened_after_a_collision_neither_burns_anew_nor_raises_an_alarm(browser: Chrome) -> None:
    """Of a collision that has burnt out, and after which the ships have parted: on bridge and instructor's page, and in
    the chart meanwhile. One that is fresh burns at its own time, at the points of the ships that touched. The run goes
    on in steps: a busy page would miss the times that matter."""
    with serve_live(browser, "guan2014", paused=True) as served:
        page = BridgePage(browser, served.address(), SMALL)
        page.wait("return document.body.dataset.ready")
        page.run("document.getElementById('chart-large').click()")
        while not served.session.snapshot.contact.count:
            served.step()
        begins = served.session.snapshot.contact.collisions[0].time
        for k in range(1, 12):
            served.step_until(begins + 0.5 * k)
            page.wait_until(served.session.snapshot.time)
        page.run("document.getElementById('chart-large').click()")
        begun = "Math.max(...live.effects.map(({ time }) => time)) - live.state.contact.collisions[0].time"
        page.wait("return live.effects.some(({ kind }) => kind === 'fire')")
        assert page.run(f"return {begun}") < 2.0
        scratched = page.run("return live.drawn().scratches")
        assert all(scratched.values())
        page.run("location.reload()")
        page.wait("return window.live?.effects?.some(({ kind }) => kind === 'fire')")
        assert page.run("return live.drawn().scratches") == scratched
        assert page.run(f"return {begun}") < 2.0
        ends = page.run("return live.state.contact.collisions[0]")
        points = {ends["ship_a"]: ends["a"], ends["ship_b"]: ends["b"]}
        assert all(points[effect["ship"]] == effect["point"] for effect in page.run("return live.effects"))
        assert page.state(".contact.points") == 0
        assert page.run("return live.session.alarms.list.has('contact')") is False
        served.step_until(100.0)  # they touch again at 167 s
        page.wait_until(100.0)
        assert page.state(".contact.points") == 0
        for role in ("bridge", "instructor"):
            browser.get("about:blank")
            opened = BridgePage(browser, served.address(role), SMALL)
            opened.wait("return live.state && document.body.dataset.ready")
            assert opened.state(".contact.count") > 0
            assert opened.run("return live.session.alarms.list.has('contact')") is False
            if role == "bridge":
                opened.wait("return live.effects.length > 0")
                assert opened.run("return live.drawn().effects") == 0


def assert_places_of_contacts(scratches: dict[str, list[list[float]]], contacts: Path) -> None:
    """Scratches of the page are at places where the model has contact, on each ship."""
    rows = list(csv.DictReader(contacts.read_text(encoding="utf-8").splitlines()))
    for ship, places in scratches.items():
        recorded = {
            tuple(float(row[f"{side}.{axis}"]) for axis in "xyz") for row in rows for side in "ab"
            if row[f"ship_{side}"] == ship
        }  # fmt: skip
        assert {tuple(place) for place in places} <= recorded


@pytest.mark.slow
def test_a_ship_is_steered_into_another_by_keys_and_the_run_is_that_of_the_orders(
    browser: Chrome, tmp_path: Path
) -> None:
    """Own ship would pass ahead of the other; hard over and full ahead it does not. The folder is the run of the orders
    as they were given, to the bit, and the debriefing shows it. From the contact on the run goes on in steps."""
    scenario, out = write_apart(tmp_path, 780.0, 90.0, 0.5), tmp_path / "run"
    assert simulate(load_scenario(scenario), in_process=True, out=tmp_path / "alone").events["collisions"] == []
    with serve_live(browser, scenario, out, rate=10.0, paused=True) as served:
        served.session.listen(lambda event: event["kind"] == "collision begins" and served.session.submit(Pause(True)))
        page = BridgePage(browser, served.address())
        page.wait("return live.state.command.own === live.client")
        page.wait("return document.getElementById('step').offsetWidth > 0")  # it is seen to be paused
        press(page, Keys.ARROW_UP * 2 + Keys.END + "p")
        page.wait("return live.contacts.length > 0")
        press(page, Keys.ENTER + Keys.BACKSPACE + "m")
        served.step_until(served.session.snapshot.time + 20.0)
        page.wait_until(served.session.snapshot.time)
        drawn = page.run("return live.drawn()")
        assert drawn["effects"] > 0
        assert all(drawn["scratches"].values())
        assert page.complaints() == []
        served.session.submit(End())
        page.wait("return document.getElementById('debriefing')")
        browser.find_element(By.ID, "debriefing").click()
        page.wait("return document.body?.dataset.ready === 'true' && window.replay")
        assert page.run("return replay.data.events.length") > 0
    assert_places_of_contacts(drawn["scratches"], out / "contacts.csv")
    simulate(load_scenario(out / "scenario.toml"), in_process=True, out=tmp_path / "again")
    for name in ("states.csv", "contacts.csv", "events.json"):
        assert (out / name).read_bytes() == (tmp_path / "again" / name).read_bytes(), name
