"""Collisions of ships: contact detection, contact solvers, and the impulse ledger.

    model                      ShipCollision: a communication step, readable as its stages
    interface                  parameters, inputs, outputs
    checks                     refusals of parameters and inputs
    ship_names                 names that ships may have
    bodies, obstacles          the bodies of a model, from ship files and obstacle tables
    exchange                   states received from the ship models, impulses returned to them
    proximity                  pairs that could touch within the step; clearance
    conservative_advancement   which pair is examined at which substep
    contact_problem            problem and solution of a substep; caches from substep to substep
    responses                  pgs, closed_form, bullet: how contact is answered
    delayed_impulses           ships that may have passed what they hit, by an impulse applied one step late
    collisions                 collisions and scratches in time, and their numbers
    contact_points             contact points of a communication step
    fender, fender_ledger      law of a fender; energy in fenders
    totals                     energy lost, and how well contact was solved
    feedback                   how ships take impulses, by name
    diagnosis, findings        is a ship wired wrongly? the table of what can be found
    motion_watch, motion_check, answer_watch    what a ship model gives, compared with itself and with its impulses

    dynamics/    states, contacts, impulses, ledger
    geometry/    contact detection
    solvers/     impulses from v and W

Data: ShipState -> exchange -> BodyState -> geometry -> Contact -> v, W -> solvers -> impulses P -> dynamics -> outputs.

Imports: ship/, toolchain and errors; within the room, model > the other files > solvers > geometry > dynamics.
`pybullet` only in geometry/bullet.py, our library only in geometry/closest_points.py.
Equations: docs/theory/contact.md.
"""
