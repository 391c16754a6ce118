"""What a campaign declares as not known of reducer and measuring chain, as parameters of a fit."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from discrepancy.campaign.model import ENCODER_PHASE, Nuisance
from discrepancy.prediction import chain
from discrepancy.problem import Parameter, Record
from fmu_src.faults import InputFault, nearest
from fmu_src.table import Table

# A nuisance that is no parameter of the reducer, as the encoder's phase is none.
HOUSING_MASS = "housing_mass"


def expanded(nuisance: Nuisance, records: list[Record]) -> list[Parameter]:
    """One parameter, or one per mounting, condition or run."""
    places = {
        "campaign": [], "mounting": [r.mounting for r in records], "condition": [r.condition for r in records],
        "run": [r.name for r in records],
    }[nuisance.per]  # fmt: skip
    p = nuisance.parameter
    return [replace(p, name=f"{p.name}[{place}]") for place in dict.fromkeys(places)] or [p]


def require_known(folder: Path, nuisances: Sequence[Nuisance], tables: Sequence[Table]) -> None:
    """InputFault for a nuisance that is no parameter of the model."""
    scalars = {v.name for table in tables for v in table.of_role("parameter", "input") if not v.shape}
    for name in (n.parameter.name for n in nuisances):
        if name not in scalars | {HOUSING_MASS, ENCODER_PHASE} and name.partition("[")[0] not in chain.PARAMETERS:
            raise InputFault(
                f"{folder}: nuisances.{name}: the model has no such parameter{nearest(name, scalars | chain.PARAMETERS, 2)}; docs/variables.md lists"
                f" those of the reducer; of the measuring chain there are {', '.join(sorted(chain.PARAMETERS))} (with the quantity or"
                f' mounting: "sensor_gain[input_torque]"), {ENCODER_PHASE} and {HOUSING_MASS}'
            )
