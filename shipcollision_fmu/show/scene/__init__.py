"""Scene: everything visible of a run, without colours on a screen or a file format.

    run_folder.py   reads and checks the files of a run        signals.py    curves over time
    scene.py        builds the Scene: ships, tracks, events    resample.py   thins tracks, lines and curves
    scratches.py    lines of contact points on the hulls       effects.py    explosion, debris, fire, smoke
    surface.py      triangle surfaces                          fittings.py   deckhouses, hatches, masts
    parts.py        surfaces by paint                          palette.py    colours
    camera.py       a camera over time

Data flow: folder -> RunFolder -> Scene. Imports from: ship, fmi (names).
"""
