"""`build`, `package`, `prepare` and `validate`: build FMUs, put them together for other hosts, and check them."""

from __future__ import annotations

from pathlib import Path

import click

from .console import say
from .mistakes import fail
from .native_code import compile_native
from .options import FMI, PATH, SCENARIO, SHIP

__all__ = ["build", "package", "prepare", "validate"]

PLATFORMS = click.option(
    "--platforms", metavar="NAME,...",
    help="With --native: some of linux64, win64, darwin64 and aarch64-linux.  [default: all]",
)  # fmt: skip


@click.command()
@click.option("--out", type=PATH, default=Path("build"), show_default=True, help="Folder.")
@click.option("--fmi", type=FMI, default="2", show_default=True, help="Version of FMI.")
@click.option("--scalar", is_flag=True, help="With --fmi 3: the variables of FMI 2.0, without arrays.")
@click.option(
    "--ships", metavar="NAME,...",
    help="Ships of ShipCollision; one is enough where it meets obstacles.  [default: own,target]",
)  # fmt: skip
@click.option("--native", is_flag=True, help="In C++, for hosts without Python.")
@PLATFORMS
@click.option("--sources", is_flag=True, help="With --native: the FMUs bring their C++ sources, too.")
def build(
    out: Path, fmi: str, scalar: bool, ships: str | None, native: bool, platforms: str | None, sources: bool
) -> None:
    """Build the FMUs.

    They are ShipCollision.fmu and ShipManoeuvring.fmu. With --fmi 3 they are called ShipCollision.fmi3.fmu and
    ShipManoeuvring.fmi3.fmu, so that both versions may lie in one folder. FMI 3.0 needs the extra `fmi3`. For hosts
    that do not pass arrays, such as OMSimulator and Ecos, --scalar makes ShipCollision.fmi3-scalar.fmu and
    ShipManoeuvring.fmi3-scalar.fmu.

    With --native they are ShipCollision.native.fmu and ShipManoeuvring.native.fmu, each one file for all platforms,
    which need no Python in the host. They are compiled by Zig, from the extra `native`. With --platforms for this
    machine alone, such as linux64, a C++ compiler of the system does. pip fetches the source of Bullet, 80 MB, once.
    """
    if scalar and fmi != "3":
        raise click.UsageError("--scalar is for FMI 3.0: FMI 2.0 has no arrays; add --fmi 3 or leave it out")
    names = ("own", "target") if ships is None else _split(ships)
    if native:
        _build_native(out, names, int(fmi), scalar, platforms, sources)
        return
    if platforms is not None or sources:
        option = "--sources" if platforms is None else "--platforms"
        raise click.UsageError(f"{option} is for native code: add --native or leave it out")
    _build_python(out, names, int(fmi), scalar)


def _build_python(out: Path, ships: tuple[str, ...], fmi: int, scalar: bool) -> None:
    """The FMUs that run Python."""
    from ..fmi.builder.package import build_fmus

    for path in build_fmus(out, ships=ships, fmi=fmi, scalar=scalar).values():
        say(str(path))


def _build_native(
    out: Path, ships: tuple[str, ...], fmi: int, scalar: bool, platforms: str | None, sources: bool
) -> None:
    """The FMUs without Python."""
    from ..collision.ship_names import check_ship_names
    from ..files import check_writable
    from ..fmi.builder.native_fmus import build_native_fmus

    check_ship_names(ships)
    check_writable(out)
    chosen = _compile(platforms)
    built = build_native_fmus(out, ships=ships, fmi=fmi, scalar=scalar, platforms=chosen, sources=sources)
    for path in built.values():
        say(str(path))


def _compile(platforms: str | None) -> tuple[str, ...]:
    """The platforms of an option, all without it, compiled for."""
    return compile_native(None if platforms is None else _split(platforms))


def _split(names: str) -> tuple[str, ...]:
    """Names that commas part."""
    return tuple(name.strip() for name in names.split(","))


@click.command()
@click.argument("scenario", type=SCENARIO)
@click.option("--ssp", is_flag=True, help="One .ssp file: System Structure and Parameterization 1.0.")
@click.option("--osp", is_flag=True, help="A folder for the Open Simulation Platform.")
@click.option("--out", type=PATH, metavar="FILE|FOLDER", help="[default: NAME.ssp or NAME-osp]")
@click.option(
    "--initial-orders", is_flag=True, help="Hold the orders of time 0, leave out the later ones and autopilots."
)
@click.option("--fmi", type=FMI, default="2", show_default=True, help="Version of FMI; 3.0 without arrays.")
@click.option(
    "--inputs", is_flag=True,
    help="With --ssp: connectors for orders, wind and current; not for FMPy, which fails on them.",
)  # fmt: skip
@click.option(
    "--replace", multiple=True, metavar="SHIP=FILE.fmu",
    help="A ship model of your own, coupled by force; FILE.toml beside it names its variables.",
)  # fmt: skip
@click.option("--native", is_flag=True, help="Ships and collision run without Python.")
@PLATFORMS
@click.option("--overwrite", is_flag=True, help="Replace files of other origin at the place of the package, too.")
def package(
    scenario: str,
    ssp: bool,
    osp: bool,
    out: Path | None,
    initial_orders: bool,
    fmi: str,
    inputs: bool,
    replace: tuple[str, ...],
    native: bool,
    platforms: str | None,
    overwrite: bool,
) -> None:
    """Make a system of FMUs for other hosts.

    SCENARIO is a name that `shipcollision scenarios` lists, or the path of a TOML file. The package holds an FMU for
    each ship and one for the collision, with the scenario's values as their start values. Settings that a
    package cannot hold, such as a route, are refused, or left out with a note.
    """
    from ..cosim.prepared_files import refuse_response
    from ..packaging.foreign_ship import read_foreign_ship
    from ..packaging.osp import write_osp
    from ..packaging.ssp import write_ssp
    from ..scenario.scenario import load_scenario

    if ssp == osp:
        raise click.UsageError("choose one form: --ssp or --osp")
    if inputs and not ssp:
        raise click.UsageError("--inputs is for --ssp: an OSP system has all variables without it")
    if platforms is not None and not native:
        raise click.UsageError("--platforms is for native code: add --native or leave it out")
    foreign = {ship: read_foreign_ship(Path(file)) for ship, file in map(_split_replacement, replace)}
    loaded = load_scenario(scenario)
    if native:
        refuse_response(loaded, "leave --native out")
    compiled = _compile(platforms) if native else ()
    if ssp:
        place = out if out is not None else Path(f"{loaded.name}.ssp")
        if place.suffix != ".ssp":
            raise click.UsageError(f"--out {place}: hosts recognise the file by its suffix; call it {place.name}.ssp")
        left_out = write_ssp(
            loaded, place, initial_orders=initial_orders, fmi=int(fmi), inputs=inputs, foreign=foreign,
            native=compiled, overwrite=overwrite,
        )  # fmt: skip
    else:
        place = out if out is not None else Path(f"{loaded.name}-osp")
        left_out = write_osp(
            loaded, place, initial_orders=initial_orders, fmi=int(fmi), foreign=foreign, native=compiled,
            overwrite=overwrite,
        )  # fmt: skip
    for line in left_out:
        say(f"note: {line}", err=True)
    say(str(place))


def _split_replacement(text: str) -> tuple[str, str]:
    """SHIP=FILE as a pair."""
    ship, equals, file = text.partition("=")
    if not (ship and equals and file):
        raise click.UsageError(f"--replace {text}: say which ship and by which file, such as own=vessel.fmu")
    return ship, file


@click.command()
@click.argument("ship", type=SHIP)
@click.option("--out", type=PATH, metavar="FILE", help="[default: NAME.ship, NAME.obstacles]")
@click.option("--overwrite", is_flag=True, help="Replace a file of other origin, too.")
def prepare(ship: str, out: Path | None, overwrite: bool) -> None:
    """Write a ship or obstacles for native FMUs.

    SHIP is a shipped ship, the path of its TOML file, or that of a TOML file of obstacles. A native FMU has no Python
    to read TOML with: its parameters `ship` and `obstacles` take the path of the file that is written here. Prepare a
    file again when the TOML or mesh file changes.
    """
    from ..collision.prepared_obstacles import FORMAT as FIRST_OF_OBSTACLES
    from ..collision.prepared_obstacles import SUFFIX as OF_OBSTACLES
    from ..collision.prepared_obstacles import is_obstacle_file, prepare_obstacles
    from ..files import check_writable, refuse_other_origin, write_file
    from ..manoeuvring.prepared_ship import FORMAT as FIRST_OF_SHIP
    from ..manoeuvring.prepared_ship import SUFFIX as OF_SHIP
    from ..manoeuvring.prepared_ship import prepare_ship
    from ..ship.loading.library import load_ship

    are_obstacles = is_obstacle_file(ship)
    suffix = OF_OBSTACLES if are_obstacles else OF_SHIP
    place = out if out is not None else Path(f"{Path(ship).stem}{suffix}")
    _check_names(ship, place, suffix)
    begin = FIRST_OF_OBSTACLES if are_obstacles else FIRST_OF_SHIP
    if place.is_file() and not (overwrite or _begins_with(place, begin)):
        refuse_other_origin(place.parent, (place.name,), f"it does not begin with '{begin}'", "file")
    content = prepare_obstacles(ship) if are_obstacles else prepare_ship(ship, needs_hull=True)
    check_writable(place.parent)
    for note in () if are_obstacles else load_ship(ship).suspicious:
        say(f"note: {note}", err=True)
    say(str(write_file(place, content)))


def _begins_with(path: Path, begin: str) -> bool:
    """Whether the file is of that kind; what cannot be read is not."""
    try:
        with path.open("rb") as file:
            return file.read(len(begin)) == begin.encode()
    except OSError:
        return False


def _check_names(ship: str, place: Path, suffix: str) -> None:
    """Raise UsageError when `ship` is no source of a ship, or `place` is not called as a prepared ship is."""
    from ..ship.loading.library import list_ship_names

    if Path(ship).is_dir() and ship not in list_ship_names():
        raise click.UsageError(f"{ship} is a folder: give the name of a ship or the path of a TOML file")
    if Path(ship).is_file() and _begins_with(Path(ship), "PK\x03\x04"):
        raise click.UsageError(f"{ship} is a zip archive, such as an FMU, and no ship file: give the ship's TOML file")
    if ship.endswith(suffix):
        raise click.UsageError(f"{ship} is called as a prepared ship is: give the TOML file that it was prepared from")
    if place.is_dir():
        raise click.UsageError(
            f"--out {place} is a folder: give the name of a file in it, such as {place / Path(ship).stem}{suffix}"
        )
    if place.suffix != suffix:
        raise click.UsageError(f"--out {place}: native FMUs know the file by its suffix; call it {place.stem}{suffix}")


@click.command()
@click.argument("fmu", type=PATH)
@click.option("--no-calls", is_flag=True, help="Look at the file only; do not run the FMU's code.")
@click.option("--ignore", multiple=True, metavar="CHECK", help="Leave out a check; may be given again.")
def validate(fmu: Path, no_calls: bool, ignore: tuple[str, ...]) -> None:
    """Check that an FMU complies with FMI.

    FMU is any FMI 2.0 or 3.0 FMU. Exit status 1 when it does not comply. FMPy's validator is followed by further
    checks of the file, and by calls that an FMU must refuse; the calls run its code in another process. Notes are
    good practice and do not count.
    """
    from ..compliance.report import NAMES
    from ..compliance.report import validate as find_breaches
    from ..ship.loading.messages import suggest_or_list

    for name in ignore:
        if name not in NAMES:
            raise click.UsageError(f"--ignore {name!r} is not a check:{suggest_or_list(name, NAMES)}")
    found = find_breaches(fmu, calls=not no_calls, ignore=ignore)
    for finding in found:
        say(f"{fmu}: {'' if finding.binding else 'note: '}{finding}")
    count = sum(finding.binding for finding in found)
    if count:
        fail(f"{fmu} has {count} problem{'s' if count > 1 else ''}", 1)
    say(f"{fmu}: no problem found")
