"""`live`: steer a scenario's ships while it runs."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from datetime import datetime
from functools import partial
from pathlib import Path
from secrets import token_urlsafe
from shlex import quote
from threading import Thread
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from ..errors import HostError, ScenarioError, ShipCollisionError
from .console import say
from .options import NUMBER, PATH, SCENARIO, WHOLE_NUMBER

if TYPE_CHECKING:
    from ..live.protocols.outlets import Outlets
    from ..live.server.app import LiveApp
    from ..live.server.host_names import Hosts
    from ..live.session.session import Session
    from ..scenario.scenario import Scenario

__all__ = ["live"]

PORT = 8750
SHORTEST_TOKEN, LONGEST_TOKEN = 8, 256
"""Characters of --order-token."""


@click.command()
@click.argument("scenario", default="kvlcc2_crossing", type=SCENARIO)
@click.option("--ship", metavar="NAME", help="The ship of the bridge.  [default: the first that takes orders]")
@click.option("--rate", type=NUMBER, default=1.0, show_default=True, help="Simulated seconds per second, 0.25 to 20.")
@click.option(
    "--port", type=WHOLE_NUMBER, default=PORT, show_default=True, help="Port of the page; 0: any that is free."
)
@click.option(
    "--host", default="127.0.0.1", show_default=True, metavar="ADDRESS", help="Address to listen at; 0.0.0.0: all."
)
@click.option("--out", type=PATH, help="Folder of the results.  [default: runs/NAME-live-TIME]")
@click.option("--overwrite", is_flag=True, help="Replace files of other origin in that folder, too.")
@click.option(
    "--duration", type=NUMBER, metavar="S", help="Simulated seconds after which the run ends.  [default: none]"
)
@click.option("--paused", is_flag=True, help="Begin with a pause.")
@click.option("--instructor-only", is_flag=True, help="Only the instructor sets rate and pause.")
@click.option(
    "--nmea", "nmea", metavar="ADDRESS", multiple=True, help="NMEA and AIS to udp://HOST:PORT, or a port here."
)
@click.option("--nmea-tcp", metavar="PORT", help="NMEA and AIS for clients by TCP.")
@click.option("--dis", metavar="ADDRESS", multiple=True, help="DIS to udp://HOST:PORT, or a port here.")
@click.option("--orders", metavar="PORT", help="Orders to ships by TCP, as JSON lines.")
@click.option(
    "--order-token", metavar="TOKEN", help="What --orders asks for.  [default: none; beyond this machine a new one]"
)
@click.option("--browser/--no-browser", default=True, help="Open the page in the browser.  [default: --browser]")
def live(
    scenario: str, ship: str | None, rate: float, port: int, host: str, out: Path | None, overwrite: bool,
    duration: float | None, paused: bool, instructor_only: bool, browser: bool,
    nmea: tuple[str, ...], nmea_tcp: str | None, dis: tuple[str, ...], orders: str | None, order_token: str | None,
) -> None:  # fmt: skip
    """Steer ships on the wall clock, in a browser.

    SCENARIO is a name that `shipcollision scenarios` lists, or the path of a TOML file. Its duration does not count:
    the run goes on until the instructor ends it, until Ctrl-C, or for --duration. Then it is stored as any other run,
    with scenario.toml, which gives the same run again, and replay.html. Exit status 0, by Ctrl-C or SIGTERM as well.

    Two addresses are printed, for the bridge and for the instructor. Whoever has one may come in.

    \b
    Examples:
      shipcollision live
      shipcollision live mine.toml --ship own --rate 4
      shipcollision live --nmea 10110 --orders 4711
      shipcollision live mine.toml --host 0.0.0.0 --no-browser
    """
    from ..cosim.folder_lock import hold_folder
    from ..live.extra import require_live
    from ..live.session.session import check_rate
    from ..live.session.ship_limits import choose_own
    from ..scenario.scenario import load_scenario

    require_live()
    loaded = load_scenario(scenario)
    for note in loaded.notes:
        say(f"note: {note}")
    own = choose_own(loaded, ship)
    check_rate(rate)
    if duration is not None and not duration > 0.0:
        raise ScenarioError(f"--duration {duration:g} s must be greater than 0: give one such as 600")
    folder = out if out is not None else Path("runs") / f"{loaded.name}-live-{datetime.now():%Y%m%d-%H%M%S}"
    offered = _Offered(own, nmea, nmea_tcp, dis, orders, _choose_order_token(orders, order_token))
    with ExitStack() as held:
        held.enter_context(hold_folder(folder))  # first: the files of a run that goes on are those of no other
        if not overwrite:
            _refuse_files(folder)
        session = _run(
            loaded, offered, folder, host, port, {"rate": rate, "duration": duration, "paused": paused}, held.close,
            sets_pace=not instructor_only, in_browser=browser,
        )  # fmt: skip
    if session.error is not None:
        raise session.error


class _Offered(NamedTuple):
    """The ship of the bridge, and what is sent and taken: addresses as options give them."""

    own: str
    nmea: tuple[str, ...]
    nmea_tcp: str | None
    dis: tuple[str, ...]
    orders: str | None
    order_token: str | None


def _choose_order_token(orders: str | None, token: str | None) -> str | None:
    """The token of the order port: the given one; a new one where other machines can reach the port; else none."""
    from ..live.protocols.addresses import is_loopback, parse_address

    if orders is None:
        if token is not None:
            raise click.UsageError("--order-token is that of --orders, which is missing: give both, or neither")
        return None
    if token is not None and not (SHORTEST_TOKEN <= len(token) <= LONGEST_TOKEN and token.isprintable()):
        raise click.UsageError(
            f"--order-token has {len(token)} characters: give {SHORTEST_TOKEN} to {LONGEST_TOKEN} printable ones"
        )
    if token is None and not is_loopback(parse_address(orders, "tcp", "--orders")[0]):
        return token_urlsafe(24)
    return token


def _refuse_files(folder: Path) -> None:
    """Refuse a folder that has files of other origin, or those of a run that was killed."""
    from ..cosim.earlier_run import refuse_foreign_files
    from ..cosim.run import RUN_FILES
    from ..live.session.input_files import FOLDERS
    from ..live.session.kept_scenario import UNFINISHED
    from ..live.session.run_folder import SCENARIO as SCENARIO_FILE
    from ..show.outputs import PICTURES

    refuse_foreign_files(folder, (*RUN_FILES, *PICTURES, SCENARIO_FILE, *FOLDERS))
    if (folder / UNFINISHED).exists():
        again = f"shipcollision run {quote(str(folder / UNFINISHED))} --in-process"
        raise HostError(
            f"{folder} holds {UNFINISHED} of a live run that was killed: give another folder with --out, or "
            f"replace it with --overwrite; `{again}` runs it again"
        )


def _run(
    scenario: Scenario, offered: _Offered, folder: Path, host: str, port: int, pace: dict[str, Any],
    give_back: Callable[[], None], *, sets_pace: bool, in_browser: bool,
) -> Session:  # fmt: skip
    """The session, after its end: pages at `host` and `port`, outlets as offered. `give_back` is called once the folder
    has the run, as pages may stay open beyond."""
    from ..live.server.app import LiveApp
    from ..live.server.host_names import find_hosts
    from ..live.server.serve import bind, serve
    from ..live.session.session import Session

    with bind(host, port) as listening, ExitStack() as stack:
        session = Session(scenario, out=folder, spool=folder, **pace)
        app = LiveApp(session, offered.own, host=host, sets_pace=sets_pace)
        outlets = _open_outlets(session, offered)
        if outlets is not None:
            stack.callback(outlets.close)
            outlets.start()
        hosts, at = find_hosts(listening), int(listening.getsockname()[1])

        def end() -> None:
            give_back()
            _tell_of_end(app, folder)

        serve(app, listening, lambda: _tell_of_start(app, hosts, at, offered, in_browser), end)
    return session


def _open_outlets(session: Session, offered: _Offered) -> Outlets | None:
    """The outlets that are offered. Where an address cannot be used, the session is given back."""
    from ..live.protocols.outlets import OutletAddresses, Outlets

    addresses = OutletAddresses(*offered[1:])
    try:
        return Outlets(session, offered.own, addresses, partial(say, err=True)) if addresses else None
    except ShipCollisionError:
        session.run.close()
        raise


def _tell_of_start(app: LiveApp, hosts: Hosts, port: int, offered: _Offered, in_browser: bool) -> None:
    """Print the addresses, for this machine and for others, and open the bridge's."""

    def write(host: str, from_where: str = "") -> str:
        bridge = f"http://{host}:{port}/?token={app.tokens.bridge}"
        say(f"bridge of {offered.own}{from_where}: {bridge}")
        say(f"instructor{from_where}: http://{host}:{port}/instructor?token={app.tokens.instructor}")
        return bridge

    bridge = write(hosts.here)
    for host in hosts.elsewhere:
        write(host, ", from other machines")
    for line in _describe_outlets(offered):
        say(line)
    say("Ctrl-C ends the run and stores it")
    if in_browser:  # in a thread: a browser of the terminal is there until it is left
        Thread(target=_open, args=(bridge,), name="browser", daemon=True).start()


def _describe_outlets(offered: _Offered) -> list[str]:
    own = offered.own
    lines = [f"NMEA of {own} and AIS to {address}" for address in offered.nmea]
    lines += [f"NMEA of {own} and AIS for clients of TCP port {offered.nmea_tcp}"] if offered.nmea_tcp else []
    lines += [f"DIS to {address}" for address in offered.dis]
    if offered.orders:
        token = f", with the token {offered.order_token}" if offered.order_token else ""
        lines.append(f"orders at TCP port {offered.orders}{token}")
    return lines


def _tell_of_end(app: LiveApp, folder: Path) -> None:
    """Print where the run is, and that open pages still lead to its replay."""
    from ..live.session.run_folder import SCENARIO as SCENARIO_FILE

    session = app.session
    if session.error is not None:
        if session.folder is not None:
            say(f"stored in {folder}")
        return
    say(f"stored in {folder}: {folder / SCENARIO_FILE} gives the same run again")
    if session.page is None:
        say(f"no page yet: `shipcollision show {quote(str(folder))}` writes it")
        return
    say(f"debriefing: `shipcollision show {quote(str(folder))} --open`, or open {session.page} in a browser")
    if app.hub.clients:
        say("open pages lead to it for a minute; Ctrl-C leaves now")


def _open(address: str) -> None:
    import webbrowser

    if not webbrowser.open(address):
        say("found no browser: open the address of the bridge yourself", err=True)
