"""scene.glb: a Scene as binary glTF 2.0.

    gltf.py      nodes, meshes and animation of a Scene
    ribbons.py   scratches as ribbons of triangles
    glb.py       the container: JSON and one buffer

Data flow: Scene -> Document -> bytes. Imports from: scene, ship (frames, convex).
"""
