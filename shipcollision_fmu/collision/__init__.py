"""Two hulls touch: who is near, where they touch, the rival responses, the impulse ledger, energy and events.

model           a step, readable as its stages; docs/theory/contact.md has the equations

what it is of   ports, checks, bodies, obstacles
where to        state, ahead, drift, ledger: poses and twists within a step, and what ships were given
who is near     neighbours, broad_phase
where           detection: engine (the one module that knows pybullet), level, manifold, clipping, joined, axes, contact
how much        responses, which chooses: delassus, then
                pgs         coulomb, extrapolation, newton, sliding_speed, warm_start, restitution
                closed_form slip_path, slip_curve, resultant; four_dof is its oracle
                enforce_passivity: no answer adds energy
besides         fenders, fender_books; energy; damage
told            slots, collisions
"""
