"""XML documents with fixed prefixes and a comment on top. Some hosts search for the prefix, not for the namespace."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from xml.etree.ElementTree import Element, indent, tostring

from ..cosim.component import Value

__all__ = ["format_document", "format_value"]


def format_document(root: Element, comment: Sequence[str], namespaces: Mapping[str, str]) -> bytes:
    """The indented document. comment: lines on top; namespaces by prefix, "" for the default namespace."""
    for prefix, uri in namespaces.items():
        root.set(f"xmlns:{prefix}" if prefix else "xmlns", uri)
    indent(root)
    lines = "".join(f"  {re.sub('--+', '-', line)}\n" for line in comment)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<!--\n{lines}-->\n{tostring(root, encoding="unicode")}\n'.encode()


def format_value(value: Value) -> str:
    """A value in the spelling of XML Schema; floats read back as the same double."""
    if isinstance(value, bool):
        return str(value).lower()
    return repr(value) if isinstance(value, float) else str(value)
