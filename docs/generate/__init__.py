"""Parts of the pages that are made from the code when the site is built.

parts        the names that pages use in `<!-- generate: NAME -->`, and what makes each part
markdown     tables and headings
schema       a JSON schema as tables of keys: files of ships and scenarios, events.json
variables    the variables of both FMUs
estimates    what fills a ship file of the fewest numbers
commands     the command line
columns      the columns of a run's tables
findings     what the collision FMU finds wrong with the wiring of a ship
api          the names that the package exports
aligned      docstrings for the API reference: aligned columns stay columns
rooms        the rooms, their floors and their maps
published    published numbers beside ours, from runs
frames       the figure of the frames
"""
