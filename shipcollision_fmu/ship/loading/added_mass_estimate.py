"""The one added mass of a ship, for impacts, coasting and manoeuvring alike.

    m_x, m_y, J_z    of [added_mass], or of the MMG set, or else of the Motora charts (motora_charts.py)
    z_y = T/2        depth at which the sway added mass acts, unless the file gives it
    m_z = 1.0 m      j_x = 0.2 I_xx      j_y = 1.0 I_yy          rules of thumb, unless the file gives them

Whether a file has a table [manoeuvring] makes no difference to an estimate: the same hull moves the same water.
Pedersen and Zhang (1998) use 0.05, 0.85 and j_z = 0.21 for impacts, with z_y = 0. Their j_z is a third of what strip
theory makes of their m_y: m_y L^2/12 over m (L/4)^2 is 1.1. A file may state them in [added_mass].
"""

from __future__ import annotations

import numpy as np

from ...errors import ShipError
from ..frames import Array
from ..inertia import added_mass_matrix
from ..tables.particulars import AddedMassTable, ParticularsTable
from .motora_charts import Dimensions, estimate_added_mass
from .ship_file import ShipFile

__all__ = ["FRACTIONS", "assemble_added_mass"]

FRACTIONS = {"m_z": 1.0, "j_x": 0.2, "j_y": 1.0}
"""Added mass over mass, added inertia over rigid-body inertia about CG, where the file gives none. They scale every
impulse of a collision in 4 and 6 degrees of freedom."""


def assemble_added_mass(content: ShipFile, inertia_g: Array, estimated: list[str], file: str) -> Array:
    """M_A about CO from the full matrix, the fractions, the MMG set, or estimates; adds to `estimated`."""
    p, table = content.particulars, content.added_mass
    if table.M_A is not None:
        return _check_M_A(np.array(table.M_A, dtype=float), file)
    brought = _convert_mmg_set(content)
    whole = dict(zip(("m_x", "m_y", "m_z", "j_x", "j_y", "j_z"), [p.mass] * 3 + inertia_g.tolist(), strict=True))
    chart = _read_charts(p, whole["j_z"])
    values = {}
    for key, unit in whole.items():
        if key in brought:
            values[key] = brought[key]
            continue
        fraction = _given_fraction(table, key)
        if fraction is None:
            fraction = {**FRACTIONS, **chart}[key]
            source = " (Motora charts, Zhou)" if key in chart else ""
            estimated.append(f"{key} = {fraction:.4g} {'mass' if key[0] == 'm' else 'I_' + 2 * key[-1]}{source}")
        values[key] = fraction * unit
    z_y = table.z_y
    if z_y is None:
        z_y = 0.5 * p.T
        estimated.append("z_y = T/2")
    return added_mass_matrix(**values, z_y=z_y)


def _convert_mmg_set(content: ShipFile) -> dict[str, float]:
    """m_x, m_y [kg] and j_z [kg m2] of an MMG set that brings its own, else nothing."""
    p, mmg = content.particulars, content.manoeuvring
    if mmg is None or mmg.m_x is None or mmg.m_y is None or mmg.J_z is None:
        return {}
    unit = 0.5 * p.rho * p.L_pp**2 * p.T
    return {"m_x": mmg.m_x * unit, "m_y": mmg.m_y * unit, "j_z": mmg.J_z * unit * p.L_pp**2}


def _read_charts(p: ParticularsTable, I_zz: float) -> dict[str, float]:
    """Fractions m_x, m_y and j_z of the Motora charts; I_zz [kg m2] about CG."""
    C_b = p.mass / (p.rho * p.L_pp * p.B * p.T)
    m_x, m_y, J_z = estimate_added_mass(Dimensions(p.L_pp, p.B, p.T, C_b, 0.0, p.rho))
    return {"m_x": m_x, "m_y": m_y, "j_z": J_z * p.mass * p.L_pp**2 / I_zz}


def _given_fraction(table: AddedMassTable, key: str) -> float | None:
    value: float | None = getattr(table, key)
    return value


def _check_M_A(M_A: Array, file: str) -> Array:
    """M_A as given, made exactly symmetric. Raises ShipError when it is not an added mass."""
    largest = float(np.abs(M_A).max())
    i, j = np.unravel_index(int(np.abs(M_A - M_A.T).argmax()), M_A.shape)
    if abs(M_A[i, j] - M_A[j, i]) > 1e-9 * largest:
        raise ShipError(
            f"{file}: [added_mass] M_A is not symmetric: M_A[{i}][{j}] = {M_A[i, j]:g} and M_A[{j}][{i}] = "
            f"{M_A[j, i]:g} must be equal"
        )
    M_A = 0.5 * (M_A + M_A.T)
    scale = np.array([1.0 / np.sqrt(d if d > 0.0 else largest or 1.0) for d in np.diag(M_A)])
    least = float(np.linalg.eigvalsh(M_A * np.outer(scale, scale))[0])
    if least < -1e-9:
        raise ShipError(
            f"{file}: [added_mass] M_A is not positive semi-definite (least eigenvalue {least:.3g} when scaled to a "
            "unit diagonal, must be at least 0): the water would give energy away; added masses are positive here"
        )
    return M_A
