"""Products and linear systems of many contacts, in blocks that BLAS computes on one thread.

OpenBLAS hands larger ones to all cores. In a host with other work this costs more than it saves: some threads wait for
a core, 3 ms a system, and the last bits depend on the number of threads. Its limits are n x m = 9216 for W x, n^2 = 1e4
for a system of n rows, and 262 144 for the number of multiplications in a product of matrices.
"""

from __future__ import annotations

import numpy as np

from ...ship.frames import Array

__all__ = ["MOST_ROWS", "ROWS", "multiply", "multiply_matrices", "rotate_rows", "solve_system"]

ROWS = 60
"""Rows and columns of a block in a product of matrices: 60^3 multiplications. Larger: threads begin. Smaller: more
calls."""

MOST_ROWS = 96
"""Rows of a system that is solved at once."""


def multiply(W: Array, x: Array) -> Array:
    """W x (n,) of W (n, m) and x (m,)."""
    if W.size <= MOST_ROWS * MOST_ROWS:
        product: Array = W @ x
        return product
    rows = max(1, MOST_ROWS * MOST_ROWS // W.shape[1])
    return np.concatenate([W[i : i + rows] @ x for i in range(0, len(W), rows)])


def multiply_matrices(A: Array, B: Array) -> Array:
    """A B (n, m) of A (n, q) and B (q, m)."""
    (n, q), m = A.shape, B.shape[1]
    if n * q * m <= ROWS**3:
        whole: Array = A @ B
        return whole
    product = np.empty((n, m))
    rows = max(1, min(ROWS, ROWS**3 // (ROWS * q)))
    for i in range(0, n, rows):
        for j in range(0, m, ROWS):
            product[i : i + rows, j : j + ROWS] = A[i : i + rows] @ B[:, j : j + ROWS]
    return product


def rotate_rows(T: Array, W: Array) -> Array:
    """T W (n, m) of T (n, n), which has blocks of 3 x 3 on its diagonal only, and W (n, m)."""
    k = len(T) // 3
    each = np.arange(k)
    blocks: Array = T.reshape(k, 3, k, 3)[each, :, each, :]
    turned: Array = (blocks @ W.reshape(k, 3, -1)).reshape(W.shape)
    return turned


def solve_system(A: Array, b: Array) -> Array:
    """x (n,) of A x = b, by elimination; of more rows than MOST_ROWS without a pivot across blocks.

    Raises LinAlgError for a singular matrix.
    """
    n = len(b)
    if n <= MOST_ROWS:
        return np.asarray(np.linalg.solve(A, b), np.float64)
    m = ROWS
    X: Array = np.asarray(np.linalg.solve(A[:m, :m], np.column_stack([A[:m, m:], b[:m]])), np.float64)
    below = A[m:, :m]
    product = multiply_matrices(below, X)
    last = solve_system(A[m:, m:] - product[:, :-1], b[m:] - product[:, -1])
    return np.concatenate([X[:, -1] - multiply(X[:, :-1], last), last])
