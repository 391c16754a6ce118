"""Connections: checked, their units converted, and grouped into transfers of whole vectors."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from fmu_src.units import UnitError, conversion
from orchestrator.component import Component, Element, Signal


@dataclass(frozen=True)
class Connection:
    """From an output to an input: ``target = factor * (source in the target's unit) + offset``."""

    source: str
    target: str
    factor: float = 1.0
    offset: float = 0.0
    convert_unit: bool = True

    def __str__(self) -> str:
        return f"connection {self.source} -> {self.target}"


@dataclass(frozen=True)
class Link:
    """A checked connection; the unit conversion is part of ``factor`` and ``offset``."""

    connection: Connection
    source_name: str
    source: Signal
    target_name: str
    target: Signal
    factor: float
    offset: float

    def elements(self) -> list["Link"]:
        """The same, one link for each element."""
        return [
            replace(self, source=element_of(self.source, i), target=element_of(self.target, i))
            for i in range(len(self.source.references))
        ]


def element_of(signal: Signal, i: int) -> Signal:
    return replace(signal, references=signal.references[i : i + 1], shape=())


@dataclass
class Transfer:
    """All links from one component to another, moved through one buffer per type of value.

    ``values`` holds the present values of all real links in the target's units, ``held``
    what the target gets; without extrapolation they are the same array.
    """

    source: str
    target: str
    links: list[Link]
    values: Floats
    held: Floats
    reads: list[Callable[[], None]]
    writes: list[Callable[[], None]]
    factors: list[tuple[Floats, float, float]]

    holds_apart: ClassVar[bool] = False

    def fetch(self, time: float) -> None:
        """Take the source's values, which are those of ``time``."""
        for read in self.reads:
            read()
        for buffer, factor, offset in self.factors:
            buffer *= factor
            buffer += offset

    def deliver(self, start: float, end: float) -> None:
        """Hand them to the target for its step from ``start`` to ``end``."""
        for write in self.writes:
            write()

    def deliver_present(self) -> None:
        """Hand them over as they are, for a communication point."""
        for write in self.writes:
            write()

    def place(self, link: Link) -> slice | None:
        """Where a link's values stand in ``values``; None for integers."""
        first = 0
        for own in self.links:
            if own.source.dtype == "f8":
                if own.connection is link.connection and own.source.references == link.source.references:
                    return slice(first, first + len(own.source.references))
                first += len(own.source.references)
        return None


def resolve(components: dict[str, Component], path: str) -> tuple[str, Signal]:
    """``component.variable`` of a path; both may hold dots of their own."""
    dot = path.find(".")
    while dot >= 0:
        if path[:dot] in components:
            return path[:dot], components[path[:dot]].as_written(path[dot + 1 :])
        dot = path.find(".", dot + 1)
    raise InputFault(f"{path}: no component {path.partition('.')[0]!r}; there are {', '.join(components)}")


def check_connections(components: dict[str, Component], connections: Iterable[Connection | tuple[str, str]]) -> list[Link]:
    """Links of connections, given as ``Connection`` or (source, target); InputFault for a bad one."""
    driven: dict[tuple[str, Element], str] = {}
    links = []
    for given in connections:
        connection = given if isinstance(given, Connection) else Connection(*given)
        source_name, source = resolve(components, connection.source)
        target_name, target = resolve(components, connection.target)
        if target.causality != "input":
            raise InputFault(f"{connection}: {connection.target} is a {target.causality}, not an input")
        if source.causality != "output":
            raise InputFault(f"{connection}: {connection.source} is a {source.causality}, not an output")
        if source.shape != target.shape:
            raise InputFault(f"{connection}: the shapes {source.shape} and {target.shape} differ")
        if source.dtype != target.dtype:
            raise InputFault(f"{connection}: {kind_of(source)} does not fit {kind_of(target)}")
        for element in target.elements:
            if (target_name, element) in driven:
                raise InputFault(
                    f"{connection}: {connection.target} is already driven by {driven[target_name, element]}"
                )
            driven[target_name, element] = connection.source
        links.append(Link(connection, source_name, source, target_name, target, *scaling(connection, source, target)))
    return links


def kind_of(signal: Signal) -> str:
    return {"f8": "a real", "i8": "an integer", "?": "a Boolean"}[signal.dtype]


def scaling(connection: Connection, source: Signal, target: Signal) -> tuple[float, float]:
    """(factor, offset) of unit conversion and transformation together."""
    factor, offset = unit_conversion(connection, source, target) if connection.convert_unit else (1.0, 0.0)
    if (connection.factor, connection.offset) != (1.0, 0.0) and source.dtype != "f8":
        raise InputFault(f"{connection}: only real values can be transformed")
    return connection.factor * factor, connection.factor * offset + connection.offset


def unit_conversion(connection: Connection, source: Signal, target: Signal) -> tuple[float, float]:
    """By the FMUs' own definitions where both have one, else by name; a unit not given fits all."""
    if source.unit == target.unit or not (source.unit_given and target.unit_given):
        return 1.0, 0.0
    if source.base_unit is not None and target.base_unit is not None:
        found = source.base_unit.conversion(target.base_unit)
        if found is None:
            raise InputFault(f"{connection}: unit {source.unit!r} does not fit {target.unit!r}")
        return found
    try:
        return conversion(source.unit, target.unit)
    except UnitError as problem:
        raise InputFault(f"{connection}: {problem}") from None


def group_links(links: Sequence[Link]) -> dict[tuple[str, str], list[Link]]:
    """Links by (source, target), in the order of their references."""
    grouped: dict[tuple[str, str], list[Link]] = {}
    for link in sorted(links, key=lambda k: k.source.references):
        grouped.setdefault((link.source_name, link.target_name), []).append(link)
    return grouped


def make_transfer(
    components: dict[str, Component], links: list[Link], make: type[Transfer] = Transfer, **options: Any
) -> Transfer:
    """One buffer for each type of value of the links, which join the same two components.

    Where ``make`` has ``holds_apart``, what the target gets has an array of its own.
    """
    source, target = components[links[0].source_name], components[links[0].target_name]
    values = np.zeros(sum(len(k.source.references) for k in links if k.source.dtype == "f8"))
    held = values.copy() if make.holds_apart else values
    reads, writes, factors = [], [], []
    for kind in ("f8", "i8", "?"):
        chosen = [k for k in links if k.source.dtype == kind]
        if not chosen:
            continue
        size = sum(len(k.source.references) for k in chosen)
        read, written = (values, held) if kind == "f8" else [np.zeros(size, kind)] * 2
        reads.append(source.reader(tuple(r for k in chosen for r in k.source.references), read))
        writes.append(target.writer(tuple(r for k in chosen for r in k.target.references), written))
        first = 0
        for link in chosen:
            size = len(link.source.references)
            if (link.factor, link.offset) != (1.0, 0.0):
                factors.append((read[first : first + size], link.factor, link.offset))
            first += size
    return make(links[0].source_name, links[0].target_name, links, values, held, reads, writes, factors, **options)
