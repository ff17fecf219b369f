"""FMU ShipManoeuvring in FMI 3.0; the same model and variables as in FMI 2.0.

Its module in the FMU has a name of its own for each content, because pythonfmu3 imports it like any other: the first
of a name would serve all. The word Fmi3Slave in the class line is what pythonfmu3 looks for.
"""

from pythonfmu3 import Fmi3Slave

from shipcollision_fmu.fmi.slave_fmi3 import ModelSlave3


class ShipManoeuvring(ModelSlave3, Fmi3Slave):
    """The manoeuvring model as an FMI 3.0 slave."""

    interface = "shipcollision_fmu.fmi.ship_manoeuvring"
