"""What is known of the noise of one signal."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from fmu_src.arrays import Floats


@dataclass(frozen=True)
class StreamNoise:
    """Noise of one signal.  ``scales`` by condition; ``patterns`` variance relative to scale^2; ``dof`` of each part;
    ``axis`` noise of the torque over which a loop is written [N m] over ``scale``."""

    scale: float
    scales: dict[str, float]
    proportional: bool
    length: float
    nugget: float
    taps: Floats
    patterns: dict[str, float]
    dof: dict[str, float]
    source: str
    tail: float
    floor: float = 0.0
    axis: float = 0.0

    def to_dict(self) -> dict[str, Any]:
        return {"scale": self.scale, "proportional": self.proportional, "correlation_length": self.length,
                "white_share": self.nugget, "between_runs": {k: float(np.sqrt(v)) * self.scale for k, v in self.patterns.items()},
                "degrees_of_freedom": dict(self.dof), "source": self.source, "tail": self.tail,
                "torque_noise": self.axis * self.scale}
