"""Solvers of an impact: from W and v at the contacts to impulses P.

Data that flows in: the Delassus operator W [1/kg] and the relative velocities v [m/s] before the impact, both in
contact axes (normal, two tangents), friction mu and restitution e. Out: impulses P [N s] on ship b; v + W P obeys
the law of contact. No solver depends on ships or hulls; resultant_contact, energy_split and warm_start alone read
contacts.

    contact_law            the law of contact and its residual; friction in a disc
    one_contact            one contact, exactly
    gauss_seidel           all contacts of a plastic impact: NSGS, with what follows
        warm_start         the impulses of the substep before, to start from
        aitken             extrapolation between sweeps
        alart_curnier      after MAX_SWEEPS: Newton's method on all contacts together
        aclm_fixed_point   where Newton's method cycles: a sequence of convex problems (ACLM)
    held_motions           friction of ships whose heave and pitch are held
    work_limit             the bound on the work of a communication step
    poisson_restitution    all contacts of an impact with restitution: the solver of response `pgs`
    resultant_contact      the contacts of a pair reduced to one
    impact_process         one contact followed along its normal impulse: the solver of response `closed_form`
        slip_flow          how the slip turns on the way
    energy_split           the energy lost along the normal and by friction, of any response

Imports: dynamics/ (contacts, W), ship/frames, errors. Used by: collision/responses.py, contact_problem.py
and model.py.
"""
