"""XML as the hosts read it: fixed prefixes (some look for the prefix, not for the namespace), a comment on top."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from xml.etree.ElementTree import Element, indent, tostring

from ..cosim.component import Value

__all__ = ["xml_bytes", "xml_value"]


def xml_bytes(root: Element, comment: Sequence[str], namespaces: Mapping[str, str]) -> bytes:
    """The document, indented. `comment` are its lines; `namespaces` by their prefixes, "" for the default one."""
    for prefix, uri in namespaces.items():
        root.set(f"xmlns:{prefix}" if prefix else "xmlns", uri)
    indent(root)
    said = "".join(f"  {re.sub('--+', '-', line)}\n" for line in comment)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<!--\n{said}-->\n{tostring(root, encoding="unicode")}\n'.encode()


def xml_value(value: Value) -> str:
    """A value in the spelling of XML Schema; floats read back as the same double."""
    if isinstance(value, bool):
        return str(value).lower()
    return repr(value) if isinstance(value, float) else str(value)
