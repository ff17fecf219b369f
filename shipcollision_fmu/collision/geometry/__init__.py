"""Contact detection: where hulls touch, with which normal and gap.

    broad_phase      pairs of bodies whose rectangles in the plane overlap
    narrow_phase     what is asked of Bullet: closest points of convex parts, whichever adapter gives them
    bullet           the adapter of pybullet, which has a step of Bullet's own dynamics, too
    bullet_worlds    its worlds, kept for the next model
    closest_points   the adapter of this package's own library, for a Python without pybullet
    adapter          which of both
    detection        contacts of two hulls, from closest points
    first_touch      the time at which moving hulls touch first
    thickness        least width of a hull
    compound_hull    hulls of several convex parts: inner faces give no contact
    contact_place    places and heights at which two parts touch: common corners of the features that face each other
    clipping         intersection of polygons, edges and points in a plane
    plan_overlap     normal of least overlap in plan, for hulls that overlap deeply from the start

Data: poses (BodyState) in, lists of Contact out. Imports: ship/, toolchain, dynamics.body_state,
dynamics.contact and dynamics.contact_frame. pybullet is imported in bullet.py only.
"""
