"""Reducer files: read, checked against the units' tables, turned into start values.

A file has [reducer] (name, description), [topology] (counts) and any other sections
with ``key = { value, unit, source }``.  Section and key together are the name of a variable of the plant, the
wear unit or the unit of both: ``radius`` in [pin] is ``pin.radius``.  The units' tables say what exists, in which
unit and within which bounds, so a new parameter needs no change here.

A number may have a ``range = [low, high]`` in its unit, in which it is held to lie; one whose source says
``assumed`` has a tenth to either side where none is given.
"""

from dataclasses import asdict, dataclass, field
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

from pydantic import Field, ValidationError

from fmu_src.faults import InputFault, nearest
from fmu_src.names import dotted, found_by_name
from fmu_src.reading import quoted, read_toml, reading, shown
from fmu_src.strict_file import NAME, Piece, Strict, keys_at
from fmu_src.table import Table
from fmu_src.unit import Specification, Worn
from fmu_src.variables import SETTABLE, Variable
from reducers.entry import Entry, in_unit, range_of, si_value
from reducers.library import LIBRARY, available
from reducers.usual import FILLED, filled
from rv_plant.dimension import FILE
from rv_plant.topology import Topology
from rv_plant.variables import plant_table
from rv_reducer.variables import reducer_table
from wear_fmu.variables import Resolution, wear_table

REMEDY = "the reducers of the library, in the folder reducers, show what one holds"
OF_A_MODEL = "give the one that its [model] names, or build its units with `rvwear build --reducer`"


class Head(Strict):
    name: str = Field(pattern=NAME)
    description: str = ""


class Counts(Strict):
    discs: int = Field(ge=1, le=3)
    cranks: int = Field(ge=1, le=3)
    pins: int = Field(ge=4, le=400)
    lobes: int = Field(ge=3, le=399)
    rollers: int = Field(ge=3, le=200)
    output_pins: int = Field(default=0, ge=0, le=100)


# A reducer that lacks no part, where names alone matter.
EVERY_PART = Topology(discs=3, cranks=3, pins=4, lobes=3, rollers=3, output_pins=3)


@dataclass(frozen=True)
class Reducer:
    """One reducer: its topology and the numbers of its file in SI units; ``starts`` of whole variables, or of one element (``name[3]``)."""

    name: str
    description: str
    topology: Topology
    starts: dict[str, float]
    sources: dict[str, str]
    path: Path
    resolution: Resolution = Resolution()
    # What a worn one starts with, by unit; a new one has nothing.
    worn: dict[str, Worn] = field(default_factory=dict)
    # By name (lowest, highest), SI: numbers that are not known for sure.
    ranges: dict[str, tuple[float, float]] = field(default_factory=dict)
    # What people read in place of the name, which files are called by: of a model its file and its name.
    called: str = ""

    @property
    def heading(self) -> str:
        """What a result of it is headed with."""
        return self.called or self.name

    @property
    def is_of_library(self) -> bool:
        """Whether it comes with the software, so that its name is enough."""
        return self.path.resolve().parent == LIBRARY.resolve()

    @property
    def as_named(self) -> str:
        """What a command line names it by: its name, or its file."""
        return self.name if self.is_of_library else str(self.path)

    def specification(self, unit: str) -> Specification:
        """What makes a unit of this reducer, see fmu_src.unit; ``unit`` is rv_plant, wear_fmu or rv_reducer."""
        table: Table = getattr(self, {"rv_plant": "plant", "wear_fmu": "wear", "rv_reducer": "joint"}[unit])
        names = table.by_name
        specification: Specification = {
            "unit": unit,
            "reducer": self.name,
            "sizes": {"topology": asdict(self.topology), "resolution": asdict(self.resolution)},
            "starts": {k: v for k, v in self.starts.items() if k.partition("[")[0] in names},
            "sources": {k: v for k, v in self.sources.items() if k in names},
        }
        if unit in self.worn:
            specification["worn"] = self.worn[unit]
        return specification

    @cached_property
    def plant(self) -> Table:
        """The plant's table with this reducer's numbers."""
        return tables_of(self.topology)[0].with_starts(self.starts, self.sources)

    @cached_property
    def wear(self) -> Table:
        """The wear unit's table with this reducer's numbers."""
        return tables_of(self.topology, self.resolution)[1].with_starts(self.starts, self.sources)

    @cached_property
    def joint(self) -> Table:
        """The table of both in one unit with this reducer's numbers."""
        return tables_of(self.topology, self.resolution)[2].with_starts(self.starts, self.sources)


def every_table() -> tuple[Table, Table, Table]:
    """The tables of plant, wear unit and both in one, of a reducer that lacks no part: for names."""
    return tables_of(EVERY_PART)


@lru_cache(16)
def tables_of(topology: Topology, resolution: Resolution = Resolution()) -> tuple[Table, Table, Table]:
    """The tables of plant, wear unit and both in one before a file's numbers go in; to make them takes most of what a file takes."""
    return plant_table(topology), wear_table(topology, resolution), reducer_table(topology, resolution)


def must_be_stated(v: Variable) -> bool:
    """Whether a reducer file without it is none: it neither follows from other numbers nor is there a usual one."""
    return v.source == FILE and v.role in SETTABLE and v.path not in FILLED


def kernels_name(written: str, place: str) -> str:
    """What kernels call the variable of plant or wear unit of a name; one of no variable, whatever the reducer, stays as it is."""
    found = found_by_name(every_table()[:2], written, place)
    return found[0][1].name if found else written


def is_model_file(path: Path) -> bool:
    """Whether a file is a reducer with what was added to it, which ``discrepancy.model_file`` reads."""
    if path.suffix != ".toml" or not path.is_file():
        return False
    with reading(path, "a reducer file", REMEDY):
        return "model" in read_toml(path, "reducer file", REMEDY)


def load_reducer(name_or_path: str | Path) -> Reducer:
    """A reducer by its name in the library or by the path of its file."""
    path = Path(name_or_path)
    if path.suffix == ".toml" and not path.is_file():
        raise InputFault(f"there is no file {path}{nearest(path.name, [p.name for p in path.parent.glob('*.toml')])}; or give one of {', '.join(available())}")
    if path.suffix != ".toml":
        path = LIBRARY / f"{name_or_path}.toml"
    if not path.is_file():
        raise InputFault(
            f"no reducer {str(name_or_path)!r}{nearest(str(name_or_path), available(), 1, files_beside(Path(name_or_path)))}; give one of"
            f" {', '.join(available())}, or the path of a .toml file"
        )
    with reading(path, "a reducer file", REMEDY):
        return reducer_of(read_toml(path, "reducer file", REMEDY), path)


def files_beside(path: Path) -> dict[str, str]:
    """Reducer and model files of the folder in which somebody looked for one: ending or letters may be mistyped."""
    return {name: str(found) for found in path.parent.glob("*.toml") for name in (found.name, found.stem)}


def reducer_of(content: dict[str, Any], path: Path) -> Reducer:
    """The reducer of a file's content."""
    if "model" in content and "reducer" not in content:
        raise InputFault(f"{path} is a model file (a reducer with what was added to it), and a reducer file is wanted here: {OF_A_MODEL}")
    head = checked(Head, content.pop("reducer", None), path, "reducer")
    counts = checked(Counts, content.pop("topology", None), path, "topology")
    if counts.pins != counts.lobes + 1:
        raise InputFault(
            f"{path}: [topology] pins = {counts.pins}, lobes = {counts.lobes}: the pins do not close the ring;"
            f" a cycloid disc needs one pin more than it has lobes: set pins = {counts.lobes + 1}"
            f" or lobes = {counts.pins - 1}"
        )
    if counts.output_pins in (1, 2):
        raise InputFault(f"{path}: [topology] output_pins = {counts.output_pins}: give at least 3, or 0 for output through the cranks")
    if counts.output_pins == 0 and counts.cranks == 1:
        raise InputFault(
            f"{path}: [topology] cranks = 1, output_pins = 0: one crank cannot turn the carrier; set cranks = 2 or 3, or give"
            " the number of output_pins of a plain cycloidal drive"
        )
    if counts.output_pins and counts.cranks != 1:
        raise InputFault(
            f"{path}: [topology] output_pins = {counts.output_pins}, cranks = {counts.cranks}: with output pins one eccentric on"
            " the axis turns the discs; set cranks = 1, or output_pins = 0"
        )
    topology = Topology(**counts.model_dump())
    starts: dict[str, float] = {}
    sources: dict[str, str] = {}
    ranges: dict[str, tuple[float, float]] = {}
    moved: dict[str, str] = {}
    tables = tables_of(topology)
    for section, entries in content.items():
        if not isinstance(entries, dict):
            raise InputFault(f"{path}: {section} stands outside of a section; put it below a [section]")
        for path_there, raw in dotted({section: entries}, Entry.model_fields).items():
            group, _, key = path_there.rpartition(".")
            entry = checked(Entry, raw, path, f"{group}.{key}")
            place = f"{path}: [{group}] {key}"
            name, value = si_value(tables, group, key, entry, place)
            if name in starts:
                raise InputFault(f"{place} is given twice; keep one")
            starts[name], sources[name] = value, entry.source
            if moves_only_with_others(entry):
                moved[path_there] = f"{place} = {entry.value:g}{in_unit(entry)}"
            elif (span := range_of(tables, group, key, entry, place)) is not None:
                ranges[name] = span
    fill(tables, topology, starts, sources, ranges)
    missing = sorted({v.path for t in tables for v in t.variables if v.source == FILE and v.role in SETTABLE and v.name not in starts})
    if missing:
        raise InputFault(f"{path}: {', '.join(missing)}: missing; each needs {{ value, unit, source }} in some section")
    if "rated_torque" not in starts and starts["load_torque"] != 0.0:
        starts["rated_torque"], sources["rated_torque"] = abs(starts["load_torque"]), sources["load_torque"]
    reducer = Reducer(head.name, head.description, topology, starts, sources, path, ranges=ranges)
    if moved:
        raise moved_alone(reducer, moved)
    return reducer


def moves_only_with_others(entry: Entry) -> bool:
    """Whether a number was changed whose range is the one value that fits the others, as a completion writes it."""
    return entry.range is not None and entry.range[0] == entry.range[1] != entry.value and not isinstance(entry.value, str)


def moved_alone(reducer: Reducer, moved: dict[str, str]) -> InputFault:
    """What to do in place of changing numbers that move only with others, told by name and with where they stand."""
    from reducers.completion.again import command

    anew = command(reducer, moved)
    return InputFault(
        f"{'; '.join(moved.values())}: the file's range is another single value, for what goes with it was completed to that one;"
        + (f" complete again: {anew}" if anew else "")
        + f"{'; or' if anew else ''} leave the range out, and look with rvwear reducer check whether the parts fit still"
    )


def fill(
    tables: tuple[Table, ...], topology: Topology, starts: dict[str, float], sources: dict[str, str], ranges: dict[str, tuple[float, float]]
) -> None:
    """Numbers that the file leaves out and that follow from others, or are usual, with where they are from."""
    variables = {v.path: v for table in tables for v in table.variables}
    have = {path: starts[v.name] for path, v in variables.items() if v.name in starts}
    for one in filled(have, topology):
        v = variables.get(one.path)
        if v is not None and v.source == FILE:
            starts[v.name], sources[v.name] = one.value, one.source
            if one.range is not None:
                ranges[v.name] = one.range


def numbers_of(reducer: Reducer) -> dict[str, float]:
    """All that its file states, and what was filled in, by structured name, SI."""
    variables = {v.path: v for table in (reducer.plant, reducer.wear, reducer.joint) for v in table.variables}
    return {path: reducer.starts[v.name] for path, v in variables.items() if v.name in reducer.starts}


def checked(model: type[Piece], raw: object, path: Path, place: str) -> Piece:
    """Validate one piece of the file; the error names file, key, value and remedy."""
    if raw is None:
        raise InputFault(f"{path}: section [{place}] is missing; it needs {', '.join(model.model_fields)}")
    if not isinstance(raw, dict):
        raise InputFault(
            f"{path}: {place} = {quoted(raw)} has no unit: write {place.rsplit('.', maxsplit=1)[-1]} ="
            ' { value = ..., unit = "...", source = "..." }'
        )
    try:
        return model(**raw)
    except ValidationError as problem:
        first = problem.errors()[0]
        key = ".".join(map(str, (place, *first["loc"])))
        given = "" if first["type"] == "missing" else f" = {quoted(first['input'])}"
        hint = nearest(str(first["loc"][-1]), keys_at(model, ()), 1) if first["type"] == "extra_forbidden" else ""
        raise InputFault(f"{path}: {shown(key)}{given}: {first['msg']}{hint}; {place} takes {', '.join(model.model_fields)}") from None
