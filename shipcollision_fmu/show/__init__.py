"""A finished run made visible. docs/guide/pictures.md is for users, docs/develop/pictures.md for those who change it.

    outputs      the kinds of picture by name, for the command `show`
    extras       optional libraries, imported when a picture needs them
    scene/       the run's folder read and checked, and one scene made of it: SI units, frames n and b
    page/        replay.html: the scene in one file for a browser
    gltf/        scene.glb
    osg/         scene.osgt for osgviewer; zup is the one converter to a world with z up
    film/        stills and films drawn by numpy
    plots        figures for a report

Data flow: folder of a run -> RunFolder -> Scene -> every picture. Nothing is written back to the run.
Imports from: ship, fmi (names of the states), files, errors. Drawing libraries are imported here alone.
Used by: cli.
"""
