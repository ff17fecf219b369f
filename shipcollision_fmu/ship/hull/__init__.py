"""The hull of a ship as a solid that contact detection and pictures work on, in b about CO.

    hull.py      build_hull(): a box or a parametric ship form; one hull for one content
    mesh.py      build_mesh_hull(): a hull from an OBJ or STL file, checked and cut into convex parts
    solid.py     HullMesh: the closed surface, its convex parts and their half-spaces
    convex.py    enclosed volume, half-spaces and convexity of a triangle mesh

Data flow: L_oa, B, T and the table [hull] -> HullMesh, whose arrays are read-only.
Imports from: tables, frames, file_stamp, errors. Used by: collision, scenario, encounters, results, show.
"""
