"""One HTML file in which a reducer turns, is loaded, wears and shows its forces: nothing to install, nothing that is fetched.

    python examples/browser/make.py [--reducer RV20E-121] [--output reducer.html]

The page holds RvReducer as WebAssembly, the very module that ``rvwear build --wasm`` puts into the FMU, and steps it
as an importer would: instantiate, set, step, get.  Needs zig to make: pip install "rvwear[build]".
"""

import argparse
import base64
import json
import math
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from fmu_src.description import guid
from fmu_src.native import object_codes
from fmu_src.source_hash import source_hash
from fmu_src.state import HEADER_SIZE
from fmu_src.unit import make_unit
from fmu_src.unit_table import c_source
from fmu_src.wasm.encoding import memory_pages
from fmu_src.wasm.linking import TRIPLE, core_module
from orchestrator.component import InProcess
from reducers.reducer import Reducer, load_reducer
from rv_plant.geometry import lobe_point, shortening

HERE = Path(__file__).parent
# What the page sets and shows, by what it calls them.
SET = {"speed": "input_speed", "torque": "load_torque", "acceleration": "acceleration"}
SHOWN = {
    "crankAngle": "crank_angle", "outputAngle": "output_angle", "outputSpeed": "output_speed", "lag": "lag",
    "transmissionError": "transmission_error", "pinForce": "largest_pin_force", "rollerForce": "largest_roller_force", "hours": "operating_time",
    "flank": "worst_flank_depth", "race": "worst_race_depth", "lostMotion": "lost_motion", "life": "remaining_life",
}  # fmt: skip
# Single contacts and surfaces stand in the unit's state.
HELD = {"forces": "mesh_force", "wear": "disc_wear"}
# Points of the drawn flank per lobe.
FINE = 60


def facts(reducer: Reducer) -> dict[str, Any]:
    """What the page must know of the unit: references, places, geometry in mm, rated speed and torque."""
    unit = InProcess("reducer", reducer.specification("rv_reducer"))
    table = unit.table
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    unit.step(0.0, 1e-3)
    record = unit.record()[0]
    discs, pins = table.by_name["mesh_force"].shape
    discs_and_cranks = table.by_name["inner_race_depth"].shape
    lobes = pins - 1
    circle = record["pin_circle_radius"] + record["shift_modification"]
    k1 = shortening(record["eccentricity"], lobes, circle)
    phases = 2.0 * math.pi * lobes * (np.arange(lobes * FINE) + 0.5) / (lobes * FINE)
    radius = record["pin_radius"] + record["equidistant_modification"]
    points = np.array([lobe_point(phase, lobes, circle, radius, record["eccentricity"], k1) for phase in phases])
    return {
        "name": reducer.name, "token": guid(reducer.specification("rv_reducer"), source_hash()), "header": HEADER_SIZE,
        "set": {key: table.offset[name] for key, name in SET.items()}, "shown": {key: table.offset[name] for key, name in SHOWN.items()},
        "held": {key: [table.offset[name], *table.by_name[name].shape] for key, name in HELD.items()},
        "discs": discs, "pins": pins, "lobes": lobes, "cranks": discs_and_cranks[1], "fine": FINE,
        "flank": np.round(points[:FINE] * [1e3, 1e3, 1.0, 1.0], 5).tolist(),
        **{key: round(1e3 * float(record[name]), 6) for key, name in {
            "pinCircle": "pin_circle_radius", "pinRadius": "pin_radius", "eccentricity": "eccentricity", "crankCircle": "crank_circle_radius",
            "innerRace": "inner_race_radius", "outerRace": "outer_race_radius", "rollerRadius": "roller_radius",
        }.items()},
        "rated": {"torque": float(record["load_torque"]), "rpm": abs(float(record["output_speed"])) * 30.0 / math.pi},
        "ratio": float(record["input_speed"] / record["output_speed"]),
    }  # fmt: skip


def page(reducer: Reducer) -> str:
    """The whole page as text."""
    specification = reducer.specification("rv_reducer")
    unit = make_unit(specification)
    known = facts(reducer)
    core = core_module("RvReducer", c_source(unit, known["token"]), object_codes(specification, (TRIPLE,))[TRIPLE])
    known["pages"] = memory_pages(core)
    parts = {
        "NAME": escape(reducer.name), "CSS": (HERE / "page.css").read_text(encoding="utf-8"), "UNIT": (HERE / "unit.js").read_text(encoding="utf-8"),
        "PICTURE": (HERE / "picture.js").read_text(encoding="utf-8"), "SCRIPT": (HERE / "page.js").read_text(encoding="utf-8"),
        "FACTS": json.dumps(known).replace("<", "\\u003c"), "WASM": base64.b64encode(core).decode(),
    }  # fmt: skip
    text = (HERE / "page.html").read_text(encoding="utf-8")
    for name, part in parts.items():
        text = text.replace(f"{{{{{name}}}}}", part)
    return text


def main() -> None:
    options = argparse.ArgumentParser(description="A reducer as WebAssembly in one HTML file.")
    options.add_argument("--reducer", default="RV20E-121", help="name or file (default RV20E-121)")
    options.add_argument("--output", default="reducer.html", help="file to write (default reducer.html)")
    given = options.parse_args()
    target = Path(given.output)
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(page(load_reducer(given.reducer)), encoding="utf-8")
    print(f"{target}  {target.stat().st_size / 1e3:.0f} kB: open it in a browser")


if __name__ == "__main__":
    main()
