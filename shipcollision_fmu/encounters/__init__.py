"""Scenarios generated from what is asked of an impact, from Imazu's cases and from other people's traffic.

    encounter.py           encounter(): a Request becomes the text of a scenario file whose ships do collide
      request.py             the kinds of encounter, their options and limits
      planned_impact.py      place, angle and sections in plan at the impact
      plan_contact.py        positions in which two sections touch at a given place
      approaching_ship.py    speed, current and helm orders of both ships before the impact
      approach_track.py      poses of a ship at every communication point up to the impact
      targeting.py           corrects the tracks until the collision model finds the impact at the place
      earlier_overlap.py     refuses tracks whose hulls overlap before the impact
      encounter_file.py      writes the scenario file
    imazu.py               imazu(): the 22 cases of Imazu's problem
    traffic/               traffic_scenario(): a file of trafficgen or CommonOcean becomes a scenario file
    ship_table.py          the table [ships.NAME] that all three write
    units.py               knots

Data flow: Request -> PlannedImpact and ApproachingShip -> Approach (two tracks) -> text -> Scenario.
Imports from: scenario, manoeuvring (trials, model), collision (model, clipping.py), ship. Used by: batch, cli and
users of the package.
"""
