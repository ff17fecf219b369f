"""Loading a ship: from a name, a file or a dict to a Ship.

    library.py         load_ship(): finds and reads the files, lays bases under variants, makes each ship once
    toml.py            read_toml(), parse_toml(): TOML with a refusal in one line
    ship_file.py       validate_ship_file(): the tables, one by one and together
    consistency.py     find_contradictions(): between tables, with limits and remedies
    dimensions_estimate.py    complete_dimensions(): mass, depth, bow and stern from main dimensions and type
    obstacle_tables.py are_obstacles(): a file of obstacles in place of one of a ship
    messages.py        describe_error(): one line with all problems of a failed validation
    mmg_estimate.py    complete_tables(): an MMG set from L, B, T and C_b
    rudder_estimate.py estimate_rudder(): a rudder by the type of ship
    assembly.py        assemble_ship(): matrices, and estimates of what is missing
    added_mass_estimate.py    assemble_added_mass(): the file's own, the MMG set's, or estimates
    stability_estimate.py     estimate_stability(), estimate_k_xx(): CG, GM and roll radius by type of ship
    motora_charts.py   estimate_added_mass(): surge, sway and yaw from L, B, T and C_b

Data flow: name -> path -> tables -> ShipFile -> Ship. Imports from: tables and the files of ship/.
Used by: all rooms that need a ship; read_toml() and describe_error() also by other files' readers.
"""
