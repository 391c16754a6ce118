"""Icons of units and terminals, drawn here: as PNG, which FMI asks for, and as SVG."""

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt

from fmu_src.arrays import Floats

Bytes = npt.NDArray[np.uint8]
# Each pixel is the mean of so many squared.
FINE = 4
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 -100 200 200">'


@dataclass(frozen=True)
class Disc:
    """Within a circle, or a curve of ``lobes`` waves of a height about it; in units of half the picture, y up."""

    x: float
    y: float
    radius: float
    colour: str
    lobes: int = 0
    height: float = 0.0

    def edge(self, angle: Floats) -> Floats:
        """Its radius in a direction [rad]."""
        edge: Floats = self.radius - self.height * np.cos(self.lobes * angle)
        return edge


def reducer() -> Iterator[Disc]:
    """A cycloid disc between pins on three cranks, the lowest layer first."""
    eccentricity, lobes = 0.05, 15

    def around(count: int, radius: float) -> Iterator[tuple[float, float]]:
        angles = 2.0 * np.pi * np.arange(count) / count
        return zip(radius * np.cos(angles), radius * np.sin(angles))

    yield Disc(0.0, 0.0, 0.97, "#4a5d73")
    yield Disc(0.0, 0.0, 0.88, "#dfe6ee")
    for x, y in around(lobes + 1, 0.86):
        yield Disc(x, y, 0.07, "#1f2d3d")
    yield Disc(eccentricity, 0.0, 0.77, "#8fa9c4", lobes, eccentricity)
    for x, y in around(3, 0.42):
        yield Disc(x + eccentricity, y, 0.19, "#dfe6ee")
        yield Disc(x + eccentricity, y, 0.13, "#c46a2b")
        yield Disc(x, y, 0.06, "#1f2d3d")
    yield Disc(eccentricity, 0.0, 0.15, "#dfe6ee")
    yield Disc(0.0, 0.0, 0.08, "#1f2d3d")


# Flange: the end of a shaft; heat: a diamond; bus: a hexagon.  A diamond or hexagon is a polygon of so many corners.
CORNERS = {"flange": 0, "heat": 4, "bus": 6}
FILLS = {"flange": "#9a9a9a", "heat": "#bf0000", "bus": "#ffcc33"}


def terminal_outline(icon: str, angle: Floats) -> Floats:
    """Radius of a terminal's icon in a direction [rad]."""
    corners = CORNERS[icon]
    if not corners:
        return np.full_like(angle, 0.9)
    half = np.pi / corners
    outline: Floats = 0.95 * np.cos(half) / np.cos(np.mod(angle, 2.0 * half) - half)
    return outline


@cache
def picture(size: int) -> bytes:
    """The units' icon as PNG of ``size`` pixels squared."""
    x, y, colours = canvas(size)
    for disc in reducer():
        reach = disc.radius + disc.height
        # Nothing else is near it.
        rows, columns = span(y[:, 0] - disc.y, reach), span(x[0] - disc.x, reach)
        right, up = x[:, columns] - disc.x, y[rows] - disc.y
        edge = disc.edge(np.arctan2(up, right)) if disc.lobes else disc.radius
        colours[rows, columns][np.hypot(right, up) < edge] = paint(disc.colour)
    return png(colours)


def span(places: Floats, reach: float) -> slice:
    """Where a sorted row lies within ``reach`` of 0."""
    inside = np.flatnonzero(np.abs(places) <= reach)
    return slice(inside[0], inside[-1] + 1)


@cache
def drawing() -> bytes:
    """The units' icon as SVG."""
    parts = [SVG]
    for disc in reducer():
        if disc.lobes:
            angle = np.linspace(0.0, 2.0 * np.pi, 16 * disc.lobes, endpoint=False)
            edge = disc.edge(angle)
            parts.append(polygon(disc.x + edge * np.cos(angle), disc.y + edge * np.sin(angle), disc.colour))
        else:
            parts.append(f'<circle cx="{100 * disc.x:.4g}" cy="{-100 * disc.y:.4g}" r="{100 * disc.radius:.4g}" fill="{disc.colour}"/>')
    return ("".join(parts) + "</svg>\n").encode()


@cache
def terminal_picture(icon: str, size: int) -> bytes:
    """A terminal's icon as PNG: its colour within a dark line."""
    x, y, colours = canvas(size)
    outline, distance = terminal_outline(icon, np.arctan2(y, x)), np.hypot(x, y)
    colours[distance < outline] = paint("#333333")
    colours[distance < outline - 0.08] = paint(FILLS[icon])
    return png(colours)


def terminal_drawing(icon: str) -> bytes:
    """The same as SVG."""
    count = CORNERS[icon] or 72
    angle = 2.0 * np.pi * np.arange(count) / count
    edge = terminal_outline(icon, angle)
    shape = polygon(edge * np.cos(angle), edge * np.sin(angle), FILLS[icon]).replace("/>", ' stroke="#333333" stroke-width="8"/>')
    return f"{SVG}{shape}</svg>\n".encode()


def polygon(x: Floats, y: Floats, colour: str) -> str:
    points = " ".join(f"{100 * a:.4g},{-100 * b:.4g}" for a, b in zip(x, y))
    return f'<polygon points="{points}" fill="{colour}"/>'


def canvas(size: int) -> tuple[Floats, Floats, Bytes]:
    """Places of the fine pixels, x (1, n) and y (n, 1), -1 to 1, y up, and their colours (n, n, 4), clear."""
    axis = (np.arange(FINE * size) + 0.5) / (FINE * size) * 2.0 - 1.0
    return axis[None], -axis[:, None], np.zeros((len(axis), len(axis), 4), "u1")


def paint(colour: str) -> tuple[int, ...]:
    return (*(int(colour[i : i + 2], 16) for i in (1, 3, 5)), 255)


def png(colours: Bytes) -> bytes:
    """A PNG file of fine pixels."""
    size = len(colours) // FINE
    pixels = colours.reshape(size, FINE, size, FINE, 4).mean((1, 3)).astype("u1")
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", size, size, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
