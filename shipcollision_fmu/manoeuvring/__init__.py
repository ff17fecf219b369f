"""Motion of one ship: steering, propulsion, hydrodynamics, and the impulses of collisions.

    interface                       parameters, inputs and outputs by name
    model                           a step of the ship, readable as its stages
    mmg                             what the equations of motion share: force groups, machines, integration
    mmg_3dof, mmg_6dof              equations of motion in 3, and in 4 or 6 degrees of freedom
    hull_forces, propeller, rudder  forces of the MMG standard model
    torque_limit                    revolutions of an engine of limited torque
    wind                            forces of the air
    held_motions                    starts in 3 and 4 degrees of freedom: what is held must be at rest
    actuators                       rudder and engine follow their orders
    prepared_ship                   a ship as the native model reads it: all numbers, exact, in one file
    trials/                         turning circle, zigzag and crash stop of a ship; no FMU carries them

Imports: ship and errors. The room collision is not imported; impulses come in as numbers.

Data flow: ShipInputs -> ShipManoeuvring.step -> State (a value, never changed) -> ShipOutputs
"""
