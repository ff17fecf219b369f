"""Rigid-body dynamics at contacts: states of the bodies, impulses, and the balance with the ship models.

    body_state       pose and twist of a body within a communication step
    contact          a contact point; velocities there; booking of impulses and the energy that they cost
    contact_frame    axes of a contact
    delassus         approach velocities v and Delassus operator W of all contacts
    small_blocks     products and linear systems of many contacts, without threads
    passivity        scales back impulses that would add energy
    impulse_ledger   what was issued to a ship, and what the ship model applied
    other_forces     velocity that other forces add within a step

Data: a received state becomes a BodyState; geometry/ makes Contacts from BodyStates; solvers/ gets v and W and returns
impulses P; book_impulses enters them. Imports: ship/ only. Nothing here imports geometry/ or solvers/.
"""
