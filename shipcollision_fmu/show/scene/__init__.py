"""Scene: everything visible of a run, without colours on a screen or a file format.

    run_folder.py   reads and checks the files of a run        signals.py    curves over time
    scene.py        builds the Scene: ships, tracks, events    resample.py   thins tracks, lines and curves
    scratches.py    lines of contact points on the hulls       effects.py    explosion, debris, fire, smoke
    surface.py      triangle surfaces                          solids.py     boxes, prisms, rods
    looks.py        all that is drawn of a ship                ship_style.py how ships of a type look
    hull_shell.py   the hull as drawn                          hull_rings.py, hull_ends.py, hull_lines.py  its form
    lettering.py    names, draught marks                       appendages.py rudders, propellers, anchors
    fittings.py     arrangement by type of ship                outfit.py, cargo.py  houses, masts, boats; cargo on deck
    lights.py       navigation lights
    parts.py        surfaces by paint                          palette.py    colours
    camera.py       a camera over time

Data flow: folder -> RunFolder -> Scene. Imports from: ship, fmi (names).
"""
