"""FMU ShipManoeuvring: the motion of one ship.

pythonfmu runs this text twice at the first instantiation and once at each later one: nothing may happen here but
these definitions.
"""

from shipcollision_fmu.fmi.slave import ModelSlave


class ShipManoeuvring(ModelSlave):
    """The manoeuvring model as an FMI 2.0 slave."""

    interface = "shipcollision_fmu.fmi.ship_manoeuvring"
