"""A ship: its file, its hull as a solid, its inertia in water, and the frames in which its state is given.

    frames.py                n, b and Bullet's world, and the conversions between them
    ship_state.py            ShipState: pose and twist of a ship in one value
    degrees_of_freedom.py    free and held motions, the level axes, and the inverse of the free block of M
    coasting.py              coast(), coast_pose(): the straight motion of CG
    coasting_law.py          make_coasting(): how a ship moves between impulses, in both models
    kirchhoff_plane.py       Kirchhoff's equations in surge, sway, yaw and roll
    kirchhoff_space.py       Kirchhoff's equations in six degrees of freedom
    kinetic_energy.py        kinetic energy of the free motions
    inertia.py               M = M_RB + M_A about CO
    hydrostatics.py          waterplane and metacentric heights from L, B, T and C_b
    roll_period.py           natural period of roll, of the Intact Stability Code and of a ship
    ship_type.py             what is typical of a type of ship: GM, speed, machinery
    b_series.py              a propeller measured in all four quadrants
    propeller_torque.py      torque of a propeller from its thrust and pitch
    seakeeping.py            stiffness and damping in heave, roll and pitch
    restoring.py, damping.py    forces of buoyancy and weight, and of waves and friction
    windage.py               areas above the water and Blendermann's coefficients
    ship.py                  Ship: all numbers of a ship, which cannot be changed
    ship_checksum.py         compute_checksum(): of these, by which a saved state recognises its ship
    file_stamp.py            when a file that was read once must be read again
    tables/                  every key of a ship file with its description, unit and limits
    hull/                    the hull: a closed surface and its convex parts
    loading/                 load_ship(): a name, a file or a dict becomes a Ship

Data flow: TOML -> tables -> ShipFile -> Ship -> build_hull(), compute_seakeeping(), compute_windage().
Imports from: errors. Used by: collision, manoeuvring and all rooms above them.
"""
