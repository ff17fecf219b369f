"""Scenarios run in time: the master, its components, and what is recorded.

tables, scenario            a scenario file
component, fmu_component    a model in process and an FMU, seen alike
master, wiring              the two algorithms; from a scenario to connected components
recorder                    what happened, at communication points
events, reference, summary  what follows from it: collisions, the paper beside us, the books
fmu_files, folder           where FMUs are found and runs are written
simulate                    all of it in one call
helm                        who steers: autopilot, route, evasion
wanted, touching, tracks, aim, encounters, encounter_text, imazu    scenarios in which ships do meet
traffic_schema, traffic_ships, tangent_plane, traffic               scenarios from traffic situations in JSON
approach, trial_track, trials, trial_report                         standard manoeuvres of one ship
report, compliance          for people: tables, and the FMI check
"""
