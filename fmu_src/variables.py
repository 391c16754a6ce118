"""Variables of a unit.

They are declared here alone, each beside the kernels that need it (``output``, ``state`` ...).  From their table
(``table``) come the NumPy record, the FMI model description, the documentation and the headers of result files.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from numbers import Real
from typing import Any

import numpy as np

from fmu_src.limits import usual_limits


class ValueFault(ValueError):
    """A value that a variable cannot take; says which, why and what would fit."""


ROLES = ("input", "parameter", "output", "local", "state", "scratch")
# What an importing tool sees: locals may be looked at, and nothing is connected to them.
SEEN = ("input", "parameter", "output", "local")
# What a caller may set.
SETTABLE = ("input", "parameter")
LARGEST = float(np.finfo(float).max)
# In place of a bound or nominal value: the usual one.
USUAL = math.nan


@dataclass(frozen=True)
class Variable:
    """A scalar or array of one unit.

    It has two names: ``path``, the structured one that people and tools see (``mesh.force``), and ``name``, the field
    of the record that kernels see (``mesh_force``).  Where the one is the other with its dots made underscores, it is declared
    once, as ``name``; where kernels say it otherwise, ``path`` is declared beside it.

    ``shape`` is () for a scalar; ``start`` is in ``unit`` (an FMI unit string, "1" if
    there is none).  ``axes`` names what each index counts.  ``choices`` makes the
    variable an enumeration: its value is an index into it.  ``source`` says where the
    number comes from (``author, table``, ``reducer file``, ``assumed: reason``).
    Bounds and nominal value have usual ones where none are given (``limits``).  ValueError if one of the numbers is none.
    ``profile`` makes a state visible as a local array where there are arrays (FMI 3); ``last_axes`` are the axes
    (name, length) that its last one is made of.  ``display`` is the unit people read it in, where that is not the usual one
    (``display``).  ``needs`` is a count of the topology and how many there must be for the variable to mean anything.
    """

    name: str
    role: str
    unit: str
    description: str
    start: float | int = 0.0
    shape: tuple[int, ...] = ()
    axes: tuple[str, ...] = ()
    minimum: float = USUAL
    maximum: float = USUAL
    nominal: float = USUAL
    choices: tuple[str, ...] = ()
    integer: bool = False
    tunable: bool = False
    profile: bool = False
    source: str = ""
    path: str = ""
    display: str = ""
    last_axes: tuple[tuple[str, int], ...] = ()
    needs: tuple[str, int] = ("", 0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "path", self.path or self.name)
        object.__setattr__(self, "name", self.name.replace(".", "_"))
        if self.role not in ROLES:
            raise ValueError(f"variable {self.name}: role {self.role!r} is none of {ROLES}")
        if len(self.axes) != len(self.shape):
            raise ValueError(f"variable {self.name}: {len(self.shape)} dimensions but axes {self.axes}")
        for name in ("start", "minimum", "maximum", "nominal"):
            # The abstract class last: it takes far longer to ask.
            if not isinstance(getattr(self, name), (float, int, Real)):
                hint = "" if name == "start" else "; leave it out for the usual one"
                raise ValueError(f"variable {self.name}: {name} = {getattr(self, name)!r} is no number{hint}")
        usual = (0, len(self.choices) - 1, 1.0) if self.choices else usual_limits(self.unit, self.is_integer)
        for name, value in zip(("minimum", "maximum", "nominal"), usual):
            if math.isnan(getattr(self, name)):
                object.__setattr__(self, name, value)

    @property
    def numbered_choices(self) -> str:
        """What an importer sets by number and people by word: ``0 quasi-static, 1 dynamic``."""
        return ", ".join(f"{number} {name}" for number, name in enumerate(self.choices))

    @property
    def is_integer(self) -> bool:
        return self.integer or bool(self.choices)

    @property
    def size(self) -> int:
        return math.prod(self.shape)

    @property
    def seen_axes(self) -> tuple[tuple[str, int], ...]:
        """(name, length) of each axis as a tool with arrays sees them."""
        axes = tuple(zip(self.axes, self.shape))
        return (*axes[:-1], *self.last_axes) if self.last_axes else axes

    @property
    def variability(self) -> str:
        if self.role == "parameter":
            return "tunable" if self.tunable else "fixed"
        return "discrete" if self.is_integer else "continuous"

    def within(self, counts: Mapping[str, int]) -> "Variable":
        """The variable in a topology; hidden where that lacks the part that it speaks of."""
        part, least = self.needs
        return replace(self, role="state") if part and counts[part] < least else self

    def check(self, value: float, element: str | None = None) -> None:
        """Raise ValueFault unless ``value`` (in the variable's unit) is finite and within its bounds."""
        name, unit = element or self.path, "" if self.unit == "1" else f" {self.unit}"
        if self.choices:
            if value not in range(len(self.choices)):
                known = ", ".join(f"{i} ({c})" for i, c in enumerate(self.choices))
                raise ValueFault(f"{name} = {value:g} is not one of {known}")
        elif not np.isfinite(value):
            raise ValueFault(f"{name} = {value}{unit} is not a finite number; give a value in {self.unit}")
        elif not self.minimum <= value <= self.maximum:
            bounds = f"[{self.minimum:g}, {self.maximum:g}]{unit}"
            raise ValueFault(f"{name} = {value:g}{unit} is out of range: it must lie in {bounds}")

    def element_names(self) -> Iterator[str]:
        """Names of the scalars, FMI 2 structured names with indices from 1: ``mesh.force[1,7]``."""
        if not self.shape:
            yield self.path
            return
        for index in product(*(range(1, n + 1) for n in self.shape)):
            yield f"{self.path}[{','.join(map(str, index))}]"


def output(name: str, unit: str, text: str, **more: Any) -> Variable:
    return Variable(name, "output", unit, text, 0.0, **more)


def local(name: str, unit: str, text: str, **more: Any) -> Variable:
    """A diagnostic: computed, shown, not connected."""
    return Variable(name, "local", unit, text, 0.0, **more)


def state(name: str, unit: str, text: str, **more: Any) -> Variable:
    return Variable(name, "state", unit, text, 0.0, **more)


def scratch(name: str, shape: tuple[int, ...] = (), integer: bool = False) -> Variable:
    """Work space of the kernels."""
    return Variable(name, "scratch", "1", "", 0.0, shape, ("",) * len(shape), integer=integer)


class Sizes(dict[str, int]):
    """How many of each part there are, by the axis that counts them.

    What a unit is made of declares its variables by functions ``variables(sizes)``, each beside its kernels.
    """

    def over(self, *parts: str, **lengths: int) -> dict[str, Any]:
        """Shape and axes of an array over these parts; ``lengths`` are of axes that count no parts."""
        return {"shape": (*(self[part] for part in parts), *lengths.values()), "axes": (*parts, *lengths)}
