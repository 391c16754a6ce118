"""A unit's kernels as C99: the same operations in the same order as the object code is made of.

It is made from the compiler's own LLVM text before optimisation, so there is one meaning
of every kernel; the C compiler optimises as LLVM does.  What comes out needs ``math.h``
alone, allocates nothing and calls nothing but its own functions and libm.
"""

import re
from pathlib import PurePosixPath

from fmu_src.compiler.assembly import Definition, definitions
from fmu_src.compiler.c_expressions import C_TYPES
from fmu_src.compiler.c_function import FunctionInC, letters, members
from fmu_src.compiler.module import Module, host_triple

HEAD = """/* The kernels of a unit: made by a translator from the sources that stand beside each function, do not edit.
 *
 * A record is an array of cells, each a double or an integer of 64 bits; at_NAME is the place of a field.  Numbers are
 * rounded operation by operation: compile without -ffast-math and without contraction (-std=c99 does, or -ffp-contract=off).
 */
#include "unit.h"

#include <math.h>

#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

#if defined(__GNUC__)
#define MAY_STAND_IDLE __attribute__((unused))
#else
#define MAY_STAND_IDLE
#endif

/* Whole numbers wrap round; towards zero, and the lowest number for what is too large. */
MAY_STAND_IDLE static int64_t wrapped_add(int64_t a, int64_t b)
{
    return (int64_t)((uint64_t)a + (uint64_t)b);
}

MAY_STAND_IDLE static int64_t wrapped_sub(int64_t a, int64_t b)
{
    return (int64_t)((uint64_t)a - (uint64_t)b);
}

MAY_STAND_IDLE static int64_t wrapped_mul(int64_t a, int64_t b)
{
    return (int64_t)((uint64_t)a * (uint64_t)b);
}

MAY_STAND_IDLE static int64_t whole(double x)
{
    return x >= -0x1p63 && x < 0x1p63 ? (int64_t)x : INT64_MIN;
}
"""


def c_source(module: Module) -> str:
    """The C file of a module whose entries are written."""
    functions = definitions(module.text(host_triple()))
    c_names = names_in_c(functions)
    # What is given numbers alone changes nothing.
    pure = {f.name for f in functions if f.is_internal and all(kind != "ptr" for kind, _ in f.parameters)}
    fields: dict[str, int] = {}
    told = origins(module)
    texts = [told.get(f.name, "") + FunctionInC(f, c_names, pure, fields).text() for f in functions]
    groups = sorted({f.kind for f in functions if f.kind.startswith("{")}, key=letters)
    structures = [structure(group) for group in groups]
    places = "enum {\n" + "".join(f"    {name} = {cell},\n" for name, cell in sorted(fields.items(), key=lambda item: (item[1], item[0]))) + "};\n"
    return "\n".join([HEAD, places, *structures, "\n\n".join(texts)]) + "\n"


def names_in_c(functions: list[Definition]) -> dict[str, str]:
    """Of every function; entries keep theirs."""
    return {f.name: re.sub(r"\W", "_", f.name) if f.is_internal else f.name for f in functions}


def structure(group: str) -> str:
    """Of several results; flags are integers."""
    held = " ".join(f"{C_TYPES[kind]} m{i};" for i, kind in enumerate(members(group)))
    return f"struct {letters(group)} {{ {held} }};\n"


def origins(module: Module) -> dict[str, str]:
    """A comment for every function: the file that it was written in, its name and what it says of itself."""
    told = {}
    for (kernel, _), instance in module.instances.items():
        place = PurePosixPath(*kernel.module.split(".")).with_suffix(".py")
        words = (kernel.function.__doc__ or "").strip().partition("\n\n")[0]
        said = " ".join(words.split()).replace("*/", "* /").encode("ascii", "replace").decode()
        told[instance.symbol.strip('@"')] = f"/* {place}: {kernel.name}{'. ' + said if said else ''} */\n"
    return told
