"""A campaign in memory: records in SI units, and what stands beside them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from discrepancy.problem import Parameter, Record
from fmu_src.faults import InputFault
from reducers.reducer import Reducer


@dataclass(frozen=True)
class Condition:
    """One state of the rig; ``factors`` in SI units, as in ``Record``."""

    name: str
    factors: Mapping[str, float]
    mounting: str
    held_out: bool
    direction_stated: bool
    interventions: tuple[str, ...] = ()
    # What was held there was measured at positions over a turn of the cranks, and is the mean.
    of_positions: bool = False


@dataclass(frozen=True)
class Source:
    """Where numbers of a run come from; ``factor`` leads from the stated unit to that of the record."""

    file: str
    column: str
    unit: str
    factor: float

    def __str__(self) -> str:
        # Most heads say their unit.
        return f"{self.file}, {self.column}" + ("" if self.column.endswith(f"[{self.unit}]") else f" [{self.unit}]")


@dataclass(frozen=True)
class Rows:
    """How many rows of a run's file came into its record."""

    selected: int
    dropped: int
    used: int


# Nuisance: where a mounting counts its angles from.
ENCODER_PHASE = "encoder_phase"


@dataclass(frozen=True)
class Nuisance:
    """A parameter that may be calibrated; one value for the whole campaign, or one per mounting, condition or run."""

    parameter: Parameter
    per: str = "campaign"


@dataclass(frozen=True)
class Rig:
    """What the rig can do and what it costs: the limits of a proposed experiment.

    ``ranges`` maps factors to (lowest, highest) in SI units; a factor that is not there cannot be set.
    """

    ranges: Mapping[str, tuple[float, float]]
    directions: tuple[int, ...]
    quantities: tuple[str, ...]
    interventions: tuple[str, ...]
    cost_per_run: float
    cost_per_hour: float
    cost_per_intervention: float
    currency: str


@dataclass(frozen=True)
class Campaign:
    """A checked campaign.

    ``records`` hold every run that has rows and is no copy of another; ``unfilled`` names the runs whose file has none
    yet, with the file.  ``rows`` counts, by run, what was selected, dropped and used.
    ``ratio`` and ``rated_torque`` [N.m] are the reducer's where the file does not state them.
    """

    folder: Path
    name: str
    description: str
    reducer: Reducer | None
    ratio: float | None
    rated_torque: float | None
    conditions: Mapping[str, Condition]
    records: tuple[Record, ...]
    rows: Mapping[str, Rows]
    unfilled: Mapping[str, str]
    nuisances: tuple[Nuisance, ...]
    rig: Rig | None
    text: str
    seal: str = ""
    quantities: tuple[str, ...] = field(default=())
    # Further families of orders per output turn to look for: of motor, coupling, bench.
    orders: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    # Where its file states speeds: at "input" or "output"; records have them at the input.
    speed_at: str = "input"
    # By run and axis ("value" for the quantity itself) what the file says.
    sources: Mapping[str, Mapping[str, Source]] = field(default_factory=dict)
    # Runs that hold the numbers of another one, with that one; no records, for a copy is no repetition.
    copies: Mapping[str, str] = field(default_factory=dict)

    @property
    def training(self) -> tuple[Record, ...]:
        return tuple(record for record in self.records if not record.held_out)

    @property
    def held_out(self) -> tuple[Record, ...]:
        return tuple(record for record in self.records if record.held_out)

    def require_fittable(self) -> None:
        """InputFault where no run is left to fit a model to."""
        if not self.records:
            raise InputFault(f"{self.folder}: no run has any rows yet; fill in the files (rvwear campaign check lists them)")
        if not self.training:
            raise InputFault(f"{self.folder}: every run is held out; leave some conditions for fitting (held_out = false)")

    def place(self, run: str, axis: str) -> str:
        """Where the numbers of a run's axis (or ``value``) stand, in brackets; empty for records of no file."""
        source = self.source(run, axis)
        return f" ({source})" if source else ""

    def source(self, run: str, axis: str) -> Source | None:
        """Where the numbers of a run's axis (or ``value``) stand; None for records of no file."""
        return self.sources.get(run, {}).get(axis)

    def of(self, quantity: str) -> tuple[Record, ...]:
        return tuple(record for record in self.records if record.quantity == quantity)
