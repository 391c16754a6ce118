"""Reading SSP's XML by local names: packages in circulation differ in prefixes, versions and care."""

import math
import re
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from lxml import etree

from fmu_src.faults import InputFault
from fmu_src.reading import quoted, reading, require_size
from fmu_src.units import BaseUnit
from orchestrator.model_description import EXPONENTS

# Of a URI, or the letter of a drive.
SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")
# Bytes of a file (assumed: thousands of units with all their connections take a tenth).
MOST = 100_000_000


def parse(path: Path) -> etree._Element:
    """The root of a file; one whose namespaces are not declared is read all the same."""
    if not path.is_file():
        raise InputFault(f"no file {path.name} in {path.parent}")
    with reading(path, "XML"):
        require_size(path, MOST)
        try:
            return etree.parse(str(path), parser()).getroot()
        except etree.XMLSyntaxError as problem:
            if "Namespace prefix" not in str(problem):
                raise
        root = etree.parse(str(path), parser(recover=True)).getroot()
        if root is None:
            raise InputFault(f"{path}: not readable as XML: it has no element")
        return root


def parser(recover: bool = False) -> etree.XMLParser:
    """Reads what stands in the file alone: no entities, nothing from elsewhere; libxml2 limits depth and size of a text."""
    return etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False, recover=recover)


def file_at(folder: Path, source: str, place: str) -> Path:
    """A file that a description in ``folder`` names; InputFault for what is no path below it."""
    name = unquote(source)
    parts = PurePosixPath(name.replace("\\", "/")).parts
    if not parts or SCHEME.match(name) or parts[0] == "/" or ".." in parts or "\0" in name:
        raise InputFault(f"{place}: source {quoted(source)} is not a file of the package; name one by its path below the description")
    return folder / name


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
        value = default if text is None else float(text)
    except ValueError:
        raise InputFault(f"{local(element)}: {key} = {quoted(text)} is not a number") from None
    if not math.isfinite(value):
        raise InputFault(f"{local(element)}: {key} = {quoted(text)}: a finite number is needed")
    return value


def whole(element: etree._Element, key: str) -> int:
    """A whole number of a few digits, 0 where there is none."""
    value = number(element, key, 0.0)
    if value != int(value) or abs(value) > 1000.0:
        raise InputFault(f"{local(element)}: {key} = {element.get(key)!r}: a whole number up to 1000 is needed")
    return int(value)


def units_of(root: etree._Element) -> dict[str, BaseUnit]:
    """The definitions in a file's ``Units``."""
    found = {}
    for unit in children(root, "Units", "Unit"):
        base = child(unit, "BaseUnit")
        if base is not None:
            exponents = tuple(whole(base, key) for key in EXPONENTS)
            factor = number(base, "factor", 1.0)
            if factor == 0.0:
                raise InputFault(f"unit {unit.get('name')!r}: factor = 0: nothing can be converted by it")
            found[unit.get("name", "")] = BaseUnit(exponents, factor, number(base, "offset", 0.0))
    return found
