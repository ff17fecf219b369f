"""scene.osgt: a Scene for OpenSceneGraph's osgviewer.

    osg.py           the scene graph and the camera's path
    osg_effects.py   particle effects and their sprites
    osgt.py          OSG's text format
    zup.py           conversion to a world with z up

Data flow: Scene -> Item -> text. Imports from: scene, ship (frames).
"""
