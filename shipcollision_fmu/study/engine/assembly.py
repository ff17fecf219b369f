"""Assembly: the answers of workers put together to parts, in any order of arrival."""

from __future__ import annotations

from .part_file import PartBytes, Tables, encode_part, join_tables, unpack
from .part_files import PartFiles
from .parts import Part
from .work import Answer

__all__ = ["Assembly"]


class Assembly:
    """Answers of parts that are not complete. As many parts can be open as batches are out, so memory is bounded."""

    def __init__(self, fingerprint: str) -> None:
        self._fingerprint = fingerprint
        self._open: dict[Part, list[Answer]] = {}

    def add(self, answer: Answer) -> PartBytes | PartFiles | None:
        """The files of the part that the answer completes, None while other answers are missing."""
        if answer.part is not None:
            return answer.part
        part = answer.batch.part
        answers = self._open.setdefault(part, [])
        answers.append(answer)
        if sum(one.batch.count for one in answers) < part.count:
            return None
        del self._open[part]
        answers.sort(key=lambda one: one.batch.first)
        tables = join_tables(Tables(unpack(one.encounters), unpack(one.collisions)) for one in answers)
        return encode_part(tables, part, self._fingerprint)
