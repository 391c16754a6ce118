"""The project's kernels as numba sees them: functions of the benchmarks that numba compiles call them as they are.

So numba is also a peer of the project's own compiler (``benchmarks.compilers``).
"""

from functools import cache
from typing import Any

import numba
from numba.core import types
from numba.extending import typeof_impl

from fmu_src.kernel import Kernel

# Division by zero gives inf, as in the kernels.
njit = numba.njit(error_model="numpy")


@cache
def by_numba(kernel: Kernel) -> Any:
    """The kernel compiled by numba, for whichever arguments it is called with."""
    return njit(kernel.function)


@typeof_impl.register(Kernel)
def dispatcher_type(kernel: Kernel, context: object) -> Any:
    return types.Dispatcher(by_numba(kernel))
