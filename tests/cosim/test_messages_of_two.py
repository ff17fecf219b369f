"""Messages of FMUs reach their own listener, while a run goes on and after it.

FMPy's proxy for messages with arguments has one place for a listener, for all FMUs of a process: the last one is told.
"""

from __future__ import annotations

import subprocess
import sys
from contextlib import ExitStack, closing
from pathlib import Path

import pytest

from shipcollision_fmu.cosim.fmi2_component import Fmi2Component
from shipcollision_fmu.cosim.fmu_instance import UnpackedFmu
from shipcollision_fmu.errors import HostError
from shipcollision_fmu.fmi.builder.package import build_fmus

AFTER_A_RUN = """
import gc, sys
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from shipcollision_fmu import load_scenario, simulate

simulate(load_scenario("guan2014_added_mass"))
gc.collect()
folder = extract(sys.argv[1])
description = read_model_description(folder)
slave = FMU2Slave(guid=description.guid, unzipDirectory=folder, instanceName="alone",
                  modelIdentifier=description.coSimulation.modelIdentifier)
slave.instantiate(loggingOn=True)
reference = {v.name: v.valueReference for v in description.modelVariables}
slave.setupExperiment(startTime=0.0)
slave.setString([reference["ship"]], ["no such ship"])
slave.enterInitializationMode()
try:
    slave.exitInitializationMode()
except Exception:
    pass
"""


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_fmus(tmp_path_factory.mktemp("fmus"))["ShipManoeuvring"]


def test_a_slave_of_another_master_may_speak_after_a_run(fmu: Path) -> None:
    """The run's own listeners are gone by then: the process ended by a segmentation fault."""
    done = subprocess.run(
        [sys.executable, "-c", AFTER_A_RUN, str(fmu)], capture_output=True, text=True, timeout=600, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "no such ship" in done.stdout


def test_of_two_instances_the_first_gives_its_own_reason(fmu: Path) -> None:
    with ExitStack() as stack:
        unpacked = stack.enter_context(closing(UnpackedFmu(fmu)))
        first, second = (stack.enter_context(closing(Fmi2Component(name, unpacked))) for name in ("first", "second"))
        with pytest.raises(HostError, match="no such ship"):
            first.initialise({"ship": "no such ship"}, 1.0)
        second.initialise({"ship": "kvlcc2"}, 1.0)
