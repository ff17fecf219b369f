"""`live`: steer a scenario's ships while it runs."""

from __future__ import annotations

from contextlib import suppress
from datetime import datetime
from pathlib import Path

import click

from ..errors import ScenarioError, ShipCollisionError
from .console import say
from .options import NUMBER, PATH, SCENARIO, WHOLE_NUMBER

__all__ = ["live"]

PORT = 8750


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
@click.option("--browser/--no-browser", default=True, help="Open the page in the browser.  [default: --browser]")
def live(
    scenario: str, ship: str | None, rate: float, port: int, host: str, out: Path | None, overwrite: bool,
    duration: float | None, paused: bool, instructor_only: bool, browser: bool,
    nmea: tuple[str, ...], nmea_tcp: str | None, dis: tuple[str, ...], orders: str | None,
) -> None:  # fmt: skip
    """Steer ships on the wall clock, in a browser.

    SCENARIO is a name that `shipcollision scenarios` lists, or the path of a TOML file. Its duration does not count:
    the run goes on until the instructor ends it, until Ctrl-C, or for --duration. Then it is stored as any other run,
    with scenario.toml, which gives the same run again, and replay.html.

    Two addresses are printed, for the bridge and for the instructor. Whoever has one may come in.

    \b
    Examples:
      shipcollision live
      shipcollision live mine.toml --ship own --rate 4
      shipcollision live --nmea 10110 --orders 4711
      shipcollision live mine.toml --host 0.0.0.0 --no-browser
    """
    from ..cosim.earlier_run import refuse_foreign_files
    from ..cosim.run import RUN_FILES
    from ..files import check_writable
    from ..live.extra import require_live
    from ..live.session.input_files import FOLDERS
    from ..live.session.run_folder import SCENARIO as SCENARIO_FILE
    from ..live.session.session import Session, check_rate
    from ..live.session.ship_limits import choose_own
    from ..scenario.scenario import load_scenario
    from ..show.outputs import PICTURES

    require_live()
    from ..live.protocols.outlets import OutletAddresses, Outlets
    from ..live.server.app import LiveApp
    from ..live.server.serve import bind, serve

    loaded = load_scenario(scenario)
    own = choose_own(loaded, ship)
    check_rate(rate)
    if duration is not None and not duration > 0.0:
        raise ScenarioError(f"--duration {duration:g} s must be greater than 0: give one such as 600")
    folder = out if out is not None else Path("runs") / f"{loaded.name}-live-{datetime.now():%Y%m%d-%H%M%S}"
    if not overwrite:
        refuse_foreign_files(folder, (*RUN_FILES, *PICTURES, SCENARIO_FILE, *FOLDERS))
    check_writable(folder)
    listening = bind(host, port)
    with listening:
        session = Session(loaded, out=folder, rate=rate, duration=duration, paused=paused, spool=_make_spool(folder))
        app = LiveApp(session, own, host=host, sets_pace=not instructor_only)
        at = listening.getsockname()[:2]
        addresses = OutletAddresses(nmea, nmea_tcp, dis, orders)
        try:
            outlets = Outlets(session, own, addresses) if addresses else None
        except ShipCollisionError:
            session.run.close()
            with suppress(OSError):
                folder.rmdir()  # empty, unless it was there
            raise

        def tell() -> None:
            shown = f"[{at[0]}]" if ":" in at[0] else at[0]
            bridge = f"http://{shown}:{at[1]}/?token={app.tokens.bridge}"
            say(f"bridge of {own}: {bridge}")
            say(f"instructor: http://{shown}:{at[1]}/instructor?token={app.tokens.instructor}")
            for line in _describe_outlets(own, nmea, nmea_tcp, dis, orders):
                say(line)
            say("Ctrl-C ends the run and stores it")
            if browser:
                _open(bridge)

        try:
            if outlets is not None:
                outlets.start()
            serve(app, listening, tell)
        finally:
            if outlets is not None:
                outlets.close()
    if session.error is not None:
        say(f"stored in {folder}")
        raise session.error
    say(f"stored in {folder}: {folder / SCENARIO_FILE} gives the same run again")


def _describe_outlets(
    own: str, nmea: tuple[str, ...], nmea_tcp: str | None, dis: tuple[str, ...], orders: str | None
) -> list[str]:
    lines = [f"NMEA of {own} and AIS to {address}" for address in nmea]
    lines += [f"NMEA of {own} and AIS for clients of TCP port {nmea_tcp}"] if nmea_tcp else []
    lines += [f"DIS to {address}" for address in dis]
    return lines + ([f"orders at TCP port {orders}"] if orders else [])


def _make_spool(folder: Path) -> Path:
    """The folder, made now: the record of the run grows in temporary files there."""
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _open(address: str) -> None:
    import webbrowser

    if not webbrowser.open(address):
        say("found no browser: open the address of the bridge yourself", err=True)
