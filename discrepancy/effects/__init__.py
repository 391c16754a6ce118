"""Effects of the measuring chain, one a file: what rig and sensors make of what the reducer does.

``EFFECT`` says what they are, as for the reducer's own effects; a parameter with ``{}`` in
its name exists once per quantity (or mounting, where its ``per`` says so).
``change(values, record, at, size)`` returns the changed values of a record; ``at(name)`` gives a
parameter's present value for the record, the ``output_speed`` [rad/s] that it ran at, and what the base model says of the record
that an effect asks for by a name of its own.  ``PRIOR``, where a file has one, is the standard deviation of its amplitudes that is known
beforehand.  They act in the order of STAGES.
"""

from collections.abc import Callable
from typing import Any, Protocol, cast

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, effect_modules


class ChainModule(Protocol):
    """A file of this folder."""

    PER: str
    PRIOR: float | None
    EFFECT: Effect

    def change(self, values: Floats, record: Record, at: Callable[[str], Any], size: float) -> Floats: ...


STAGES = (
    "locked_position", "torsional_resonance", "torque_ripple", "clock_slip", "encoder_eccentricity", "encoder_distortion", "sensor_gain", "sensor_offset",
    "sensor_drift",
)  # fmt: skip
MODULES = {name: cast(ChainModule, effect_modules(__name__)[name]) for name in STAGES}
EFFECTS: dict[str, Effect] = {name: module.EFFECT for name, module in MODULES.items()}
# Values of the parameters that nobody has set.
STARTS = {p.variable.name: float(p.variable.start) for effect in EFFECTS.values() for p in effect.parameters}
OUTPUT_SPEED = "output_speed"
