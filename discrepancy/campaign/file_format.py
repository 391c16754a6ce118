"""What ``campaign.toml`` may hold; docs/campaigns.md explains it by examples.

Only the form is checked here: names, types, required keys.  What the numbers mean, and
whether they fit together, is checked where they are used.
"""

import difflib
import shlex
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, ValidationInfo, field_validator, model_validator

from discrepancy.campaign.quantities import INTERVENTIONS, QUANTITIES
from discrepancy.problem import WITH_ZERO
from fmu_src.faults import InputFault
from fmu_src.file_name import FILE_NAME
from fmu_src.names import dotted
from fmu_src.reading import parse_toml, quoted, read_text
from fmu_src.strict_file import Strict, validated

FILE, REMEDY = "campaign.toml", "see docs/campaigns.md"

# "15 rpm" or { value = 15, unit = "rpm" }; read by ``amount``, which knows the unit that is needed.
Stated = str | float | dict[str, Any]


class Head(Strict):
    name: str = Field(pattern=FILE_NAME)
    description: str = ""
    reducer: str | None = None
    ratio: float | None = Field(default=None, gt=0.0)
    rated_torque: Stated | None = None
    data: str = "."
    seal: str = ""
    notes: str = ""


class ConditionEntry(Strict):
    input_speed: Stated | None = None
    output_speed: Stated | None = None
    load_torque: Stated | None = None
    temperature: Stated | None = None
    hours: Stated | None = None
    locked_at: Stated | None = None
    normal_force: Stated | None = None
    sliding_speed: Stated | None = None
    sliding_distance: Stated | None = None
    direction: Literal["forward", "reverse", 1, -1] | None = None
    mounting: str | int | None = None
    held_out: bool = False
    interventions: list[str] = []
    notes: str = ""

    @field_validator("interventions")
    @classmethod
    def known(cls, names: list[str]) -> list[str]:
        for name in names:
            if name not in INTERVENTIONS:
                raise ValueError(f"{name!r} is not an intervention; choose from {', '.join(INTERVENTIONS)}")
        return names


class Column(Strict):
    column: str | int
    unit: str = Field(min_length=1)
    scale: float = 1.0
    from_start: bool = False
    unwrap: bool = False


class Inline(Strict):
    values: list[float]
    unit: str = Field(min_length=1)


class Range(Strict):
    min: float | None = None
    max: float | None = None


class Average(Strict):
    points: int | None = Field(default=None, ge=2)
    axis: str | None = None
    width: Stated | None = None


class Convention(Strict):
    """How a table of orders is meant; as it stands here TE = sum a_k cos(k theta + p_k), TE = output - input/ratio, theta forward."""

    wave: Literal["cosine", "sine"] = "cosine"
    phase: Literal["plus", "minus"] = "plus"
    angle: Literal["forward", "backward", "motion"] = "forward"
    minus: Literal["input", "output"] = "input"


class Run(Strict):
    id: str = Field(pattern=FILE_NAME)
    quantity: str
    condition: str
    replicate: int = Field(default=1, ge=1)
    mounting: str | int | None = None
    direction: Literal["forward", "reverse", 1, -1] | None = None
    held_out: bool | None = None
    actual: dict[str, Stated] = {}
    tags: dict[str, str | int] = {}
    noise: Stated | None = None
    zero: Literal["free", "absolute"] | None = None
    angle_of: Literal["input", "output"] | None = None
    notes: str = ""
    # Where the numbers are: a file's columns, a table written here, or one value.
    file: str | None = None
    columns: dict[str, Column] = {}
    table: dict[str, Inline] = {}
    value: Stated | None = None
    # How the file is read.
    format: Literal["csv", "parquet", "mat", "mdf", "tdms", "xlsx"] | None = None
    delimiter: str | None = Field(default=None, min_length=1, max_length=1)
    decimal: Literal[".", ","] | None = None
    thousands: str | None = Field(default=None, min_length=1, max_length=1)
    encoding: str | None = None
    header: bool = True
    units_line: bool = False
    skip_lines: int = Field(default=0, ge=0)
    group: str | None = None
    sheet: str | None = None
    align: str | None = None
    # Which of its rows are used, and how.
    where: dict[str, float | str | Range] = {}
    missing: list[float | str] = []
    average: Average | None = None
    # Curves over the angle in even steps through whole turns, orders of them, and what a table of orders means.
    per_turn: int | None = Field(default=None, ge=8)
    orders: list[float] = []
    window: Literal["none", "hann"] = "none"
    convention: Convention | None = None

    @field_validator("quantity")
    @classmethod
    def known(cls, name: str) -> str:
        if name not in QUANTITIES:
            close = difflib.get_close_matches(name, QUANTITIES, 1)
            hint = f"did you mean {close[0]}?" if close else f"choose from {', '.join(QUANTITIES)}"
            raise ValueError(f"{name!r} is not a quantity; {hint}")
        return name


class QuantityEntry(Strict):
    """What holds for all runs of a quantity that do not state it themselves."""

    zero: Literal["free", "absolute"] = "free"
    zero_noise: Stated | None = None
    angle_of: Literal["input", "output"] = "input"

    @model_validator(mode="after")
    def of_a_known_zero(self) -> "QuantityEntry":
        if self.zero_noise is not None and self.zero != "absolute":
            raise ValueError('zero_noise says how well a known zero is known: state zero = "absolute" with it, or leave it out')
        return self


class NuisanceEntry(Strict):
    unit: str = Field(min_length=1)
    start: float = 0.0
    lower: float
    upper: float
    prior: float | None = Field(default=None, gt=0.0)
    per: Literal["campaign", "mounting", "condition", "run"] = "campaign"
    description: str = ""


class RigEntry(Strict):
    input_speed: list[Stated] | None = Field(default=None, min_length=2, max_length=2)
    output_speed: list[Stated] | None = Field(default=None, min_length=2, max_length=2)
    load_torque: list[Stated] | None = Field(default=None, min_length=2, max_length=2)
    temperature: list[Stated] | None = Field(default=None, min_length=2, max_length=2)
    hours: list[Stated] | None = Field(default=None, min_length=2, max_length=2)
    directions: list[Literal["forward", "reverse"]] = ["forward", "reverse"]
    quantities: list[str] = []
    interventions: list[str] = []
    cost_per_run: float = Field(default=1.0, ge=0.0)
    cost_per_hour: float = Field(default=0.0, ge=0.0)
    cost_per_intervention: float = Field(default=0.0, ge=0.0)
    currency: str = "1"

    @field_validator("quantities", "interventions")
    @classmethod
    def known(cls, names: list[str], info: ValidationInfo) -> list[str]:
        known = QUANTITIES if info.field_name == "quantities" else INTERVENTIONS
        for name in names:
            if name not in known:
                raise ValueError(f"{name!r} is not known; choose from {', '.join(known)}")
        return names


class CampaignFile(Strict):
    campaign: Head
    conditions: dict[str, ConditionEntry] = Field(min_length=1)
    runs: list[Run] = Field(min_length=1)
    nuisances: dict[str, NuisanceEntry] = {}
    rig: RigEntry | None = None
    orders: dict[str, list[float]] = {}
    quantities: dict[str, QuantityEntry] = {}

    @field_validator("nuisances", mode="before")
    @classmethod
    def by_structured_name(cls, given: Any) -> Any:
        return dotted(given, NuisanceEntry.model_fields) if isinstance(given, dict) else given

    @field_validator("quantities")
    @classmethod
    def with_a_zero(cls, entries: dict[str, QuantityEntry]) -> dict[str, QuantityEntry]:
        for name in entries:
            if name not in WITH_ZERO:
                raise ValueError(f"{name!r} has no zero to declare; {', '.join(WITH_ZERO)} have")
        return entries


def read_campaign_file(path: Path, data: str | Path | None = None) -> tuple[CampaignFile, str]:
    """The checked content of the file, and its text; ``data``: where its measured files are, if that was said."""
    folder = str(path.parent)
    words = [str(data), "--output", folder] if data is not None else [folder]
    remedy = f"rvwear campaign from {shlex.join(words)} --reducer ... makes one of measured files, rvwear campaign template FOLDER an empty one"
    text = read_text(path, "campaign file", remedy)
    content = parse_toml(text, path, REMEDY)
    lay_out(content, path)
    return validated(CampaignFile, content, path, REMEDY), text


def lay_out(content: dict[str, Any], path: Path) -> None:
    """Fill each run from the layout that it names; what the run states itself wins."""
    layouts = content.pop("layouts", {})
    runs = content.get("runs", [])
    if not isinstance(layouts, dict) or not all(isinstance(layout, dict) for layout in layouts.values()):
        raise InputFault(f"{path}: layouts = {quoted(layouts)}: write [layouts.NAME] with keys of a run below it")
    if not isinstance(runs, list) or not all(isinstance(run, dict) for run in runs):
        raise InputFault(f"{path}: runs = {quoted(runs)}: write [[runs]], in double brackets, once for each run")
    for i, run in enumerate(runs):
        name = run.pop("layout", None)
        if name is None:
            continue
        if not isinstance(name, str) or name not in layouts:
            known = ", ".join(layouts) or "none is stated"
            raise InputFault(
                f"{path}: runs[{i + 1}].layout = {quoted(name)}: there is no such layout ({known}); add [layouts.{name}]"
            )
        runs[i] = layouts[name] | run
