"""Rows of a study: compute_rows(), a pure function of the study and the numbers of the rows.

    compute.py           compute_rows(): cases are drawn, run, and written into tables
      cases.py             the values of all variables and the ships, by row number
        sampling.py          the share u of each variable: random, Latin hypercube, Sobol
          uniform_numbers.py   random numbers by counter (Philox)
          permutation.py       a random permutation at any place (Feistel)
          sobol.py             Sobol's sequence at any place; direction_numbers.py
      fleet_ships.py       a ship of the fleet by number; ship_folder.py: as a file
      pairs.py             cases by pair of ships, pairs that stay open
      impact_rows.py       level impact; python_impacts.py without the native library
      encounter_rows.py    level encounter
      sailed_rows.py       level sailed
      situation_rows.py    files of traffic
        encounter_results.py   whole encounters by column; python_run.py without the native library
      case_scenario.py     write_case(): a case as a scenario file, to be run and shown
      results.py           what became of the cases, by column
    tables.py            the tables as Arrow; columns.py: names, units, meanings

Data flow: Study, row numbers -> Cases -> Results -> RowTables. Imports from: definition, batch, cosim, encounters,
scenario, collision, fmi (names), ship, toolchain. Used by: study/engine.
"""
