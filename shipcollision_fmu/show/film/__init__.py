"""Films and stills of a Scene, drawn by NumPy without a GPU or a display.

    animation.py   GIF, MP4 and PNG with captions
    film.py        Film: the picture of a Scene at a time
    picture.py     lit solids, lines and puffs before the backdrop
    raster.py      triangles to pixels with a depth buffer
    sea.py         sky and sea
    puffs.py       particles of the effects

Data flow: Scene -> Film -> pixels -> file. Imports from: scene, ship (frames), extras. Pillow and
imageio-ffmpeg only in animation.py.
"""
