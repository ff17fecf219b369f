"""An FMU file in the forms that rules need."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from zipfile import ZipFile

from fmpy import read_model_description

__all__ = ["Subject", "join_some"]


class Subject:
    """An FMU file in the forms that the rules need.

    Raises the errors of FMPy and ElementTree for a description that cannot be read.
    """

    def __init__(self, file: Path) -> None:
        self.file = file
        with ZipFile(file) as archive:
            self.entries = archive.infolist()
            self.root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        self.description: Any = read_model_description(str(file), validate=False)
        self.variables: list[Any] = self.description.modelVariables

    @cached_property
    def contents(self) -> dict[str, bytes]:
        """All files in the archive by name."""
        with ZipFile(self.file) as archive:
            return {name: archive.read(name) for name in archive.namelist()}


def join_some(names: list[str]) -> str:
    """The first five names and the count of the others."""
    return ", ".join(names[:5]) + (f" and {len(names) - 5} more" if len(names) > 5 else "")
