"""Many cases in one call of the native library (native/batch): structured arrays come out.

    impact.py          impact(): the contact alone, for arrays of angles, places and speeds
      case_table.py      arguments of both as a table of cases
      impact_columns.py      columns of its table, with units and meanings
      native_impacts.py    the calls of the library
    collide.py         collide(): whole collisions of coasting ships, for the same arrays
    encounters.py      run_encounters(): whole scenarios
      encounter_columns.py columns of the three tables of both
      encounter_tables.py  Encounters: the tables, from the rows of the library
      encounter_case.py    a scenario as the library reads it
      native_encounters.py the calls of the library, and the structures that it reads
    prepared_ships.py  ships and obstacles as files that the library reads

Data flow: arguments, or scenarios -> cases -> native/batch -> rows -> tables. Imports from: cosim (parameters,
scenario_helm), encounters (plan_contact.py), scenario, manoeuvring and collision (prepared files), ship, toolchain.
Used by: users of the package.
"""
