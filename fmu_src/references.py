"""FMI-LS-REF: what an FMU carries besides itself, with the role of each file, and experiments that can be done with it.

Written after release 1.0.0-beta.1 of the layered standard (Modelica Association, FMI and COORD projects) and the draft of
its format for experiments, MA-HS-Experiments, as its schema stood in mid 2026.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
MANIFEST = f"{FOLDER}/fmi-ls-manifest.xml"
NAME = "org.fmi-standard.fmi-ls-ref"
VERSION = "1.0.0-beta.1"
MANIFEST_SPACE = "http://fmi-standard.org/fmi-ls-manifest"
# The one that the standard prescribes.
DESCRIPTION = "Layered Standard providing information on related files included in an FMU."
EXPERIMENTS, VALUES = "application/x-ma-hs-experiments", "application/x-ssp-parameter-set"
# Within the FMU, as seen from the manifest.
DOCUMENTATION = "../../documentation"


@dataclass(frozen=True)
class Related:
    """One file: its MIME type, place as seen from the manifest, role; ``labels`` tell variants apart."""

    kind: str
    source: str
    role: str
    description: str
    labels: tuple[str, ...] = ()


@dataclass(frozen=True)
class Experiment:
    """A run over time: values (SSV) and inputs over time (CSV) to apply, and what must come out (CSV); "" where there is none."""

    name: str
    description: str
    stop: float
    step: float
    tolerance: float
    references: str
    stimuli: str = ""
    parameters: str = ""


def manifest(files: Iterable[Related]) -> bytes:
    """fmi-ls-manifest.xml."""
    root = Element("fmiReferences", {
        "xmlns:fmi-ls": MANIFEST_SPACE, "fmi-ls:fmi-ls-name": NAME, "fmi-ls:fmi-ls-version": VERSION,
        "fmi-ls:fmi-ls-description": DESCRIPTION,
    })  # fmt: skip
    for file in files:
        element = SubElement(root, "Related", type=file.kind, source=file.source, role=file.role, description=file.description)
        for label in file.labels:
            SubElement(element, "Label", name=label)
    return written(root)


def experiments(name: str, described: Iterable[Experiment]) -> bytes:
    """An .exp file."""
    root = Element("Experiments", name=name)
    for e in described:
        element = SubElement(root, "Experiment", name=e.name, description=e.description, tolerance=repr(e.tolerance))
        SubElement(element, "TransientSimulation", startTime="0", stopTime=repr(e.stop), stepSize=repr(e.step))
        if e.parameters:
            SubElement(element, "Parameters", type=VALUES, source=e.parameters)
        if e.stimuli:
            SubElement(element, "Stimuli", type="text/csv", source=e.stimuli)
        SubElement(element, "References", type="text/csv", source=e.references)
    return written(root)


def written(root: Element) -> bytes:
    ElementTree.indent(root)
    text: bytes = ElementTree.tostring(root, "utf-8", xml_declaration=True)
    return text
