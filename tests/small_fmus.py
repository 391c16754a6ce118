"""FMUs small enough to check by hand, as others write them with pythonfmu: no units, no declared dependencies."""

import subprocess
import sys
import zipfile
from pathlib import Path

SPRING = '''
import math
import os
import time

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Boolean, Integer, Real, String


class Spring(Fmi2Slave):
    """x'' = -k x + c (u - x), exact for a held input."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.u, self.x, self.v, self.k, self.c = 0.0, 0.0, 0.0, 1.0, 0.5
        self.mode, self.note, self.loud = 0, "", False
        self.register_variable(Real("u", causality=Fmi2Causality.input))
        self.register_variable(Real("x", causality=Fmi2Causality.output, start=0.0))
        self.register_variable(Real("v", causality=Fmi2Causality.output))
        for name in ("k", "c"):
            self.register_variable(Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))
        # 1 crashes in the third step, 2 hangs there, 3 refuses.
        self.register_variable(Integer("mode", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))
        self.register_variable(Boolean("loud", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))
        self.register_variable(String("note", causality=Fmi2Causality.parameter, variability=Fmi2Variability.tunable))

    def do_step(self, current_time, step_size):
        if current_time > 0.15 and self.mode == 1:
            os.kill(os.getpid(), 11)
        if current_time > 0.15 and self.mode == 2:
            time.sleep(60.0)
        if self.loud:
            print("a step", flush=True)
        rest, w = self.c * self.u / (self.k + self.c), math.sqrt(self.k + self.c)
        a, b = math.cos(w * step_size), math.sin(w * step_size)
        x = self.x - rest
        self.x, self.v = rest + x * a + self.v * b / w, -x * w * b + self.v * a
        return not (current_time > 0.15 and self.mode == 3)
'''


def build_spring(folder):
    """``folder``/Spring.fmu"""
    (folder / "spring_slave.py").write_text(SPRING, encoding="utf-8")
    command = [sys.executable, "-m", "pythonfmu", "build", "-f", folder / "spring_slave.py", "-d", folder,
               "--no-external-tool", "--handle-state", "--serialize-state"]  # fmt: skip
    subprocess.run(command, check=True, capture_output=True)
    return folder / "Spring.fmu"


SLEEPER = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Sleeper" guid="{sleeper}">
<CoSimulation modelIdentifier="Sleeper" canHandleVariableCommunicationStepSize="true" canGetAndSetFMUstate="true"/>
<ModelVariables>
<ScalarVariable name="x" valueReference="0" causality="output" variability="continuous"><Real/></ScalarVariable>
<ScalarVariable name="u" valueReference="1" causality="input" variability="continuous"><Real start="0"/></ScalarVariable>
</ModelVariables>
<ModelStructure><Outputs><Unknown index="1" dependencies=""/></Outputs></ModelStructure>
</fmiModelDescription>
"""


def build_sleeper(folder):
    """``folder``/Sleeper.fmu: an FMI 2.0 unit in C that hangs in the function that HANG_IN names."""
    library = folder / "Sleeper.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-w", "-o", library, Path(__file__).with_name("sleeper.c")], check=True, capture_output=True)
    with zipfile.ZipFile(folder / "Sleeper.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", SLEEPER)
        archive.write(library, f"binaries/{platform_of()}/Sleeper.so")
    return folder / "Sleeper.fmu"


def platform_of():
    """Of FMI 2.0, as fmpy names it."""
    import fmpy

    return fmpy.platform
