"""The tables of a scenario file, one pydantic model each, with the description, unit and limits of every key.

    [scenario]             header.py        Header: name, duration, step, algorithm
    [ships.NAME]           ship_start.py    ShipStart: ship, position, heading, speed, rates, and the keys below
      orders               orders.py        Order: rudder, heading or revolutions at a time
      autopilot, route     autopilot.py     AutopilotTable, RouteTable
      evasion              evasion.py       EvasionTable
      track, ais           ais.py           TrackTable, AisTable
      fender                                collision/obstacles.py
    [obstacles.NAME]                        collision/obstacles.py
    [collision]            collision.py     Collision, DamageTable
    [place]                place.py         Place: latitude, longitude, start
    [environment]          environment.py   Environment, WindTable
    [reference]            reference.py     Reference, Published, Tolerance

Angles are in degrees in keys that end in `_deg`; everything else is in SI units. Positions and velocities are of CO
(midship, centreline, waterline). Unknown keys, NaN and numbers in quotes are refused. The description of a field ends
the message that refuses its value, and is the key's text in the reference of the documentation.

Data flow: a parsed TOML file -> Scenario. Imports from: ship (frames, tables), collision (checks, responses,
obstacles), scenario/tracks. Used by: scenario, cosim, encounters, results.
"""
