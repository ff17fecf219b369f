"""The study file: its keys, the checks, and the Study that is made from it.

    study.py              read_study(): a file becomes a Study, which holds all that determines the rows
      study_file.py         tables of the file, each key with unit, limits and meaning
      variables.py          unit, limits and meaning of each variable, and the levels and kinds with which it acts
      distribution_text.py  a number, a word or a table becomes a distribution
      distributions.py      distributions by their exact inverse distribution functions
      empirical.py          tables of data, whose lines are drawn as a whole
      fleet_tables.py       [own] and [target]
      fleet.py              the ships among which rows choose, by number
      partial_loading.py    a ship at a lesser draught
      dimensions.py         what is drawn at random, in order
    situations.py         files of traffic in place of kinds of encounter
    table_checks.py       checks that need the tables of data
      level_checks.py       checks that need the level of detail
    warnings.py           what is hardly meant
    reference.py          keys and distributions, for `shipcollision study --keys` and the documents

Imports from: encounters (kinds), ship. Used by: study/rows, study/engine.
"""
