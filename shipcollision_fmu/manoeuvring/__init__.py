"""One ship sails.

hull_forces, propeller, rudder      MMG: forces by origin
mmg                                 their sum, integrated
actuators                           rudder and engine follow their orders
coasting                            no water: velocities constant in n
ports, model                        a step of the ship model, readable as its stages
"""
