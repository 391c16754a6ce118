"""Write a system of FMUs as an SSP package that other tools open.

SSP 1.0 knows scalars only: an array of an FMI 2 unit is connected element by element.  FMI 3
units make a package of SSP 2.0, whose connectors are arrays of given dimensions.
Every real and integer scalar that may be set stands in a parameter file beside the FMU (or in the
description itself, for tools that read no other), with its unit, so that the system can be set
up without opening the FMUs.  Inputs that nothing
drives stand there too and are no connectors: some tools refuse, or set to zero, a
connector without a connection.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import fmpy

from fmu_src.checked_file import replacing
from fmu_src.faults import InputFault
from fmu_src.package import EPOCH
from orchestrator.component import Signal
from orchestrator.model_description import EXPONENTS, Described
from orchestrator.ssp.notes import NAMESPACES, note_in_experiment, note_in_system
from orchestrator.ssp.picture import Picture

STANDARD = "http://ssp-standard.org/SSP1/SystemStructure"
# Names of types in SSP 1.0 and, those of FMI 3, in 2.0.
TYPES = {"1.0": {"f8": "Real", "i8": "Integer", "?": "Boolean"}, "2.0": {"f8": "Float64", "i8": "Int64", "?": "Boolean"}}
# In the place of a unit's name: the system itself.
SYSTEM = "SystemStructure"
# From where to where one value goes, each as (unit, element).
Pair = tuple[tuple[str, str], tuple[str, str]]


@dataclass(frozen=True)
class Experiment:
    """``scheme`` is what this project's master is to use; other tools have their own."""

    step: float
    stop: float
    start: float = 0.0
    scheme: str = "jacobi"


class Unit:
    """One component of the system: its FMU's signals and the names of their elements."""

    def __init__(self, name: str, path: Path):
        self.name, self.path = name, path
        self.described = Described(fmpy.read_model_description(str(path), validate=False))
        self.signals = self.described.signals()
        # Of the SSP that can say what the unit has.
        self.version = "2.0" if self.described.is_fmi3 else "1.0"
        self.element_name = {
            (s.dtype, r): v for v, references in self.described.references.items() for r in references
            for s in [self.signals.get(v) or self.signals[v.partition("[")[0]]]
        }  # fmt: skip

    def names(self, variable: str) -> list[str]:
        """Names of a variable's elements as SSP connects them; an FMI 3 array is one connector."""
        if variable not in self.signals:
            if variable in self.element_name.values():
                return [variable]
            raise InputFault(f"{self.name} has no variable {variable!r}")
        signal = self.signals[variable]
        return list(dict.fromkeys(self.element_name[element] for element in signal.elements))

    def connectors(self, connected: set[tuple[str, str]]) -> dict[str, list[list[str]]]:
        """Connectors by kind and variable: connected inputs, outputs, scalar parameters."""
        parameters = {name for name, s in settable(self).items() if s.causality == "parameter"}
        found: dict[str, list[list[str]]] = {"input": [], "output": [], "parameter": []}
        for signal in self.signals.values():
            everything = signal.causality == "output" or signal.name in parameters
            names = [name for name in self.names(signal.name) if everything or (self.name, name) in connected]
            if names:
                found[signal.causality].append(names)
        return found

    def signal(self, element: str) -> Signal:
        return self.signals.get(element) or self.signals[element.partition("[")[0]]


def export_ssp(
    target: Path, name: str, fmus: dict[str, Path], connections: Iterable[tuple[str, str]],
    experiment: Experiment, settings: dict[str, dict[str, float]], description: str = "", tool: str = "rvwear", inline: bool = False,
) -> Path:  # fmt: skip
    """Write ``target`` (.ssp); ``settings`` gives units' parameters other values than the FMUs' own, ``inline`` puts all into the description."""
    if SYSTEM in fmus:
        raise InputFault(f"a unit cannot be named {SYSTEM}: that is the system's own description")
    units = {key: Unit(key, Path(path)) for key, path in fmus.items()}
    for key in settings.keys() - units.keys():
        raise InputFault(f"values for {key}, which is no unit of the system: it has {', '.join(units)}")
    pairs = [pair for source, end in connections for pair in element_pairs(units, source, end)]
    driven = {key: {name for _, (end, name) in pairs if end == key} for key in units}
    taken = {key: values(unit, settings.get(key, {}), driven[key]) for key, unit in units.items()}
    if not inline:
        taken = {key: [v for v in found if v.name in settings.get(key, {}) or not is_ambiguous(v)] for key, found in taken.items()}
    sets = {key: value_set([unit], taken[key], "") for key, unit in units.items()}
    # OMSimulator loses all values of such a unit where they are bound to it; libcosim and ecos read nothing that is bound elsewhere.
    lost = [value for found in taken.values() if any(is_ambiguous(v) for v in found) for value in found]
    if lost and not inline:
        sets[SYSTEM] = value_set(list(units.values()), lost, "{unit}.")
    root = structure(name, description, tool, units, pairs, experiment, sets, inline)
    files = {"SystemStructure.ssd": root} | ({} if inline else {f"resources/{key}.ssv": values for key, values in sets.items()})
    with replacing(target) as partial, ZipFile(partial, "w") as archive:
        for path, element in files.items():
            ElementTree.indent(element)
            add(archive, path, ElementTree.tostring(element, "utf-8", xml_declaration=True))
        for fmu in sorted({unit.path for unit in units.values()}):
            add(archive, f"resources/{fmu.name}", fmu.read_bytes())
    return target


def add(archive: ZipFile, name: str, content: bytes) -> None:
    info = ZipInfo(name, EPOCH)
    info.compress_type, info.external_attr = ZIP_DEFLATED, 0o644 << 16
    archive.writestr(info, content)


def element_pairs(units: dict[str, Unit], source: str, target: str) -> list[Pair]:
    (start, output), (end, taken) = source.split(".", 1), target.split(".", 1)
    outputs, inputs = units[start].names(output), units[end].names(taken)
    if len(outputs) != len(inputs):
        raise InputFault(f"connection {source} -> {target}: {len(outputs)} and {len(inputs)} elements")
    return [((start, a), (end, b)) for a, b in zip(outputs, inputs)]


def structure(
    name: str, description: str, tool: str, units: dict[str, Unit], pairs: list[Pair], experiment: Experiment,
    sets: dict[str, Element], inline: bool,
) -> Element:  # fmt: skip
    """SystemStructure.ssd; ``sets`` are the values by unit, which stand in it or in files of their own."""
    root = Element("ssd:SystemStructureDescription", {
        "xmlns:ssd": f"{STANDARD}Description", "xmlns:ssc": f"{STANDARD}Common",
        **{f"xmlns:{prefix}": space for prefix, space in NAMESPACES.items()},
        "version": max(unit.version for unit in units.values()), "name": name, "generationTool": tool,
    })  # fmt: skip
    system = SubElement(root, "ssd:System", name=name, description=description or name)
    if SYSTEM in sets:
        bind(system, SYSTEM, sets[SYSTEM], inline)
    elements = SubElement(system, "ssd:Elements")
    picture = Picture({key: i for i, key in enumerate(units)})
    connected = {end for pair in pairs for end in pair}
    for key, unit in units.items():
        bind(component(elements, unit, unit.connectors(connected), picture), key, sets[key], inline)
    connections = SubElement(system, "ssd:Connections")
    for start, end in pairs:
        connection = SubElement(connections, "ssd:Connection", {
            "startElement": start[0], "startConnector": start[1], "endElement": end[0], "endConnector": end[1],
        })  # fmt: skip
        picture.add_connection(connection, start, end)
    note_in_system(system, experiment.step)
    add_units(root, units.values(), "ssd:Units")
    times = SubElement(root, "ssd:DefaultExperiment", startTime=repr(experiment.start), stopTime=repr(experiment.stop))
    note_in_experiment(times, experiment.step, experiment.scheme)
    return root


def component(elements: Element, unit: Unit, kinds: dict[str, list[list[str]]], picture: Picture) -> Element:
    """One FMU with its connectors and a place in the picture."""
    element = SubElement(elements, "ssd:Component", {
        "name": unit.name, "type": "application/x-fmu-sharedlibrary", "source": f"resources/{unit.path.name}",
        "implementation": "CoSimulation", "description": unit.described.description.description or unit.name,
    })  # fmt: skip
    connectors = SubElement(element, "ssd:Connectors")
    picture.arrange(unit.name, kinds)
    for kind, name in [(kind, name) for kind, variables in kinds.items() for names in variables for name in names]:
        signal = unit.signal(name)
        connector = SubElement(connectors, "ssd:Connector", name=name, kind=kind)
        value = SubElement(connector, f"ssc:{TYPES[unit.version][signal.dtype]}")
        if signal.dtype == "f8" and signal.base_unit is not None:
            value.set("unit", signal.unit)
        if unit.version == "2.0":
            for size in signal.shape:
                SubElement(connector, "ssc:Dimension", size=str(size))
        picture.add_connector(connector, unit.name, name)
    picture.add_unit(element, unit.name)
    return element


def bind(element: Element, name: str, values: Element, inline: bool) -> None:
    """Values of a unit or of the system, or the file where they are."""
    bindings = SubElement(element, "ssd:ParameterBindings")
    if inline:
        SubElement(SubElement(bindings, "ssd:ParameterBinding"), "ssd:ParameterValues").append(values)
    else:
        SubElement(bindings, "ssd:ParameterBinding", source=f"resources/{name}.ssv")


def settable(unit: Unit) -> dict[str, Signal]:
    """Scalar real and integer parameters and inputs."""
    return {
        s.name: s for s in unit.signals.values()
        if s.causality in ("parameter", "input") and not s.shape and s.dtype in ("f8", "i8") and not s.choices
    }  # fmt: skip


@dataclass(frozen=True)
class StartValue:
    """What a scalar of a unit starts with."""

    unit: Unit
    name: str
    signal: Signal
    text: str


def is_ambiguous(value: StartValue) -> bool:
    """Whether a name begins with its unit's own: OMSimulator 3 takes that for the unit itself, finds no such variable and reads no further.

    Bound at the system, by its whole name (wear.wear.pin_share), there is nothing to mistake.
    """
    return value.name.startswith(f"{value.unit.name}.")


def values(unit: Unit, settings: dict[str, float], driven: set[str]) -> list[StartValue]:
    """The unit's own start values, but for the settings."""
    taken = {name: s for name, s in settable(unit).items() if name not in driven}
    unknown = settings.keys() - taken.keys()
    if unknown:
        raise InputFault(f"{unit.name} has no scalar parameter or open input {', '.join(sorted(unknown))}")
    starts = {v.name: v.start for v in unit.described.variables}
    return [StartValue(unit, name, s, repr(settings[name]) if name in settings else starts[name]) for name, s in taken.items()]


def value_set(units: list[Unit], values: list[StartValue], before: str) -> Element:
    """A set of values of units; ``before`` stands before each name, with the unit's in it."""
    root = Element("ssv:ParameterSet", {
        "xmlns:ssv": f"{STANDARD}ParameterValues", "xmlns:ssc": f"{STANDARD}Common", "version": max(unit.version for unit in units),
        "name": "initialValues",
    })  # fmt: skip
    parameters = SubElement(root, "ssv:Parameters")
    for value in values:
        parameter = SubElement(parameters, "ssv:Parameter", name=before.format(unit=value.unit.name) + value.name)
        kind = SubElement(parameter, f"ssv:{TYPES[value.unit.version][value.signal.dtype]}", value=value.text)
        if value.signal.dtype == "f8" and value.signal.base_unit is not None:
            kind.set("unit", value.signal.unit)
    add_units(root, units, "ssv:Units")
    return root


def add_units(root: Element, units: Iterable[Unit], tag: str) -> None:
    bases = {name: base for unit in units for name, base in unit.described.base_units.items()}
    if not bases:
        return
    element = SubElement(root, tag)
    for name, base in sorted(bases.items()):
        attributes = {key: str(value) for key, value in zip(EXPONENTS, base.exponents) if value}
        attributes |= {key: repr(v) for key, v, usual in (("factor", base.factor, 1.0), ("offset", base.offset, 0.0)) if v != usual}
        SubElement(SubElement(element, "ssc:Unit", name=name), "ssc:BaseUnit", attributes)
