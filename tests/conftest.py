"""Settings of the whole suite, and two barges that meet: the scenario that most tests run, in a folder of its own.

What property tests draw depends on the test itself and on nothing else.
"""

from __future__ import annotations

import gc
import os
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers

from shipcollision_fmu.cosim import fmu_files
from shipcollision_fmu.fmi.builder.native_fmus import build_native_fmus
from shipcollision_fmu.toolchain import libraries
from shipcollision_fmu.toolchain.platforms import PLATFORMS, find_own_target
from tests import needs
from tests.ship_engines import ENGINES, ModelOfFmu, use_engine
from tests.ship_files import BARGE_ADDED_MASS, ship_toml

# Hypothesis draws some values from the constants in the sources of this project's modules that are imported so far: an
# edit anywhere, or another selection of tests, would change all examples. Here it finds none (test_examples_drawn.py).
# Releases before 6.131 do not look for any.
if hasattr(providers, "_get_local_constants"):
    providers._get_local_constants = lambda: providers._local_constants  # as it is at first: empty

# Examples vary in cost by orders of magnitude, and machines in speed: time is not what these tests are about, neither
# that of one example (deadline) nor that of drawing them (too_slow).
ALWAYS: dict[str, Any] = {
    "deadline": None, "database": None, "print_blob": True, "suppress_health_check": [HealthCheck.too_slow],
}  # fmt: skip

# The same examples every time, so that red means a change. Random search is test_search.py's.
settings.register_profile("shipcollision", max_examples=25, derandomize=True, **ALWAYS)
# CI's slow stage takes more of them for the laws of contact: `--hypothesis-profile=thorough`.
settings.register_profile("thorough", max_examples=250, derandomize=True, **ALWAYS)
settings.register_profile("search", max_examples=400, derandomize=False, **ALWAYS)
settings.load_profile("shipcollision")

BARGE = ship_toml(particulars={"r_bg": [2.0, 0.0, -1.0]}, added_mass=BARGE_ADDED_MASS)

ENCOUNTER = """
[scenario]
name = "encounter"
description = "own runs into target's side"
duration = 3.0
step = 0.05

[ships.own]
ship = "./barge.toml"
position = [5.0, -64.0]
heading_deg = 90.0
speed = 4.0

[ships.target]
ship = "./barge.toml"
position = [0.0, 0.0]
heading_deg = 0.0
speed = 1.0

[collision]
friction = 0.3
"""

if TYPE_CHECKING:
    from selenium.webdriver import Chrome

NATIVE_CACHE = libraries.native_cache()
"""What is compiled stays in the user's cache, taken here before the tests set another: the next run is fast."""

Write = Callable[..., Path]
LEFT_OUT = pytest.StashKey[list[tuple[str, list[str]]]]()
"""Tests left out of this run, each with its needs that are not met."""
MOST_WORKERS = 4
"""Processes that share the whole of the tests. Each takes some 1 GB and builds its own FMUs."""


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--nothing-left-out", action="store_true",
        help="fail when a test is left out because something is not installed, or skipped",
    )  # fmt: skip


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> Iterator[None]:
    """Before pytest selects by -m, fixtures give their tests the mark `needs`, needs the mark `programs`, and `one_in`
    the mark `slow` to most cases; afterwards tests are left out."""
    mark_slow_cases(items)
    for item in items:
        for name in sorted(needs.BY_FIXTURE.keys() & set(getattr(item, "fixturenames", ()))):
            item.add_marker(pytest.mark.needs(needs.BY_FIXTURE[name]))
        if needs.needs_program(item):
            item.add_marker(pytest.mark.programs)
    yield
    is_met = cache(lambda name: needs.NEEDS[name].is_met())
    unmet = {item: needs.find_unmet(item, is_met) for item in items}
    config.stash[LEFT_OUT] = [(item.nodeid, names) for item, names in unmet.items() if names]
    config.hook.pytest_deselected(items=[item for item, names in unmet.items() if names])
    items[:] = [item for item, names in unmet.items() if not names]


def mark_slow_cases(items: list[pytest.Item]) -> None:
    """Most cases of a grid that is marked `one_in(n)` become slow."""
    grids: dict[tuple[str, str], list[Any]] = defaultdict(list)
    for item in items:
        if isinstance(item, pytest.Function) and item.get_closest_marker("one_in"):
            grids[item.nodeid.partition("::")[0], item.originalname].append(item)
    for cases in grids.values():
        (n,) = cases[0].get_closest_marker("one_in").args
        lengths = [len(mark.args[1]) for mark in cases[0].iter_markers("parametrize")]
        for k, case in enumerate(cases):
            if not is_quick(k, lengths, n):
                case.add_marker(pytest.mark.slow)


def is_quick(k: int, lengths: Sequence[int], n: int) -> bool:
    """Whether the places of case `k` in the lists of parameters add up to a multiple of n. The last list varies most,
    parameters of fixtures least. So the quick cases have each value of a list, if the others have some n values."""
    total = 0
    for length in reversed(lengths):
        k, place = divmod(k, length)
        total += place
    return total % n == 0


def pytest_collection_finish(session: pytest.Session) -> None:
    """The collector of cycles passes over modules and tests from here on, which takes a twentieth off a run."""
    del session
    gc.freeze()


def pytest_xdist_auto_num_workers(config: pytest.Config) -> int | None:
    """For -n auto: one for each core for the whole of the tests; files that are named run in this process."""
    if "PYTEST_XDIST_AUTO_NUM_WORKERS" in os.environ:
        return None  # xdist takes that
    is_whole = config.args_source == pytest.Config.ArgsSource.TESTPATHS
    return min(MOST_WORKERS, os.cpu_count() or 1) if is_whole else 0


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """A worker has ended: all of them have left out the same."""
    if "left_out" in (said := getattr(node, "workeroutput", {})):
        node.config.stash[LEFT_OUT] = said["left_out"]


def pytest_sessionfinish(session: pytest.Session) -> None:
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["left_out"] = session.config.stash.get(LEFT_OUT, [])
        return
    skipped = session.config.pluginmanager.getplugin("terminalreporter").stats.get("skipped")
    if session.config.option.nothing_left_out and (session.config.stash.get(LEFT_OUT, None) or skipped):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    for line in needs.describe_left_out(config.stash.get(LEFT_OUT, [])):
        terminalreporter.write_line(line)


@pytest.fixture(scope="session", autouse=True)
def _fmus_of_the_tests(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """The FMUs of these tests are built into a folder of their own, once. The user's cache is left alone, but for what
    is compiled: that takes a minute, and tests of a machine without compiler would find it in a cache of the tests."""
    home = tmp_path_factory.mktemp("fmus")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        patch.setattr(fmu_files, "fmu_directory", lambda ships=(): home / "-".join(ships))
        patch.setattr(libraries, "native_cache", lambda: NATIVE_CACHE)
        yield


@pytest.fixture(scope="session")
def native_fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """ShipManoeuvring without Python for this machine, by flavour: "2", "3" and "3-scalar"."""
    return build_native_flavours("ShipManoeuvring", tmp_path_factory)


@pytest.fixture(scope="session")
def native_collisions(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """ShipCollision likewise, for the ships own and target."""
    return build_native_flavours("ShipCollision", tmp_path_factory)


def build_native_flavours(name: str, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """An FMU without Python for this machine, by flavour."""
    own = find_own_target()
    platform = next(one.name for one in PLATFORMS.values() if own in one.targets)
    home = tmp_path_factory.mktemp("native-fmus")
    built = {}
    for flavour, fmi, scalar in (("2", 2, False), ("3", 3, False), ("3-scalar", 3, True)):
        made = build_native_fmus(home, fmi=fmi, scalar=scalar, platforms=[platform], names=[name])
        built[flavour] = made[name]
    return built


@pytest.fixture(scope="session")
def test_library() -> Path:
    """The library of the test models."""
    from tests.native.fmi import native_fmus as native_dummy

    return native_dummy.build_test_library(NATIVE_CACHE)


@pytest.fixture(scope="session")
def native_dummies(test_library: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Unpacked FMUs of the dummy, by flavour: "2", "3", and "3-scalar"."""
    from tests.fmi.Dummy import INTERFACE
    from tests.native.fmi import native_fmus as native_dummy

    home = tmp_path_factory.mktemp("native")
    return {
        "2": native_dummy.write_fmu(home / "2", test_library, INTERFACE),
        "3": native_dummy.write_fmu(home / "3", test_library, INTERFACE, 3),
        "3-scalar": native_dummy.write_fmu(home / "3-scalar", test_library, INTERFACE, 3, scalar=True),
    }


@pytest.fixture(scope="session")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chrome]:
    """A browser for all pages: to start it takes longer than to open a page."""
    from tests.show.browser import chromium

    with chromium(tmp_path_factory.mktemp("profile")) as driver:
        yield driver


@pytest.fixture
def scenario_file(tmp_path: Path) -> Write:
    """Writes the encounter with some of its text replaced and some added, and returns its path."""

    def write(*replaced: tuple[str, str], added: str = "", barge: tuple[str, str] = ("", "")) -> Path:
        text = ENCOUNTER
        for old, new in replaced:
            assert old in text, f"{old!r} is not in the encounter"
            text = text.replace(old, new)
        (tmp_path / "barge.toml").write_text(BARGE.replace(*barge) if barge[0] else BARGE, encoding="utf-8")
        path = tmp_path / "encounter.toml"
        path.write_text(text + added, encoding="utf-8")
        return path

    return write


@pytest.fixture(
    scope="module",
    params=[pytest.param(name, marks=[] if name == "Python" else pytest.mark.slow) for name in ENGINES],
)
def engine(request: pytest.FixtureRequest) -> Iterator[str]:
    """Which form of the ship model make_model() gives; a test that uses it runs on each."""
    from shipcollision_fmu.manoeuvring.model import ShipManoeuvring

    name: str = request.param
    use_engine(ShipManoeuvring if name == "Python" else request.getfixturevalue(f"make_{name.replace(' ', '_')}"))
    yield name
    use_engine(ShipManoeuvring)


@pytest.fixture(scope="session")
def make_Python_FMU(tmp_path_factory: pytest.TempPathFactory) -> Callable[[], ModelOfFmu]:
    """Makes ships behind the Python FMU."""
    from fmpy import extract

    from shipcollision_fmu.fmi.builder.package import build_fmus

    folder = tmp_path_factory.mktemp("Python FMU")
    unpacked = Path(extract(build_fmus(folder)["ShipManoeuvring"], folder / "unpacked"))
    return lambda: ModelOfFmu(unpacked)


@pytest.fixture(scope="session")
def make_native_FMU(native_fmus: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> Callable[[], ModelOfFmu]:
    """Makes ships behind the native FMU, which takes ship files prepared."""
    from fmpy import extract

    from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship

    folder = tmp_path_factory.mktemp("native FMU")
    unpacked = Path(extract(native_fmus["2"], folder / "unpacked"))

    @cache
    def find_ship(ship: str) -> str:
        if not ship.endswith(".toml"):
            return ship
        prepared = tmp_path_factory.mktemp("prepared") / "own.ship"
        prepared.write_bytes(prepare_ship(ship))
        return str(prepared)

    return lambda: ModelOfFmu(unpacked, find_ship)
