"""Cosine and sine of one wave as amplitude and phase: what a dial gauge shows, whatever angle is called zero."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from discrepancy.scales import largest, of_parameter
from discrepancy.words.as_told import told_name
from discrepancy.words.intervals import relied_on
from fmu_src.table import Table

COSINE = re.compile(r"(?<![A-Za-z])cos(?![A-Za-z])")


@dataclass(frozen=True)
class Wave:
    """amplitude cos(x - phase), of the parameters ``cosine`` and ``sine``; ``unit`` and interval (95 %) of the amplitude, phase in degrees."""

    cosine: str
    sine: str
    amplitude: float
    interval: tuple[float, float]
    unit: str
    phase: float

    def as_json(self, tables: Sequence[Table]) -> dict[str, Any]:
        """By the names and in the unit that screen and page have."""
        scale = of_parameter(largest(self.amplitude, *self.interval), self.unit)
        return {
            "cosine": told_name(self.cosine, tables), "sine": told_name(self.sine, tables), "amplitude": scale.number(self.amplitude),
            "interval": [scale.number(end) for end in self.interval], "unit": scale.unit, "phase_deg": self.phase,
        }  # fmt: skip


def waves_of(parameters: Mapping[str, Mapping[str, Any]]) -> list[Wave]:
    """Of an effect's estimates by name, those that come as cosine and sine."""
    found = []
    for name, cosine in parameters.items():
        other = COSINE.sub("sin", name)
        if other == name or other not in parameters:
            continue
        sine = parameters[other]
        parts = float(cosine["value"]), float(sine["value"])
        size = math.hypot(*parts)
        if size == 0.0:
            continue
        # Along the wave's own direction.
        halves = [0.5 * (high - low) for low, high in map(relied_on, (cosine, sine))]
        half = math.hypot(*(part * half for part, half in zip(parts, halves))) / size
        phase = math.degrees(math.atan2(parts[1], parts[0])) % 360.0
        found.append(Wave(name, other, size, (max(0.0, size - half), size + half), str(cosine["unit"]), phase))
    return found
