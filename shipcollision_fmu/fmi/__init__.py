"""A model as an FMU: one table of variables, and everything that follows from it.

variables           what a variable is, and how a table of them is written
units               the units and their SI exponents
interface           table + model = Interface, what an FMU is made from
ports               fast access to a model through value references; the same for the FMU and for a run in process
slave               the base of the slaves in fmu_src/
build_record        what an FMU was built from, and whether that is what is running
builder/            the .fmu files
ship_manoeuvring, ship_collision    the two tables
"""
