"""The keys of a ship file, one class per table: name, unit, limits and meaning stand there and nowhere else.

    table.py          Table, the strict base of the tables of all rooms, and the kinds of number
    particulars.py    [ship], [particulars], [added_mass], [seakeeping], [wind]
    hull.py           [hull]
    manoeuvring.py    [manoeuvring], [propeller], [rudder], [engine]

Data flow: a dict as TOML gives it -> validated, frozen tables. Checks that need several tables are in
loading/ship_file.py. Imports from: pydantic alone. Used by: loading, hull, the models, and the tables of other rooms.
"""
