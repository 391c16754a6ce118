"""Terminals: which variables belong to one place of the machine, and what a tool draws there (FMI 3.0, terminalsAndIcons)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from xml.etree.ElementTree import Element, SubElement, indent, tostring

# Colours of lines to a terminal, red green blue, by its icon.
COLOURS = {"flange": "110 110 110", "heat": "191 0 0", "bus": "255 204 51"}
HALF = 12.0


@dataclass(frozen=True)
class Member:
    """A variable, by its structured name; ``kind`` is FMI's: signal, or inflow and outflow of what is conserved."""

    name: str
    variable: str
    kind: str = "signal"


@dataclass(frozen=True)
class Terminal:
    """``rule`` is FMI's: plug joins terminals of the same members, bus those members that both have.

    ``place`` is where its middle stands on the unit's icon, from -100 to 100, x to the right and y up.
    """

    name: str
    description: str
    icon: str
    rule: str
    place: tuple[float, float]
    members: Sequence[Member]

    @property
    def kind(self) -> str:
        return f"rvwear.{self.icon}"


def terminals_file(terminals: Sequence[Terminal], names_of: Callable[[str], Sequence[str]]) -> bytes:
    """terminalsAndIcons.xml; ``names_of`` gives the names that a description has for a variable's parts."""
    root = Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    picture = SubElement(root, "GraphicalRepresentation")
    corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    SubElement(picture, "CoordinateSystem", corners, suggestedScalingFactorTo_mm="0.1")
    SubElement(picture, "Icon", corners)
    if terminals:
        group = SubElement(root, "Terminals")
        for terminal in terminals:
            add_terminal(group, terminal, names_of)
    indent(root)
    text: bytes = tostring(root, "utf-8", xml_declaration=True)
    return text + b"\n"


def add_terminal(group: Element, terminal: Terminal, names_of: Callable[[str], Sequence[str]]) -> None:
    element = SubElement(
        group, "Terminal", name=terminal.name, matchingRule=terminal.rule, terminalKind=terminal.kind, description=terminal.description,
    )  # fmt: skip
    for member in terminal.members:
        for name in names_of(member.variable):
            called = member.name + name[len(member.variable) :]
            SubElement(element, "TerminalMemberVariable", variableName=name, memberName=called, variableKind=member.kind)
    (x, y), half = terminal.place, HALF
    SubElement(
        element, "TerminalGraphicalRepresentation", defaultConnectionColor=COLOURS[terminal.icon], defaultConnectionStrokeSize="0.5",
        x1=f"{x - half:g}", y1=f"{y - half:g}", x2=f"{x + half:g}", y2=f"{y + half:g}", iconBaseName=terminal.icon,
    )  # fmt: skip
