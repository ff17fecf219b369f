"""Reading a TOML file, on Python 3.10 as well."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from typing import Any

from ...errors import InputError

__all__ = ["parse_toml", "read_toml"]

# tomllib came with Python 3.11; tomli is the same code. Imported by name so that type checking needs neither twice.
_tomllib = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")


def read_toml(path: Path, refusal: type[InputError]) -> dict[str, Any]:
    """Content of the TOML file at `path`; `refusal` is raised, with one line, when it cannot be read or parsed."""
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise refusal(f"{path.name}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise refusal(f"{path.name}: is not UTF-8 text (byte {error.start}): save it as UTF-8") from None
    return parse_toml(text, path.name, refusal)


def parse_toml(text: str, source: str, refusal: type[InputError]) -> dict[str, Any]:
    """Content of TOML text; `source` names it in the one line with which `refusal` is raised when it is not TOML."""
    try:
        content: dict[str, Any] = _tomllib.loads(text)
    except ValueError as error:
        raise refusal(f"{source}: is not valid TOML: {error}") from None
    return content
