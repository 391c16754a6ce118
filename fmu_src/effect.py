"""Effects: pieces of physics, one file each, compiled into a unit and off by default.

An effect is a module in a unit's ``effects`` folder (or in a user's own folder, see
``user_folder``) with

- a docstring: the equation, its range, its source;
- ``EFFECT``, an ``Effect``: its parameters with units, bounds and the value at which it
  vanishes, its states, the signature it leaves in measurements;
- kernels named after the unit's hooks, which the unit calls at their time.

All effects of a unit are composed into one module, so that the compiler sees plain calls.
"""

import importlib
import linecache
import math
import sys
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from fmu_src.effect_check import is_name
from fmu_src.effect_finding import OWN
from fmu_src.source_hash import user_effect_files
from fmu_src.variables import Variable

# In a unit's ``ALLOWED``, for hooks that may set the effect's own states.
OWN_STATES = {OWN: "="}
TURN = 2.0 * math.pi


@dataclass(frozen=True)
class EffectParameter:
    """A parameter of an effect and how one looks for it.

    ``kind`` is ``amplitude`` (the effect vanishes when all of them stand at their start
    value), ``shape`` (says how it acts, nothing by itself) or ``choice`` (which part it
    sits on; not estimated).  ``scale`` is a typical size, ``sign`` +1 or -1 where only one
    side of the start value makes sense, ``grid`` the values at which a search looks and from which
    it goes on; a shape without is held at its start.
    Amplitudes of one ``group`` are looked for together, with the shapes of that group and those of none.
    """

    variable: Variable
    kind: str
    scale: float = 1.0
    sign: int = 0
    grid: tuple[float, ...] = ()
    group: str = ""
    part: str = ""

    @property
    def is_held(self) -> bool:
        """Whether no search changes it, although it says how the effect acts."""
        return self.kind == "shape" and not self.grid

    @property
    def told_kind(self) -> str:
        return f"{self.kind}, held" if self.is_held else self.kind


@dataclass(frozen=True)
class Effect:
    """What is known about an effect beside its kernels; ``number`` is that of the physics audit's catalogue.

    ``also_in`` names the unit whose effect of the same name is the other half; ``needs`` says without what the effect
    cannot show: "output pins" of the reducer, or a loop with "locked output".  ``rolled_over``: it acts as each roller passes the
    angle of this name, so that what it leaves hangs on where the cages stand.
    """

    number: int
    title: str
    law: str
    source: str
    signature: str
    parameters: tuple[EffectParameter, ...]
    states: tuple[Variable, ...] = ()
    signals: tuple[str, ...] = ()
    also_in: str = ""
    needs: str = ""
    rolled_over: str = ""

    def amplitudes(self) -> tuple[EffectParameter, ...]:
        return tuple(p for p in self.parameters if p.kind == "amplitude")

    def variables(self) -> list[Variable]:
        """Everything that the unit's table needs."""
        return [p.variable for p in self.parameters] + list(self.states)


@dataclass(frozen=True)
class Guard:
    """A condition before every effect's kernel of a hook: the kernel ``function`` of ``module``, asked with the
    effect's parameter EFFECT_``suffix`` and with a further ``argument`` of the hook, which effects do not see.
    """

    argument: str
    module: str
    function: str
    suffix: str


def amplitude(
    name: str, unit: str, text: str, scale: float, low: float, high: float, off: float = 0.0, sign: int = 0, source: str = "off",
    group: str = "", **more: Any,
) -> EffectParameter:  # fmt: skip
    """A parameter that is off at ``off``; [low, high] are its bounds in ``unit``.  It may be set during a run."""
    variable = Variable(name, "parameter", unit, f"{text} ({off:g}: off)", off, minimum=low, maximum=high,
                        nominal=abs(scale), source=source, tunable=True, **more)
    return EffectParameter(variable, "amplitude", scale, sign, (), group)


def shape(
    name: str, unit: str, text: str, start: float, low: float, high: float, source: str, grid: Iterable[float] = (), group: str = "",
    display: str = "", held: bool = False,
) -> EffectParameter:  # fmt: skip
    """A parameter that says how an effect acts once it is on; ``group`` names one group or several.

    It is fitted with the amplitudes, from the value of ``grid`` that explains most (without: ``usual_grid``), unless it is ``held``.
    """
    variable = Variable(name, "parameter", unit, text, start, minimum=low, maximum=high, nominal=abs(start) or 1.0,
                        source=source, display=display)
    # A phase of 0 has no size of its own.
    scale = abs(start) or (0.3 if unit == "rad" else 0.1 * (high - low))
    values = () if held else tuple(grid) or usual_grid(unit, start, low, high)
    return EffectParameter(variable, "shape", scale, 0, values, group)


def usual_grid(unit: str, start: float, low: float, high: float) -> tuple[float, ...]:
    """Where a search looks for a shape of which nothing more is said, within its bounds.

    An angle that may go all round: quarters of a turn; else the start, a third and three times of it; about 0 a tenth of the bounds to
    either side.
    """
    if unit == "rad" and high - low > 0.99 * TURN:
        values = [start + quarter * TURN / 4.0 for quarter in range(-3, 4)]
        return tuple(v for v in values if low <= v <= high)[:4]
    step = 0.1 * (high - low)
    values = [start / 3.0, start, 3.0 * start] if start else [-step, 0.0, step]
    return tuple(v for v in values if low <= v <= high)


def choice(name: str, text: str, start: int = 1, low: int = 1, high: int = 400, part: str = "", group: str = "") -> EffectParameter:
    """Which part an effect sits on, counted from 1: a ``part``, ``disc`` or ``crank``, if a diagnosis is to say it; of the groups of amplitudes
    that begin with ``group``."""
    variable = Variable(name, "parameter", "1", text, start, minimum=low, maximum=high, integer=True,
                        source="assumed: the first")
    return EffectParameter(variable, "choice", group=group, part=part)


def effect_modules(package: str) -> dict[str, ModuleType]:
    """The effects of a package, built in and of the user, by name in a fixed order.

    A user's file that cannot be imported or has no EFFECT is left out here; ``effect_check`` says why as soon as
    the unit's table is made, before anything is compiled.
    """
    parent = importlib.import_module(package)
    own = {p.stem for p in Path(parent.__path__[0]).glob("*.py") if p.stem != "__init__"}
    modules = {name: importlib.import_module(f"{package}.{name}") for name in own}
    for _, file in user_effect_files(package.partition(".")[0]):
        if str(file.parent) not in parent.__path__:
            parent.__path__.append(str(file.parent))
        if is_name(file.stem) and file.stem not in {*own, "__init__"}:
            with suppress(Exception, SystemExit):
                module = importlib.import_module(f"{package}.{file.stem}")
                if isinstance(module.EFFECT, Effect):
                    modules[file.stem] = module
    return dict(sorted(modules.items()))


def amplitude_memory(effects: Iterable[Effect]) -> Variable:
    """The state that ``keep_amplitudes`` of a unit's composed effects fills."""
    count = sum(len(effect.amplitudes()) for effect in effects)
    return Variable("amplitude_kept", "state", "1", "amplitudes that hold now", shape=(count,), axes=("amplitude",))


def tuning_lines(modules: Mapping[str, ModuleType]) -> list[str]:
    """Kernels ``amplitudes_changed(r)``, since ``keep_amplitudes(r)``."""
    names = [p.variable.name for module in modules.values() for p in module.EFFECT.amplitudes()]
    return [
        "", "", "@kernel", "def amplitudes_changed(r):",
        *(f"    if r.{name} != r.amplitude_kept[{i}]:\n        return True" for i, name in enumerate(names)), "    return False",
        "", "", "@kernel", "def keep_amplitudes(r):",
        *(f"    r.amplitude_kept[{i}] = r.{name}" for i, name in enumerate(names)),
    ]  # fmt: skip


def compose(package: str, hooks: Mapping[str, tuple[str, str]], guards: Mapping[str, Guard] | None = None) -> ModuleType:
    """One module with a kernel per hook that calls every effect's kernel of that name, and those of ``tuning_lines``.

    ``hooks`` maps the hook's name to (arguments, operation): operation ``""`` calls one after
    the other, ``"*"`` gives the product of what they return.  ``guards`` maps it to a condition of each call, whose
    argument comes last.
    """
    name = f"{package}.composed"
    if name in sys.modules:
        return sys.modules[name]
    modules = effect_modules(package)
    lines = ['"""Made anew from the effects that there are; do not edit."""', "from fmu_src.kernel import kernel"]
    body = []
    for hook, (arguments, operation) in hooks.items():
        present = [name for name, module in modules.items() if hasattr(module, hook)]
        lines += [f"from {package}.{name} import {hook} as {hook}_{name}" for name in present]
        calls = [f"{hook}_{name}({arguments})" for name in present]
        calls = [f"value *= {call}" for call in calls] if operation == "*" else calls
        guard = (guards or {}).get(hook)
        if guard is not None:
            lines.append(f"from {guard.module} import {guard.function}")
            calls = [f"if {guard.function}(r.{name}_{guard.suffix}, {guard.argument}):\n        {call}" for name, call in zip(present, calls)]
        body += ["", "", "@kernel", f"def {hook}({arguments}{', ' + guard.argument if guard else ''}):"]
        if operation == "*":
            body += ["    value = 1.0", *(f"    {call}" for call in calls), "    return value"]
        else:
            body += [f"    {call}" for call in calls] or ["    pass"]
    text = "\n".join([*lines, *body, *tuning_lines(modules)]) + "\n"
    # Not on disk: the compiler, tracebacks and debuggers find its text in ``linecache``.
    file = f"<{name}>"
    linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
    module = sys.modules[name] = ModuleType(name)
    module.__file__ = file
    exec(compile(text, file, "exec"), module.__dict__)  # noqa: S102
    return module
