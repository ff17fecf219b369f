"""The hull of a ship as a solid that contact detection and pictures work on, in b about CO.

    hull.py      build_hull(): a box or a parametric ship form; one hull for one content
    levels.py    draw_levels(): the polygons that the form is stacked from
    room_for_the_bow.py    describe_lack_of_room(): of rake, flare and bilge, and what makes room
    mesh.py      build_mesh_hull(): a hull from a mesh file, in the steps of the next lines
    mesh_file.py     read_mesh_file(): the formats, and what a file states of itself
    mending.py       close_surface(): vertices joined, doubled faces dropped, holes closed or refused
    file_frame.py    read_frame(): unit, axes and origin of the file
    mesh_checks.py   check_size(), check_axes(), check_place(); list_suspicions(), which are warned of
    one_solid.py     unite_surfaces(), find_convex_hull(): the one solid, simplified where it has many faces
    convex_parts.py  cut_into_convex_parts(): of a solid that is not convex
    hull_cache.py    find_hull(), keep_hull(): in the user's cache
    child_process.py     run_program(): one of the next two, in a process of its own
    manifold_process.py  the program that unites, simplifies and fills, by the library Manifold
    coacd_process.py     the program that cuts, by the library CoACD
    self_crossing.py     find_crossings(): where a surface passes through itself
    solid.py     HullMesh: the closed surface, its convex parts and their half-spaces
    convex.py    enclosed volume, half-spaces and convexity of a triangle mesh

Data flow: L_oa, B, T and the table [hull] -> HullMesh, whose arrays are read-only.
Imports from: tables, frames, file_stamp, errors, files. Used by: collision, scenario, encounters, results, show.
"""
