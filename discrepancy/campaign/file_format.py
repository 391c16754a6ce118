"""What ``campaign.toml`` may hold; docs/campaigns.md explains it by examples.

Only the form is checked here: names, types, required keys.  What the numbers mean, and
whether they fit together, is checked where they are used.
"""

import difflib
import tomllib
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, ValidationError, ValidationInfo, field_validator

from discrepancy.campaign.quantities import INTERVENTIONS, QUANTITIES
from discrepancy.problem import FREE_ZERO
from fmu_src.faults import InputFault
from fmu_src.names import dotted
from reducers.reducer import NAME, Strict

FILE = "campaign.toml"

# "15 rpm" or { value = 15, unit = "rpm" }; read by ``amount``, which knows the unit that is needed.
Stated = str | float | dict[str, Any]


class Head(Strict):
    name: str = Field(pattern=NAME)
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


class Run(Strict):
    id: str = Field(pattern=NAME)
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
    notes: str = ""
    # Where the numbers are: a file's columns, a table written here, or one value.
    file: str | None = None
    columns: dict[str, Column] = {}
    table: dict[str, Inline] = {}
    value: Stated | None = None
    # How the file is read.
    format: Literal["csv", "parquet", "mat", "mdf", "tdms"] | None = None
    delimiter: str | None = Field(default=None, min_length=1, max_length=1)
    decimal: Literal[".", ","] | None = None
    header: bool = True
    units_line: bool = False
    skip_lines: int = Field(default=0, ge=0)
    group: str | None = None
    align: str | None = None
    # Which of its rows are used, and how.
    where: dict[str, float | str | Range] = {}
    missing: list[float | str] = []
    average: Average | None = None

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
            if name not in FREE_ZERO:
                raise ValueError(f"{name!r} has no zero to declare; {' and '.join(FREE_ZERO)} have")
        return entries


def read_campaign_file(path: Path) -> tuple[CampaignFile, str]:
    """The checked content of the file, and its text."""
    if not path.is_file():
        raise InputFault(f"no campaign file at {path}; rvwear campaign template FOLDER writes one")
    try:
        text = path.read_text(encoding="utf-8-sig")
        content = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
        raise InputFault(f"{path}: not a TOML file: {problem}; see docs/campaigns.md") from None
    lay_out(content, path)
    try:
        return CampaignFile(**content), text
    except ValidationError as problem:
        raise InputFault(f"{path}: {describe(problem, content)}; see docs/campaigns.md") from None


def lay_out(content: dict[str, Any], path: Path) -> None:
    """Fill each run from the layout that it names; what the run states itself wins."""
    layouts = content.pop("layouts", {})
    runs = content.get("runs", [])
    if not isinstance(layouts, dict) or not all(isinstance(layout, dict) for layout in layouts.values()):
        raise InputFault(f"{path}: layouts = {layouts!r}: write [layouts.NAME] with keys of a run below it")
    if not isinstance(runs, list) or not all(isinstance(run, dict) for run in runs):
        raise InputFault(f"{path}: runs = {runs!r}: write [[runs]], in double brackets, once for each run")
    for i, run in enumerate(runs):
        name = run.pop("layout", None)
        if name is None:
            continue
        if name not in layouts:
            known = ", ".join(layouts) or "none is stated"
            raise InputFault(
                f"{path}: runs[{i + 1}].layout = {name!r}: there is no such layout ({known}); add [layouts.{name}]"
            )
        runs[i] = layouts[name] | run


def describe(problem: ValidationError, content: dict[str, Any]) -> str:
    """Key, value and remedy of the first fault."""
    first = problem.errors()[0]
    location, kind = first["loc"], first["type"]
    place = key_path(location, content)
    if kind == "missing":
        return f"{place}.{location[-1]}".lstrip(".") + " is missing; add it"
    if kind == "extra_forbidden":
        section = [str(part) for part in location[:-1] if part in SECTIONS]
        owner = list((SECTIONS[section[-1]] if section else CampaignFile).model_fields)
        close = difflib.get_close_matches(str(location[-1]), owner, 1)
        hint = f"did you mean {close[0]}?" if close else f"possible here: {', '.join(owner)}"
        return f"{place} = {first['input']!r} is not a key here; {hint}"
    message = first["msg"].removeprefix("Value error, ").replace("Input should", "it should")
    return f"{place} = {first['input']!r}: {message}"


def key_path(location: tuple[int | str, ...], content: dict[str, Any]) -> str:
    """The place as written in the file, runs counted from 1 and with their id.

    pydantic also names the members of a union; they are no keys of the file and are left out.
    """
    place = ""
    item: Any = content
    for part in location:
        if isinstance(item, list) and isinstance(part, int):
            item = item[part]
            place += f"[{part + 1}]" + (f" ({item['id']})" if isinstance(item, dict) and "id" in item else "")
        elif isinstance(item, dict) and part in item:
            item = item[part]
            place += f".{part}" if place else str(part)
    return place


# The keys below a key, for the hints of ``describe``.
SECTIONS: dict[str, type[Strict]] = {
    "campaign": Head, "quantities": QuantityEntry, "conditions": ConditionEntry, "runs": Run, "nuisances": NuisanceEntry, "rig": RigEntry,
    "columns": Column, "table": Inline, "average": Average, "where": Range,
}  # fmt: skip
