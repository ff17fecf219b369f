"""Live runs: a scenario on the wall clock, steered by people and programs.

    session/     the simulation in a thread of its own: commands in, snapshots out
    server/      pages and WebSocket on localhost
    protocols/   NMEA 0183, AIS and DIS out, orders in by TCP; the log of a finished run

Data flow: clients -> commands -> Session -> Snapshot -> clients; at the end an ordinary run folder and scenario.toml.
Needs the extra `live`, but for session/. Imports from: packaging (ship files), cosim, results and show (pages, the
scene), scenario, collision (its default separation), fmi (names), ship. Used by: cli.
"""
