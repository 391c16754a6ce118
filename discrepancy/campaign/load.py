"""``load_campaign``: a folder with campaign.toml becomes records."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from discrepancy.campaign.amount import split, to_si
from discrepancy.campaign.file_format import FILE, REMEDY, CampaignFile, ConditionEntry, NuisanceEntry, RigEntry, Run, Stated, read_campaign_file
from discrepancy.campaign.model import ENCODER_PHASE, Campaign, Condition, Nuisance, Rig, Rows, Source
from discrepancy.campaign.order_tables import as_asked, given_quantity
from discrepancy.campaign.quantities import ENCODERS, FACTOR_KEYS, QUANTITIES, TAGS, VALUE, Quantity, keys_for, numbers_of, roles_of
from discrepancy.campaign.readers import Options, read_columns
from discrepancy.campaign.scales import Scales, make_scales
from discrepancy.campaign.series import Series, complete, series_of
from discrepancy.closed_loop import is_closed
from discrepancy.held_names import HELD, LOCKED_AT
from discrepancy.problem import MEAN, WITH_ZERO, Parameter, Record
from discrepancy.repetitions import copies
from fmu_src.faults import InputFault
from fmu_src.reading import reading
from fmu_src.units import parse, registry
from reducers.reducer import kernels_name

DIRECTIONS = {"forward": 1, "reverse": -1, 1: 1, -1: -1}


def load_campaign(folder: str | Path, data: str | Path | None = None, file: Path | None = None) -> Campaign:
    """Read a campaign; ``data`` is where its files are if not where the file says, ``file`` what stands for its campaign.toml."""
    folder = Path(folder)
    path = file or folder / FILE
    with reading(path, "a campaign", REMEDY):
        return campaign_of(folder, data, path)


def campaign_of(folder: Path, data: str | Path | None, path: Path) -> Campaign:
    content, text = read_campaign_file(path, data)
    scales = make_scales(content.campaign, folder, path)
    conditions = {
        name: condition_of(name, entry, scales, f"{path}: conditions.{name}") for name, entry in content.conditions.items()
    }
    records, rows, unfilled = [], {}, {}
    files = Files(Path(data) if data is not None else folder / content.campaign.data)
    places = [f"{path}: runs[{i + 1}] ({run.id})" for i, run in enumerate(content.runs)]
    require_distinct(content.runs, conditions, places)
    sources = {}
    for run, place in zip(content.runs, places):
        series, rows[run.id] = measured(run, scales, files, place)
        sources[run.id] = sources_of(run, scales, place)
        if rows[run.id].used == 0:
            unfilled[run.id] = run.file or "table"
        else:
            condition, zero = conditions[run.condition], zero_known(run, content, place)
            direction = int(DIRECTIONS[run.direction] if run.direction is not None else condition.factors["direction"])
            record = record_of(run, condition, as_asked(run, series, zero, direction, place), scales, place)
            records.append(as_stated(record, run, content, path, place, zero))
    copied = copies(records)
    return Campaign(
        folder, content.campaign.name, content.campaign.description, scales.reducer, scales.ratio, scales.rated_torque,
        conditions, tuple(record for record in records if record.name not in copied), rows, unfilled,
        tuple(nuisance_of(name, entry, scales, f"{path}: nuisances.{name}") for name, entry in content.nuisances.items()),
        rig_of(content.rig, scales, f"{path}: rig") if content.rig else None,
        text, content.campaign.seal, tuple(dict.fromkeys(run.quantity for run in content.runs)),
        {name: tuple(family) for name, family in content.orders.items()}, speed_at(content), sources, copied,
    )  # fmt: skip


def speed_at(content: CampaignFile) -> str:
    """Where speeds are stated: by the rig, else by most conditions and columns."""
    if content.rig is not None and (content.rig.output_speed or content.rig.input_speed):
        return "output" if content.rig.output_speed else "input"
    stated = [key for entry in content.conditions.values() for key in ("input_speed", "output_speed") if getattr(entry, key) is not None]
    stated += [role for run in content.runs for role in (*run.columns, *run.table)]
    return "output" if stated.count("output_speed") > stated.count("input_speed") else "input"


def as_stated(record: Record, run: Run, content: CampaignFile, path: Path, place: str, zero: bool) -> Record:
    """The record with what the campaign says of its ``zero``, whether that is known, and of its angle."""
    general = content.quantities.get(run.quantity)
    if run.angle_of is not None and "angle" not in record.axes:
        raise InputFault(f"{place}.angle_of = {run.angle_of!r}: {run.quantity} of this run has no angle; leave it out")
    angle_of = run.angle_of or (general.angle_of if general else "input")
    return replace(record, zero_known=zero, zero_noise=zero_noise(run, content, path) if zero else 0.0,
                   of_output=angle_of == "output" and "angle" in record.axes)


def zero_known(run: Run, content: CampaignFile, place: str) -> bool:
    """Whether the mean of a quantity with a free zero counts all the same."""
    if run.zero is not None and run.quantity not in WITH_ZERO:
        raise InputFault(f"{place}.zero = {run.zero!r}: {run.quantity} has no zero to declare; {', '.join(WITH_ZERO)} have; leave it out")
    general = content.quantities.get(run.quantity)
    return (run.zero or (general.zero if general else "free")) == "absolute"


def zero_noise(run: Run, content: CampaignFile, path: Path) -> float:
    """Standard deviation, SI, by which a known zero of a run's quantity differs from run to run; 0 if it is not stated."""
    general = content.quantities.get(run.quantity)
    if general is None or general.zero_noise is None:
        return 0.0
    return deviation(general.zero_noise, QUANTITIES[run.quantity], f"{path}: quantities.{run.quantity}.zero_noise")


def sources_of(run: Run, scales: Scales, place: str) -> dict[str, Source]:
    """By axis, and "value" for the quantity itself, where the run's numbers stand."""
    roles = roles_of(given_quantity(run))
    found: dict[str, Source] = {}
    for role, key in roles.items():
        if role in run.columns:
            column = run.columns[role]
            factor = scales.conversion(key, column.unit, f"{place}.columns.{role}.unit = {column.unit!r}")[0]
            found.setdefault(key.name, Source(run.file or "", f"column {column.column}", column.unit, factor * column.scale))
        elif role in run.table:
            unit = run.table[role].unit
            found[key.name] = Source(FILE, f"table.{role}", unit, scales.conversion(key, unit, f"{place}.table.{role}.unit = {unit!r}")[0])
    if run.value is not None:
        unit = split(run.value, roles[VALUE].unit, f"{place}.value")[1]
        found[VALUE] = Source(FILE, "value", unit, scales.conversion(roles[VALUE], unit, f"{place}.value = {run.value!r}")[0])
    return found


class Files:
    """Columns of the files, read once for all runs that take the same ones (repetitions in one file)."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.read: dict[tuple[str, Options, frozenset[str]], Series] = {}

    def columns(self, file: str, run: Run, place: str) -> Series:
        options = Options(**{name: getattr(run, name) for name in Options.__dataclass_fields__})
        names = frozenset(str(column.column) for column in run.columns.values()) | frozenset(run.where)
        key = (file, options, names)
        if key not in self.read:
            self.read[key] = read_columns(self.folder / file, set(names), options, place)
        return self.read[key]


def require_distinct(runs: list[Run], conditions: dict[str, Condition], places: list[str]) -> None:
    """Every run is named once, belongs to a condition, and repeats no replicate."""
    ids: dict[str, str] = {}
    replicates: dict[tuple[object, ...], str] = {}
    for run, place in zip(runs, places):
        if run.id in ids:
            raise InputFault(f"{place}: id = {run.id!r} is used twice, first in {ids[run.id]}; give every run its own")
        ids[run.id] = place.split(": ", 1)[1]
        if run.condition not in conditions:
            raise InputFault(
                f"{place}: condition = {run.condition!r}: there is no such condition ({', '.join(conditions)}); add"
                f" [conditions.{run.condition}]"
            )
        same = (run.quantity, run.condition, run.replicate, str(run.mounting), run.direction, *sorted(run.tags.items()))
        if same in replicates:
            raise InputFault(
                f"{place}: replicate = {run.replicate}: {replicates[same]} is replicate {run.replicate} of {run.quantity}"
                f" in {run.condition} already; count replicates on, or name what differs by tags"
            )
        replicates[same] = run.id


def condition_of(name: str, entry: ConditionEntry, scales: Scales, place: str) -> Condition:
    stated = {key: getattr(entry, key) for key in FACTOR_KEYS if getattr(entry, key) is not None}
    of_positions = stated.get(LOCKED_AT) == MEAN
    if of_positions:
        del stated[LOCKED_AT]
    factors = scales.factors(stated, place)
    factors["direction"] = float(DIRECTIONS[entry.direction or "forward"])
    return Condition(
        name, factors, str(entry.mounting or "1"), entry.held_out, entry.direction is not None, tuple(entry.interventions), of_positions
    )


def measured(run: Run, scales: Scales, files: Files, place: str) -> tuple[Series, Rows]:
    """The run's numbers, from a file, a table written in the campaign, or one value."""
    given = [name for name in ("file", "table", "value") if getattr(run, name) or (name == "value" and run.value is not None)]
    if len(given) != 1:
        raise InputFault(
            f"{place}: has {' and '.join(given) or 'no numbers'}: give exactly one of file (with columns), table, or value"
        )
    quantity = given_quantity(run)
    roles = roles_of(quantity)
    if run.value is not None:
        require_roles([VALUE], quantity, f"{place}.value = {run.value!r}")
        return complete({VALUE: np.array([scales.number(roles[VALUE], run.value, f"{place}.value")])}, run, 1, place)
    stated = run.columns if run.file is not None else run.table
    kind = "columns" if run.file is not None else "table"
    require_roles(list(stated), quantity, f"{place}.{kind}")
    if run.file is not None:
        return series_of(run, roles, files.columns(run.file, run, place), scales, place)
    series = {}
    for role, entry in run.table.items():
        factor, offset = scales.conversion(roles[role], entry.unit, f"{place}.table.{role}.unit = {entry.unit!r}")
        series[roles[role].name] = factor * np.array(entry.values, float) + offset
    lengths = {role: len(entry.values) for role, entry in run.table.items()}
    if len(set(lengths.values())) > 1:
        raise InputFault(f"{place}.table: columns of different length {lengths}; give every row all its numbers")
    return complete(series, run, lengths[VALUE], place)


def require_roles(given: list[str], quantity: Quantity, place: str) -> None:
    """Value and axes are there, nothing is unknown or given twice."""
    roles = roles_of(quantity)
    for role in given:
        if role not in roles:
            raise InputFault(f"{place}.{role}: {quantity.name} has no such column; possible: {', '.join(roles)}")
    if quantity.name == "transmission_error" and set(given) >= ENCODERS and VALUE not in given:
        return
    names = [roles[role].name for role in given]
    if twice := {name for name in names if names.count(name) > 1}:
        raise InputFault(f"{place}: {twice.pop()} is given twice; keep one of {', '.join(given)}")
    for name in (VALUE, *quantity.axes):
        if name not in names:
            keys = " or ".join(keys_for(name)) or VALUE
            raise InputFault(f"{place}: {quantity.name} needs {keys}; add {keys} = {{ column = ..., unit = ... }}")


def record_of(run: Run, condition: Condition, series: Series, scales: Scales, place: str) -> Record:
    quantity = QUANTITIES[run.quantity]
    # What a row says of itself is nearer to the truth than the condition's nominal number.
    actual = {key: given for key, given in run.actual.items() if (key, given) != (LOCKED_AT, MEAN)}
    of_positions = len(actual) < len(run.actual) or (condition.of_positions and LOCKED_AT not in actual and LOCKED_AT not in series)
    factors = dict(condition.factors) | scales.factors(actual, f"{place}.actual")
    meant = {"direction", *numbers_of(quantity)}
    factors = {name: number for name, number in factors.items() if name in meant and name not in series and not (name == LOCKED_AT and of_positions)}
    if run.direction is not None:
        factors["direction"] = float(DIRECTIONS[run.direction])
    closed = quantity.name == "hysteresis" and "torque" in series and is_closed(series["torque"], series[VALUE])
    return Record(
        run.id, run.quantity, quantity.unit, run.condition, run.replicate, series[VALUE],
        {name: column for name, column in series.items() if name != VALUE}, factors,
        str(run.mounting or condition.mounting), condition.held_out if run.held_out is None else run.held_out,
        noise_of(run, quantity, place), tags_of(run, condition, quantity, scales, place), of_positions=of_positions and quantity.name in HELD,
        closed=closed,
    )  # fmt: skip


def noise_of(run: Run, quantity: Quantity, place: str) -> float | None:
    return None if run.noise is None else deviation(run.noise, quantity, f"{place}.noise")


def deviation(stated: Stated, quantity: Quantity, place: str) -> float:
    """A stated standard deviation in SI."""
    number, unit = split(stated, quantity.usual_unit, place)
    # A standard deviation is a difference: degC has its zero, a noise has not.
    noise = to_si(unit, quantity.unit, f"{place} = {number:g} {unit}")[0] * number
    if not 0.0 < noise < float("inf"):
        raise InputFault(f"{place} = {number:g} {unit}: a standard deviation must be positive; leave it out if unknown")
    return noise


def tags_of(run: Run, condition: Condition, quantity: Quantity, scales: Scales, place: str) -> dict[str, str]:
    tags = {name: str(word) for name, word in run.tags.items()}
    for name, word in tags.items():
        if name not in TAGS:
            raise InputFault(f"{place}.tags.{name} = {word!r} is not a tag; possible: {', '.join(TAGS)}")
        tag = TAGS[name]
        if tag.choices and word not in tag.choices:
            raise InputFault(f"{place}.tags.{name} = {word!r}: choose one of {', '.join(tag.choices)}")
        if tag.counted:
            count = getattr(scales.reducer.topology, tag.counted) if scales.reducer else None
            if not (word.isascii() and word.isdigit()) or int(word) < 1 or (count is not None and int(word) > count):
                last = f" to {count}" if count else " on"
                raise InputFault(f"{place}.tags.{name} = {word!r}: give the {tag.description.split(',')[0]}, from 1{last}")
    for name in quantity.tags:
        if name not in tags:
            choices = ", ".join(TAGS[name].choices) or TAGS[name].description
            raise InputFault(f"{place}: {quantity.name} needs tags.{name} ({choices})")
    if condition.interventions:
        tags["interventions"] = ",".join(condition.interventions)
    return tags


def nuisance_of(name: str, entry: NuisanceEntry, scales: Scales, place: str) -> Nuisance:
    """In the unit of the parameter of that name, else in SI base units."""
    name = kernels_name(name, place)
    tables = (scales.reducer.plant, scales.reducer.wear) if scales.reducer else ()
    unit = "rad" if name == ENCODER_PHASE else next((t.by_name[name].unit for t in tables if name in t.by_name), None)
    if name == ENCODER_PHASE:
        require_zero(entry, place)
    if unit is None:
        to_si(entry.unit, entry.unit, f"{place}.unit = {entry.unit!r}")
        unit = f"{registry().Quantity(1.0, parse(entry.unit)).to_base_units().units:~C}" or "1"
    factor, offset = to_si(entry.unit, unit, f"{place}.unit = {entry.unit!r}")
    if not entry.lower < entry.upper or not entry.lower <= entry.start <= entry.upper:
        raise InputFault(
            f"{place}: lower = {entry.lower:g}, start = {entry.start:g}, upper = {entry.upper:g} {entry.unit}: must rise in"
            f" this order{'' if 'start' in entry.model_fields_set else '; start is 0 where it is not given: give it'}"
        )
    prior = None if entry.prior is None else factor * entry.prior
    lower, start, upper = (factor * number + offset for number in (entry.lower, entry.start, entry.upper))
    # A range of decades says nothing about a step.
    size = min(0.1 * (upper - lower), abs(start) or upper - lower)
    parameter = Parameter(name, unit, start, lower, upper, prior or size, 0, prior, entry.description)
    return Nuisance(parameter, entry.per)


def require_zero(entry: NuisanceEntry, place: str) -> None:
    """InputFault for what is stated of an encoder's zero and cannot be held to."""
    if entry.per in ("condition", "run"):
        raise InputFault(f'{place}.per = "{entry.per}": an encoder keeps its zero through a mounting; write per = "mounting", and state the mounting of'
                         " runs before which it was set anew")  # fmt: skip
    if entry.prior is not None:
        raise InputFault(f"{place}.prior = {entry.prior:g} {entry.unit}: the zero is looked for by the pattern of the transmission error, alike everywhere"
                         " between lower and upper; leave prior out, and state these closer")  # fmt: skip


def rig_of(entry: RigEntry, scales: Scales, place: str) -> Rig:
    ranges = {}
    for name in ("input_speed", "output_speed", "load_torque", "temperature", "hours"):
        if (limits := getattr(entry, name)) is None:
            continue
        key = FACTOR_KEYS[name]
        if key.name in ranges:
            raise InputFault(f"{place}.{name}: the {key.name} is given twice, at input and output; keep one")
        low, high = (scales.number(key, limit, f"{place}.{name}[{i + 1}]") for i, limit in enumerate(limits))
        if not low <= high:
            raise InputFault(f"{place}.{name} = {limits!r}: give the lowest first")
        ranges[key.name] = (low, high)
    return Rig(
        ranges, tuple(DIRECTIONS[d] for d in entry.directions), tuple(entry.quantities), tuple(entry.interventions),
        entry.cost_per_run, entry.cost_per_hour, entry.cost_per_intervention, entry.currency,
    )  # fmt: skip
