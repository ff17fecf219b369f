"""The native ship model under sanitizers: damaged ships whose checksums are right, and states of random bytes."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from shipcollision_fmu.manoeuvring.prepared_ship import prepare_ship
from shipcollision_fmu.toolchain.compilers import find_compiler
from shipcollision_fmu.toolchain.objects import compile_object
from shipcollision_fmu.toolchain.platforms import find_own_target
from shipcollision_fmu.toolchain.sources import Part
from tests.compiler import compile_c
from tests.native.kernels import CACHE, find_ship_model

SANITIZERS = ("-g", "-fsanitize=address,undefined,float-cast-overflow", "-fno-sanitize-recover=all")


@pytest.mark.slow
@pytest.mark.needs("g++")
def test_damaged_ships_and_states(tmp_path: Path) -> None:
    target, ship, program = find_own_target(), tmp_path / "whole.ship", tmp_path / "damage"
    assert target is not None
    compiler = find_compiler(target, prefer_system=True)
    objects = [
        compile_object(replace(part, flags=(*part.flags, *SANITIZERS)), file, target, compiler, CACHE / "objects")
        for part in (find_ship_model(), Part(Path(__file__).parent, ("damage.cpp",)))
        for file in part.files
    ]
    compile_c(*SANITIZERS, *objects, "-o", program)
    ship.write_bytes(prepare_ship("guan2014_own_manoeuvring"))  # it has a torque limit
    command = [program, ship, tmp_path / "damaged.ship", "2000"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600, env={})
    assert (done.returncode, done.stderr[-3000:]) == (0, "")
    numbers = re.fullmatch(r"(\d+) started, (\d+) refused, (\d+) steps, (\d+) hulls\n", done.stdout)
    assert numbers is not None
    assert min(map(int, numbers.groups())) > 500  # all of them happen
