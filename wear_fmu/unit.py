"""The wear accumulator as a unit."""

from types import SimpleNamespace

from fmu_src.unit import Specification, Unit, started
from wear_fmu.accumulator import CAUTIONS, FAULTS, initialise, step
from wear_fmu.variables import Resolution, wear_table


def make_unit(specification: Specification) -> Unit:
    """The wear unit of a specification, see fmu_src.unit."""
    sizes = specification["sizes"]
    table = wear_table(SimpleNamespace(**sizes["topology"]), Resolution(**sizes["resolution"]))
    return Unit(started(table, specification), initialise, step, FAULTS, fault_reach=0, cautions=CAUTIONS)
