"""A system structure description, flattened: FMUs, their connections and parameter values.

Connectors of nested systems are only passed through: a connection is traced from a unit's
input back to a unit's output, the transformations on the way composed.  Units are
converted before a transformation is applied, as the standard says.
"""

from dataclasses import dataclass, field, replace
from pathlib import Path
from zipfile import is_zipfile

from lxml import etree

from fmu_src.faults import InputFault
from fmu_src.reading import reading, unpack_archive
from fmu_src.units import BaseUnit
from orchestrator.master import Connection
from orchestrator.scratch import Scratch
from orchestrator.ssp.parameters import Parameter, read_bindings
from orchestrator.ssp.xml import child, children, file_at, local, number, parse, units_of

MAIN_FILE = "SystemStructure.ssd"
# Whatever comes after the point.
KNOWN_VERSIONS = ("1", "2")
# Systems in systems, systems and components in all, connectors that a value is handed on through (all assumed, far beyond what is built).
DEEPEST, MOST_ELEMENTS, MOST_HOPS = 20, 5000, 200
# A path of element names from the top, and a connector there.
Node = tuple[tuple[str, ...], str]
MAPPINGS = ("BooleanMappingTransformation", "IntegerMappingTransformation", "EnumerationMappingTransformation")
# Where tools note their communication step: element and attribute, whatever the namespace.
STEP_NOTES = (("Master", "step"), ("FixedStepAlgorithm", "baseStepSize"), ("FixedStepMaster", "stepSize"))


@dataclass(frozen=True)
class Edge:
    """A connection as written, seen from its end."""

    start: Node
    factor: float
    offset: float
    convert_unit: bool


@dataclass
class Structure:
    """A flattened system.  Unit names are paths joined by dots."""

    name: str = "system"
    fmus: dict[str, Path] = field(default_factory=dict)
    connections: list[Connection] = field(default_factory=list)
    parameters: list[tuple[str, str, Parameter]] = field(default_factory=list)
    open_inputs: list[str] = field(default_factory=list)
    # Dimensions of array connectors (SSP 2.0), by unit and connector, where all are given.
    shapes: dict[tuple[str, str], tuple[int, ...]] = field(default_factory=dict)
    start: float = 0.0
    stop: float | None = None
    step: float | None = None
    scheme: str | None = None
    notes: list[str] = field(default_factory=list)
    folders: list[Scratch] = field(default_factory=list)


class Importer:
    """Walks the systems and collects what the structure is made of."""

    def __init__(self) -> None:
        self.structure = Structure()
        # Descriptions that are being read, the outermost first.
        self.within: list[Path] = []
        self.units: dict[tuple[str, ...], Path] = {}
        self.systems: list[tuple[str, ...]] = []
        self.edges: dict[Node, Edge] = {}
        self.connector_units: dict[Node, BaseUnit] = {}
        self.kinds: dict[Node, str] = {}
        self.bound: list[tuple[tuple[str, ...], Parameter]] = []

    def open(self, path: Path) -> Path:
        """The description's file; a package is unpacked into a folder that goes with the structure."""
        if path.is_dir():
            return path / MAIN_FILE
        if path.suffix == ".ssd":
            return path
        if not path.is_file():
            raise InputFault(f"no SSP at {path}")
        folder = Scratch()
        self.structure.folders.append(folder)
        if not is_zipfile(path):
            raise InputFault(f"{path} is not an SSP package: it is no zip archive")
        unpack_archive(path, folder.path, "SSP package")
        return folder.path / MAIN_FILE

    def read(self, path: Path, place: tuple[str, ...]) -> etree._Element:
        """One description, its system at ``place``; returns its root."""
        if len(self.within) >= DEEPEST:
            raise InputFault(f"{path}: systems within systems more than {DEEPEST} deep; does one contain itself?")
        file = self.open(path)
        if file.resolve() in self.within:
            raise InputFault(f"{path}: the system contains itself, as {'.'.join(place)}: take it out of it")
        self.within.append(file.resolve())
        root = parse(file)
        if local(root) != "SystemStructureDescription":
            raise InputFault(f"{file}: a {local(root)}, not a SystemStructureDescription")
        if root.get("version", "1.0").split(".")[0] not in KNOWN_VERSIONS:
            raise InputFault(f"{file}: SSP version {root.get('version')!r} is not known; versions {' and '.join(KNOWN_VERSIONS)} are")
        system = child(root, "System")
        if system is None:
            raise InputFault(f"{file}: no System")
        # What a package names is in it; a system that was unpacked by hand stands where its author put it.
        self.walk(system, place, file.parent, units_of(root))
        self.within.pop()
        return root

    def walk(self, system: etree._Element, place: tuple[str, ...], folder: Path, units: dict[str, BaseUnit]) -> None:
        if len(self.systems) + len(self.units) > MOST_ELEMENTS:
            raise InputFault(f"more than {MOST_ELEMENTS} systems and components; run parts of it on their own")
        if len(place) > DEEPEST:
            raise InputFault(f"{'.'.join(place[:3])} ...: systems within systems more than {DEEPEST} deep")
        self.systems.append(place)
        self.connectors(system, place, units)
        self.bound += [(place, p) for p in read_bindings(system, folder)]
        for element in [e for group in children(system, "Elements") for e in group]:
            inner = (*place, element.get("name", ""))
            if local(element) == "System":
                self.walk(element, inner, folder, units)
            elif local(element) == "Component":
                self.component(element, inner, folder, units)
            elif local(element):
                raise InputFault(f"{'.'.join(inner)}: a {local(element)} cannot be run; only systems and components can")
        for connection in children(system, "Connections", "Connection"):
            self.connection(connection, place)

    def connectors(self, element: etree._Element, place: tuple[str, ...], units: dict[str, BaseUnit]) -> None:
        for connector in children(element, "Connectors", "Connector"):
            node = place, connector.get("name", "")
            self.kinds[node] = connector.get("kind", "")
            named = next((unit for e in connector if (unit := e.get("unit"))), None)
            if named in units:
                self.connector_units[node] = units[named]
            sizes = [d.get("size") for d in children(connector, "Dimension")]
            if sizes and None not in sizes:
                self.structure.shapes[".".join(place), node[1]] = sizes_of(node, sizes)

    def component(self, element: etree._Element, place: tuple[str, ...], folder: Path, units: dict[str, BaseUnit]) -> None:
        path = file_at(folder, element.get("source", ""), ".".join(place))
        if path.suffix in (".ssp", ".ssd"):
            self.read(path, place)
        else:
            self.units[place] = path
            self.connectors(element, place, units)
        self.bound += [(place, p) for p in read_bindings(element, folder)]

    def connection(self, element: etree._Element, place: tuple[str, ...]) -> None:
        ends = []
        for side in ("start", "end"):
            name = element.get(f"{side}Element")
            ends.append(((*place, name) if name else place, element.get(f"{side}Connector", "")))
        start, end = ends
        # Which way values go is a matter of the connectors' kinds, not of what was written first.
        if self.gives(end, place) and not self.gives(start, place):
            start, end = end, start
        for part in ("startIndices", "endIndices"):
            if element.get(part):
                raise InputFault(f"connection to {text_of(end)}: {part} = {element.get(part)!r} is not supported; connect whole arrays")
        for transformation in MAPPINGS:
            if child(element, transformation) is not None:
                raise InputFault(f"connection to {text_of(end)}: {transformation} is not supported")
        linear = child(element, "LinearTransformation")
        factor, offset = (1.0, 0.0) if linear is None else (number(linear, "factor", 1.0), number(linear, "offset", 0.0))
        if end in self.edges:
            raise InputFault(f"connection {text_of(start)} -> {text_of(end)}: driven already by {text_of(self.edges[end].start)}")
        self.edges[end] = Edge(start, factor, offset, element.get("suppressUnitConversion", "false") not in ("true", "1"))

    def gives(self, node: Node, place: tuple[str, ...]) -> bool:
        """Whether a connector is a source within the system at ``place``: its own are seen from inside."""
        return self.kinds.get(node) in (("input", "parameter") if node[0] == place else ("output", "calculatedParameter"))

    def trace(self, end: Node) -> Connection | None:
        """The connection that ends at a unit's input; None if it begins outside the system."""
        node, factor, offset, convert = end, 1.0, 0.0, True
        passed: set[Node] = set()
        while node[0] not in self.units or node == end:
            if node in passed:
                raise InputFault(f"connection to {text_of(end)}: it goes in a circle through {text_of(node)}; let it begin at an output")
            passed.add(node)
            edge = self.edges.get(node)
            if edge is None:
                return None
            # Later hops act on what the earlier ones give.
            offset += factor * edge.offset
            factor *= edge.factor
            convert = convert and edge.convert_unit
            node = edge.start
        given, taken = self.connector_units.get(node), self.connector_units.get(end)
        if convert and given is not None and taken is not None:
            found = given.conversion(taken)
            if found is None:
                raise InputFault(f"connection {text_of(node)} -> {text_of(end)}: the units of the connectors do not fit")
            offset += factor * found[1]
            factor *= found[0]
            convert = False
        return Connection(text_of(node), text_of(end), factor, offset, convert)

    def bind(self, place: tuple[str, ...], parameter: Parameter, hops: int = 0) -> None:
        """Find the unit's variable that a value is for; a name that fits nothing is noted, as the standard allows it."""
        if hops > MOST_HOPS:
            raise InputFault(f"parameter {text_of((place, parameter.name))}: it goes in a circle from connector to connector")
        if place in self.units:
            self.structure.parameters.append((".".join(place), parameter.name, parameter))
            return
        if (place, parameter.name) in self.kinds:
            # A connector of this system hands the value on to what it is connected with.
            for inner, connector in [end for end, edge in self.edges.items() if edge.start == (place, parameter.name)]:
                self.bind(inner, replace(parameter, name=connector), hops + 1)
            return
        # The longest path of elements that the name begins with.
        below = [p for p in (*self.units, *self.systems) if p != place and p[: len(place)] == place]
        for inner in sorted(below, key=len, reverse=True):
            prefix = ".".join(inner[len(place) :]) + "."
            if parameter.name.startswith(prefix):
                self.bind(inner, replace(parameter, name=parameter.name[len(prefix) :]), hops + 1)
                return
        self.structure.notes.append(text_of((place, parameter.name)))

    def finish(self, root: etree._Element) -> Structure:
        structure = self.structure
        structure.name = root.get("name") or "system"
        structure.fmus = {".".join(place): path for place, path in self.units.items()}
        if len(structure.fmus) != len(self.units):
            raise InputFault("two components have the same name, counted with the systems that they are in; rename one")
        for end in [node for node in self.edges if node[0] in self.units]:
            connection = self.trace(end)
            if connection is None:
                structure.open_inputs.append(text_of(end))
            else:
                structure.connections.append(connection)
        for place, parameter in self.bound:
            self.bind(place, parameter)
        experiment = child(root, "DefaultExperiment")
        if experiment is not None:
            structure.start = number(experiment, "startTime", 0.0)
            structure.stop = number(experiment, "stopTime", 0.0) if experiment.get("stopTime") else None
        for name, attribute in STEP_NOTES:
            for element in root.iter():
                if local(element) == name and element.get(attribute) and structure.step is None:
                    structure.step = number(element, attribute, 0.0)
                    structure.scheme = element.get("scheme")
        return structure


def sizes_of(node: Node, sizes: list[str | None]) -> tuple[int, ...]:
    try:
        return tuple(int(size or "") for size in sizes)
    except ValueError:
        raise InputFault(f"connector {text_of(node)}: Dimension size = {', '.join(map(repr, sizes))}: a whole number is needed") from None


def text_of(node: Node) -> str:
    return ".".join((*node[0], node[1]))


def read_ssp(path: str | Path) -> Structure:
    """The flattened system of a package (.ssp), a folder with one unpacked, or an .ssd file."""
    importer = Importer()
    with reading(Path(path), "a system structure (SSP)"):
        return importer.finish(importer.read(Path(path), ()))
