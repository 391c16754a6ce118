"""A reducer of three laws, its comparison and diagnosis, and what every page of the loop must fulfil."""

import json
import re
from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import plotly.graph_objects as go
from shared import unpacked

from discrepancy.compare import Comparison, by_signal, warnings_of
from discrepancy.extend import DID_NOT_HELP, HELPED, NOT_PROVEN
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.law.recover import recover
from discrepancy.inference.verdict import ONE, UNKNOWN
from discrepancy.model_file import ModelFile
from discrepancy.page import write_page
from discrepancy.problem import Candidate, Parameter, Record
from discrepancy.verdict import Answer, effects_of

ARCSEC = np.pi / 180.0 / 3600.0
ANGLE = np.linspace(0.0, 2.0 * np.pi, 240, endpoint=False)
CANDIDATES = (
    Candidate("clearance", "clearance", (Parameter("gap", "m", 0.0, 0.0, 1e-4, 1e-6, 1),), signals=("transmission_error",)),
    Candidate("sensor_gain.input_torque", "gain", (Parameter("gain", "1", 0.0, -0.5, 0.5, 0.02),), signals=("input_torque",), part="chain"),
    Candidate("runout", "runout", (Parameter("run_c", "rad", 0.0, -1e-2, 1e-2, 1e-6), Parameter("run_s", "rad", 0.0, -1e-2, 1e-2, 1e-6)),
              signals=("transmission_error",)),
)  # fmt: skip
FRICTION = Parameter("friction", "1", 0.01, 0.0, 0.1, 1e-3, prior=5e-4, description="coefficient")


def law(record, v):
    load = record.factors["load"]
    if record.quantity == "input_torque":
        return np.full(1, v.get("friction", 0.01) * load * (1.0 + v.get("gain", 0.0)))
    return (3.0 * ARCSEC * np.cos(40 * ANGLE) + 2.0 * (v.get("gap", 0.0) + v.get("tilt", 0.0)) * load / 167.0 * np.cos(20 * ANGLE)
            + v.get("run_c", 0.0) * np.cos(ANGLE) + v.get("run_s", 0.0) * np.sin(ANGLE))  # fmt: skip


@dataclass
class Model:
    """What the pages ask of a physical model."""

    records: list
    file: object
    campaign: object
    nuisances: tuple = (FRICTION,)
    candidates: tuple = CANDIDATES
    unpredicted: tuple = ()

    def predict(self, values, which=None):
        return [law(self.records[i], values) for i in (range(len(self.records)) if which is None else which)]


def model_of(hidden=None, held=True, extra=None):
    rng = np.random.default_rng(4)
    records = []
    for k, load in enumerate((50.0, 100.0, 130.0, 167.0, 80.0)):
        factors = {"speed": 190.0, "load": load, "temperature": 293.0 + 5.0 * (k % 2)}
        for replicate in range(2):
            for quantity, unit, size in (("transmission_error", "rad", ARCSEC), ("input_torque", "N.m", 0.01)):
                axes = {"angle": ANGLE} if quantity == "transmission_error" else {}
                record = Record(f"{quantity} {k} {replicate}", quantity, unit, f"load {load:g}", replicate, np.zeros(1), axes, factors, "1", held and k == 4)
                values = law(record, hidden or {})
                if extra and axes:
                    values = values + extra(load)
                records.append(replace(record, values=values + size * rng.normal(size=values.size)))
    file = SimpleNamespace(name="gearbox <7>", heading="gearbox <7>", effects={}, in_words="the base model")
    return Model(records, file, SimpleNamespace(name="bench & bolt", rig=None, records=(), copies={}, speed_at="output", ratio=100.0))


def compared(model):
    doctor = Diagnostician(model)
    doctor.prepare()
    space = doctor.space
    predictions = space.predictions(space.base.values, list(range(len(space.records))))
    runs = []
    for record, y, w in zip(space.records, predictions, space.noise.whiteners):
        error, floor = float(np.sqrt(np.mean((record.values - y) ** 2))), float(np.sqrt(np.mean(w.scale**2)))
        runs.append({"run": record.name, "signal": record.quantity, "condition": record.condition, "replicate": record.replicate, "held_out": record.held_out,
                     "left_out": record.left_out, "unit": record.unit, "samples": y.size, "dropped": 0, "error": error, "noise_floor": floor, "ratio": error / floor})  # fmt: skip
    return Comparison(model, doctor, runs, by_signal(runs), dict(space.base.values), warnings_of(model, []), predictions)


def diagnosed(model):
    doctor = Diagnostician(model)
    found = doctor.run()
    laws = recover(found.fits.space, found.fits.space.base, ["transmission_error"]) if found.verdict == UNKNOWN else []
    return Answer(model, found, found.verdict, found.reason, effects_of(found, doctor), found.confusable, laws, list(found.warnings), [], doctor)


def spike(load):
    return 8.0 * ARCSEC * np.exp(-(((ANGLE - 2.0) / 0.3) ** 2)) * load / 167.0


def named():
    """An answer that names the clearance."""
    found = diagnosed(model_of({"gap": 2e-6 * 5}))
    assert found.verdict == ONE and found.effects[0]["name"] == "clearance"
    return found


def step(effect, before, after, verdict, **more):
    half = [None if v is None else 0.5 * v for v in (before, after)]
    signals = [{"signal": "transmission_error", "held_out": held, "unit": "rad", "before": 8e-6, "after": 4e-6, "noise_floor": 3e-6} for held in (False, True)]
    return {"campaign": "bench", "effects": [effect], "verdict": verdict, "reason": f"because of {effect}", "kept": verdict != DID_NOT_HELP,
            "training_before": 6.0, "training_after": 2.0, "held_out_before": before, "held_out_after": after,
            "held_out_error_before": half[0], "held_out_error_after": half[1], "signals": signals} | more  # fmt: skip


def file_of(*steps):
    effects = {"clearance": {"gap": {"value": 2.1e-6, "unit": "m", "low": 1.9e-6, "high": 2.3e-6}}}
    return ModelFile("gearbox 7", SimpleNamespace(name="RV20E-121"), {}, effects if steps else {}, tuple(steps))


STEPS = (step("clearance", 12.34, 3.21, HELPED), step("sensor_gain.input_torque", 3.21, 4.56, DID_NOT_HELP),
         step("runout", None, None, NOT_PROVEN), step("drag", 3.21, 1.05, HELPED))  # fmt: skip


def written(result, tmp_path):
    """The page's text; checks what every page must fulfil."""
    one, two = write_page(result, tmp_path / "one.html"), write_page(result, tmp_path / "two.html")
    assert one.read_bytes() == two.read_bytes() and one.stat().st_size < 7e6
    page = one.read_text(encoding="utf-8")
    markup = re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
    assert not re.search(r"https?:|@import|url\(|<link|<img|<iframe", markup)
    assert not re.search(r"<script[^>]*\bsrc", page) and "plotly.js v" in unpacked(page)
    links = re.findall(r'href="#([^"]*)"', markup)
    assert all(re.search(rf'<(section|details class="fold notes") id="{name}"', markup) for name in links)
    figures = figures_of(page)
    assert [f["name"] for f in figures] == re.findall(r'class="plot" id="plot-(\w+)"', markup)
    for figure in figures:
        go.Figure(figure["data"], figure["layout"])
        for choice in figure["choices"]:
            assert len(choice["traces"]) == len(figure["data"])
            go.Figure([t | u for t, u in zip(figure["data"], choice["traces"])], figure["layout"] | choice["layout"])
    return page


def figures_of(page):
    return json.loads(re.search(r'<script type="application/json" id="content">(.*?)</script>', page, re.DOTALL)[1])["figures"]


def figure(page, name):
    return next(f for f in figures_of(page) if f["name"] == name)
