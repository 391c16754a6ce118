"""Plant and wear as one unit."""

from fmu_src.unit import Unit
from rv_plant.variables import FILE, Topology
from wear_fmu.variables import Resolution

from rv_reducer.reducer import FAULTS, initialise, step
from rv_reducer.variables import reducer_table


def make_unit(specification: dict) -> Unit:
    """The unit of a specification, see fmu_src.unit."""
    sizes = specification["sizes"]
    table = reducer_table(Topology(**sizes["topology"]), Resolution(**sizes["resolution"]))
    return Unit(table.with_starts(specification["starts"], specification["sources"]), initialise, step, FAULTS)
