"""Step 4: an effect file drafted from a law that was recovered without a name.

The draft builds and runs: put into a folder ``DIR/rv_plant/`` or ``DIR/wear_fmu/`` and named by the
environment variable RVWEAR_EFFECTS, it is compiled into the units and found by the diagnosis.
"""

from pathlib import Path

from discrepancy.inference.law.recover import Recovered
from discrepancy.verdict import Answer

# Signals whose missing part is a loss at the input, and those that are worn depths.
LOSSES = ("input_torque", "no_load_torque", "efficiency", "temperature")
WEAR = ("wear_depth", "wear_profile", "mass_loss", "debris_iron")

# The recovered factor as the kernels call it, by unit.
PLANT_NAMES = {"speed": "abs(r.input_speed)", "load": "abs(r.load_torque)", "temperature": "r.reducer_temperature"}
WEAR_NAMES = {
    "speed": "abs(r.crank_speed)", "load": "line_load", "temperature": "r.temperature", "hours": "r.operating_time",
}  # fmt: skip

BODIES = {
    "constant": "1.0", "linear": "x / {scale}", "quadratic": "(x / {scale}) ** 2", "power": "(x / {scale}) ** r.{name}_power",
    "exponential": "math.exp(r.{name}_power * x / {scale})", "logarithmic": "math.log(max(x, 1e-12) / {scale})",
    "saturating": "x / (x + r.{name}_power * {scale})", "threshold": "max(0.0, x / {scale} - r.{name}_power)",
    "step": "1.0 / (1.0 + math.exp(min(60.0, -50.0 * (x / {scale} - r.{name}_power))))",
    "bump": "math.exp(-25.0 * (x / {scale} - r.{name}_power) ** 2)", "periodic": "math.cos(r.{name}_power * x / {scale})",
}  # fmt: skip


def draft_effect(answer: Answer, target: Path) -> Path | None:
    """Write the draft of the best law; None where no law was recovered or the effect would have no place."""
    laws = [law for law in answer.laws if law.forms]
    for law in laws:
        quantity = law.signal.partition("[")[0]
        unit = "rv_plant" if quantity in LOSSES else "wear_fmu" if quantity in WEAR else None
        names = PLANT_NAMES if unit == "rv_plant" else WEAR_NAMES
        if unit is None or law.leading not in names:
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text_of(target.stem, law, unit, names[law.leading]), encoding="utf-8")
        return target
    return None


def text_of(name: str, law: Recovered, unit: str, x: str) -> str:
    """The effect's file: a term that is added (plant) or a factor (wear), off at amplitude 0."""
    form = law.forms[0]
    scale = repr(max(abs(v) for v in law.points["x"]) or 1.0)
    body = BODIES.get(form.name, BODIES["linear"]).format(name=name, scale=scale)
    lines = [
        f'"""Draft: {law.text}.', "", f"Recovered from measurements, confidence among closed forms {form.confidence:.2f}.",
        "Give it a name, a source and physical bounds before it is trusted.", '"""', "", "import math", "",
        "from fmu_src.effect import Effect, amplitude, shape", "from fmu_src.kernel import kernel", "", "EFFECT = Effect(",
        f'    0, "draft: {name}", "{law.text}", "recovered from measurements, no physics yet", "that of the recovered law",', "    (",
        f'        amplitude("{name}_size", "{"N.m" if unit == "rv_plant" else "1"}", "size of the recovered term", 0.1, -1e3, 1e3),',
    ]  # fmt: skip
    if "_power" in body:
        lines.append(f'        shape("{name}_power", "1", "its shape", 1.0, -20.0, 20.0, "recovered", grid=(0.5, 1.0, 2.0)),')
    lines += ["    ),", f"    signals=({law.signal.partition('[')[0]!r},),", ")", "", "", "@kernel"]
    if unit == "rv_plant":
        lines += [
            "def after(r):", f"    if r.{name}_size == 0.0:", "        return", f"    x = {x}",
            "    # Torque at the input, as power.", f"    r.friction_power += r.{name}_size * ({body}) * abs(r.input_speed)",
        ]  # fmt: skip
    else:
        lines += [
            "def prepare(r):", f"    if r.{name}_size != 0.0:", "        r.effects_on += 1", "", "", "@kernel",
            "def factor(r, surface, line_load, radius, speed, depth):", f"    if r.{name}_size == 0.0:", "        return 1.0",
            f"    x = {x}", f"    return max(0.0, 1.0 + r.{name}_size * ({body}))",
        ]  # fmt: skip
    return "\n".join(lines) + "\n"
