"""Plant and wear stepped as one unit, by the kernels of both on one record.

The views ``plant`` and ``wear`` share the cells of what the two exchange: the wear sees
the forces of the step just done, the next step the profile errors after it.  That is
the master's Gauss-Seidel scheme.
"""

from fmu_src.kernel import entry_point
from rv_plant.faults import FAULTS as PLANT_FAULTS
from rv_plant.plant import initialise as initialise_plant
from rv_plant.plant import step as step_plant
from rv_reducer.judgement import judge, start_judgement
from wear_fmu.accumulator import FAULTS as WEAR_FAULTS
from wear_fmu.accumulator import initialise as initialise_wear
from wear_fmu.accumulator import step as step_wear

# Status codes of the wear stand above those of the plant.
OF_WEAR = 100
FAULTS = PLANT_FAULTS | {OF_WEAR + code: text for code, text in WEAR_FAULTS.items()}


@entry_point
def initialise(records):
    """Check the parameters, find the first equilibrium; new surfaces."""
    fault = initialise_plant(records.plant)
    if fault != 0:
        return fault
    fault = initialise_wear(records.wear)
    if fault != 0:
        return OF_WEAR + fault
    start_judgement(records)
    return 0


@entry_point
def step(records, time, duration):
    """One communication step of both."""
    before = records[0].crank_angle
    fault = step_plant(records.plant, time, duration)
    if fault != 0:
        return fault
    fault = step_wear(records.wear, time, duration)
    if fault != 0:
        return OF_WEAR + fault
    judge(records, abs(records[0].crank_angle - before))
    return 0
