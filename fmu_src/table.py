"""One table of variables per unit: the record that kernels work on, and what importing tools see of it.

Every field is eight bytes wide (``f8`` or ``i8``), so a record is a row of cells
without padding, the FMI value reference is the cell's index, and the FMU state is
one copy of the leading cells.  Roles stand in the order of ``ROLES``; scratch,
which holds nothing between two steps, comes last and is not part of the state.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from fmu_src.arrays import Floats, Mask, Records, field_of
from fmu_src.kernel import PLAIN
from fmu_src.terminals import Terminal
from fmu_src.variables import LARGEST, ROLES, SEEN, SETTABLE, ValueFault, Variable


class Table:
    """The variables of one unit, in record order.

    ``known_at_start`` names the inputs and parameters that an output's initial value is computed from, where that is not all of
    them (a new surface depends on none), which FMI wants to be declared.

    ``views`` lay other records over the same cells, each as {its field: variable of this
    table}: a kernel written for another table then works on this one (``records.plant``).
    ``terminals`` say which variables belong to one place of the machine.
    A record with views also has all its ``cells`` as one row of ``i8``.

    ``arrays`` are start values that are not alike in all elements (worn surfaces, one pin that is larger).
    """

    def __init__(
        self, name: str, description: str, variables: list[Variable],
        known_at_start: Mapping[str, Sequence[str]] | None = None, views: dict[str, dict[str, str]] | None = None,
        terminals: Sequence[Terminal] = (), arrays: dict[str, Floats] | None = None,
    ):  # fmt: skip
        self.name = name
        self.description = description
        self.known_at_start = known_at_start or {}
        self.views = views or {}
        self.terminals = terminals
        self.arrays = arrays or {}
        order = sorted(range(len(variables)), key=lambda i: (ROLES.index(variables[i].role), i))
        self.variables = [variables[i] for i in order]
        self.by_name = {v.name: v for v in self.variables}
        self.by_path = {v.path: v for v in self.variables if self.is_visible(v)}
        if len(self.by_name) != len(variables):
            names = [v.name for v in variables]
            raise ValueError(f"{name}: declared twice: {sorted({n for n in names if names.count(n) > 1})}")
        if len(self.by_path) != sum(map(self.is_visible, variables)):
            paths = [v.path for v in variables if self.is_visible(v)]
            raise ValueError(f"{name}: two variables show the same name: {sorted({p for p in paths if paths.count(p) > 1})}")
        self.dtype = with_views(
            np.dtype([(v.name, "i8" if v.is_integer else "f8", v.shape) for v in self.variables], align=True), self.views
        )
        self.offset = {v.name: field_of(self.dtype, v.name)[1] // 8 for v in self.variables}

    @cached_property
    def cell_count(self) -> int:
        return self.dtype.itemsize // 8

    @cached_property
    def state_cells(self) -> int:
        """Number of leading cells that make up the state (all but scratch)."""
        return sum(v.size for v in self.variables if v.role != "scratch")

    @cached_property
    def interface_cells(self) -> int:
        """Number of leading cells that an importing tool sees."""
        return sum(v.size for v in self.interface())

    @cached_property
    def bounds(self) -> tuple[Floats, Floats]:
        """(lowest, highest) value of each interface cell that may be set; NaN where none may."""
        lowest, highest = np.full((2, self.interface_cells), np.nan)
        for v in self.of_role(*SETTABLE):
            cells = self.cell_range(v.name)
            lowest[cells], highest[cells] = v.minimum, v.maximum
        return lowest, highest

    @cached_property
    def integer_cells(self) -> Mask:
        """Which interface cells hold integers."""
        mask = np.zeros(self.interface_cells, bool)
        for v in self.interface():
            mask[self.cell_range(v.name)] = v.is_integer
        return mask

    @cached_property
    def fixed_cells(self) -> Mask:
        """Which interface cells may not be set once the unit is initialised."""
        mask = np.zeros(self.interface_cells, bool)
        for v in self.of_role("parameter"):
            mask[self.cell_range(v.name)] = not v.tunable
        return mask

    def of_role(self, *roles: str) -> list[Variable]:
        return [v for v in self.variables if v.role in roles]

    def interface(self) -> list[Variable]:
        """The variables that an importing tool sees."""
        return self.of_role(*SEEN)

    def is_visible(self, v: Variable) -> bool:
        """Whether an importing tool with arrays sees it: the interface and the surfaces' profiles."""
        return v.role in SEEN or v.profile

    def find(self, name: str) -> Variable | None:
        """The visible variable of a structured name, of one of its elements, or of the name that kernels have for it."""
        base = name.partition("[")[0]
        found = self.by_path.get(base) or self.by_name.get(base)
        return found if found is not None and self.is_visible(found) else None

    @cached_property
    def renamed(self) -> dict[str, str]:
        """Old names, which are those of the kernels, and what they are now; only those that differ."""
        return {v.name: path for path, v in self.by_path.items() if v.name != path}

    def new_records(self) -> Records:
        """A one-element record array holding every start value."""
        records = np.zeros(1, self.dtype)
        for v in self.variables:
            records[v.name] = v.start
        for name, values in self.arrays.items():
            records[name] = values
        # Plain Python takes fields as attributes of NumPy's own records.
        return records.view(np.recarray) if PLAIN else records

    def scalars(self, records: Records) -> dict[str, float]:
        """Single values of a record by name, for the words of a fault."""
        return {v.name: records[v.name][0] for v in self.variables if not v.shape}

    def with_starts(self, starts: dict[str, float], sources: dict[str, str]) -> "Table":
        """The same table with other start values (and their sources), of whole variables or of elements (``pin_radius_error[3]``)."""
        changed = [
            replace(v, start=starts[v.name], source=sources.get(v.name, v.source)) if v.name in starts else v
            for v in self.variables
        ]
        arrays: dict[str, Floats] = {}
        for element, value in starts.items():
            name, bracket, _ = element.partition("[")
            if bracket and name in self.by_name:
                shape = self.by_name[name].shape
                start = arrays.setdefault(name, np.full(shape, float(starts.get(name, self.by_name[name].start))))
                start.flat[self.cell_index(element) - self.offset[name]] = value
        return self.remade(self.description, changed, self.arrays | arrays)

    def start_of(self, variable: Variable) -> Floats:
        """Start values of a variable's elements, in C order."""
        found: Floats = np.broadcast_to(self.arrays.get(variable.name, variable.start), variable.shape).ravel()
        return found

    def with_arrays(self, arrays: dict[str, Floats], description: str) -> "Table":
        """The same table that starts with these outputs and states, described as such."""
        return self.remade(description, self.variables, self.arrays | arrays)

    def remade(self, description: str, variables: list[Variable], arrays: dict[str, Floats]) -> "Table":
        return Table(self.name, description, variables, self.known_at_start, self.views, self.terminals, arrays)

    def cells(self, records: Records) -> Floats:
        """The record's memory as one flat ``f8`` array (integers reinterpreted, not converted)."""
        return records.view("f8")

    def cell_range(self, name: str) -> slice:
        """Where the elements of a variable lie among the cells, in C order."""
        return slice(self.offset[name], self.offset[name] + self.by_name[name].size)

    def cell_index(self, element: str) -> int:
        """Cell (= FMI value reference) of a scalar or of ``mesh.force[i,j]``; KeyError if there is none."""
        name, _, rest = element.partition("[")
        variable = self.by_path.get(name) or self.by_name[name]
        if not rest:
            if variable.shape:
                raise KeyError(f"{variable.path} is an array of shape {variable.shape}: give indices, {variable.path}[1]")
            return self.offset[variable.name]
        try:
            index = tuple(int(i) - 1 for i in rest.rstrip("]").split(","))
            return self.offset[variable.name] + int(np.ravel_multi_index(index, variable.shape))
        except ValueError:
            raise KeyError(f"{element}: indices do not fit the shape {variable.shape} of {variable.path}") from None

    def element_at(self, cell: int) -> tuple[Variable, str]:
        """The variable that a cell belongs to and the name of its scalar."""
        for v in self.variables:
            first = self.offset[v.name]
            if first <= cell < first + v.size:
                return v, next(name for i, name in enumerate(v.element_names()) if i == cell - first)
        raise IndexError(f"{self.name} has no cell {cell}")

    def check_values(self, cells: Iterable[int], values: Iterable[float]) -> None:
        """Raise ValueFault for the first value that its variable cannot take."""
        for cell, value in zip(cells, values):
            if not 0 <= cell < self.interface_cells:
                raise ValueFault(f"{self.name} has no variable with value reference {cell}")
            variable, element = self.element_at(cell)
            if variable.role not in SETTABLE:
                raise ValueFault(f"{element} is an output of {self.name}; it cannot be set")
            variable.check(float(value), element)

    @cached_property
    def state_ranges(self) -> list[tuple[Variable, float, float]]:
        """(variable, lowest, highest) of all that makes up the state.

        Numbers that are set, and whole numbers (indices and counts of the kernels), lie within their bounds; all others need be finite alone.
        """
        return [
            (v, v.minimum, v.maximum) if v.is_integer or v.role in SETTABLE else (v, -LARGEST, LARGEST)
            for v in self.variables if v.role != "scratch"
        ]  # fmt: skip

    @cached_property
    def state_bounds(self) -> tuple[Floats, Floats, Mask]:
        """(lowest, highest, whether it is an integer) of each cell of the state."""
        sizes = [v.size for v, _, _ in self.state_ranges]
        columns = zip(*((lowest, highest, v.is_integer) for v, lowest, highest in self.state_ranges))
        lowest, highest, integers = (np.repeat(np.array(column), sizes) for column in columns)
        return lowest, highest, integers

    def check_state(self, cells: Floats) -> None:
        """Raise ValueFault unless a unit can have got to this state (its leading cells, integers reinterpreted)."""
        if len(cells) != self.state_cells:
            raise ValueFault(f"a state of {self.name} has {self.state_cells} numbers, not {len(cells)}")
        lowest, highest, integers = self.state_bounds
        values = np.where(integers, cells.view("i8"), cells)
        wrong = np.flatnonzero(~((values >= lowest) & (values <= highest)))
        if len(wrong):
            _, element = self.element_at(int(wrong[0]))
            raise ValueFault(f"the state is impossible: {element} = {values[wrong[0]]:.6g}; it was not saved by this unit")


def with_views(plain: np.dtype, views: dict[str, dict[str, str]]) -> np.dtype:
    """The record type with other records laid over it, see ``Table``."""
    if not views:
        return plain

    def overlay(fields: list[tuple[str, np.dtype, int]]) -> np.dtype:
        names, formats, offsets = zip(*fields)
        return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": plain.itemsize}, align=True)

    own = [(name, *field_of(plain, name)) for name in plain.names or ()]
    laid = [
        (view, overlay([(field, *field_of(plain, name)) for field, name in fields.items()]), 0)
        for view, fields in views.items()
    ]
    return overlay([*own, *laid, ("cells", np.dtype(("i8", (plain.itemsize // 8,))), 0)])
