"""Scenario files: their tables, their checks, and the start of a run that they describe.

    scenario.py          Scenario, load_scenario(), parse_scenario(): a file or its text becomes a checked Scenario
    tables/              every key of the file with its description, unit and limits
    tracks/              recorded AIS as motion; places on earth
    recorded_ships.py    gives ships the tracks that they follow
    order_schedule.py    orders by communication point
    initial_overlap.py   refuses bodies that overlap at the start
    toml_writer.py       writes tables as TOML, for generated scenarios and ship files

Data flow: TOML -> Scenario -> ShipStart.start, load_ships(), schedule_orders(). Imports from: collision (detection of
overlap, obstacles, limits, responses), ship. Used by: cosim, encounters, packaging, results, cli.
"""
