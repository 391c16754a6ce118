"""Every variable of the wear unit; each piece of physics declares its own."""

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

from fmu_src.effect import amplitude_memory
from fmu_src.effect_check import require_sound_effects
from fmu_src.table import Table
from fmu_src.variables import Sizes, Variable
from wear_fmu import accumulator, kinematics, received, surfaces, sweeps, wear_laws
from wear_fmu.effects import EFFECTS
from wear_fmu.terminals import TERMINALS

# In this order they stand in the table, within each role.
PIECES = (kinematics, wear_laws, accumulator, received, sweeps, surfaces)


@dataclass(frozen=True)
class Resolution:
    """Number of bins of a surface: flank of one lobe, contact side of a pin, raceway."""

    flank: int = 180
    pin: int = 180
    raceway: int = 360


# Where only the names of the variables matter.
SMALLEST = SimpleNamespace(discs=1, cranks=1, pins=4, lobes=3, rollers=3)


def own_variables(topology: Any = SMALLEST, resolution: Resolution = Resolution()) -> list[Variable]:
    """Those that the wear unit has without any effect; ``topology`` has discs, cranks, pins, lobes, rollers."""
    sizes = Sizes({
        "disc": topology.discs, "crank": topology.cranks, "pin": topology.pins, "lobe": topology.lobes,
        "roller": topology.rollers, "flank bin": resolution.flank, "pin bin": resolution.pin, "raceway bin": resolution.raceway,
    })  # fmt: skip
    return [v for piece in PIECES for v in piece.variables(sizes)]


def wear_table(topology: Any, resolution: Resolution = Resolution()) -> Table:
    """The wear unit's variables for one topology."""
    require_sound_effects("wear_fmu")
    effects = [v for effect in EFFECTS.values() for v in effect.variables()]
    variables = [*own_variables(topology, resolution), *effects, amplitude_memory(EFFECTS.values())]
    # New surfaces are even, whatever is to wear them.
    known = {v.name: () for v in variables if v.role == "output"}
    return Table("RvWear", "RV reducer: wear of flanks, pins and needle-bearing raceways", variables, known, terminals=TERMINALS)
