"""Steps an SSP with ecos and prints what asked-for variables are at the end.

    python ecos.py SSP STEP STEPS component.variable...
"""

import ctypes
import json
import sys
from pathlib import Path
from time import process_time

# The library asks for TBB, which the package of that name puts beside the interpreter.
for library in sorted(Path(sys.prefix, "lib").glob("libtbb.so.12*"))[:1]:
    ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)

from ecospy import EcosLib, EcosSimulation  # noqa: E402

path, step, steps, paths = sys.argv[1], float(sys.argv[2]), int(sys.argv[3]), sys.argv[4:]
EcosLib.set_log_level("err")
simulation = EcosSimulation(ssp_path=path, step_size=step)
simulation.init(parameter_set="initialValues")
# The smallest of bursts of a hundred: others use the machine too.
burst, seconds = min(100, steps), float("inf")
for _ in range(steps // burst):
    started = process_time()
    simulation.step(burst)
    seconds = min(seconds, (process_time() - started) / burst)
values = {p: simulation.get_real(p.replace(".", "::", 1)) for p in paths}
print(json.dumps({"values": values, "seconds_per_step": seconds}))
simulation.terminate()
