"""The hull of a ship as a solid that contact detection and pictures work on, in b about CO.

    hull.py      build_hull(): a box or a parametric ship form; one hull for one content
    levels.py    draw_levels(): the polygons that the form is stacked from
    room_for_the_bow.py    describe_lack_of_room(): of rake, flare and bilge, and what makes room
    mesh.py      build_mesh_hull(): a hull from an OBJ or STL file, checked
    convex_parts.py    cut_into_convex_parts(): of a solid that is not convex; kept in the user's cache
    coacd_process.py   the program that cuts, in a process of its own
    solid.py     HullMesh: the closed surface, its convex parts and their half-spaces
    convex.py    enclosed volume, half-spaces and convexity of a triangle mesh

Data flow: L_oa, B, T and the table [hull] -> HullMesh, whose arrays are read-only.
Imports from: tables, frames, file_stamp, errors, files. Used by: collision, scenario, encounters, results, show.
"""
