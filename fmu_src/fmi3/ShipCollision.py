"""FMU ShipCollision in FMI 3.0; the same model and variables as in FMI 2.0.

The word Fmi3Slave in the class line is what pythonfmu3 looks for. Its wrapper crashes the host when this text raises,
so an error of the import is raised when an instance is made.
"""

from pythonfmu3 import Fmi3Slave

try:
    from shipcollision_fmu.fmi.slave_fmi3 import ModelSlave3
except Exception as error:  # a package is missing, or the process has imported another shipcollision_fmu
    reason = f"shipcollision_fmu cannot be imported as this FMU needs it: {error}"

    class ModelSlave3:
        def __init__(self, **kwargs):
            raise ImportError(reason)


class ShipCollision(ModelSlave3, Fmi3Slave):
    """The collision model as an FMI 3.0 slave."""

    interface = "shipcollision_fmu.fmi.ship_collision"
