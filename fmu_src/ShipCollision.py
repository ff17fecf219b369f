"""FMU ShipCollision: contact between two or more ships.

pythonfmu runs this text twice at the first instantiation and once at each later one: nothing may happen here but
these definitions.
"""

from shipcollision_fmu.fmi.slave import ModelSlave


class ShipCollision(ModelSlave):
    """The collision model as an FMI 2.0 slave."""

    interface = "shipcollision_fmu.fmi.ship_collision"
