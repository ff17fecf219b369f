"""Elementary functions of native/ against mpmath, and over a million arguments against extended precision."""

from __future__ import annotations

import ctypes
from collections.abc import Callable

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

Reals = NDArray[np.float64]
Call = Callable[..., Reals]

MOST_ULP = 2.0
"""Units in the last place that a result may be off."""
HUGE = 1.7976931348623157e308
TINY = 5e-324
NAN, INF = float("nan"), float("inf")

ONE = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin, "atan": np.arctan, "exp": np.exp, "log": np.log,
}  # fmt: skip
TWO = {"atan2": np.arctan2, "hypot": np.hypot}


@pytest.fixture(scope="module")
def call(native_library: ctypes.CDLL) -> Call:
    """call(name, x) or call(name, x, y): results of an elementary function for arrays."""
    pointer = ctypes.POINTER(ctypes.c_double)
    function = native_library.shipcollision_elementary
    function.argtypes = [ctypes.c_char_p, pointer, pointer, pointer, ctypes.c_size_t]
    function.restype = ctypes.c_bool

    def evaluate(name: str, *arguments: object) -> Reals:
        arrays = [np.ascontiguousarray(argument, float).reshape(-1) for argument in arguments]
        result = np.empty(arrays[0].size)
        x, y, out = (array.ctypes.data_as(pointer) for array in (arrays[0], arrays[-1], result))
        assert function(name.encode(), x, y, out, result.size)
        return result

    return evaluate


def hard_arguments(name: str) -> list[float]:
    """Where an argument is reduced in another way, near zeros and poles, and at the ends of the range."""
    if name == "exp":
        found = [1e-300, 1e-17, 0.3465, 0.34658, 1.0, 20.0, 709.7, 709.78271289338397, -0.3466, -700.0, -708.4, -745.1]
        return [*found, *np.linspace(-740.0, 709.0, 150)]
    if name == "log":
        near = [1.0 + sign * 2.0**-k for k in range(1, 54) for sign in (1, -1)]
        return [
            one
            for one in (*near, TINY, 1e-310, 2.3e-308, 0.7071, 1.4142135623730951, 1.41421356238, 2.0, HUGE)
            if one > 0
        ]
    if name == "asin":
        return [0.0, 1e-300, 1e-9, 0.49999999, 0.5, 0.50000001, 0.9999999999999999, 1.0, -0.75, *np.linspace(-1, 1, 99)]
    if name == "atan":
        steps = [(k + 0.5) / 8 for k in range(9)]
        return [0.0, TINY, 1e-300, *steps, 1.0, 1.0000000000000002, 16.1, 1e17, HUGE, -3.0, *np.linspace(-4, 4, 99)]
    # Multiples of pi/2, as near as doubles come, some of them famous; both ways of reduction, and their border.
    multiples = [float(k * mpmath.pi / 2) for k in (1, 2, 3, 11, 344, 1000, 667543, 667544, 667545, 10**9, 10**15)]
    famous = [6381956970095103.0 * 2.0**797, 5.319372648326541e255, 1.0e22, HUGE, 2.0**1023, 1048575.9, 1048576.0]
    return [0.0, TINY, 1e-300, 7.4e-9, 0.7853981633974483, 0.7853981633974484, *multiples, *famous, -2.0, -1e10, -HUGE]


def ulps(found: Reals, exact: NDArray[np.longdouble]) -> NDArray[np.longdouble]:
    """Distance in units in the last place of a double at `exact`."""
    exponent = np.frexp(exact)[1]
    return np.abs((found.astype(np.longdouble) - exact) / np.ldexp(np.longdouble(1), np.maximum(exponent - 53, -1074)))


def exact_values(name: str, *arguments: list[float]) -> list[mpmath.mpf]:
    """By mpmath, with more bits than the largest argument has before the point."""
    with mpmath.workprec(1300):
        return [+getattr(mpmath, name)(*map(mpmath.mpf, one)) for one in zip(*arguments, strict=True)]


def off_by(found: float, exact: mpmath.mpf) -> float:
    """ulps() of one number that mpmath gives."""
    if exact == 0:
        return 0.0 if found == 0.0 else INF
    unit = max(mpmath.floor(mpmath.log(abs(exact), 2)) - 52, -1074)
    return float(abs(mpmath.mpf(found) - exact) / mpmath.mpf(2) ** unit)


@pytest.mark.parametrize("name", ONE)
def test_hard_arguments(call: Call, name: str) -> None:
    arguments = hard_arguments(name)
    found = call(name, arguments)
    errors = [off_by(*pair) for pair in zip(found, exact_values(name, arguments), strict=True)]
    assert max(errors) <= MOST_ULP, f"{name}({arguments[int(np.argmax(errors))]!r}) is off by {max(errors):.2f} ulp"


@pytest.mark.parametrize("name", TWO)
def test_hard_pairs(call: Call, name: str) -> None:
    single = [-HUGE, -3.0, -1e-200, TINY, 1e-310, 1e-160, 0.11, 1.0, 1.0000000000000002, 7.0, 1e160, 1e300, HUGE / 2]
    x, y = (list(one) for one in zip(*[(a, b) for a in single for b in single], strict=True))
    with np.errstate(over="ignore"):
        found = call(name, x, y)
    for a, b, value, exact in zip(x, y, found, exact_values(name, x, y), strict=True):
        if exact >= mpmath.mpf(2) ** 1024:
            assert value == INF
        else:
            assert off_by(value, exact) <= MOST_ULP, f"{name}({a!r}, {b!r})"


SPECIAL = [
    *[(name, (x,), NAN) for name in ("sin", "cos", "tan") for x in (INF, -INF, NAN)],
    *[(name, (0.0,), 0.0) for name in ("sin", "tan", "asin", "atan", "round", "floor", "ceil")],
    *[(name, (-0.0,), -0.0) for name in ("sin", "tan", "asin", "atan", "round", "floor", "ceil")],
    ("cos", (0.0,), 1.0), ("cos", (1e-300,), 1.0), ("sin", (TINY,), TINY),
    ("asin", (1.0000000000000002,), NAN), ("asin", (NAN,), NAN), ("asin", (-1.0,), -np.pi / 2),
    ("atan", (INF,), np.pi / 2), ("atan", (-INF,), -np.pi / 2), ("atan", (NAN,), NAN),
    ("exp", (INF,), INF), ("exp", (-INF,), 0.0), ("exp", (NAN,), NAN), ("exp", (0.0,), 1.0), ("exp", (-0.0,), 1.0),
    ("exp", (709.79,), INF), ("exp", (-745.2,), 0.0), ("exp", (-745.13,), TINY),
    ("log", (0.0,), -INF), ("log", (-0.0,), -INF), ("log", (-1.0,), NAN), ("log", (INF,), INF), ("log", (NAN,), NAN),
    ("log", (1.0,), 0.0),
    *[("atan2", (y, x), np.arctan2(y, x)) for y in (0.0, -0.0, INF, -INF, 1.0, -1.0) for x in (0.0, -0.0, INF, -INF)],
    *[("atan2", (y, x), np.arctan2(y, x)) for y in (0.0, -0.0) for x in (2.0, -2.0)],
    ("atan2", (NAN, 1.0), NAN), ("atan2", (1.0, NAN), NAN),
    ("hypot", (INF, NAN), INF), ("hypot", (NAN, -INF), INF), ("hypot", (NAN, 1.0), NAN), ("hypot", (0.0, -0.0), 0.0),
    ("hypot", (3.0, -4.0), 5.0), ("hypot", (TINY, 0.0), TINY),
    ("round", (0.5,), 0.0), ("round", (1.5,), 2.0), ("round", (2.5,), 2.0), ("round", (-0.5,), -0.0),
    ("round", (-1.5,), -2.0), ("round", (0.49999999999999994,), 0.0),
    ("round", (4503599627370495.5,), 4503599627370496.0), ("round", (1e300,), 1e300),
    ("round", (INF,), INF), ("round", (NAN,), NAN),
    ("floor", (-0.5,), -1.0), ("floor", (2.7,), 2.0), ("floor", (-3.0,), -3.0), ("floor", (-1e300,), -1e300),
    ("floor", (INF,), INF), ("floor", (NAN,), NAN), ("ceil", (-0.5,), -0.0), ("ceil", (2.1,), 3.0),
    ("ceil", (4503599627370495.5,), 4503599627370496.0), ("ceil", (NAN,), NAN),
]  # fmt: skip
"""Name, arguments, and the result to the bit, with the sign of a zero."""


@pytest.mark.parametrize(("name", "arguments", "expected"), SPECIAL)
def test_special_values(call: Call, name: str, arguments: tuple[float, ...], expected: float) -> None:
    found = float(call(name, *arguments)[0])
    assert repr(found) == repr(float(expected))


def test_an_unknown_function_is_refused(native_library: ctypes.CDLL) -> None:
    assert not native_library.shipcollision_elementary(b"gamma", None, None, None, 0)


def draw(name: str, count: int) -> list[list[Reals]]:
    """Sets of arguments that fill the range in different ways."""
    rng = np.random.default_rng(15)

    def spread(least: float, most: float) -> Reals:
        """Of all orders of magnitude, and of both signs."""
        return np.exp(rng.uniform(np.log(least), np.log(most), count)) * rng.choice([-1.0, 1.0], count)

    if name in TWO:
        alike = [spread(0.1, 10.0), spread(0.1, 10.0)]
        return [alike, [spread(1e-290, 1e290), spread(1e-290, 1e290)], [spread(1e290, 1e307), spread(1e290, 1e307)]]
    if name == "asin":
        return [[rng.uniform(-1.0, 1.0, count)], [spread(1e-300, 1.0)], [1.0 - np.abs(spread(1e-16, 1.0))]]
    if name == "atan":
        return [[rng.uniform(-4.0, 4.0, count)], [spread(1e-300, 1e300)]]
    if name == "exp":
        return [[rng.uniform(-1.0, 1.0, count)], [rng.uniform(-745.0, 709.7, count)], [spread(1e-300, 700.0)]]
    if name == "log":
        return [[np.abs(spread(1e-320, 1e308))], [1.0 + spread(1e-15, 0.4)], [rng.uniform(0.0, 4.0, count)]]
    return [[rng.uniform(-10.0, 10.0, count)], [spread(1e-300, 1e6)], [spread(1e5, 1e18)]]


EXTENDED = np.finfo(np.longdouble).nmant >= 63
"""Whether this machine's long double has 11 bits more than a double: Windows and macOS on ARM have none."""


def worst(call: Call, name: str, count: int) -> float:
    """Largest error over `count` arguments of each set [ulp]."""
    errors = []
    for arguments in draw(name, count):
        exact = {**ONE, **TWO}[name](*(argument.astype(np.longdouble) for argument in arguments))
        errors.append(float(np.max(ulps(call(name, *arguments), exact))))
    return max(errors)


@pytest.mark.skipif(not EXTENDED, reason="long double is double here")
@pytest.mark.parametrize("name", [*ONE, *TWO])
def test_accuracy(call: Call, name: str) -> None:
    assert worst(call, name, 20_000) <= MOST_ULP


@pytest.mark.slow
@pytest.mark.skipif(not EXTENDED, reason="long double is double here")
@pytest.mark.parametrize("name", [*ONE, *TWO])
def test_accuracy_over_a_million_arguments(call: Call, name: str) -> None:
    assert worst(call, name, 1_000_000) <= MOST_ULP
