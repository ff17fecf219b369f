"""Loaded by each worker of a local cluster. Ctrl-C reaches all processes of a terminal; the client alone answers it.

What rows need is imported here, by all workers at once, and not by each within its first batch.
"""

from __future__ import annotations

import logging
import signal
import threading
from importlib import import_module

if threading.current_thread() is threading.main_thread():
    signal.signal(signal.SIGINT, signal.SIG_IGN)
for name in list(logging.root.manager.loggerDict):
    if name.startswith("distributed"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
import_module("...rows.compute", __name__)
