"""Closed forms of the literature for the energy of an impact, beside the rows of a study.

    energies.py         estimate_energies(): all of them for a table of encounters
      minorsky.py         Minorsky (1959): central, right-angled
      popov.py            Popov et al. (1967): along the normal, without friction
      pedersen_zhang.py   Pedersen and Zhang (1998): with friction, sticking or sliding
    read_impacts.py     rows of the table as impacts in plan
    planar_impact.py    PlanarImpacts: inertia at the point of contact, closing speed and slip
    comparison.py       ratios of the simulation to the formulas, in classes

Data flow: encounters -> impacts in plan -> energies -> ratios. Imports from: ship. Used by: users of the package, and
benchmarks/closed_forms.py.
"""
