"""Many impacts in one call of the native library: arrays in, a structured array out.

    impact.py          impact(): the contact alone, for arrays of angles, places and speeds
      impact_table.py    columns of its table, with units and meanings
      native_impacts.py  the calls of the native library (native/batch)
    prepared_ships.py  ships as files that the native library reads

Data flow: arguments -> table of cases -> native/batch -> table of rows. Imports from: encounters (plan_contact.py),
manoeuvring (prepared_ship.py), ship, toolchain. Used by: users of the package.
"""
