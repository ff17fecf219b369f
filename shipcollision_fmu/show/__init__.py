"""Pictures of a finished run: page, glTF, OpenSceneGraph, films, figures.

    outputs.py   pictures by kind, for `shipcollision show`
    scene/       the folder of a run becomes a Scene
    page/        replay.html for a browser
    gltf/        scene.glb for Blender, Unity, Unreal and viewers
    osg/         scene.osgt for osgviewer
    film/        GIF, MP4 and stills, drawn by NumPy
    plots.py     figures by Matplotlib
    extras.py    a clear line where an optional package is missing

Data flow: files of a run -> RunFolder -> Scene -> bytes of a picture. Imports from: ship (frames,
convex solids, kinetic energy), fmi (names of columns), collision (clipping.py, for figures). Drawing libraries are
imported only here. Used by: cli, cosim (page of a run).
"""
