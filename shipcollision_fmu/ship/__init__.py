"""What a ship is.

frames              n, b and Bullet's world, and the one converter
toml, refusal       reading a user's file, and saying in one line why it is refused
particulars, hull_table, manoeuvring_tables    the tables of a ship file, key by key
ship_file           the file, validated
inertia             M = M_RB + M_A about CO
hydrostatics, seakeeping    waterplane, metacentres, restoring and damping of heave, roll and pitch
windage             what the wind finds above the water
estimate            an MMG set from L, B, T and C_b
hull                the solid that touches other ships
ship, assembly, library     a ship, put together from its file, and found by name
"""
