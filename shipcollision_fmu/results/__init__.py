"""What follows from the record of a run: the contents of the files in its folder.

    record.py             Record: tables of states, signals and contacts, as the recorder of cosim/ leaves them
    events.py             events.json: collisions and scratches; its schema is events.schema.json
      collision_events.py, scratch_events.py    one collision, one scratch
      velocity_gains.py   delta_v of each ship by each collision
      contact_rows.py     vectors of a row of contacts, and the states at the start of its step
      damage.py           indicative damage from the energy, by published correlations
    summary.py            summary.json: ledger, momentum, energy
      published.py        computed states beside published ones
    bodies.py             bodies.json: hulls, inertias and obstacles
    run_text.py           CSV and JSON text of the files

Data flow: Record and Ships -> events -> summary; Ships -> bodies; all -> text. Imports from: scenario, collision, fmi
(names of variables), ship. Used by: cosim.
"""
