"""A fault of the wrappers' libraries that corrupts the host's memory at its end, and how it is kept from happening.

The libraries of pythonfmu 0.7.0 and pythonfmu3 0.3.4 hold a static shared_ptr to the state of the interpreter. When
the library is unloaded, or the process ends, C++ destroys that pointer first; then the library's own destructor
function assigns to it, and counts down in memory that is already free. Often nothing comes of it. In a Python host
that had not imported NumPy before the FMU did, the process aborts with "free(): corrupted unsorted chunks" after all
its work is done.

The pointer is needed only where the wrapper started the interpreter, to end it. In a host that is itself Python it may
be let go of as soon as there is an instance, by the function that the library exports for its own end; each instance
has a reference of its own.
"""

from __future__ import annotations

import os
import sys
from ctypes import CDLL
from pathlib import Path

__all__ = ["let_go"]


def let_go(resources: str) -> None:
    """Make the library of the FMU unpacked around `resources` safe to unload, in a host that is itself Python.

    Elsewhere nothing is done: on Windows the order is another; in a native host the pointer ends the interpreter.
    """
    if sys.platform == "win32" or not sys.orig_argv:  # an interpreter that the wrapper started has no command line
        return
    for library in Path(resources).parent.glob("binaries/*linux*/*.so"):
        _finalise(library)


def _finalise(library: Path) -> None:
    from _ctypes import dlclose  # CPython on Unix; ctypes itself never closes what it opens

    try:
        opened = CDLL(str(library), mode=os.RTLD_NOW | os.RTLD_NOLOAD)
    except OSError:  # not the file that the host has loaded
        return
    try:
        opened.finalizePythonInterpreter.restype = None
        opened.finalizePythonInterpreter()
    except AttributeError:  # a later wrapper, which may have mended this
        pass
    finally:
        dlclose(opened._handle)
