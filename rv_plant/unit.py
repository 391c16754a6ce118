"""The plant as a unit."""

from functools import partial

from fmu_src.unit import Specification, Unit, started
from rv_plant.faults import FAULTS
from rv_plant.parts import cannot_be_made
from rv_plant.plant import initialise, step
from rv_plant.topology import Topology
from rv_plant.variables import plant_table


def make_unit(specification: Specification) -> Unit:
    """The plant of a specification, see fmu_src.unit."""
    topology = Topology(**specification["sizes"]["topology"])
    table = started(plant_table(topology), specification)
    return Unit(table, initialise, step, FAULTS, refusal=partial(cannot_be_made, table=table, topology=topology, name=specification["reducer"]))
