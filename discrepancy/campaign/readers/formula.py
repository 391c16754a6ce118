"""Conversion formulas that stand in measurement files: computed as arithmetic, never run as code.

Known are numbers, the raw value X (or X1), + - * / ^ ** (), and the functions of ASAM's formulas on one argument or two.
"""

import ast
from collections.abc import Callable

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.reading import quoted

FUNCTIONS: dict[str, tuple[int, Callable[..., Floats]]] = {
    "sin": (1, np.sin), "cos": (1, np.cos), "tan": (1, np.tan), "asin": (1, np.arcsin), "acos": (1, np.arccos), "atan": (1, np.arctan),
    "arcsin": (1, np.arcsin), "arccos": (1, np.arccos), "arctan": (1, np.arctan), "sinh": (1, np.sinh), "cosh": (1, np.cosh),
    "tanh": (1, np.tanh), "exp": (1, np.exp), "log": (1, np.log), "ln": (1, np.log), "log10": (1, np.log10), "sqrt": (1, np.sqrt),
    "abs": (1, np.abs), "floor": (1, np.floor), "ceil": (1, np.ceil), "pow": (2, np.power),
}  # fmt: skip
OPERATORS: dict[type[ast.operator], Callable[..., Floats]] = {
    ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.divide, ast.Pow: np.power, ast.BitXor: np.power,
}  # fmt: skip
RAW = ("X", "X1", "x", "x1")
# Signs of a formula, and parts in it (assumed: a polynomial of tenth order has a tenth).
LONGEST, MOST_PARTS = 1000, 300


class FormulaFault(ValueError):
    """A formula that cannot be computed; says which, and why."""


def computed(formula: str, raw: np.ndarray) -> Floats:
    """The formula's value for each raw value; FormulaFault if it is none, or not a number where the raw value is one."""
    if len(formula) > LONGEST:
        raise FormulaFault(f"the formula {quoted(formula)} is longer than {LONGEST} signs")
    try:
        # ^ binds weaker than + in Python, stronger in the formulas.
        tree = ast.parse(formula.replace("^", "**").strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise FormulaFault(f"{quoted(formula)} is no formula that is known") from None
    if sum(1 for _ in ast.walk(tree)) > MOST_PARTS:
        raise FormulaFault(f"the formula {quoted(formula)} has more than {MOST_PARTS} parts")
    values = np.asarray(raw, float)
    with np.errstate(all="ignore"):
        found = np.broadcast_to(value_of(tree.body, values, formula), values.shape).astype(float)
    if not np.isfinite(found[np.isfinite(values)]).all():
        raise FormulaFault(f"the formula {quoted(formula)} gives no finite number for some raw values")
    return found


def value_of(part: ast.expr, values: Floats, formula: str) -> Floats:
    match part:
        case ast.Constant(value=bool()):
            pass
        case ast.Constant(value=int() | float() as number) if abs(number) < 1e300:
            # As floats: whole numbers would grow without end.
            return np.array(float(number))
        case ast.Name(id=name) if name in RAW:
            return values
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return np.negative(value_of(operand, values, formula))
        case ast.UnaryOp(op=ast.UAdd(), operand=operand):
            return value_of(operand, values, formula)
        case ast.BinOp(left=left, op=operator, right=right) if type(operator) in OPERATORS:
            return OPERATORS[type(operator)](value_of(left, values, formula), value_of(right, values, formula))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if FUNCTIONS.get(name.lower(), (-1,))[0] == len(arguments):
            return FUNCTIONS[name.lower()][1](*(value_of(argument, values, formula) for argument in arguments))
    raise FormulaFault(f"the formula {quoted(formula)}: {quoted(ast.unparse(part))} is none of its known parts")
