"""One life of an ensemble, in whatever process it runs."""

from dataclasses import dataclass, replace

import numpy as np

from fmu_src.faults import InputFault, RunFault
from orchestrator.settings import ArraySetting, Setting
from reducers.reducer import Reducer
from studies.coupled_master import CoupledMaster
from studies.duty import Segment
from studies.ensemble.ensemble_file import DUTY_FACTORS
from studies.ensemble.figures import Outcome
from studies.held_input import lost_here, way_back
from studies.life import Life, LifeSettings, live
from studies.meshing_cycle import HOUR
from studies.pair import Pair, make_pair
from studies.solve import ARCMIN, ARCSEC
from studies.wear_figures import wear_figures

# Places of a turn at which lost motion is taken.
PLACES = 4
WEAR = ("inner_raceway_um", "outer_raceway_um", "disc_flank_um", "pin_um")
# A parameter's value, of an array that of each element.
Cells = float | list["Cells"]


@dataclass(frozen=True)
class Task:
    """All that a worker needs for one life."""

    number: int
    reducer: Reducer
    settings: tuple[Setting, ...]
    duty: tuple[Segment, ...]
    hours: float
    tolerance: float
    values: dict[str, Cells]


class LeanLife(Life):
    """Keeps the judged figures alone."""

    def note(self, pair: Pair) -> None:
        record = pair.wear.record()
        worn = wear_figures(record)
        self.hours.append(float(record["operating_time"][0]) / HOUR)
        self.figures.append({name: worn[name] for name in WEAR} | stiffness_figures(pair))


def stiffness_figures(pair: Pair) -> dict[str, float]:
    """Lag over a turn and lost motion at the present wear; the pair's state is put back."""
    saved = pair.master.save()
    pair.wear.set("acceleration", 0.0)
    way = way_back(abs(pair.plant.number("load_torque")))
    lags, lost = [], []
    for _ in range(PLACES):
        pair.master.run(max(1, pair.positions // PLACES))
        lags.append(pair.plant.number("lag"))
        lost.append(lost_here(pair, way))
    pair.master.restore(saved)
    return {"lost_motion_arcmin": float(np.mean(lost)) * ARCMIN, "lag_arcsec": abs(float(np.mean(lags))) * ARCSEC}


def run(task: Task) -> Outcome:
    """The life's hours and figures, or the fault that stopped it: part errors can make a reducer impossible."""
    values = dict(task.values)
    torque, speed = (scalar(values.pop(name, 1.0)) for name in DUTY_FACTORS)
    duty = tuple(replace(s, torque=s.torque * torque, speed=s.speed * speed) for s in task.duty)
    settings = [*task.settings, *(setting_of(name, value) for name, value in values.items())]
    life = LeanLife(LifeSettings(task.hours, task.tolerance))
    try:
        pair = make_pair(task.reducer, settings, duty=duty, master_kind=CoupledMaster)
        live(pair, life, lambda _: None, lambda _: None)
    except (InputFault, RunFault) as fault:
        return {"number": task.number, "fault": str(fault)}
    found = {name: [figures[name] for figures in life.figures] for name in life.figures[0]}
    return {"number": task.number, "hours": life.hours, "figures": found}


def setting_of(name: str, value: Cells) -> Setting | ArraySetting:
    return ArraySetting(name, np.array(value)) if isinstance(value, list) else Setting(name, value)


def scalar(value: Cells) -> float:
    assert not isinstance(value, list)
    return value
