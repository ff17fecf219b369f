"""Scenarios as systems of FMUs that other hosts run: SSP 1.0 and the Open Simulation Platform.

    system_structure.py   a scenario becomes a SystemStructure: instances, start values, connections, orders
    instance.py           an instance with its start values, and a connection
    foreign_ship.py       reads a ship model of somebody else; replaced_ship.py puts it into the system
    packed_ship.py        a user's ship file as files inside an FMU
    left_out.py           refuses or describes what a format cannot hold
    ssp.py                writes one .ssp file
    osp.py                writes a folder; osp_groups.py has its variable groups
    xml_file.py           XML documents and values in the spelling of the hosts

Data flow: Scenario -> SystemStructure -> files. Imports from: cosim (parameters and prepared files of a scenario), fmi
(FMUs, variable tables), collision (interface), scenario, ship (loading). Used by: live, cli.
"""
