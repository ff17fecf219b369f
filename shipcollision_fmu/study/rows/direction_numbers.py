"""Direction numbers of Sobol's sequence for the first 32 dimensions.

From S. Joe and F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci. Comput. 30
(2008), file new-joe-kuo-6.21201, whose licence allows its use in source and binary form with this notice:
Copyright (c) 2008, Frances Y. Kuo and Stephen Joe. All rights reserved. It comes without warranty.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import numpy.typing as npt

__all__ = ["BITS", "DIMENSIONS", "direction_numbers"]

BITS = 40
"""Bits of a point, and so 2^40 points."""

PRIMITIVE = (
    (3, (1,)), (7, (1, 3)), (11, (1, 3, 1)), (13, (1, 1, 1)), (19, (1, 1, 3, 3)), (25, (1, 3, 5, 13)),
    (37, (1, 1, 5, 5, 17)), (41, (1, 1, 5, 5, 5)), (47, (1, 1, 7, 11, 19)), (55, (1, 1, 5, 1, 1)),
    (59, (1, 1, 1, 3, 11)), (61, (1, 3, 5, 5, 31)), (67, (1, 3, 3, 9, 7, 49)), (91, (1, 1, 1, 15, 21, 21)),
    (97, (1, 3, 1, 13, 27, 49)), (103, (1, 1, 1, 15, 7, 5)), (109, (1, 3, 1, 15, 13, 25)),
    (115, (1, 1, 5, 5, 19, 61)), (131, (1, 3, 7, 11, 23, 15, 103)), (137, (1, 3, 7, 13, 13, 15, 69)),
    (143, (1, 1, 3, 13, 7, 35, 63)), (145, (1, 3, 5, 9, 1, 25, 53)), (157, (1, 3, 1, 13, 9, 35, 107)),
    (167, (1, 3, 1, 5, 27, 61, 31)), (171, (1, 1, 5, 11, 19, 41, 61)), (185, (1, 3, 5, 3, 3, 13, 69)),
    (191, (1, 1, 7, 13, 1, 19, 1)), (193, (1, 3, 7, 5, 13, 19, 59)), (203, (1, 1, 3, 9, 25, 29, 41)),
    (211, (1, 3, 5, 13, 23, 1, 55)), (213, (1, 3, 7, 3, 13, 59, 17))
)  # fmt: skip
"""Of each dimension after the first: the primitive polynomial over the integers modulo 2, its coefficients as bits with
the highest first, and the first direction numbers m_1, m_2, ..., as many as its degree."""

DIMENSIONS = len(PRIMITIVE) + 1
"""As many as definition/study.py allows."""


@lru_cache(maxsize=DIMENSIONS)
def direction_numbers(dimension: int) -> npt.NDArray[np.uint64]:
    """v_k = m_k 2^(BITS - k) for k = 1 to BITS, of a dimension from 0.

    m_k = 2 a_1 m_(k-1) ^ 4 a_2 m_(k-2) ^ ... ^ 2^s m_(k-s) ^ m_(k-s), a_i the coefficients, s the degree.
    """
    if dimension == 0:
        m = [1] * BITS
    else:
        polynomial, first = PRIMITIVE[dimension - 1]
        s, m = len(first), list(first)
        for k in range(s, BITS):
            value = m[k - s] ^ (m[k - s] << s)
            for i in range(1, s):
                if polynomial >> (s - i) & 1:
                    value ^= m[k - i] << i
            m.append(value)
    return np.array([value << (BITS - k) for k, value in enumerate(m, 1)], np.uint64)
