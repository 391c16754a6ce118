"""Every variable of the plant; each piece of physics declares its own."""

from fmu_src.effect import amplitude_memory
from fmu_src.effect_check import require_sound_effects
from fmu_src.table import Table
from fmu_src.variables import Variable
from rv_plant import (
    assembly,
    constraints,
    contact,
    dynamics,
    equilibrium,
    force_paths,
    gear_stage,
    integrator,
    mesh,
    motion,
    near_mesh,
    needle_bearing,
    output_pins,
    outputs,
    plant,
    poses,
    profiles,
    supports,
    turning,
)
from rv_plant.effects import EFFECTS
from rv_plant.terminals import TERMINALS
from rv_plant.topology import SMALLEST, Topology

# In this order they stand in the table, within each role.
PIECES = (
    plant, turning, mesh, near_mesh, poses, needle_bearing, profiles, force_paths, output_pins, gear_stage, supports, contact, assembly, equilibrium,
    outputs, dynamics, constraints, integrator, motion,
)  # fmt: skip


# Nothing has turned yet.
STARTS_AT_ZERO = ("cage_angle", "crank_path", "mesh_force_path", "roller_force_path")


def own_variables(topology: Topology = SMALLEST) -> list[Variable]:
    """Those that the plant has without any effect."""
    sizes = topology.sizes()
    return [v for piece in PIECES for v in piece.variables(sizes)]


def plant_table(topology: Topology) -> Table:
    """The plant's variables for one topology; numbers of a real reducer come from its file."""
    require_sound_effects("rv_plant")
    effects = [v for effect in EFFECTS.values() for v in effect.variables()]
    return Table("RvPlant", "RV reducer: equilibrium or motion of discs, pins, needle bearings and cranks",
                 [v.within(vars(topology)) for v in [*own_variables(topology), *effects, amplitude_memory(EFFECTS.values())]],
                 dict.fromkeys(STARTS_AT_ZERO, ()), terminals=TERMINALS)
