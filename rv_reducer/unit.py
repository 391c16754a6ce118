"""Plant and wear as one unit."""

from fmu_src.unit import Specification, Unit, started
from rv_plant.topology import Topology
from rv_reducer.judgement import CAUTIONS
from rv_reducer.reducer import FAULTS, initialise, step
from rv_reducer.variables import reducer_table
from wear_fmu.accumulator import CAUTIONS as OF_WEAR
from wear_fmu.variables import Resolution


def make_unit(specification: Specification) -> Unit:
    """The unit of a specification, see fmu_src.unit."""
    sizes = specification["sizes"]
    table = started(reducer_table(Topology(**sizes["topology"]), Resolution(**sizes["resolution"])), specification)
    # The wear refuses before it changes anything; what the plant changes is what a look at lost motion puts back.
    return Unit(table, initialise, step, FAULTS, fault_reach=table.by_name["kept"].size, cautions=OF_WEAR | CAUTIONS, pause=("pausing", "paused_after"))
