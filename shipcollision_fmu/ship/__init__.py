"""What a ship is.

frames              n, b and Bullet's world, and the one converter
toml, refusal       reading a user's file, and saying in one line why it is refused
particulars         a ship file, validated
inertia             M = M_RB + M_A about CO
hull                the solid that touches other ships
ship, library       a ship assembled, and found by name
"""
