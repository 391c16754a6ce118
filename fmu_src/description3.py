"""FMI 3.0 model description from a table of variables: arrays stay arrays, surfaces are local variables."""

from xml.etree.ElementTree import Element, SubElement

from fmu_src.description import add_experiment, add_log_categories, add_units, limits_of, number, shown_in, starts_from, type_name
from fmu_src.project import Project
from fmu_src.table import Table
from fmu_src.variables import SETTABLE, Variable


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
    add_units(root, variables, inverses=True)
    add_types3(root, variables)
    add_log_categories(root)
    add_experiment(root, step_size)
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
    for v in variables:
        causality = "local" if v.profile else v.role
        attributes = {
            "name": v.path, "valueReference": str(table.offset[v.name]), "description": v.description,
            "causality": causality, "variability": v.variability,
            "initial": "exact" if causality in SETTABLE else "calculated",
        }
        if v.choices:
            attributes["declaredType"] = type_name(v)
        elif v.unit != "1" and not v.is_integer:
            attributes["unit"] = v.unit
            attributes |= shown_in(v)
        attributes |= limits_of(v)
        if causality in SETTABLE:
            attributes["start"] = " ".join(number(v, x) for x in table.start_of(v))
        kind = "Enumeration" if v.choices else "Int64" if v.is_integer else "Float64"
        element = SubElement(model_variables, kind, attributes)
        for _, size in v.seen_axes:
            SubElement(element, "Dimension", start=str(size))
    structure = SubElement(root, "ModelStructure")
    outputs = table.of_role("output")
    for v in outputs:
        SubElement(structure, "Output", valueReference=str(table.offset[v.name]), dependencies="")
    references = {v.name: [table.offset[v.name]] for v in variables}
    for v in outputs:
        known = starts_from(table, v, references)
        SubElement(structure, "InitialUnknown", {"valueReference": str(table.offset[v.name]), **known})
