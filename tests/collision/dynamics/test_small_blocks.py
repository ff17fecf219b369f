"""Products and systems in small blocks: those of whole arrays, with every block below the limits of BLAS threads."""

from __future__ import annotations

import numpy as np
import pytest

from shipcollision_fmu.collision.dynamics.small_blocks import (
    MOST_ROWS,
    ROWS,
    multiply,
    multiply_matrices,
    rotate_rows,
    solve_system,
)

SIZES = (3, 30, 96, 99, 150, 240)


@pytest.mark.parametrize("n", SIZES)
def test_the_product_and_the_system_of_a_whole_array(n: int) -> None:
    rng = np.random.default_rng(n)
    half = rng.normal(size=(n, n))
    A, x = half @ half.T / n + np.eye(n), rng.normal(size=n)
    np.testing.assert_allclose(multiply(A, x), A @ x, atol=1e-12 * n)
    np.testing.assert_allclose(solve_system(A, A @ x), x, atol=1e-9)


@pytest.mark.parametrize("shape", [(3, 6, 9), (150, 6, 150), (132, 72, 132), (60, 240, 61), (7, 5000, 130)])
def test_the_product_of_whole_matrices(shape: tuple[int, int, int]) -> None:
    n, q, m = shape
    rng = np.random.default_rng(n)
    A, B = rng.normal(size=(n, q)), rng.normal(size=(q, m))
    np.testing.assert_allclose(multiply_matrices(A, B), A @ B, atol=1e-13 * q)


def test_a_block_diagonal_turns_the_rows() -> None:
    rng = np.random.default_rng(1)
    T, W = np.zeros((9, 9)), rng.normal(size=(9, 9))
    for i in (0, 3, 6):
        T[i : i + 3, i : i + 3] = rng.normal(size=(3, 3))
    np.testing.assert_allclose(rotate_rows(T, W), T @ W, atol=1e-14)


def test_no_block_is_large_enough_for_threads() -> None:
    """Limits of OpenBLAS: 9216 numbers in W x, 1e4 in a system, 262 144 multiplications of matrices."""
    assert MOST_ROWS * MOST_ROWS <= 9216
    assert ROWS**3 <= 262_144
