"""Where units, their connectors and the connections stand on a system's picture.

Units stand in a row.  A unit has its inputs on the left, its outputs on the right, in the order
of its variables, and its parameters along the lower edge; the elements of an array share
what one variable has.  A connection that goes back passes below the units.  The system's own
frame (SystemGeometry) is left to tools: OMSimulator 3 refuses a package that has one.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from xml.etree.ElementTree import Element, SubElement

WIDTH, HEIGHT, GAP = 60.0, 40.0, 40.0
# How far from a unit, and below the row, a connection goes round.
CLEAR = 8.0


@dataclass
class Picture:
    """Places of the connectors of units in a row; ``places`` are within a unit, from its lower left (0, 0) to its upper right (1, 1)."""

    rank: dict[str, int]
    places: dict[tuple[str, str], tuple[float, float]] = field(default_factory=dict)

    def arrange(self, unit: str, sides: Mapping[str, Sequence[Sequence[str]]]) -> None:
        """Find places; ``sides`` are the variables' connectors by kind (input, output, parameter)."""
        for kind, variables in sides.items():
            for i, names in enumerate(variables):
                for k, name in enumerate(names):
                    along = round((i + (k + 0.5) / len(names)) / len(variables), 5)
                    beside = {"input": (0.0, 1.0 - along), "output": (1.0, 1.0 - along)}
                    self.places[unit, name] = beside.get(kind, (along, 0.0))

    def left(self, unit: str) -> float:
        return self.rank[unit] * (WIDTH + GAP)

    def add_unit(self, element: Element, unit: str) -> None:
        corners = {"x1": self.left(unit), "y1": 0.0, "x2": self.left(unit) + WIDTH, "y2": HEIGHT}
        SubElement(element, "ssd:ElementGeometry", {key: repr(value) for key, value in corners.items()})

    def add_connector(self, element: Element, unit: str, name: str) -> None:
        x, y = self.places[unit, name]
        SubElement(element, "ssd:ConnectorGeometry", x=f"{x:g}", y=f"{y:g}")

    def add_connection(self, element: Element, start: tuple[str, str], end: tuple[str, str]) -> None:
        """The way between the ends, without these: only where a straight line would cross units."""
        if self.rank[start[0]] < self.rank[end[0]]:
            return
        leaves, arrives = self.left(start[0]) + WIDTH + CLEAR, self.left(end[0]) - CLEAR
        heights = [HEIGHT * self.places[node][1] for node in (start, end)]
        points = [(leaves, heights[0]), (leaves, -CLEAR), (arrives, -CLEAR), (arrives, heights[1])]
        SubElement(element, "ssd:ConnectionGeometry", {
            "pointsX": " ".join(f"{x:g}" for x, _ in points), "pointsY": " ".join(f"{y:g}" for _, y in points),
        })  # fmt: skip
