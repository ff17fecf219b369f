"""Two hulls touch: detection, the rival responses, the impulse ledger, energy and events.

contact     the data of a contact point, and the shadow of a ship
engine      the one module that knows pybullet
clipping    which points of two touching features are common to both
detection   Bullet's answer, cleaned: contacts, normals, clearance
delassus    inertia felt at the contacts
pgs, bullet the rival responses, one signature; RESPONSES in responses.py chooses
ledger      impulses issued, applied, pending
episodes    collisions and scratches in time
model       a step of the collision model, readable as its stages
"""
