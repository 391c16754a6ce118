"""What a rig can measure: every run of a grid over what it can set, its price and noise, and how a run is called."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from discrepancy.campaign.model import Campaign, Rig
from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.experiment.usual_noise import UNMEASURED
from discrepancy.held_names import HELD, LOCKED_AT
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.next_experiment import Experiment
from discrepancy.inference.noise.noise import noise_key
from discrepancy.inference.noise.series import spacing_of, stream_of
from discrepancy.inference.noise.stream_noise import StreamNoise
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.unstated_places import locked
from discrepancy.problem import Record
from discrepancy.scales import Scale, of_axis, unit_of_axis
from fmu_src.arrays import Floats
from studies.hysteresis import torque_way

HOUR = 3600.0
# Quantities whose condition has these factors; the others are taken with the input held.
RUNNING = {"transmission_error", "transmission_order", "input_torque", "efficiency", "vibration_order", "cage_speed", "no_load_torque"}
AGED = {"wear_depth", "wear_profile", "mass_loss", "debris_iron"}
LEVELS, POSITIONS = 3, 4
ANGLES = 400
LOOP_STEPS = 9
# What can be meant by a quantity that was not measured yet.
TAGS: dict[str, tuple[dict[str, str], ...]] = {
    "wear_depth": tuple({"surface": s} for s in ("flank", "pin", "inner_race", "outer_race")),
}  # fmt: skip
# Several runs of a proposed experiment are averaged.
REPEATS = 2


@dataclass(frozen=True, kw_only=True)
class Measurement(Experiment):
    """An experiment on the rig: ``record`` is what it would measure, its values still empty."""

    record: Record


def at_a_position(loop: Measurement, campaign: Campaign) -> Measurement:
    """The same loop measured where the input is known to stand."""
    settings = {**loop.settings, LOCKED_AT: 0.0}
    return replace(loop, name=f"{loop.kind} at {describe(settings, campaign)}", settings=settings, record=locked(loop.record, 0.0))


def at_rated(model: PhysicalModel) -> list[Measurement]:
    """Every signal at rated speed and load: what the rivals disagree about where the reducer is used."""
    found = {}
    for record in model.records:
        speed = {} if record.quantity in HELD else {"speed": model.bench.rated_speed}
        rated = speed | {"load": model.bench.rated_load, "temperature": 293.15}
        if record.quantity in AGED:
            rated["hours"] = 6000.0 * HOUR
        found[stream_of(record)] = Measurement(f"{stream_of(record)} at {describe(rated, model.campaign)}", 0.0, record=blank(record, rated))
    return list(found.values())


def possible(model: PhysicalModel, campaign: Campaign, space: Workspace) -> list[Measurement]:
    """Every experiment of a grid over what the rig can set and measure."""
    rig = campaign.rig
    signals = {stream_of(r): r for r in model.records}
    measured = set(rig.quantities) if rig and rig.quantities else {r.quantity for r in model.records}
    for quantity in sorted(measured - {r.quantity for r in model.records}):
        # Not measured so far, but the rig could.
        for tags in TAGS.get(quantity, ({},)) if quantity in UNMEASURED else ():
            axes = {"transmission_error": {"angle": np.zeros(1)},
                    "hysteresis": {"torque": torque_way(model.bench.rated_load, LOOP_STEPS, np.zeros(0))[1:]}}.get(quantity, {})
            example = Record("proposed", quantity, QUANTITIES[quantity].unit, "", 1, np.zeros(1), axes, {"direction": 1}, tags=tags)
            signals[stream_of(example)] = example
    found = []
    for signal, example in signals.items():
        if example.quantity not in measured:
            continue
        # Single numbers share the noise of their quantity, whatever part they are of.
        stream = space.noise.streams.get(noise_key(example))
        for condition in conditions(example, model, rig, campaign):
            record = blank(example, condition)
            hours = condition.get("hours", 0.0) if example.quantity in AGED else 0.0
            run_cost, hour_cost = (rig.cost_per_run, rig.cost_per_hour) if rig else (1.0, 0.01)
            cost = REPEATS * run_cost + hour_cost * hours / HOUR
            noise = noise_of(stream, record, model) if stream else UNMEASURED[example.quantity]
            found.append(Measurement(
                f"{signal} at {describe(condition, campaign)}", cost, noise / np.sqrt(REPEATS),
                settings=condition, record=record, kind=signal,
            ))  # fmt: skip
    return found


def noise_of(stream: StreamNoise, record: Record, model: PhysicalModel) -> Floats | float:
    """Standard deviation of each sample as good as independent, in SI."""
    if stream.proportional:
        return stream.scale * np.maximum(np.abs(model.one(record, model.standing())), stream.floor)
    return stream.scale * correlation_loss(stream, record)


def correlation_loss(stream: StreamNoise, record: Record) -> float:
    """How much worse correlated samples average than independent ones."""
    if "angle" not in record.axes or not stream.length:
        return 1.0
    return float(np.sqrt(1.0 + 2.0 * (1.0 - stream.nugget) * stream.length / max(spacing_of(record.axes["angle"]), 1e-12)))


def conditions(example: Record, model: PhysicalModel, rig: Rig | None, campaign: Campaign) -> list[dict[str, float]]:
    """Corners and middles of what can be set, for this quantity."""
    names = ["temperature"]
    if example.quantity in RUNNING | AGED:
        names = ["speed", "load", "temperature"]
    if example.quantity in AGED:
        names.append("hours")
    levels: dict[str, Sequence[float]] = {}
    if example.quantity in HELD and LOCKED_AT in example.factors:
        # Evenly over a turn of the cranks.
        turn = 2.0 * np.pi * abs(model.bench.ratio) / model.bench.reducer.topology.lobes
        levels[LOCKED_AT] = np.linspace(0.0, turn, POSITIONS, endpoint=False).tolist()
    for name in names:
        low, high = limits(name, model, rig, campaign)
        levels[name] = [low] if high <= low else np.linspace(low, high, LEVELS).tolist()
    return [dict(zip(levels, map(float, values))) for values in product(*levels.values())]


def limits(name: str, model: PhysicalModel, rig: Rig | None, campaign: Campaign) -> tuple[float, float]:
    """The rig's range of a factor, or that of the campaign's own conditions."""
    if rig and name in rig.ranges:
        return rig.ranges[name]
    seen = [c.factors[name] for c in campaign.conditions.values() if name in c.factors]
    seen += [float(v) for r in model.records for v in np.atleast_1d(r.axes.get(name, r.factors.get(name, np.nan))) if np.isfinite(v)]
    if seen:
        return min(seen), max(seen)
    return {"speed": model.bench.rated_speed, "load": model.bench.rated_load, "temperature": 293.15, "hours": 1000.0 * HOUR}[name], 0.0


def blank(example: Record, condition: dict[str, float]) -> Record:
    """A record of that quantity at another condition, with nothing measured yet."""
    axes: dict[str, Floats] = {}
    if "angle" in example.axes and example.quantity == "transmission_error":
        axes = {"angle": np.linspace(0.0, 2.0 * np.pi, ANGLES, endpoint=False)}
    elif example.quantity in ("hysteresis", "wear_profile", "vibration_order", "transmission_order"):
        axes = {k: v for k, v in example.axes.items() if k in ("torque", "depth_angle", "order", "part")}
    size = len(next(iter(axes.values()))) if axes else 1
    factors = {**example.factors, **condition}
    return replace(example, name="proposed", values=np.zeros(size), axes=axes, factors=factors, held_out=False, far_off=())


def describe(condition: Mapping[str, float], campaign: Campaign, spans: Mapping[str, tuple[float, float]] | None = None) -> str:
    """Settings as the campaign states them; those that make no difference with their span, a temperature that no run states as assumed."""
    every = {name: (spans or {}).get(name, (value, value)) for name, value in condition.items()}
    texts = {name: setting_text(name, span, campaign) for name, span in every.items()}
    low, high = every.get("temperature", (0.0, 1.0))
    if low == high and campaign.records and not any("temperature" in r.factors for r in campaign.records):
        texts["temperature"] += " (assumed)"
    return ", ".join(texts.values())


def position_text(at: float, scale: Scale, unit: str) -> str:
    """A position of the input [rad], and how one comes there: after a whole turn the input stands as before, and the cranks elsewhere."""
    turns, rest = divmod(round(math.degrees(at), 6), 360.0)
    low = f"{rest:{'.3g' if 0.0 < rest < 10.0 else '.0f'}} deg"
    if not turns:
        return low
    on = f"{turns:.0f} whole turn{'s' * (turns != 1.0)}{f' and {low}' if rest else ''}"
    return f"{scale.number(at):.0f} {unit} (from the encoder's zero turn the input on by {on})"


def setting_text(name: str, span: tuple[float, float], campaign: Campaign) -> str:
    scale = of_axis(name, campaign)
    low, high = (f"{scale.number(v):{'.3g' if 0.0 < abs(scale.number(v)) < 10.0 else '.0f'}}" for v in span)
    unit = unit_of_axis(name, campaign)
    if name == LOCKED_AT and low != high:
        # They lie evenly over a turn of the cranks.
        return "input locked anywhere"
    if name == LOCKED_AT:
        return f"input locked at {position_text(span[0], scale, unit)}"
    return f"{low} {unit}".rstrip() if low == high else f"any {name} from {low} to {high} {unit}".rstrip()
