"""Reading SSP's XML by local names: packages in circulation differ in prefixes, versions and care."""

from pathlib import Path

from lxml import etree

from fmu_src.faults import InputFault
from fmu_src.units import BaseUnit
from orchestrator.model_description import EXPONENTS


def parse(path: Path) -> etree._Element:
    """The root of a file; one whose namespaces are not declared is read all the same."""
    if not path.is_file():
        raise InputFault(f"no file {path.name} in {path.parent}")
    try:
        return etree.parse(str(path), etree.XMLParser(resolve_entities=False)).getroot()
    except etree.XMLSyntaxError as problem:
        if "Namespace prefix" not in str(problem):
            raise InputFault(f"{path}: not readable as XML: {problem}") from None
        return etree.parse(str(path), etree.XMLParser(resolve_entities=False, recover=True)).getroot()


def local(element: etree._Element) -> str:
    """Name of an element without namespace or prefix."""
    # Comments have a function there, which lxml's types do not tell.
    tag: object = element.tag
    return tag.rpartition("}")[2].rpartition(":")[2] if isinstance(tag, str) else ""


def children(element: etree._Element | None, *path: str) -> list[etree._Element]:
    """The elements at the end of a path of local names."""
    found = [] if element is None else [element]
    for name in path:
        found = [child for parent in found for child in parent if local(child) == name]
    return found


def child(element: etree._Element | None, *path: str) -> etree._Element | None:
    return next(iter(children(element, *path)), None)


def number(element: etree._Element, key: str, default: float) -> float:
    text = element.get(key)
    try:
        return default if text is None else float(text)
    except ValueError:
        raise InputFault(f"{local(element)}: {key} = {text!r} is not a number") from None


def units_of(root: etree._Element) -> dict[str, BaseUnit]:
    """The definitions in a file's ``Units``."""
    found = {}
    for unit in children(root, "Units", "Unit"):
        base = child(unit, "BaseUnit")
        if base is not None:
            exponents = tuple(int(base.get(key, "0")) for key in EXPONENTS)
            found[unit.get("name", "")] = BaseUnit(exponents, number(base, "factor", 1.0), number(base, "offset", 0.0))
    return found
