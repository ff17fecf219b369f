"""Other people's traffic as scenario files: maritime-schema and trafficgen (JSON), CommonOcean (XML).

    situation.py              traffic_scenario(): the scenario file, and notes on what is left out
      traffic.py                Traffic: what both readers give
      ships.py                  reads JSON: start, route and planned speeds of each ship in n
        schema.py                 the members that are read, with their limits, in all versions
        ais.py                    values by which AIS says "not available"
        angle_units.py            files of 2024 in radians and m/s
      commonocean.py            reads XML: planning problem, dynamic and static obstacles
        commonocean_schema.py     the members that are read, with their limits
        commonocean_ships.py      start and route
        commonocean_obstacles.py  tables of fixed obstacles
        commonocean_shapes.py     middles, boxes and corners; x, y to north, east
        xml_tree.py               XML without document types and entities
        thinning.py               a trajectory's corners
      unread.py                 names the tables that nothing reads

Data flow: JSON or XML -> Traffic -> text -> Scenario. Imports from the room above and what it imports; positions
on earth and ship files by size are in scenario/tracks/.
"""
