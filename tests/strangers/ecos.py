"""Steps an SSP with ecos and prints what asked-for variables are at the end.

    python ecos.py SSP STEP STEPS component.variable...
"""

import ctypes
import json
import sys
from pathlib import Path
from time import perf_counter

# The library asks for TBB, which the package of that name puts beside the interpreter.
for library in sorted(Path(sys.prefix, "lib").glob("libtbb.so.12*"))[:1]:
    ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)

from ecospy import EcosLib, EcosSimulation  # noqa: E402

path, step, steps, paths = sys.argv[1], float(sys.argv[2]), int(sys.argv[3]), sys.argv[4:]
EcosLib.set_log_level("err")
simulation = EcosSimulation(ssp_path=path, step_size=step)
simulation.init(parameter_set="initialValues")
simulation.step(1)
started = perf_counter()
simulation.step(steps - 1)
seconds = perf_counter() - started
values = {p: simulation.get_real(p.replace(".", "::", 1)) for p in paths}
print(json.dumps({"values": values, "seconds_per_step": seconds / (steps - 1)}))
simulation.terminate()
