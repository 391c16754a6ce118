"""Two units of no physics, to take the C shell through every decision of its code: tables as real units have them, kernels in C.

``Whole`` has everything that a unit may have, ``Bare`` nothing that it may lack.  Its parameter ``mode`` says what the next
initialisation or step does.
"""

from fmu_src.table import Table
from fmu_src.unit import Unit
from fmu_src.variables import Variable, local, output, scratch, state

MODES = ("still", "fault", "long_fault", "unknown_fault", "not_finite", "parts", "caution", "no_way_up")


def table(name: str) -> Table:
    return Table(name, "a unit without physics", [
        Variable("push", "input", "N", "", minimum=-10.0, maximum=10.0, nominal=1.0),
        Variable("tight", "input", "N", "", 1e-4, minimum=0.0, maximum=3e-4, nominal=1.0),
        Variable("stuck", "input", "1", "", 0.0, minimum=0.0, maximum=0.0, nominal=1.0),
        Variable("far.field", "input", "N", "", 0.0, (2, 3), ("row", "column"), minimum=-10.0, maximum=10.0, nominal=1.0),
        Variable("stiffness", "parameter", "N/m", "", 1.0, minimum=0.0, maximum=100.0),
        Variable("gain", "parameter", "1", "", 2.0, minimum=-5.0, maximum=5.0, nominal=1.0, tunable=True),
        Variable("mode", "parameter", "1", "", 0, choices=MODES, tunable=True),
        Variable("number", "parameter", "1", "", 3, integer=True, minimum=0, maximum=9, tunable=True),
        output("answer", "N", ""),
        output("answers", "N", "", shape=(2, 3), axes=("row", "column")),
        output("count", "1", "", integer=True),
        local("x" * 300, "1", "", shape=(2,), axes=("of_a_long_name",)),
        state("memory", "N", ""),
        state("early", "1", "", integer=True, minimum=0, maximum=2),
        state("done", "s", ""),
        state("profile", "m", "", shape=(4,), axes=("bin",), profile=True),
        scratch("work", (2,)),
    ])  # fmt: skip


def impossible(*_: object) -> int:
    """These units' kernels are written in C, see shell_unit.c."""
    raise AssertionError


def unit(name: str) -> Unit:
    if name == "Bare":
        return Unit(table(name), impossible, impossible, {})
    faults = {1: "push of {push:.6g} N in mode {mode} asks for a fault", 2: "a long fault: " + "word " * 600 + "{push}"}
    cautions = {"count": "the first caution", "number": "a caution that is said at once"}
    made = table(name)
    return Unit(made, impossible, impossible, faults, made.offset["memory"], cautions, ("early", "done"))


def places(made: Table) -> str:
    """Where the kernels find their numbers."""
    return "".join(f"#define AT_{name.upper()} {cell}\n" for name, cell in made.offset.items() if len(name) < 30)
