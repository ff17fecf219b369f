"""Loaded by each worker of a local cluster. Ctrl-C reaches all processes of a terminal; the client alone answers it."""

from __future__ import annotations

import logging
import signal
import threading

if threading.current_thread() is threading.main_thread():
    signal.signal(signal.SIGINT, signal.SIG_IGN)
for name in list(logging.root.manager.loggerDict):
    if name.startswith("distributed"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
