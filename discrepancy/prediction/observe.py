"""One function per measured quantity: what the bench would have shown on a record's axes, in SI units."""

import math
from collections.abc import Callable, Iterable, Mapping

import numpy as np

from discrepancy.held_names import HELD
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.cage_ripples import cage_ripples, locked_ripples
from discrepancy.prediction.conditions import Values, angles_of, at_rest, condition_of, held_condition, identity, row_conditions, zero_of
from discrepancy.prediction.curves import signal
from discrepancy.prediction.lives import fresh
from discrepancy.prediction.over_angle import OverAngle, error_change
from discrepancy.prediction.over_torque import OverTorque, coarse_loop_change, loop_change
from discrepancy.prediction.standard_test import WAY, weights_of
from discrepancy.prediction.turning_torque import applied
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from fmu_src.arrays import Floats
from rv_plant.locked_output import ELEMENTS, locked_output_loop
from studies.hysteresis import LOST_MOTION_SHARE
from studies.wear_figures import peak_of_circle

STEEL = 7850.0
# Samples of one output turn from which an order spectrum is taken.
SPECTRUM_SAMPLES = 2048
# Torques of either sign at which a locked drive's springs are computed, and crank positions of that table: its play is far wider than
# what positions differ by.
ELASTIC_STEPS, LOCKED_ANGLES = 20, 8
WITHOUT_FRICTION = {"friction_coefficient": 0.0, "friction_excess": 0.0, "mesh_friction": 0.0, "mesh_friction_excess": 0.0}
DRIVE_FRICTION = ("drive_friction", "drive_friction_share", "drive_presliding")
# Of the deepest place: what is worn less is not compared in proportion.
LEAST_WORN = 0.1


def centred(values: Floats) -> Floats:
    return values - float(values.mean())


def from_zero(record: Record, values: Floats) -> Floats:
    """As counted by the record: from its own mean unless its zero is known."""
    return centred(values) if record.free_zero else values


def transmission_error(bench: Bench, record: Record, values: Values) -> Floats:
    return from_zero(record, signal(OverAngle(bench, record, "transmission_error"), values))


def transmission_error_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    change = error_change(bench, record, values, base)
    return None if change is None else from_zero(record, change)


def ripples_of_cages(bench: Bench, record: Record, values: Values, shares: Iterable[float], exactly: bool = False) -> list[Floats]:
    """What cages each of ``shares`` of their rollers' pitch ahead change in the transmission error, or in a loop at one place."""
    cages = [float(share) * bench.reducer.topology.roller_pitch for share in shares]
    return locked_ripples(bench, record, values, cages) if record.quantity in HELD else cage_ripples(bench, record, values, cages, exactly)


def hysteresis(bench: Bench, record: Record, values: Values) -> Floats:
    if record.tags.get("locked") == "output":
        return locked_output(bench, record, values)
    return signal(OverTorque(bench, record), values)


def hysteresis_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    return None if record.tags.get("locked") == "output" else loop_change(bench, record, values, base)


def coarse_hysteresis_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    return None if record.tags.get("locked") == "output" else coarse_loop_change(bench, record, values, base)


def coarse_lost_motion_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    """What ``values`` change in lost motion next to ``base``, roughly seen; None where the way leaves no mark: then it is not dear."""
    if not (bench.remembers(values) or bench.remembers(base)):
        return None
    return lost_motion(bench.rougher, record, values) - lost_motion(bench.rougher, record, base)


def locked_output(bench: Bench, record: Record, values: Values) -> Floats:
    """Turning of the input over the ratio, output locked: the drive's springs and play, friction beside them."""
    torques = applied(bench, record)
    elastic = {name: value for name, value in values.items() if name not in DRIVE_FRICTION} | WITHOUT_FRICTION
    # Finely about no torque, where play is.
    rising = np.linspace(1.0 / ELASTIC_STEPS, 1.0, ELASTIC_STEPS) ** 2
    table = float(np.abs(torques).max()) * np.concatenate([-rising[::-1], rising])
    turning = bench.held(held_condition(bench, record), elastic, table, LOCKED_ANGLES)
    friction, share, presliding = (values.get(n, bench.starts[0][n]) for n in DRIVE_FRICTION)
    if friction + share == 0.0:
        return np.interp(torques, table, turning)
    found, sliders = np.zeros(len(torques)), np.zeros(ELEMENTS)
    # The ramp before left the elements somewhere: it was the same ramp.
    for _ in range(2):
        locked_output_loop(turning, table, torques, friction, share, presliding, sliders, found)
    return found


def lost_motion(bench: Bench, record: Record, values: Values) -> Floats:
    """Turning between +3 % and -3 % of the rated torque: middle lines of the closed loop."""
    rows = row_conditions(bench, record)
    conditions = list(dict.fromkeys(rows))
    by_condition = dict(zip(conditions, bench.threads.map(lambda c: lost_motion_at(bench, c, values), conditions)))
    return np.array([by_condition[c] for c in rows])


def lost_motion_at(bench: Bench, condition: Condition, values: Values) -> float:
    if not bench.remembers(values):
        # Wherever the torque came from.
        forward, backward = bench.held(at_rest(bench, condition), values, LOST_MOTION_SHARE * bench.rated_load * np.array([1.0, -1.0]))
        return float(forward - backward)
    if bench.test_way is WAY or not bench.relevant(values, condition.hours > 0.0):
        return middle_lines(bench, condition, values, WAY)
    # What the values change, roughly seen from fewer torques.
    with_values, without = (middle_lines(bench, condition, v, bench.test_way) for v in (values, {}))
    return middle_lines(bench, condition, {}, WAY) + with_values - without


def middle_lines(bench: Bench, condition: Condition, values: Values, way: Floats) -> float:
    """Lost motion [rad] by the middle lines of the closed loop along a ``way`` of torques [rated torque]."""
    return float(weights_of(way.tobytes()) @ bench.held(at_rest(bench, condition), values, bench.rated_load * way))


def torsional_stiffness(bench: Bench, record: Record, values: Values) -> Floats:
    torque = bench.rated_load
    way_in = [0.0, 0.25] if bench.remembers(values) else []
    turning = bench.held(held_condition(bench, record), values, np.array([*way_in, 0.5, 0.75, 1.0]) * torque)
    return np.full(len(record.values), 0.5 * torque / (turning[-1] - turning[-3]))


def input_torque(bench: Bench, record: Record, values: Values) -> Floats:
    if "angle" in record.axes or "time" in record.axes:
        return np.abs(signal(OverAngle(bench, record, "drive_torque"), values))
    return np.array([abs(bench.average("drive_torque", c, values)) for c in row_conditions(bench, record)])


def no_load_torque(bench: Bench, record: Record, values: Values) -> Floats:
    free = Record(**{**record.__dict__, "factors": {**record.factors, "load": 0.0}})
    return input_torque(bench, free, values)


def efficiency(bench: Bench, record: Record, values: Values) -> Floats:
    found = []
    for c in row_conditions(bench, record):
        torque = abs(bench.average("drive_torque", c, values))
        found.append(abs(c.load) / (abs(bench.ratio) * torque))
    return np.array(found)


def vibration(bench: Bench, record: Record, values: Values) -> Floats:
    """Acceleration of a rigid housing on soft mounts: force of the pins over the mass that moves."""
    angles = angles_of(bench, record, zero_of(bench, record, values))
    spectrum_angles, force = housing_force(bench, record, values)
    return np.interp(angles % (2.0 * math.pi), spectrum_angles, force, period=2.0 * math.pi) / values.get("housing_mass", 10.0)


def housing_force(bench: Bench, record: Record, values: Values) -> tuple[Floats, Floats]:
    """Force of the pins on their ring along x over one output turn, less its mean."""
    condition = condition_of(bench, record)
    angles = np.linspace(0.0, 2.0 * math.pi, SPECTRUM_SAMPLES, endpoint=False)
    force = bench.column("housing_force_x", condition, values, angles if condition.direction > 0 else angles[::-1])
    force = force if condition.direction > 0 else force[::-1]
    return angles, centred(force)


def vibration_order(bench: Bench, record: Record, values: Values) -> Floats:
    _, force = housing_force(bench, record, values)
    amplitudes = 2.0 * np.abs(np.fft.rfft(force)) / len(force)
    orders = np.asarray(record.axes["order"], np.float64)
    return np.interp(orders, np.arange(len(amplitudes)), amplitudes) / values.get("housing_mass", 10.0)


def temperature(bench: Bench, record: Record, values: Values) -> Floats:
    condition = condition_of(bench, record)
    steady = bench.average("reducer_temperature", condition, {**values, "thermal_time": 0.0})
    constant = values.get("thermal_time", 0.0)
    time = np.asarray(record.axes["time"], np.float64)
    rise = 1.0 - np.exp(-(time - time[0]) / constant) if constant > 0.0 else np.ones(len(time))
    return condition.temperature + (steady - condition.temperature) * rise


def cage_speed(bench: Bench, record: Record, values: Values) -> Floats:
    return np.array([abs(bench.average("cage_speed", c, values)) for c in row_conditions(bench, record)])


def worn_difference(measure: Callable[..., Floats]) -> Callable[[Bench, Record, Values], Floats]:
    """The base model's wear from full meshing cycles, changed as short cycles change with the values.

    In proportion: what short cycles get wrong they get wrong alike for all values.
    """

    def observed(bench: Bench, record: Record, values: Values) -> Floats:
        turns = bench.cycle_turns
        full, base, share = bench.kept(("in proportion", measure.__name__, turns, *identity(record)), lambda: in_proportion(bench, record, turns))
        return full + share * (measure(bench, record, values, turns) - base)

    def in_proportion(bench: Bench, record: Record, turns: int) -> tuple[Floats, Floats, Floats]:
        full, base = (measure(bench, record, {}, t) for t in (bench.reducer.topology.lobes, turns))
        worn = np.abs(base) > LEAST_WORN * np.abs(base).max()
        return full, base, np.clip(np.divide(full, base, out=np.ones_like(base), where=worn), 0.5, 2.0)

    observed.__name__ = measure.__name__
    return observed


def inspections(bench: Bench, record: Record, values: Values, turns: int) -> list[np.ndarray]:
    """The wear unit's record at every row's hours."""
    rows = row_conditions(bench, record)
    hours: dict[Condition, set[float]] = {}
    for c in rows:
        hours.setdefault(fresh(c), set()).add(c.hours)
    return [bench.life(c, values, hours[fresh(c)], turns)[c.hours] for c in rows]


def surface_of(wear: np.ndarray, tags: Mapping[str, str]) -> Floats:
    """Profile(s) of the tagged surface; flanks and pins as the mean of those that are not told apart."""
    w = wear[0]

    def part(name: str) -> int | slice:
        return int(tags[name]) - 1 if name in tags else slice(None)

    surface = tags["surface"]
    if surface == "flank":
        discs = w["disc_wear"].shape[0]
        teeth = w["disc_wear"].reshape(discs, -1, w["slide"].shape[0])[part("disc")]
        return mean_profile(teeth[..., part("tooth"), :] if "tooth" in tags else teeth)
    if surface == "pin":
        both = (w["pin_wear"] + w["pin_even_wear"][..., None]).sum(axis=0)
        return mean_profile(both[part("tooth")])
    field = {"inner_race": "inner_race_wear", "outer_race": "outer_race_wear"}[surface]
    races: Floats = w[field][part("disc")][..., part("crank"), :]
    profiles = races.reshape(-1, races.shape[-1])
    deepest: Floats = profiles[profiles.max(axis=1).argmax()]
    return deepest


def mean_profile(profiles: Floats) -> Floats:
    mean: Floats = profiles.reshape(-1, profiles.shape[-1]).mean(axis=0)
    return mean


@worn_difference
def wear_profile(bench: Bench, record: Record, values: Values, turns: int) -> Floats:
    wear = inspections(bench, record, values, turns)[0]
    profile = surface_of(wear, record.tags)
    angle = np.asarray(record.axes["depth_angle"], np.float64)
    if record.tags["surface"] == "pin":
        places = (angle / math.pi + 0.5) * len(profile) - 0.5
        return np.interp(places, np.arange(len(profile)), profile)
    # Races are counted the way the cranks turn.
    sense = -1.0 if record.tags["surface"] != "flank" and wear["crank_speed"][0] < 0.0 else 1.0
    bins = (np.arange(len(profile)) + 0.5) * 2.0 * math.pi / len(profile)
    return np.interp(sense * angle, bins, smooth(profile), period=2.0 * math.pi)


def smooth(profile: Floats, harmonics: int = 24) -> Floats:
    """The profile's first harmonics: a cycle's ripple is not wear."""
    spectrum = np.fft.rfft(profile)
    spectrum[harmonics + 1 :] = 0.0
    return np.fft.irfft(spectrum, len(profile))


@worn_difference
def wear_depth(bench: Bench, record: Record, values: Values, turns: int) -> Floats:
    found = []
    for wear in inspections(bench, record, values, turns):
        if record.tags["surface"] == "pin":
            found.append(surface_of(wear, record.tags).max())
        else:
            found.append(peak_of_circle(surface_of(wear, record.tags)[None])[0])
    return np.array(found)


@worn_difference
def mass_loss(bench: Bench, record: Record, values: Values, turns: int) -> Floats:
    """Of the part named by the tag: reducer, discs, pins, cranks."""
    parts = {
        "disc": ("flank_volume", "outer_race_volume"), "pin": ("pin_volume",), "crank": ("inner_race_volume",),
        "reducer": ("flank_volume", "pin_volume", "inner_race_volume", "outer_race_volume"),
    }  # fmt: skip
    part = next((k for k in parts if record.tags.get("part", "reducer").lower().startswith(k)), "reducer")
    return np.array([STEEL * sum(float(w[name][0]) for name in parts[part]) for w in inspections(bench, record, values, turns)])


def debris_iron(bench: Bench, record: Record, values: Values) -> Floats:
    mass = bench.starts[1]["grease_mass"]
    whole = Record(**{**record.__dict__, "tags": {"part": "reducer"}})
    return mass_loss(bench, whole, values) / values.get("grease_mass", mass)


OBSERVED: dict[str, Callable[[Bench, Record, Values], Floats]] = {
    f.__name__: f for f in (
        transmission_error, hysteresis, lost_motion, torsional_stiffness, input_torque, no_load_torque, efficiency,
        vibration, vibration_order, temperature, wear_profile, wear_depth, mass_loss, debris_iron, cage_speed,
    )
}  # fmt: skip

Changes = Mapping[str, Callable[[Bench, Record, Values, Values], Floats | None]]
# What values change next to others where it is cheaper than both: good for any distance, by a share of itself ...
COARSE_CHANGES: Changes = {"hysteresis": coarse_hysteresis_change, "lost_motion": coarse_lost_motion_change}
# ... and to first order.
CHANGES: Changes = {"transmission_error": transmission_error_change, "hysteresis": hysteresis_change, "lost_motion": coarse_lost_motion_change}
