"""Many cases in one call of the native library (native/batch): structured arrays come out.

    impact.py          impact(): the contact alone, for arrays of angles, places and speeds
      impact_table.py      columns of its table, with units and meanings
      native_impacts.py    the calls of the library
    encounters.py      run_encounters(): whole scenarios, without tables over time
      encounter_table.py   columns of its three tables
      encounter_case.py    a scenario as the library reads it
      native_encounters.py the calls of the library, and the structures that it reads
    prepared_ships.py  ships and obstacles as files that the library reads

Data flow: arguments, or scenarios -> cases -> native/batch -> rows -> tables. Imports from: cosim (parameters,
scenario_helm), encounters (plan_contact.py), scenario, manoeuvring and collision (prepared files), ship, toolchain.
Used by: users of the package.
"""
