"""Plant and wear as one unit."""

from functools import partial

from fmu_src.unit import Specification, Unit, started
from rv_plant.parts import cannot_be_made
from rv_plant.topology import Topology
from rv_reducer.judgement import CAUTIONS
from rv_reducer.reducer import FAULTS, initialise, step
from rv_reducer.variables import reducer_table
from wear_fmu.accumulator import CAUTIONS as OF_WEAR
from wear_fmu.variables import Resolution


def make_unit(specification: Specification) -> Unit:
    """The unit of a specification, see fmu_src.unit."""
    sizes = specification["sizes"]
    topology = Topology(**sizes["topology"])
    table = started(reducer_table(topology, Resolution(**sizes["resolution"])), specification)
    # The wear refuses before it changes anything; what the plant changes is what a look at lost motion puts back.
    refusal = partial(cannot_be_made, table=table, topology=topology, name=specification["reducer"])
    return Unit(table, initialise, step, FAULTS, table.by_name["kept"].size, OF_WEAR | CAUTIONS, ("pausing", "paused_after"), refusal)
