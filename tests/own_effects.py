"""Effect files as somebody would write them, and a process of their own in which they are taken."""

import os
import subprocess
import sys
from pathlib import Path

from fmu_src.effect_check import check_any_file

HEAD = """import math
from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel
from fmu_src.variables import Variable
from rv_plant.gear_stage import planet_radius

EFFECT = Effect(
    0, "mine", "law", "source", "signature",
    (amplitude("my_size", "1", "size", 0.1, 0.0, 1.0),),
    states=(Variable("my_state", "state", "1", "state", 0.0, (2,), ("element",)),),
)


"""
# Lines of a kernel in ``HEAD`` count from here.
FIRST = HEAD.count("\n") + 1


def written(folder: Path, text: str, unit: str = "rv_plant", name: str = "mine") -> Path:
    file = folder / unit / f"{name}.py"
    file.parent.mkdir(exist_ok=True)
    file.write_text(text, encoding="utf-8")
    return file


def told(folder, text, **where) -> list[tuple[int, str]]:
    return [(f.line, f.text) for f in check_any_file(written(folder, text, **where))]


def hook(line: str, name: str = "before(r)") -> str:
    return f"{HEAD}@kernel\ndef {name}:\n    {line}\n"


GOOD = """@kernel
def share(r, gap, k):
    gap[k] += r.my_size * planet_radius(r.crank_circle_radius, 3.0)
    return gap


@kernel
def before(r):
    discs, cranks, rollers = r.roller_gap_now.shape
    for d in range(discs):
        for c in range(cranks):
            gap = r.roller_gap_now[d, c]
            for k in range(rollers):
                share(r, gap, k)
    r.ring_scale *= 1.0 + r.my_size * (r.reducer_temperature - 293.15)
    r.my_state[0] = r.my_state[1] + math.cos(r.ideal_output)
    last = len(r.my_state) - 1
    r.my_state[last] -= 1.0 if r.my_size > 0.0 else 0.0


@kernel
def hold(r):
    tangent, force = r.tangent, r.residual_vector
    tangent[0, 0] += r.my_size
    force[0] += r.my_size * r.z[0]
"""


LAW = """import math
from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel

EFFECT = Effect(
    0, "lip", "T = a exp(-n/n0)", "own bench", "falls with speed",
    (amplitude("lip_torque", "N.m", "a", 0.1, 0.0, 5.0, sign=1), shape("lip_speed", "rad/s", "n0", 30.0, 12.0, 300.0, "assumed"),
     shape("lip_power", "1", "p", 1.0, 0.5, 2.0, "known", held=True)),
    signals=("input_torque",),
)


@kernel
def after(r):
    speed = abs(r.input_speed)
    r.friction_power += r.lip_torque * math.exp(-((speed / r.lip_speed) ** r.lip_power)) * speed
"""


def in_its_own_process(folder: Path, program: str) -> subprocess.CompletedProcess:
    """Effects are taken when the units are imported."""
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120,
                          env={**os.environ, "RVWEAR_EFFECTS": str(folder), "RVWEAR_PLAIN_PYTHON": "1", "XDG_CACHE_HOME": str(folder)})
