"""The simulation of a live run, in a thread that owns the models.

session.py         Session: the thread; takes commands, publishes snapshots and events, ends with a run folder
actions.py         does what commands ask for; in_command.py: which client may order which ship
news.py            tells of events; collision_news.py: of collisions
clock.py           the wall clock
live_run.py        LiveRun: the same without clock and thread
bridge.py          orders and failures of one ship; ship_limits.py checks them, order_log.py keeps them
touch_log.py       where bodies have touched
input_files.py     ship files and recordings, kept for the run's folder
scenario_text.py   the scenario file that gives the run again
pacer.py           when the next step is due
commands.py        what clients may ask for;   snapshot.py   what they see
"""
