"""Standard manoeuvring trials of one ship, sailed in process.

    steady_course     where a trial begins: a straight course, and the revolutions that keep the speed
    trial             the ship step by step, and the track as moments
    ship_summary      stability, roll period, speed, power and stopping distance of a ship
    trials            turning circle, zigzag and crash stop, with IMO's limits

Imports: manoeuvring.model, ship, errors.

Data flow: SteadyCourse -> ShipManoeuvring -> track of Moments -> Trial with its Figures
"""
