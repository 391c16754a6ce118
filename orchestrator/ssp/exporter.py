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
    units = {key: Unit(key, Path(path)) for key, path in fmus.items()}
    for key in settings.keys() - units.keys():
        raise InputFault(f"values for {key}, which is no unit of the system: it has {', '.join(units)}")
    pairs = [pair for source, end in connections for pair in element_pairs(units, source, end)]
    sets = {key: values(unit, settings.get(key, {}), {name for _, (end, name) in pairs if end == key}) for key, unit in units.items()}
    root = structure(name, description, tool, units, pairs, experiment, sets if inline else None)
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
    inline: dict[str, Element] | None,
) -> Element:  # fmt: skip
    """SystemStructure.ssd; ``inline`` holds the units' values if they are to stand in it."""
    root = Element("ssd:SystemStructureDescription", {
        "xmlns:ssd": f"{STANDARD}Description", "xmlns:ssc": f"{STANDARD}Common",
        **{f"xmlns:{prefix}": space for prefix, space in NAMESPACES.items()},
        "version": max(unit.version for unit in units.values()), "name": name, "generationTool": tool,
    })  # fmt: skip
    system = SubElement(root, "ssd:System", name=name, description=description or name)
    elements = SubElement(system, "ssd:Elements")
    picture = Picture({key: i for i, key in enumerate(units)})
    connected = {end for pair in pairs for end in pair}
    for key, unit in units.items():
        component(elements, unit, unit.connectors(connected), picture, None if inline is None else inline[key])
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


def component(elements: Element, unit: Unit, kinds: dict[str, list[list[str]]], picture: Picture, inline: Element | None) -> None:
    """One FMU with its connectors, a place in the picture, and its values or where they are."""
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
    bindings = SubElement(element, "ssd:ParameterBindings")
    if inline is None:
        SubElement(bindings, "ssd:ParameterBinding", source=f"resources/{unit.name}.ssv")
    else:
        SubElement(SubElement(bindings, "ssd:ParameterBinding"), "ssd:ParameterValues").append(inline)


def settable(unit: Unit) -> dict[str, Signal]:
    """Scalar real and integer parameters and inputs."""
    return {
        s.name: s for s in unit.signals.values()
        if s.causality in ("parameter", "input") and not s.shape and s.dtype in ("f8", "i8") and not s.choices
    }  # fmt: skip


def values(unit: Unit, settings: dict[str, float], driven: set[str]) -> Element:
    """A parameter set with the unit's own start values, but for the settings."""
    taken = {name: s for name, s in settable(unit).items() if name not in driven}
    unknown = settings.keys() - taken.keys()
    if unknown:
        raise InputFault(f"{unit.name} has no scalar parameter or open input {', '.join(sorted(unknown))}")
    starts = {v.name: v.start for v in unit.described.variables}
    root = Element("ssv:ParameterSet", {
        "xmlns:ssv": f"{STANDARD}ParameterValues", "xmlns:ssc": f"{STANDARD}Common", "version": unit.version, "name": "initialValues",
    })  # fmt: skip
    parameters = SubElement(root, "ssv:Parameters")
    for name, signal in taken.items():
        if name.startswith(f"{unit.name}.") and name not in settings:
            # OMSimulator 3 takes the first part for the unit itself, finds no such variable and reads no further.
            continue
        parameter = SubElement(parameters, "ssv:Parameter", name=name)
        value = repr(settings[name]) if name in settings else starts[name]
        kind = SubElement(parameter, f"ssv:{TYPES[unit.version][signal.dtype]}", value=value)
        if signal.dtype == "f8" and signal.base_unit is not None:
            kind.set("unit", signal.unit)
    add_units(root, [unit], "ssv:Units")
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
