"""The tables of a run as pandas DataFrames. pandas is optional and imported here alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy.typing as npt

from ..errors import HostError, describe_installation

if TYPE_CHECKING:
    from pandas import DataFrame

__all__ = ["RunFrames", "data_frames"]


class RunFrames(NamedTuple):
    """`states` and `signals`: a row per communication point, the index is the time [s]; `contacts`: a row per contact
    point and step. Columns are those of the CSV files, SI units."""

    states: DataFrame
    contacts: DataFrame
    signals: DataFrame


def data_frames(states: npt.NDArray[Any], contacts: npt.NDArray[Any], signals: npt.NDArray[Any]) -> RunFrames:
    """Copies of the three structured arrays as DataFrames. Raises HostError when pandas is missing."""
    try:
        from pandas import DataFrame
    except ImportError:
        raise HostError(
            f"Run.to_pandas needs pandas, which is not installed: {describe_installation('pandas')}"
        ) from None
    return RunFrames(
        DataFrame(states.copy()).set_index("time"),
        DataFrame(contacts.copy()),
        DataFrame(signals.copy()).set_index("time"),
    )
