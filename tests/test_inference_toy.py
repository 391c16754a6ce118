"""A toy reducer with a catalogue of effects, hidden truths in and outside it, and noise as on a bench."""

from dataclasses import dataclass, field

import numpy as np

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.screening.effect_size import amplitude_for
from discrepancy.problem import Candidate, Parameter, Record

LOADS = (60.0, 120.0, 240.0, 400.0)
TURN = 2 * np.pi


def amplitude(name, unit="arcsec", scale=1.0, sign=0):
    return Parameter(name, unit, 0.0, 0.0 if sign > 0 else -1e3 * scale, 1e3 * scale, scale, sign)


def shape(name, unit, typical, lower, upper):
    return Parameter(name, unit, typical, lower, upper, 0.3 * typical)


def grid(name, *values):
    return tuple({name: v} for v in values)


CANDIDATES = (
    Candidate("encoder_eccentricity", "Encoder", (amplitude("enc_c"), amplitude("enc_s")), signals=("te",), part="chain"),
    Candidate("pin_errors", "Pins", (amplitude("pin_c"), amplitude("pin_s")), signals=("te",)),
    Candidate("disc_pitch", "Disc", (amplitude("disc_c"), amplitude("disc_s")), signals=("te",)),
    Candidate("needle_clearance", "Needles", (amplitude("clearance", "um", 1.0, 1),), signals=("te",)),
    Candidate("thermal_expansion", "Heat", (amplitude("expansion", scale=0.05),), signals=("te",)),
    Candidate("housing_compliance", "Housing", (amplitude("housing", scale=0.01, sign=1),), signals=("te",)),
    Candidate("backlash", "Backlash", (amplitude("gap", scale=1.0, sign=1),), signals=("te",)),
    Candidate("stribeck", "Stribeck", (amplitude("mu_s", "1", 0.002, 1),), (shape("vs", "m/s", 0.1, 0.01, 1.0),),
              grid("vs", 0.03, 0.06, 0.12, 0.25, 0.5), ("torque",)),
    Candidate("churning", "Churning", (amplitude("churn", "N.m", 0.05, 1),), signals=("torque",)),
    Candidate("seal_drag", "Seal", (amplitude("seal", "N.m", 0.02, 1),), signals=("torque",)),
    Candidate("torque_offset", "Offset", (amplitude("t_offset", "N.m", 0.02),), signals=("torque",), part="chain"),
    Candidate("torque_gain", "Gain", (Parameter("t_gain", "1", 0.0, -0.6, 0.6, 0.02),), signals=("torque",), part="chain"),
    Candidate("running_in", "Run-in", (amplitude("r", "1", 1.0, 1),), (shape("s0", "h", 150.0, 20.0, 800.0),),
              grid("s0", 40.0, 100.0, 250.0, 600.0), ("wear",)),
    Candidate("debris", "Debris", (amplitude("debris", "1", 0.3, 1),), signals=("wear",)),
    Candidate("load_exponent", "Exponent", (Parameter("m", "1", 0.0, 0.0, 3.0, 0.2, 1),), signals=("wear",)),
    Candidate("clock_slip", "Clock", (Parameter("slip", "1", 0.0, -0.05, 0.05, 0.002),), signals=("te",), part="chain"),
)
NUISANCES = (
    Parameter("stiffness", "1", 1.0, 0.3, 3.0, 0.1),
    Parameter("friction", "1", 0.02, 0.0, 0.2, 0.002, prior=0.0004),
    Parameter("wear_rate", "1", 1.0, 0.1, 10.0, 0.1),
    *(Parameter(f"phase_{k}", "rad", 0.0, -1.0, 1.0, 0.05) for k in ("1", "2")),
)


def law(record, v):
    """Predicted values of one record."""
    get = v.get
    f = record.factors
    if record.quantity == "te":
        x = record.axes["angle"] * (1 + get("slip", 0.0)) + get("phase_" + record.mounting, 0.0)
        load, warm = f["load"], f["temperature"] - 293.0
        y = get("stiffness", 1.0) * 0.5 * load**0.9 * f["direction"]
        y = y + (3 + 0.01 * load) * np.cos(40 * x) + 2 * np.cos(39 * x + 1)
        y = y + get("enc_c", 0.0) * np.cos(record.axes["angle"]) + get("enc_s", 0.0) * np.sin(record.axes["angle"])
        y = y + get("pin_c", 0.0) * (np.cos(78 * x) + 0.3 * np.cos(156 * x)) + get("pin_s", 0.0) * (np.sin(78 * x) + 0.3 * np.sin(156 * x))
        y = y + get("disc_c", 0.0) * np.cos(40 * x) + get("disc_s", 0.0) * np.sin(40 * x)
        c = get("clearance", 0.0)
        y = y + c * (0.7 * np.cos(80 * x) * (1 + load / 800) + f["direction"] * np.tanh(load / 100))
        return y + get("expansion", 0.0) * warm * f["direction"] + get("housing", 0.0) * load * f["direction"] + get("gap", 0.0) * f["direction"]
    if record.quantity == "torque":
        speed, load = record.axes["sliding_speed"], f["load"]
        y = get("friction", 0.02) * load * f["direction"] * (1 - 0.1 * np.log(speed / 0.3) * 0.2)
        y = y + get("mu_s", 0.0) * load * f["direction"] * np.exp(-speed / get("vs", 0.1))
        y = y + get("churn", 0.0) * f["direction"] * speed ** (2 / 3) * np.exp(-0.03 * (f["temperature"] - 293))
        y = y + get("seal", 0.0) * f["direction"]
        return y * (1 + get("t_gain", 0.0)) + get("t_offset", 0.0)
    hours, load = f["hours"] / 3600.0, f["load"]
    y = get("wear_rate", 1.0) * (load / 200) ** (1 + get("m", 0.0))
    y = y * (hours + get("r", 0.0) * get("s0", 150.0) * (1 - np.exp(-hours / get("s0", 150.0))) + get("debris", 0.0) * hours**2 / 1000) / 100
    return np.full(record.values.shape, y)


OUTSIDE = {
    "cage order": lambda r, a: a * np.cos(17.4 * r.axes["angle"]) if r.quantity == "te" else None,
    "resonance": lambda r, a: a * np.exp(-((r.axes["sliding_speed"] - 0.45) / 0.06) ** 2) * r.factors["direction"] if r.quantity == "torque" else None,
    "warm order 80": lambda r, a: a * np.cos(80 * r.axes["angle"]) * (r.factors["temperature"] - 310) if r.quantity == "te" else None,
    "arrhenius wear": lambda r, a: a * (r.factors["temperature"] - 310) / 20 * law(r, {}) if r.quantity == "wear" else None,
    "square load torque": lambda r, a: a * (r.factors["load"] / 200) ** 2 * r.factors["direction"] + 0 * r.values if r.quantity == "torque" else None,
    "thermal square": lambda r, a: a * (r.factors["temperature"] - 305) ** 2 / 100 * r.factors["load"] / 100 + 0 * r.values if r.quantity == "te" else None,
    "odd order": lambda r, a: a * np.cos(33 * r.axes["angle"] + 0.4) if r.quantity == "te" else None,
    "periodic speed": lambda r, a: a * np.sin(40 * r.axes["sliding_speed"]) if r.quantity == "torque" else None,
    "wear threshold": lambda r, a: a * max(r.factors["hours"] / 3600 - 500, 0) / 300 * (r.factors["temperature"] - 305) / 10 + 0 * r.values if r.quantity == "wear" else None,
    "loaded order 1": lambda r, a: a * np.cos(r.axes["angle"]) * np.sign(r.factors["load"] - 150) if r.quantity == "te" else None,
}


@dataclass
class Toy:
    """The model: records with their values, and the laws above."""

    records: list
    nuisances: tuple = NUISANCES
    candidates: tuple = CANDIDATES
    calls: int = 0

    def predict(self, values, which=None):
        self.calls += 1
        return [law(self.records[i], values) for i in (range(len(self.records)) if which is None else which)]


@dataclass
class Noise:
    """How the bench disturbs: correlation, tails, drift and offset from run to run, uneven sampling."""

    phi: float = 0.6
    tail: float = 5.0
    drift: float = 0.3
    offset: float = 0.3
    uneven: bool = False
    te: float = 1.0
    torque: float = 0.05
    wear: float = 0.04


def random_noise(rng):
    return Noise(rng.uniform(0.0, 0.9), rng.choice([3.0, 5.0, 50.0]), rng.choice([0.0, 0.5]), rng.choice([0.1, 0.5]), bool(rng.random() < 0.3))


def series(rng, n, noise, step):
    scale = np.sqrt(noise.tail / (noise.tail - 2)) if noise.tail > 2 else 1.0
    e = np.empty(n)
    state = 0.0
    for i, s in enumerate(rng.standard_t(noise.tail, n) / scale):
        rho = noise.phi ** step[i] if noise.phi else 0.0
        state = rho * state + np.sqrt(1 - rho**2) * s
        e[i] = state
    x = np.linspace(-1, 1, n)
    return e + noise.offset * rng.standard_normal() + noise.drift * rng.standard_normal() * x


def design(rng, noise, samples=360):
    """Empty records of a campaign: conditions with replicates, a quarter of them held out."""
    records = []

    def add(quantity, condition, count, axes, factors, mounting="1"):
        held = hash_of(quantity, condition) % 4 == 0
        for k in range(count):
            made = axes()
            n = len(next(iter(made.values()))) if made else 1
            records.append(Record(f"{quantity} {condition} {k}", quantity, "1", f"{quantity} {condition}", k, np.zeros(n), made, factors,
                                  mounting, held))

    def angle():
        a = np.linspace(0, TURN, samples, endpoint=False)
        return {"angle": np.sort(a + rng.uniform(-0.4, 0.4, samples) * TURN / samples) if noise.uneven else a}

    for k, (load, temperature, direction) in enumerate((a, b, c) for a in LOADS for b in (293.0, 320.0) for c in (1.0, -1.0)):
        add("te", k, 2, angle, {"load": load, "temperature": temperature, "direction": direction, "speed": 1.0}, "1" if k % 2 else "2")
    for k, (load, temperature, direction) in enumerate((a, b, c) for a in LOADS[:3] for b in (293.0, 320.0) for c in (1.0, -1.0)):
        add("torque", k, 2, lambda: {"sliding_speed": np.linspace(0.02, 0.9, 100)}, {"load": load, "temperature": temperature, "direction": direction})
    for k, (load, hours) in enumerate((a, b) for a in (100.0, 200.0, 400.0) for b in (50.0, 150.0, 400.0, 800.0)):
        add("wear", k, 3, dict, {"load": load, "hours": hours * 3600, "temperature": 293.0 + 15 * ((k * 7) % 3)})
    return records


def hash_of(quantity, condition):
    return (condition * 7 + {"te": 0, "torque": 1, "wear": 2}[quantity]) % 12


def measure(records, truth, noise, rng, extra=None):
    """Records filled with the truth and the noise."""
    result = []
    for r in records:
        y = law(r, truth)
        if extra is not None:
            more = extra(r)
            y = y if more is None else y + more
        if r.quantity == "wear":
            y = y * (1 + noise.wear * rng.standard_normal(y.shape))
        else:
            axis = next(iter(r.axes.values()))
            step = np.concatenate([[1.0], np.diff(axis) / np.median(np.diff(axis))])
            y = y + (noise.te if r.quantity == "te" else noise.torque) * series(rng, y.size, noise, step)
        result.append(Record(r.name, r.quantity, r.unit, r.condition, r.replicate, y, r.axes, r.factors, r.mounting, r.held_out))
    return result


@dataclass
class Hidden:
    """What a campaign hides."""

    kind: str
    names: tuple[str, ...] = ()
    values: dict = field(default_factory=dict)
    strength: float = 0.0


def campaign(seed, kind, strength=0.0, which=None, samples=360):
    """A campaign with ``kind`` in null, effect, outside, pair, fault; its model and its truth."""
    rng = np.random.default_rng(seed)
    noise = random_noise(rng)
    records = design(rng, noise, samples)
    truth = {"stiffness": rng.uniform(0.8, 1.2), "friction": rng.normal(0.02, 0.0004), "wear_rate": rng.uniform(0.7, 1.4),
             "phase_1": rng.uniform(-0.005, 0.005), "phase_2": rng.uniform(-0.005, 0.005)}
    if kind == "null":
        return Toy(measure(records, truth, noise, rng)), Hidden(kind)
    space = Workspace(Toy(measure(records, truth, noise, np.random.default_rng(seed + 10**6))))
    space.fit_base()
    plain = {i: law(records[i], truth) for i in space.training}
    if kind == "outside":
        name = which or rng.choice(sorted(OUTSIDE))

        def change(a):
            return {i: d for i in space.training if (d := OUTSIDE[name](records[i], a)) is not None}
        a = amplitude_for(space, change, strength, 1.0)
        return Toy(measure(records, truth, noise, rng, lambda r: OUTSIDE[name](r, a))), Hidden(kind, (str(name),), {"a": a}, strength)
    if kind == "fault":
        made = measure(records, truth, noise, rng)
        return Toy([faulty(r, which or rng.choice(["dropout", "quantised", "spikes", "swapped", "offset_one"]), rng, k) for k, r in enumerate(made)]), Hidden(kind)
    count = 2 if kind == "pair" else 1
    names = [which] if which else list(rng.choice([c.name for c in CANDIDATES], count, replace=False))
    values = {}
    for name in names:
        c = next(c for c in CANDIDATES if c.name == name)
        own = {p.name: float(np.exp(rng.uniform(np.log(0.5), np.log(2.0)))) * p.off for p in c.shapes}
        mix = rng.standard_normal(len(c.amplitudes)) if len(c.amplitudes) > 1 else np.ones(1)
        sign = [p.sign or rng.choice([-1, 1]) if len(c.amplitudes) == 1 else 1 for p in c.amplitudes]

        def effect(a, c=c, own=own, mix=mix, sign=sign):
            return {**own, **{p.name: a * p.scale * m * s for p, m, s in zip(c.amplitudes, mix, sign)}}
        a = amplitude_for(space, lambda a: {i: law(records[i], {**truth, **effect(a)}) - plain[i] for i in space.training}, strength, 1.0)
        values.update(effect(a))
    return Toy(measure(records, {**truth, **values}, noise, rng)), Hidden(kind, tuple(names), values, strength)


def faulty(record, fault, rng, index):
    """A record with a fault of the measuring chain that no replicate shares."""
    y = record.values.copy()
    if record.quantity != "te":
        return record
    if fault == "dropout" and index % 5 == 0:
        start = rng.integers(0, y.size - 40)
        y[start: start + 25] = 0.0
    elif fault == "quantised":
        y = np.round(y / 0.8) * 0.8
    elif fault == "spikes":
        y[rng.integers(0, y.size, 4)] += 30 * rng.standard_normal(4)
    elif fault == "offset_one" and index == 3:
        y = y + 4.0
    elif fault == "swapped" and index == 5:
        y = -y
    return Record(record.name, record.quantity, record.unit, record.condition, record.replicate, y, record.axes, record.factors,
                  record.mounting, record.held_out)
