"""Text from a host that is not UTF-8, as FMI wants it.

The wrappers' libraries make a Python string of each text. Where that fails they put a null pointer into the list of
values, and leave the error pending: who reads that entry ends the process of the host. Here such entries become
UNDECODABLE before anybody reads them.

While an error is pending, CPython finds an attribute of an object in its own class alone, and not in its bases.
"""

from __future__ import annotations

from ctypes import PYFUNCTYPE, c_int, c_ssize_t, c_void_p, py_object, pythonapi
from typing import Any

__all__ = ["UNDECODABLE", "make_own", "replace_undecodable"]


class _Undecodable:
    def __repr__(self) -> str:
        return "bytes that are no text in UTF-8"


UNDECODABLE = _Undecodable()
"""In place of a text that is not UTF-8."""

_clear_error: Any = PYFUNCTYPE(None)(("PyErr_Clear", pythonapi))
_get_item: Any = PYFUNCTYPE(c_void_p, py_object, c_ssize_t)(("PyList_GetItem", pythonapi))
_set_item: Any = PYFUNCTYPE(c_int, py_object, c_ssize_t, py_object)(("PyList_SetItem", pythonapi))
_take_reference: Any = PYFUNCTYPE(None, py_object)(("Py_IncRef", pythonapi))


def replace_undecodable(values: list[Any]) -> None:
    """Puts UNDECODABLE in the place of null pointers. To be called first, for an error may be pending."""
    _clear_error()
    for k in range(len(values)):
        if _get_item(values, k) is None:
            _take_reference(UNDECODABLE)  # the list takes over a reference
            _set_item(values, k, UNDECODABLE)


def make_own(cls: type, name: str) -> None:
    """Gives a class the attribute that it inherits, so that it is found while an error is pending."""
    setattr(cls, name, getattr(cls, name))
