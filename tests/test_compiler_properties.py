"""Random kernels: compiled and as plain Python they give the same bits, wherever Python gives any."""

import itertools
import linecache
import math
import struct
import types
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from kernel_sources import GIVEN, ROW, WHOLE, kernel_sources
from properties import examples

from fmu_src.compiler import store
from fmu_src.compiler.types import KernelFault
from fmu_src.kernel import Kernel

# What Python does where a kernel gives inf, nan or 0, reads beyond an array or what has no value yet.
RAISED = (ArithmeticError, ValueError, IndexError, UnboundLocalError)
names = (f"made_kernel_{i}" for i in itertools.count())


@pytest.fixture(autouse=True, scope="module")
def without_store():
    """What is compiled here is of no use to anybody later."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(store, "read", lambda name: None)
        patch.setattr(store, "write", lambda *entry: None)
        yield


def functions_of(source):
    """The functions of a text by name, in a module of their own."""
    name = next(names)
    linecache.cache[name] = (len(source), None, source.splitlines(keepends=True), name)
    scope = {"__name__": name, "math": math}
    exec(compile(source, name, "exec"), scope)
    return scope


@cache
def both_ways(source, name="made"):
    """(as plain Python, compiled)"""
    compiled = functions_of(source)
    for key, value in compiled.items():
        if isinstance(value, types.FunctionType):
            compiled[key] = Kernel(value)
    return functions_of(source)[name], compiled[name]


def bits(value):
    """What a value is to the last bit; one nan is like another."""
    if isinstance(value, np.ndarray):
        return [bits(item) for item in value.tolist()]
    if isinstance(value, tuple):
        return [bits(item) for item in value]
    if isinstance(value, (float, np.floating)):
        return "nan" if math.isnan(value) else struct.pack("<d", value).hex()
    return int(value)


def outcome(function, arguments):
    """What a function gives back and leaves in its arrays; None where Python raises."""
    own = [argument.copy() if isinstance(argument, np.ndarray) else argument for argument in arguments]
    try:
        # Elements of arrays are NumPy's numbers, whose division by zero is that of kernels.
        with np.errstate(all="ignore"):
            given_back = function(*own)
    except RAISED:
        return None
    return bits(given_back), [bits(argument) for argument in own if isinstance(argument, np.ndarray)]


def assert_same(source, argument_sets, name="made"):
    bare, compiled = both_ways(source, name)
    for arguments in argument_sets:
        expected = outcome(bare, arguments)
        if expected is not None:
            assert outcome(compiled, arguments) == expected, f"{arguments}\n{source}"


numbers = st.one_of(
    st.sampled_from([0.0, -0.0, 1.0, -1.0, 0.1, 0.5, 3.0, -7.5, 1e-300, 1e300, math.inf, -math.inf, math.nan]),
    st.floats(-100.0, 100.0), st.floats(),
)  # fmt: skip
wholes = st.integers(-GIVEN, GIVEN)
argument_sets = st.lists(
    st.tuples(
        numbers, numbers, wholes, wholes, st.lists(numbers, min_size=ROW, max_size=ROW).map(np.array),
        st.lists(wholes, min_size=WHOLE, max_size=WHOLE).map(np.array),
    ),
    min_size=4, max_size=4,
)  # fmt: skip


@examples(8)
@given(kernel_sources(), argument_sets)
def test_a_kernel_gives_the_bits_of_plain_python(source, sets):
    assert_same(source, sets)


OPERATIONS = (
    "x + y", "x - y", "x * y", "x / y", "x // y", "x % y", "-x", "abs(x)", "min(x, y)", "max(x, y)", "x < y", "x <= y", "x == y",
    "x != y", "not x", "bool(x)", "x if y else -x", "x > 0.0 and y > 0.0", "x < y < 1.0 or x == 0.0",
)  # fmt: skip


@pytest.mark.parametrize("operation", OPERATIONS)
@examples(4)
@given(numbers, numbers)
def test_operations_on_numbers(operation, x, y):
    assert_same(f"def made(x, y):\n    return {operation}\n", [(x, y)])


@pytest.mark.parametrize("operation", [*OPERATIONS, "x ** 3", "x // 1", "x % -3", "float(x) // y", "y % float(x)"])
@examples(4)
@given(st.integers(-(2**20), 2**20) | wholes, st.integers(-(2**20), 2**20) | wholes)
def test_operations_on_whole_numbers(operation, x, y):
    assert_same(f"def made(x, y):\n    return {operation}\n", [(x, y)])


FUNCTIONS = (
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "expm1", "log", "log1p", "log2", "log10", "sqrt", "fabs",
    "radians", "degrees", "isnan", "isfinite",
)  # fmt: skip


@pytest.mark.parametrize("function", ["floor", "ceil", "trunc"])
@given(st.floats(-(2.0**53), 2.0**53) | st.floats(-10.0, 10.0))
def test_roundings(function, x):
    assert_same(f"def made(x):\n    return math.{function}(x), int(x)\n", [(x,)])


@pytest.mark.parametrize("function", FUNCTIONS)
@given(st.floats(-1e9, 1e9) | numbers)
def test_functions_of_one_number(function, x):
    assert_same(f"def made(x):\n    return math.{function}(x)\n", [(x,)])


@pytest.mark.parametrize("function", ["atan2", "fmod", "pow"])
@given(numbers, numbers)
def test_functions_of_two_numbers(function, x, y):
    assert_same(f"def made(x, y):\n    return math.{function}(x, y)\n", [(x, y)])


@pytest.mark.parametrize("power", [-7, -2, -1, 0, 1, 2, 3, 5, 8, 13])
@given(st.floats(-1e20, 1e20))
def test_powers(power, x):
    """Whole constant powers are products: one rounding a factor where the C library has one in all."""
    bare, compiled = both_ways(f"def made(x):\n    return x ** {power}\n")
    try:
        expected = bare(x)
    except ArithmeticError:
        return
    assert compiled(x) == pytest.approx(expected, rel=abs(power) * 2.3e-16, abs=5e-324)


# Counters that may be negative when they index: (what gives them their values, n).
COUNTED = {
    "an empty loop after one below zero": ("for k in range(-2, 0):\n        pass\n    for k in range(n):\n        pass", 0),
    "a loop below zero on the way round": (
        "total = 0.0\n    for k in range(2):\n        pass\n    while n > 0:\n        n -= 1\n        total += row[k]\n"
        "        for k in range(-2, 0):\n            pass\n    row[0] = total", 2,
    ),
    "an argument of the name": ("for n in range(0):\n        pass\n    row[0] = row[n]\n    k = 0", -1),
    "one of two loops": ("if n < 0:\n        for k in range(n, 0):\n            pass\n    else:\n        for k in range(3):\n            pass", -2),
    "downwards": ("for k in range(2, n, -1):\n        pass", -3),
    "over a tuple": ("for k in (1, n):\n        pass", -2),
}  # fmt: skip


@pytest.mark.parametrize("case", COUNTED)
def test_a_counter_below_zero_counts_from_the_end(case):
    body, n = COUNTED[case]
    assert_same(f"def made(row, n):\n    {body}\n    return row[k]\n", [(np.array([1.0, 2.0, 4.0]), n)])


def test_and_or_of_numbers_is_refused_where_python_gives_the_number():
    for text in ("x or 2.0", "x and y", "(x or y) + 1.0", "x > 0.0 and y"):
        compiled = both_ways(f"def made(x, y):\n    return {text}\n")[1]
        with pytest.raises(KernelFault, match="write x != 0.0"):
            compiled(1.0, 2.0)
    assert_same("def made(x, y):\n    return 1.0 if x or not y and x else 2.0\n", itertools.product([0.0, 1.0], repeat=2))
