"""The file of an ensemble: which reducer, what scatters and how, and the limits.

    reducer = "RV20E-121"
    samples = 16                # base samples, a power of two: (parameters + 2) lives each
    hours = 10000

    [parameters]                # any parameter or input of plant or wear unit, with its unit
    bearing.clearance = { distribution = "normal", mean = 2.5, deviation = 0.4, unit = "um" }
    errors.pin.radius = { distribution = "normal", mean = 0, deviation = 0.5, unit = "um" }     # every pin on its own
    output.load_torque = { distribution = "uniform", low = 120, high = 200, unit = "N.m" }            # with a duty: duty_torque_factor
    wear.mesh_coefficient = { distribution = "lognormal", median = 5e-9, factor = 1.5, unit = "1" }

    [limits]                    # the life of a reducer ends where the first is passed
    lost_motion_arcmin = 1.0
    disc_flank_um = 8.0

Further keys: ``seed``, ``tolerance``, ``settings`` (a list of "name=value"), ``duty`` (a file beside this one).
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from pydantic import ConfigDict, Field, field_validator

from fmu_src.faults import InputFault
from fmu_src.names import dotted, found_by_name
from fmu_src.reading import read_toml, reading
from fmu_src.strict_file import Strict, validated
from fmu_src.units import UnitError, conversion
from fmu_src.variables import SETTABLE
from orchestrator.settings import Setting, parse_setting
from reducers.reducer import Reducer, load_reducer
from studies.duty import Segment, load_duty
from studies.ensemble.figures import FIGURES

REMEDY = "examples/ensemble.toml shows one"
# What a duty's scatter multiplies; no variables of a unit.
DUTY_FACTORS = ("duty_torque_factor", "duty_speed_factor")
# The numbers that each distribution takes.
NUMBERS = {
    "normal": ("mean", "deviation"), "uniform": ("low", "high"), "triangular": ("low", "mode", "high"),
    "lognormal": ("median", "factor"),
}  # fmt: skip


class Finite(Strict):
    """Nothing scatters about infinity."""

    model_config = ConfigDict(allow_inf_nan=False)


class Entry(Finite):
    distribution: Literal["normal", "uniform", "triangular", "lognormal"]
    unit: str
    mean: float | None = None
    deviation: float | None = Field(None, gt=0.0)
    low: float | None = None
    mode: float | None = None
    high: float | None = None
    median: float | None = Field(None, gt=0.0)
    factor: float | None = Field(None, gt=1.0)


class Content(Finite):
    reducer: str
    parameters: dict[str, Entry] = Field(min_length=1)
    limits: dict[str, float] = {}
    samples: int = Field(16, ge=2, le=2**20)
    seed: int = Field(1, ge=0)
    hours: float = Field(10_000.0, gt=0.0)
    tolerance: float = Field(0.02, gt=0.0, le=0.5)
    settings: list[str] = []
    duty: str = ""

    @field_validator("parameters", mode="before")
    @classmethod
    def by_structured_name(cls, given: Any) -> Any:
        return dotted(given, Entry.model_fields) if isinstance(given, dict) else given


@dataclass(frozen=True)
class Scatter:
    """One parameter's distribution, its numbers in the variable's own unit; ``shape`` is that of the variable."""

    name: str
    distribution: str
    numbers: tuple[float, ...]
    shape: tuple[int, ...]


@dataclass(frozen=True)
class Ensemble:
    reducer: Reducer
    scatters: tuple[Scatter, ...]
    limits: dict[str, float]
    samples: int
    seed: int
    hours: float
    tolerance: float
    settings: tuple[Setting, ...]
    duty: tuple[Segment, ...]

    def identity(self) -> dict[str, Any]:
        """What a stored life depends on; another ensemble's lives are not mixed in."""
        return {
            "reducer": self.reducer.name, "starts": self.reducer.starts, "scatters": [vars(s) for s in self.scatters],
            "samples": self.samples, "seed": self.seed, "hours": self.hours, "tolerance": self.tolerance,
            "settings": [vars(s) for s in self.settings], "duty": [vars(s) for s in self.duty],
        }  # fmt: skip


def load_ensemble(path: str | Path, samples: int | None = None) -> Ensemble:
    """Read and check an ensemble's file; ``samples`` before the file's."""
    path = Path(path)
    with reading(path, "an ensemble file", REMEDY):
        return ensemble_of(validated(Content, read_toml(path, "ensemble file", REMEDY), path, REMEDY), path, samples)


def ensemble_of(content: Content, path: Path, samples: int | None) -> Ensemble:
    beside = path.parent / content.reducer
    reducer = load_reducer(beside if beside.suffix == ".toml" and beside.is_file() else content.reducer)
    count = samples or content.samples
    if count & (count - 1) or count < 2:
        raise InputFault(f"{path}: samples = {count}: a power of two is needed (8, 16, 32, ...): the sequence is even only then")
    for name in content.limits:
        if name not in FIGURES:
            raise InputFault(f"{path}: limits.{name}: there is no such figure; known are {', '.join(FIGURES)}")
    duty = load_duty(path.parent / content.duty) if content.duty else ()
    scatters = tuple(scatter_of(reducer, bool(duty), name, entry, f"{path}: parameters.{name}") for name, entry in content.parameters.items())
    settings = tuple(parse_setting(text, [reducer.plant, reducer.wear]) for text in content.settings)
    return Ensemble(reducer, scatters, content.limits, count, content.seed, content.hours, content.tolerance, settings, duty)


def scatter_of(reducer: Reducer, has_duty: bool, name: str, entry: Entry, place: str) -> Scatter:
    wanted = NUMBERS[entry.distribution]
    given = [key for key in Entry.model_fields if key not in ("distribution", "unit") and getattr(entry, key) is not None]
    if set(given) != set(wanted):
        raise InputFault(f"{place}: the distribution {entry.distribution} takes {', '.join(wanted)}, given are {', '.join(given) or 'none'}")
    unit, shape = "1", tuple[int, ...]()
    if name in DUTY_FACTORS:
        if not has_duty:
            raise InputFault(f"{place}: there is no duty; scatter output.load_torque or input.speed, or give duty = FILE")
    else:
        # Refuses unknown names with a hint.
        found = found_by_name([reducer.plant, reducer.wear], name, place, SETTABLE)
        if not found:
            parse_setting(f"{name}=0", [reducer.plant, reducer.wear])
        variable = found[0][1]
        if variable.is_integer:
            raise InputFault(f"{place}: {name} counts or chooses; only quantities scatter")
        name = variable.name
        if has_duty and name in ("load_torque", "input_speed"):
            raise InputFault(f"{place}: the duty sets it; scatter {' or '.join(DUTY_FACTORS)}")
        unit, shape = variable.unit, variable.shape
    try:
        factor, offset = conversion(entry.unit, unit)
    except UnitError as problem:
        raise InputFault(f"{place}: {problem}") from None

    def in_own_unit(key: str) -> float:
        value: float = getattr(entry, key)
        # A deviation is a difference, a factor has no unit.
        return value if key == "factor" else factor * value + (offset if key != "deviation" else 0.0)

    numbers = tuple(in_own_unit(key) for key in wanted)
    if entry.distribution in ("uniform", "triangular") and list(numbers) != sorted(set(numbers)):
        raise InputFault(f"{place}: {' < '.join(wanted)} is needed")
    return Scatter(name, entry.distribution, numbers, shape)
