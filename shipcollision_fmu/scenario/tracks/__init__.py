"""Recorded tracks of ships, from AIS, as motion in a scenario; and places on earth.

    track.py            Track: the state of a ship at any time; build_track()
      smoothing.py        the smoothing spline of noisy values and rates
      cleaning.py         the reports of one ship in order of time, and what is refused
      recording.py        Report and Recording: what every reader of a recording gives
      read_recording.py   a file becomes a Recording
        csv_recording.py    columns of latitude, longitude, SOG, COG, heading
        nmea_recording.py   sentences VDM with time stamps, decoded by pyais
        time_stamps.py      texts and numbers that are times
    estimated_ship.py   a ship file from the dimensions in a recording, in the user's cache
      ship_file.py, ship_size.py   a ship file from length, width and type, for other foreign files as well
    ais_codes.py        values by which AIS says "not available", types of ship
    tangent_plane.py    latitude and longitude to north and east, and back

Data flow: a file -> Recording -> reports of one ship -> Track -> ShipState at a time. Imports from: ship. Used by:
scenario, encounters (places and ship files), cosim, live.
"""
