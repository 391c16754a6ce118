"""FMI 3.0 model description from a table of variables: arrays stay arrays, surfaces are outputs."""

from xml.etree.ElementTree import Element, SubElement

import numpy as np

from fmu_src.description import CAUSALITY, add_log_categories, add_units, limits_of, number, starts_from, type_name
from fmu_src.project import Project
from fmu_src.variables import Table, Variable


def model_description3(table: Table, identity: str, code_hash: str, step_size: float, tool: str, made_by: Project) -> Element:
    """The ``fmiModelDescription`` element; ``fmu_src.description`` says what it declares and why."""
    root = Element(
        "fmiModelDescription", fmiVersion="3.0", modelName=table.name, instantiationToken=identity,
        description=table.description, generationTool=tool, variableNamingConvention="structured",
    )  # fmt: skip
    root.attrib.update(made_by.attributes(code_hash))
    SubElement(
        root, "CoSimulation", modelIdentifier=table.name, needsExecutionTool="false",
        canBeInstantiatedOnlyOncePerProcess="false", canGetAndSetFMUState="true", canSerializeFMUState="true",
        canHandleVariableCommunicationStepSize="true",
    )
    variables = [v for v in table.variables if table.is_visible(v)]
    add_units(root, variables)
    add_types3(root, variables)
    add_log_categories(root)
    SubElement(root, "DefaultExperiment", startTime="0", stopTime=repr(72 * step_size), stepSize=repr(step_size))
    add_variables3(root, table, variables)
    return root


def add_types3(root: Element, variables: list[Variable]) -> None:
    chosen = [v for v in variables if v.choices]
    if not chosen:
        return
    definitions = SubElement(root, "TypeDefinitions")
    for v in chosen:
        kind = SubElement(definitions, "EnumerationType", name=type_name(v))
        for value, name in enumerate(v.choices):
            SubElement(kind, "Item", name=name, value=str(value))


def add_variables3(root: Element, table: Table, variables: list[Variable]) -> None:
    """ModelVariables and ModelStructure; the value reference is a variable's first cell, the time's is one past all."""
    model_variables = SubElement(root, "ModelVariables")
    SubElement(
        model_variables, "Float64", name="time", valueReference=str(table.cell_count), causality="independent",
        variability="continuous", unit="s", description="simulation time",
    )
    unknowns = []
    for v in variables:
        causality = CAUSALITY.get(v.role, "output")
        attributes = {
            "name": v.name, "valueReference": str(table.offset[v.name]), "description": v.description,
            "causality": causality, "variability": v.variability,
            "initial": "calculated" if causality == "output" else "exact",
        }
        if v.choices:
            attributes["declaredType"] = type_name(v)
        elif v.unit != "1" and not v.is_integer:
            attributes["unit"] = v.unit
        attributes |= limits_of(v)
        if causality == "output":
            unknowns.append(v)
        else:
            attributes["start"] = " ".join(number(v, x) for x in np.broadcast_to(v.start, v.shape).ravel())
        kind = "Enumeration" if v.choices else "Int64" if v.is_integer else "Float64"
        element = SubElement(model_variables, kind, attributes)
        for size in v.shape:
            SubElement(element, "Dimension", start=str(size))
    structure = SubElement(root, "ModelStructure")
    for v in unknowns:
        SubElement(structure, "Output", valueReference=str(table.offset[v.name]), dependencies="")
    for v in unknowns:
        # New surfaces are even: what is hidden in FMI 2 depends on nothing at the start.
        dependencies = {"dependencies": ""} if v.profile else starts_from(table)
        SubElement(structure, "InitialUnknown", {"valueReference": str(table.offset[v.name]), **dependencies})
