"""The added mass of a ship: the file's own, that of its MMG set, or fractions of the mass and inertia.

    m_x, m_y, m_z = 0.05, 0.85, 1.0 of the mass       j_x, j_y, j_z = 0.2, 1.0, 0.21 of I_xx, I_yy, I_zz

The fractions in surge, sway and yaw are those of Pedersen & Zhang for impacts; the others are rules of thumb. They
belong to motions of about a second. Manoeuvring values differ: j_z is three times as large. A ship has one added mass,
so an MMG set with its own m_x, m_y, J_z replaces the fractions. The sway added mass then acts at z_y = T/2; the
fractions for impacts are used in the literature with z_y = 0.
"""

from __future__ import annotations

import numpy as np

from ...errors import ShipError
from ..frames import Array
from ..inertia import added_mass_matrix
from .ship_file import ShipFile

__all__ = ["FRACTIONS", "estimate_added_mass"]

FRACTIONS = {"m_x": 0.05, "m_y": 0.85, "m_z": 1.0, "j_x": 0.2, "j_y": 1.0, "j_z": 0.21}
"""Added mass over mass, added inertia over rigid-body inertia about CG, where the file gives none. They scale every
impulse of a collision."""


def estimate_added_mass(content: ShipFile, inertia_g: Array, estimated: list[str], file: str) -> Array:
    """M_A about CO from the full matrix, the fractions, or the MMG set; adds to `estimated`."""
    p, table, mmg = content.particulars, content.added_mass, content.manoeuvring
    if table.M_A is not None:
        return _check_M_A(np.array(table.M_A, dtype=float), file)
    brought: dict[str, float] = {}
    if mmg is not None and mmg.m_x is not None and mmg.m_y is not None and mmg.J_z is not None:
        mass_unit = 0.5 * p.rho * p.L_pp**2 * p.T
        brought = {"m_x": mmg.m_x * mass_unit, "m_y": mmg.m_y * mass_unit, "j_z": mmg.J_z * mass_unit * p.L_pp**2}
    whole = dict(zip(FRACTIONS, [p.mass] * 3 + inertia_g.tolist(), strict=True))
    values = {}
    for key, default in FRACTIONS.items():
        if key in brought:
            values[key] = brought[key]
            continue
        fraction = getattr(table, key)
        if fraction is None:
            fraction = default
            estimated.append(f"{key} = {default} {'mass' if key[0] == 'm' else 'I_' + 2 * key[-1]}")
        values[key] = fraction * whole[key]
    z_y = table.z_y
    if z_y is None:
        z_y = 0.5 * p.T if brought else 0.0
        estimated.append("z_y = T/2" if brought else "z_y = 0")
    return added_mass_matrix(**values, z_y=z_y)


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
