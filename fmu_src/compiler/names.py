"""What a name in a kernel means: a local variable, or a number, function or module from outside."""

import builtins
import types as python_types
from typing import Any

import numpy as np

from fmu_src.compiler import arithmetic
from fmu_src.compiler.function import Function
from fmu_src.compiler.types import Value, together
from fmu_src.faults import nearest


def named(e: Function, name: str) -> Value:
    if name in e.variables:
        return e.load_name(name)
    if name in e.instance.kernel.local_names:
        raise e.fault(f"{name} is used before it has a value")
    return constant(e, outer(e, name), name)


def outer(e: Function, name: str) -> Any:
    """What a name means outside of the function."""
    found = e.instance.kernel.outer(name)
    if found is None and not hasattr(builtins, name):
        known = [*e.variables, *e.instance.kernel.function.__globals__]
        raise e.fault(f"there is no {name}{nearest(name, known)}")
    return found


def in_module(e: Function, owner: python_types.ModuleType, called: str, name: str) -> Any:
    """What a module has under a name; ``called`` is the module's in the kernel."""
    if not hasattr(owner, name):
        raise e.fault(f"{called} has no {name}{nearest(name, dir(owner))}")
    return getattr(owner, name)


def constant(e: Function, value: Any, text: str) -> Value:
    if isinstance(value, (bool, int, float, np.integer, np.floating)):
        number = value.item() if isinstance(value, np.generic) else value
        e.module.note_constant(e.instance.kernel, text, number)
        return arithmetic.literal(number)
    if isinstance(value, tuple):
        return together([constant(e, item, f"{text}[{i}]") for i, item in enumerate(value)])
    raise e.fault(f"{text} is {type(value).__name__}; kernels take numbers and tuples of numbers from outside")
