"""The protocols of simulators and bridges: NMEA 0183, AIS and DIS out, orders in.

    sample.py        Sample: a run at one time, as the encoders need it
    identity.py      who a ship is: MMSI, name, type, dimensions, mass
    fix.py           position on earth, SOG, COG, true heading and rate of turn of a ship
      nmea.py          RMC, GGA, VTG, HDT, ROT, RSA, RPM, MWV of own ship
      ais.py           messages of type 1 and 5, VDM of others and VDO of own ship
      dis.py           entity state and collision PDUs
    schedule.py      what is due when: fixed rates, those of AIS class A, thresholds of dead reckoning
    feeds.py         NmeaFeed, DisFeed: samples in, sentences or PDUs that are due out
    senders.py       UDP and TCP senders that never wait
    addresses.py     udp://HOST:PORT as an option gives it
    order_port.py    orders as JSON lines over TCP; order_line.py has their form
    outlets.py       Outlets: all of them for a live session
    run_log.py       the sentences of a finished run as a file

Encoders are pure functions of a Sample. A sender that cannot send drops what it has: the simulation never waits for it.
"""
