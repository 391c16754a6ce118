"""The plant as a unit."""

from fmu_src.unit import Specification, Unit, started
from rv_plant.faults import FAULTS
from rv_plant.plant import initialise, step
from rv_plant.topology import Topology
from rv_plant.variables import plant_table


def make_unit(specification: Specification) -> Unit:
    """The plant of a specification, see fmu_src.unit."""
    table = plant_table(Topology(**specification["sizes"]["topology"]))
    return Unit(started(table, specification), initialise, step, FAULTS)
