"""A model as an FMU: one table of variables, and everything that follows from it.

Tables
    names               the names of the variables, in groups
    variables           what a variable is, and how a table is written
    units               units with their SI exponents
    ship_collision, ship_manoeuvring    the two tables, each with its model: an Interface
    interface           name + table + model = Interface, what an FMU is made from
    arrays              the table as FMI 3.0 has it
Run time, inside the FMU and in process
    variable_access     values by value reference, steps and saved states; the same for an FMU and a run in process
    slave_base          what the slaves of both versions of FMI do
    slave, slave_fmi3   the bases of the slaves in fmu_src/
    undecodable         text of a host that is not UTF-8
    build_record        what an FMU was built from, and whether the running package is the same
    wrapper_library     a fault of the wrappers' libraries at their end, and its remedy
Build time
    builder/            modelDescription.xml, documentation and the .fmu file; no FMU carries it

Imports: errors, manoeuvring and collision (the two tables alone), pythonfmu and pythonfmu3 (the slaves alone);
builder/ imports files, ship and toolchain, too. Nothing here imports a scenario or a master.

Data flow: Interface -> VariableAccess (table bound to a model's attributes) -> slave -> host
           Interface -> builder: XML, HTML, sources -> bytes of the .fmu file
"""
