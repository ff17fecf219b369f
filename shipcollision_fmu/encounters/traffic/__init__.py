"""Traffic situations in JSON (DNV's trafficgen and maritime-schema) as scenario files.

    schema.py          the members of the JSON that are read, with their limits
    ships.py           start, route and planned speeds of each ship in n, and a ship file of its dimensions
    tangent_plane.py   latitude and longitude to north and east
    situation.py       traffic_scenario(): the scenario file, and notes on what is left out

Data flow: JSON -> Situation -> ShipStart by role -> text -> Scenario. Imports from the room above and what it imports.
"""
