"""One ship sails.

hull_forces, propeller, rudder      MMG: forces by origin
b_series                            a propeller measured in all four quadrants
restoring, damping, wind            and what heave, roll, pitch and the air add
mmg                             what all degrees of freedom share: machines, integration
mmg, spatial                        equations of motion in 3, and in 4 or 6 degrees of freedom
actuators                           rudder and engine follow their orders
ports, model                        a step of the ship model, readable as its stages
"""
