"""How the free numbers of guan2014 were found: eight of them, fitted to the 24 "after" numbers of Table 2.

    pip install scipy
    python benchmarks/calibrate_guan2014.py            the shipped values, each varied by itself, and what it does
    python benchmarks/calibrate_guan2014.py --fit      searches on from the shipped values (some minutes)

The paper prints neither hulls nor the height of the centres of gravity. Free are the own ship's depth, stem
rake, place of the stem (trim_x), length of the bow and height of CG, the target's depth and height of CG, and the
friction. Radii of gyration follow from the hull's box, as in Bullet.

The free numbers are fitted to several runs at once (RUNS). After a plastic impact a parallel master keeps the hulls in
contact. A sequential master leaves a gap of up to one step's motion, which closes again some tenths of a second later.
Both converge to the same target roll rate as the step shrinks; a fit to one run would follow its gap.

The cost is the 4-norm of difference / tolerance over the 24 numbers, each at its worst run: 1 would be one number at
the edge of its tolerance and all others exact.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from pathlib import Path

import numpy as np
from rich.console import Console

from shipcollision_fmu import load_scenario, load_ship, simulate
from shipcollision_fmu.cli.table import make_table
from shipcollision_fmu.ship.frames import rotation
from shipcollision_fmu.ship.loading.library import find_models
from shipcollision_fmu.ship.ship import Ship

RUNS = tuple((algorithm, step) for algorithm in ("gauss-seidel", "jacobi") for step in (0.01, 0.02, 0.05, 0.1))
"""Algorithm of the master and communication step [s] of the runs: both masters, with gaps of several lengths."""


@dataclass(frozen=True)
class Free:
    """A free number: what it is, and the step by which it is varied."""

    name: str
    step: float


FREE = (
    Free("own depth [m]", 0.5),
    Free("own stem_rake_deg", 0.5),
    Free("own trim_x [m]", 0.3),
    Free("target depth [m]", 0.5),
    Free("target CG below CO [m]", 0.3),
    Free("friction", 0.01),
    Free("own CG below CO [m]", 0.3),
    Free("own bow_length [m]", 2.0),
)


def shipped() -> list[float]:
    """The values in models/."""
    own, target, scenario = load_ship("guan2014_own"), load_ship("guan2014_target"), load_scenario("guan2014")
    friction = scenario.collision.friction
    assert friction is not None
    return [
        own.hull.depth, own.hull.stem_rake_deg, own.hull.trim_x, target.hull.depth, float(target.r_bg[2]), friction,
        float(own.r_bg[2]), own.hull.bow_length,
    ]  # fmt: skip


def ship_text(base: str, ship: Ship, depth: float, z_bg: float, **hull: float) -> str:
    """A variant of a shipped ship: another depth, CG and hull, radii of gyration of the hull's box."""
    k = [sqrt((a**2 + b**2) / 12) for a, b in ((ship.B, depth), (ship.L_oa, depth), (ship.L_oa, ship.B))]
    shape = "".join(f"{key} = {value!r}\n" for key, value in {"depth": depth, **hull}.items())
    radii = "".join(f"{key} = {value!r}\n" for key, value in zip(("k_xx", "k_yy", "k_zz"), k, strict=True))
    return f'extends = "{base}"\n[particulars]\nr_bg = [0.0, 0.0, {z_bg!r}]\n{radii}[hull]\n{shape}'


def differences(x: Sequence[float], folder: Path) -> np.ndarray:
    """Difference over tolerance of the 24 numbers, each at its worst run, for the free numbers x."""
    own_depth, rake, trim, target_depth, z_target, friction, z_own, bow = map(float, x)
    own, target = load_ship("guan2014_own"), load_ship("guan2014_target")
    (folder / "own.toml").write_text(
        ship_text("guan2014_own", own, own_depth, z_own, stem_rake_deg=rake, trim_x=trim, bow_length=bow)
    )
    (folder / "target.toml").write_text(ship_text("guan2014_target", target, target_depth, z_target))
    source = (find_models() / "scenarios" / "guan2014.toml").read_text()
    (folder / "scenario.toml").write_text(source.replace('"guan2014_own"', '"own.toml"').replace(
        '"guan2014_target"', '"target.toml"'))  # fmt: skip
    scenario = load_scenario(folder / "scenario.toml")
    # The paper's position is that of CG: CO moves as CG is put elsewhere in the hull.
    ships = dict(scenario.ships)
    for name, ship, z_bg in (("own", own, z_own), ("target", target, z_target)):
        R = rotation(ships[name].start.attitude)
        moved = np.array(ships[name].position) + R @ (ship.r_bg - [0.0, 0.0, z_bg])
        ships[name] = ships[name].model_copy(update={"position": moved.tolist()})
    collision = scenario.collision.model_copy(update={"friction": friction})
    changed = scenario.model_copy(update={"ships": ships, "collision": collision})
    runs = [simulate(changed, algorithm=a, step=h, in_process=True).summary["paper"] for a, h in RUNS]
    shares = np.array([[row["difference"] / row["tolerance"] for row in rows] for rows in runs])
    worst: np.ndarray = np.abs(shares).max(axis=0)
    return worst


def cost(x: Sequence[float], folder: Path) -> float:
    """4-norm of difference / tolerance."""
    return float((differences(x, folder) ** 4).sum() ** 0.25)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fit", action="store_true", help="search on from the shipped values")
    fit = parser.parse_args().fit
    console = Console(width=110)
    with tempfile.TemporaryDirectory() as name:
        folder, x = Path(name), shipped()
        if fit:
            from scipy.optimize import minimize

            simplex = np.vstack([x, *(np.array(x) + np.eye(len(x))[i] * free.step for i, free in enumerate(FREE))])
            options = {"initial_simplex": simplex, "maxfev": 600, "xatol": 1e-3, "fatol": 1e-4}
            found = minimize(cost, x, args=(folder,), method="Nelder-Mead", options=options)
            x = found.x.tolist()
        here = make_table(
            "free number", ">value", ">step", ">cost, step less", ">cost", ">cost, step more", ">worst number"
        )
        for i, free in enumerate(FREE):
            less, more = (cost([v + side * free.step * (k == i) for k, v in enumerate(x)], folder) for side in (-1, 1))
            worst = float(differences(x, folder).max())
            here.add_row(
                free.name, f"{x[i]:.4g}", f"{free.step:g}", f"{less:.2f}", f"{cost(x, folder):.2f}", f"{more:.2f}",
                f"{worst:.2f} of its tolerance",
            )  # fmt: skip
        console.print(here)


if __name__ == "__main__":
    main()
