"""Plant and wear unit of one reducer, connected."""

import math
import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from fmu_src.faults import InputFault
from orchestrator.component import Component, InProcess
from orchestrator.master import Master
from orchestrator.settings import ArraySetting, Setting, apply
from reducers.reducer import Reducer
from rv_plant.gear_stage import total_ratio
from rv_reducer.exchange import PLANT_TO_WEAR, WEAR_TO_PLANT
from studies.duty import Segment

if TYPE_CHECKING:
    from orchestrator.fmu import Fmu

# Everything that the two units exchange.
CONNECTIONS = [
    *((f"plant.{name}", f"wear.{name}") for name in PLANT_TO_WEAR),
    *((f"wear.{name}", f"plant.{name}") for name in WEAR_TO_PLANT),
]

POSITIONS_PER_TURN = 72


@dataclass
class Pair:
    """The coupled units and how they are stepped through crank turns."""

    reducer: Reducer
    master: Master
    plant: Component
    wear: Component
    positions: int
    duty: tuple[Segment, ...] = ()

    @property
    def turn_time(self) -> float:
        """Duration of one crank turn in the housing [s] at the set input speed."""
        return crank_turn_time(self.reducer, self.plant)

    def set_positions(self, positions: int) -> None:
        """Equilibria per crank turn from now on."""
        self.positions = positions
        self.master.rebase(self.turn_time / positions)


    def set_operation(self, speed: float, torque: float) -> None:
        """Other input speed [rad/s] and output torque [N m] from now on, the same positions per turn.

        Two positions are run without wear, so that the profile errors exchanged are those of
        the new step.
        """
        self.plant.set("input_speed", speed)
        self.plant.set("load_torque", torque)
        self.wear.set("acceleration", 0.0)
        self.master.rebase(self.turn_time / self.positions)
        self.master.run(2)


def crank_turn_time(reducer: Reducer, plant: Component) -> float:
    """Duration of one crank turn in the housing [s] at the plant's input speed."""
    speed = plant.number("input_speed")
    if speed == 0.0:
        raise InputFault("input.speed = 0 rad/s: the cranks must turn; set input.speed, for instance 2000rpm")
    ratio = total_ratio(plant.get("first_stage_ratio"), reducer.topology.pins, reducer.topology.lobes)
    return float(2.0 * math.pi / (abs(speed / ratio) * reducer.topology.lobes))


def require_built_from(reducer: Reducer, fmu: "Fmu", unit: str) -> None:
    """An FMU has its sizes and start values from one reducer file: it must be this one."""
    worn = fmu.specification().get("worn")
    if worn is not None:
        raise InputFault(
            f"{fmu.path} is of a reducer that is delivered worn, after {worn['hours']:g} h: what is computed here begins with a new one;"
            f" build it: rvwear build --reducer {reducer.name} --output DIR, and give that folder. rvwear run takes {fmu.path.name} as it is"
        )
    if fmu.specification() != reducer.specification(unit):
        raise InputFault(
            f"{fmu.path} was built from another reducer file than {reducer.name} ({reducer.path.name});"
            f" build it anew: rvwear build --reducer {reducer.name} --output {shlex.quote(str(fmu.path.parent))}"
        )


def make_pair(
    reducer: Reducer,
    settings: Sequence[Setting | ArraySetting] = (),
    fmus: Path | None = None,
    scheme: str = "gauss-seidel",
    positions: int = POSITIONS_PER_TURN,
    duty: tuple[Segment, ...] = (),
    master_kind: type[Master] = Master,
) -> Pair:
    """Initialised pair of a reducer: in this process, or as FMUs from the folder ``fmus``."""
    if fmus is None:
        plant: Component = InProcess("plant", reducer.specification("rv_plant"))
        wear: Component = InProcess("wear", reducer.specification("wear_fmu"))
    else:
        # FMUs need more of a reader than a pair in this process.
        from orchestrator.fmu import Fmu

        units = Fmu("plant", fmus / "RvPlant.fmu"), Fmu("wear", fmus / "RvWear.fmu")
        for fmu, package in zip(units, ("rv_plant", "wear_fmu")):
            require_built_from(reducer, fmu, package)
        plant, wear = units
    components = {"plant": plant, "wear": wear}
    # A temperature that is set is the surroundings' too.
    connected = {target.partition(".")[2] for _, target in CONNECTIONS} - {"heat.contact_temperature"}
    for setting in settings:
        for name in {c.signal(setting.name).name for c in components.values() if c.has(setting.name)}:
            if name.partition("[")[0] in connected:
                raise InputFault(f"{name} is exchanged by the two units; a setting of it would have no effect")
    apply(settings, components)
    step = crank_turn_time(reducer, plant) / positions
    master = master_kind(components, CONNECTIONS, step, scheme=scheme)
    master.initialise()
    pair = Pair(reducer, master, plant, wear, positions, duty)
    if duty:
        pair.set_operation(duty[0].speed, duty[0].torque)
    return pair
