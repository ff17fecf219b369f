"""describe_refusals(): why most rows of a study are refused, in a line."""

from __future__ import annotations

from pathlib import Path

__all__ = ["describe_refusals"]


def describe_refusals(folder: Path, refused: int, rows: int) -> str | None:
    """A line with the commonest reason in the tables of a folder; None where half of the rows or fewer are refused."""
    if 2 * refused <= rows:
        return None
    from ..study.engine.reasons import count_reasons
    from ..study.report.reasons import find_commonest

    reason = find_commonest(count_reasons(folder))
    if rows == 1:
        return f"the only row is refused: {reason.text}"
    who = f"all {rows}" if refused == rows else f"{refused} of {rows}"
    return f"{who} rows are refused; the commonest reason, {reason.cases} times: {reason.text}"
