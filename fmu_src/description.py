"""FMI 2.0 model description from a table of variables."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from xml.etree.ElementTree import Element, SubElement

from fmu_src.display import Display, display_unit, displays
from fmu_src.project import Project
from fmu_src.table import Table
from fmu_src.unit import LOG_CATEGORIES, Specification
from fmu_src.units import conversion, fmi_base_unit
from fmu_src.variables import SETTABLE, Variable

# Relative accuracy of forces and depths at the default step.  The units hold their own error bounds (``numerics``), whatever step
# or tolerance a master asks for.
TOLERANCE = "0.001"


def guid(specification: Specification, code_hash: str) -> str:
    """Identity of a unit: the same code, sizes and start values give the same one."""
    text = code_hash + json.dumps(specification, sort_keys=True)
    digest = hashlib.sha256(text.encode()).hexdigest()
    return "{" + "-".join((digest[:8], digest[8:12], digest[12:16], digest[16:20], digest[20:32])) + "}"


def model_description(table: Table, identity: str, code_hash: str, step_size: float, tool: str, made_by: Project) -> Element:
    """The ``fmiModelDescription`` element of a co-simulation unit.

    All outputs are states of the unit: within a communication point no output depends
    on an input, so the ModelStructure declares empty dependencies.  Their initial values
    are computed from inputs and parameters alike, unless the table knows better (``known_at_start``).
    """
    root = Element(
        "fmiModelDescription", fmiVersion="2.0", modelName=table.name, guid=identity,
        description=table.description, generationTool=tool, variableNamingConvention="structured", numberOfEventIndicators="0",
    )  # fmt: skip
    root.attrib.update(made_by.attributes(code_hash))
    SubElement(
        root, "CoSimulation", modelIdentifier=table.name, needsExecutionTool="false",
        canHandleVariableCommunicationStepSize="true", canInterpolateInputs="false",
        canBeInstantiatedOnlyOncePerProcess="false", canNotUseMemoryManagementFunctions="true",
        canGetAndSetFMUstate="true", canSerializeFMUstate="true",
    )
    variables = table.interface()
    add_units(root, variables)
    add_types(root, variables)
    add_log_categories(root)
    add_experiment(root, step_size)
    add_variables(root, table, variables)
    return root


def add_log_categories(root: Element) -> None:
    categories = SubElement(root, "LogCategories")
    for name, text in LOG_CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=text)


def add_experiment(root: Element, step_size: float) -> None:
    """One crank turn in steps of the size that ``step_size`` [s] suggests."""
    times = {"startTime": "0", "stopTime": repr(72 * step_size), "stepSize": repr(step_size)}
    SubElement(root, "DefaultExperiment", times | {"tolerance": TOLERANCE})


def add_units(root: Element, variables: list[Variable], inverses: bool = False) -> None:
    """Units by what they are made of, each with those that it may be shown in; FMI 3 alone knows ``inverses``."""
    definitions = SubElement(root, "UnitDefinitions")
    for unit in sorted({v.unit for v in variables if v.unit != "1" and not v.is_integer}):
        attributes = {k: repr(v) if k in ("factor", "offset") else f"{v:g}" for k, v in fmi_base_unit(unit).items()}
        element = SubElement(definitions, "Unit", name=unit)
        SubElement(element, "BaseUnit", attributes)
        for shown in [*displays(unit), *own_displays(unit, variables)]:
            if inverses or not shown.inverse:
                how = {"offset": repr(shown.offset)} if shown.offset else {"inverse": "true"} if shown.inverse else {}
                SubElement(element, "DisplayUnit", {"name": shown.name, "factor": repr(shown.factor), **how})


def own_displays(unit: str, variables: list[Variable]) -> list[Display]:
    """What single variables of the unit are shown in beside that which all of it may be: importers refuse one that is not defined."""
    known = {unit, *(shown.name for shown in displays(unit))}
    names = sorted({v.display for v in variables if v.unit == unit and v.display} - known)
    return [Display(name, *conversion(unit, name)) for name in names]


def add_types(root: Element, variables: list[Variable]) -> None:
    chosen = [v for v in variables if v.choices]
    if not chosen:
        return
    definitions = SubElement(root, "TypeDefinitions")
    for v in chosen:
        items = SubElement(SubElement(definitions, "SimpleType", name=type_name(v)), "Enumeration")
        for value, name in enumerate(v.choices):
            SubElement(items, "Item", name=name, value=str(value))


def type_name(variable: Variable) -> str:
    return f"{variable.name}_choice"


def add_variables(root: Element, table: Table, variables: list[Variable]) -> None:
    """ModelVariables and ModelStructure; the value reference is the cell of the record."""
    model_variables = SubElement(root, "ModelVariables")
    positions: dict[str, list[int]] = {}
    position = 0
    for v in variables:
        starts = table.start_of(v)
        for i, name in enumerate(v.element_names()):
            position += 1
            attributes = {
                "name": name, "valueReference": str(table.offset[v.name] + i), "description": v.description,
                "causality": v.role, "variability": v.variability,
            }
            if v.role not in SETTABLE:
                attributes["initial"] = "calculated"
            elif v.role == "parameter":
                attributes["initial"] = "exact"
            scalar = SubElement(model_variables, "ScalarVariable", attributes)
            add_type(scalar, v, starts[i])
            positions.setdefault(v.name, []).append(position)
    structure = SubElement(root, "ModelStructure")
    outputs = SubElement(structure, "Outputs")
    initial = SubElement(structure, "InitialUnknowns")
    for v in table.of_role("output"):
        known = starts_from(table, v, positions)
        for position in positions[v.name]:
            SubElement(outputs, "Unknown", index=str(position), dependencies="")
            SubElement(initial, "Unknown", {"index": str(position), **known})


def starts_from(table: Table, v: Variable, numbers: Mapping[str, Iterable[int]]) -> dict[str, str]:
    """What the initial value is computed from, by the numbers of the variables; none declared means "depends on all"."""
    known = table.known_at_start.get(v.name)
    return {} if known is None else {"dependencies": " ".join(str(n) for name in known for n in numbers[name])}


def number(v: Variable, value: float) -> str:
    return str(int(value)) if v.is_integer else repr(float(value))


def shown_in(v: Variable) -> dict[str, str]:
    name = display_unit(v)
    return {"displayUnit": name} if name else {}


def limits_of(v: Variable) -> dict[str, str]:
    """Attributes min, max and, for reals, nominal: the same in both versions."""
    limits = {"min": number(v, v.minimum), "max": number(v, v.maximum)}
    return limits if v.is_integer else limits | {"nominal": number(v, v.nominal)}


def add_type(scalar: Element, v: Variable, start: float) -> None:
    attributes = {}
    if v.choices:
        kind = "Enumeration"
        attributes["declaredType"] = type_name(v)
    elif v.is_integer:
        kind = "Integer"
    else:
        kind = "Real"
        if v.unit != "1":
            attributes["unit"] = v.unit
            attributes |= shown_in(v)
    attributes |= limits_of(v)
    if v.role in SETTABLE:
        attributes["start"] = number(v, start)
    SubElement(scalar, kind, attributes)
