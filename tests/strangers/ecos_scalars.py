"""Couples the pair in ecos by its scalars, for FMI 3.0 units: ecos connects no arrays.

    python ecos_scalars.py FOLDER STEP STEPS component.variable...
"""

import ctypes
import json
import sys
from pathlib import Path

for library in sorted(Path(sys.prefix, "lib").glob("libtbb.so.12*"))[:1]:
    ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)

from ecospy import EcosLib, EcosSimulation, EcosSimulationStructure  # noqa: E402

folder, step, steps, paths = Path(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]), sys.argv[4:]
EcosLib.set_log_level("err")
with EcosSimulationStructure() as structure:
    structure.add_model("plant", str(folder / "RvPlant.fmu"))
    structure.add_model("wear", str(folder / "RvWear.fmu"))
    for name in ("crank.angle", "crank.speed", "output.angle", "cage.angle", "heat.contact_temperature"):
        structure.make_real_connection(f"plant::{name}", f"wear::{name}")
    with EcosSimulation(structure=structure, step_size=step) as simulation:
        simulation.init()
        simulation.step(steps)
        print(json.dumps({"values": {p: simulation.get_real(p.replace(".", "::", 1)) for p in paths}}))
        simulation.terminate()
