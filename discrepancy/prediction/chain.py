"""What rig and sensors make of what the reducer does, for one campaign: the effects of ``discrepancy.effects`` at a record's own values."""

from collections.abc import Callable, Mapping
from itertools import chain
from typing import Any

from discrepancy.effects import MODULES, OUTPUT_SPEED, STARTS
from discrepancy.effects.locked_position import PATTERNS
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.conditions import Values, condition_of
from discrepancy.prediction.positions import position_patterns
from discrepancy.problem import Record
from fmu_src.arrays import Floats

PARAMETERS = {p.variable.name for m in MODULES.values() for p in m.EFFECT.parameters}
# By a name of its own, what the base model says of a record that an effect asks for.
ASKED: dict[str, Callable[[Bench, Record], Any]] = {
    OUTPUT_SPEED: lambda bench, record: condition_of(bench, record).speed / abs(bench.ratio), PATTERNS: position_patterns,
}  # fmt: skip
# By the parameter without which it does nothing, the effect.
OWNERS = {p.variable.name: name for name, m in MODULES.items() for p in m.EFFECT.amplitudes()}


class Chain:
    """The measuring chain; ``present`` are values of the model that is extended."""

    def __init__(self, bench: Bench, present: Values):
        self.bench = bench
        self.present = {n: v for n, v in present.items() if n.partition("[")[0] in PARAMETERS}

    def acting(self, values: Values) -> list[str]:
        """Effects that may change some record, in the order in which they act."""
        on = {OWNERS.get(n.partition("[")[0]) for n, v in chain(self.present.items(), values.items()) if v != 0.0}
        return [name for name in MODULES if name in on]

    def changed(self, predicted: Floats, record: Record, values: Mapping[str, float], acting: list[str], size: float) -> Floats:
        """``predicted`` as the chain of ``acting`` effects shows it; ``size`` is that of the quantity."""
        # Loops have one position in common, or one in each condition.
        places = {"quantity": (record.quantity,), "mounting": (record.mounting,), "campaign": ("",), "loops": ("", record.condition)}
        for name in acting:
            module = MODULES[name]
            place = places[module.PER]

            def at(parameter: str, place: tuple[str, ...] = place) -> Any:
                if parameter in ASKED:
                    return ASKED[parameter](self.bench, record)
                keys = [f"{parameter}[{where}]" if where else parameter for where in place]
                return sum(values.get(key, self.present.get(key, STARTS[parameter])) for key in keys)

            if any(at(p.variable.name) != 0.0 for p in module.EFFECT.amplitudes()):
                predicted = module.change(predicted, record, at, size)
        return predicted
