"""Write a system of FMUs as an SSP 1.0 package that other tools open.

SSP 1.0 knows scalars only: an array of an FMI 2 unit is connected element by element.
Every real and integer scalar that may be set stands in a parameter file beside the FMU, with
its unit, so that the system can be set up without opening the FMUs.  Inputs that nothing
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

STANDARD = "http://ssp-standard.org/SSP1/SystemStructure"
TYPES = {"f8": "Real", "i8": "Integer", "?": "Boolean"}
# Annotations in which masters look for the communication step.
OSP = "http://opensimulationplatform.com/SSP/OSPAnnotations"
WIDTH, HEIGHT, GAP = 60.0, 40.0, 40.0
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

    def signal(self, element: str) -> Signal:
        return self.signals.get(element) or self.signals[element.partition("[")[0]]


def export_ssp(
    target: Path, name: str, fmus: dict[str, Path], connections: Iterable[tuple[str, str]],
    experiment: Experiment, settings: dict[str, dict[str, float]], description: str = "", tool: str = "rvwear",
) -> Path:  # fmt: skip
    """Write ``target`` (.ssp); ``settings`` gives units' parameters other values than the FMUs' own."""
    units = {key: Unit(key, Path(path)) for key, path in fmus.items()}
    pairs = [pair for source, end in connections for pair in element_pairs(units, source, end)]
    files = {"SystemStructure.ssd": structure(name, description, tool, units, pairs, experiment)}
    for unit in units.values():
        files[f"resources/{unit.name}.ssv"] = values(
            unit, settings.get(unit.name, {}), {name for _, (end, name) in pairs if end == unit.name})
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
    name: str, description: str, tool: str, units: dict[str, Unit], pairs: list[Pair], experiment: Experiment
) -> Element:
    """SystemStructure.ssd."""
    root = Element("ssd:SystemStructureDescription", {
        # libcosim takes an attribute of osp:Algorithm for another algorithm: its namespace is declared here.
        "xmlns:ssd": f"{STANDARD}Description", "xmlns:ssc": f"{STANDARD}Common", "xmlns:osp": OSP,
        "version": "1.0", "name": name, "generationTool": tool,
    })  # fmt: skip
    system = SubElement(root, "ssd:System", name=name, description=description or name)
    elements = SubElement(system, "ssd:Elements")
    for i, unit in enumerate(units.values()):
        component(elements, unit, i, {end for pair in pairs for end in pair})
    connections = SubElement(system, "ssd:Connections")
    for (start, output), (end, taken) in pairs:
        SubElement(connections, "ssd:Connection", {
            "startElement": start, "startConnector": output, "endElement": end, "endConnector": taken,
        })  # fmt: skip
    add_units(root, units.values(), "ssd:Units")
    times = {"startTime": repr(experiment.start), "stopTime": repr(experiment.stop)}
    annotations = SubElement(SubElement(root, "ssd:DefaultExperiment", times), "ssd:Annotations")
    own = SubElement(annotations, "ssc:Annotation", type="rvwear.master")
    SubElement(own, "Master", step=repr(experiment.step), scheme=experiment.scheme)
    other = SubElement(annotations, "ssc:Annotation", type="com.opensimulationplatform")
    algorithm = SubElement(other, "osp:Algorithm")
    SubElement(algorithm, "osp:FixedStepAlgorithm", baseStepSize=repr(experiment.step))
    return root


def component(elements: Element, unit: Unit, i: int, connected: set[tuple[str, str]]) -> None:
    """One FMU with its connected inputs, its outputs, scalar parameters, and a place in the diagram."""
    element = SubElement(elements, "ssd:Component", {
        "name": unit.name, "type": "application/x-fmu-sharedlibrary", "source": f"resources/{unit.path.name}",
        "implementation": "CoSimulation", "description": unit.described.description.description or unit.name,
    })  # fmt: skip
    parameters = {name for name, s in settable(unit).items() if s.causality == "parameter"}
    connectors = SubElement(element, "ssd:Connectors")
    for signal in unit.signals.values():
        for name in unit.names(signal.name):
            if not (signal.causality == "output" or signal.name in parameters or (unit.name, name) in connected):
                continue
            connector = SubElement(connectors, "ssd:Connector", name=name, kind=signal.causality)
            kind = SubElement(connector, f"ssc:{TYPES[signal.dtype]}")
            if signal.dtype == "f8" and signal.base_unit is not None:
                kind.set("unit", signal.unit)
    left = i * (WIDTH + GAP)
    corners = {"x1": left, "y1": 0.0, "x2": left + WIDTH, "y2": HEIGHT}
    SubElement(element, "ssd:ElementGeometry", {key: repr(value) for key, value in corners.items()})
    bindings = SubElement(element, "ssd:ParameterBindings")
    SubElement(bindings, "ssd:ParameterBinding", source=f"resources/{unit.name}.ssv")


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
        "xmlns:ssv": f"{STANDARD}ParameterValues", "xmlns:ssc": f"{STANDARD}Common", "version": "1.0", "name": "initialValues",
    })  # fmt: skip
    parameters = SubElement(root, "ssv:Parameters")
    for name, signal in taken.items():
        parameter = SubElement(parameters, "ssv:Parameter", name=name)
        value = repr(settings[name]) if name in settings else starts[name]
        kind = SubElement(parameter, f"ssv:{TYPES[signal.dtype]}", value=value)
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
