"""A fault of the wrappers' libraries that corrupts the host's memory at its end, and how it is kept from happening.

The libraries of pythonfmu 0.7.0 and pythonfmu3 0.3.4 hold a static shared_ptr to the state of the interpreter. When
the library is unloaded, or the process ends, C++ destroys that pointer first; then the library's own destructor
function assigns to it, and counts down in memory that is already free. Often nothing comes of it. In a Python host
that had not imported NumPy before the FMU did, the process aborts with "free(): corrupted unsorted chunks" after all
its work is done.

The pointer is needed only where the wrapper started the interpreter, to end it. In a host that is itself Python it may
be let go of as soon as there is an instance, by the function that the library exports for its own end; each instance
has a reference of its own. In a native host on Linux that function becomes an exit handler of the process, which runs
before C++ destroys anything, and the library stays loaded until then.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from ctypes import CDLL, c_void_p, cast
from functools import cache
from pathlib import Path

__all__ = ["make_library_safe"]


def make_library_safe(resources: str) -> None:
    """Make the library of the FMU unpacked around `resources` safe to unload, in a host that is itself Python.

    In a native host it is made safe to end the process. On Windows nothing is done: the order is another.
    """
    if sys.platform == "win32":
        return
    make_safe = _finalise if sys.orig_argv else _finalise_at_exit  # an interpreter of the wrapper has no command line
    for library in Path(resources).parent.glob("binaries/*linux*/*.so"):
        make_safe(library)


@cache
def _finalise_at_exit(library: Path) -> None:
    with suppress(OSError, AttributeError):  # not the file that the host has loaded; or a later wrapper
        function = CDLL(str(library), mode=os.RTLD_NOW | os.RTLD_NOLOAD).finalizePythonInterpreter
        register = CDLL(None).__cxa_atexit
        register.argtypes = [c_void_p, c_void_p, c_void_p]
        register(cast(function, c_void_p), None, None)


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
