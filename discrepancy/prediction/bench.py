"""The reducer on a bench: runs of the compiled pair at stated conditions.

Runs are kept, so that parameters that a run does not depend on cost nothing.
"""

import copy
from collections.abc import Mapping
from functools import cached_property

from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.held import HELD_ANGLES, Held
from discrepancy.prediction.lives import ROUGH_CYCLE
from discrepancy.prediction.running import MEAN_POSITIONS, Running
from discrepancy.prediction.standard_test import FEW, WAY
from discrepancy.prediction.stations import Stations
from discrepancy.prediction.twins import Twins
from discrepancy.problem import ERROR, ORDERS, Record
from fmu_src.threads import Once, Threads
from reducers.reducer import Reducer
from wear_fmu.variables import Resolution

# Surfaces are resolved as finely as inspections need, not as finely as a life run.
RESOLUTION = Resolution(flank=90, pin=90, raceway=180)
# What values change in a mean over a turn, roughly, is seen within 1 % from seven positions; in a held test from five as much as from eight, whose symmetry
# is that of the pins (three err by a tenth).
FEW_MEAN_POSITIONS, FEW_HELD_ANGLES = 7, 5
# Longest step of torque, of the rated one, where the way to a place matters: a loop is within 0.03 arcsec, and roughly so, within a tenth of what is changed.
TORQUE_STEP, ROUGH_TORQUE_STEP = 1.0 / 80.0, 1.0 / 16.0
# Runs that a search keeps: the last ones, and those beside which they start.
FEW_RUNS = 50


class Bench(Running, Held):
    """Runs of one reducer with settings; every method takes the values of further parameters."""

    def __init__(self, reducer: Reducer, settings: Mapping[str, float], resolution: Resolution = RESOLUTION):
        super().__init__(reducer, settings, resolution)
        self.held_angles, self.mean_positions, self.test_way, self.torque_step = HELD_ANGLES, MEAN_POSITIONS, WAY, TORQUE_STEP
        # By its name (``conditions.angle_zero``) the output angle [rad] of the model at which a mounting's angle is 0, if it is not 0.
        self.zeros: dict[str, float] = {}
        # How finely runs are computed for a campaign's samples; None: at every sample.
        self.fineness: Fineness | None = None
        # By a record's angles those at which it is computed, if others share them.
        self.stations: Mapping[bytes, Stations] = {}
        self.twins = Twins()
        # What shares the parts of one run.
        self.threads = Threads()

    @cached_property
    def rougher(self) -> "Bench":
        """The same bench with the same runs, as coarse as a search allows."""
        other = copy.copy(self)
        other.__dict__["rougher"] = other
        other.fineness = self.fineness.roughly() if self.fineness else None
        other.held_angles, other.mean_positions, other.cycle_turns = FEW_HELD_ANGLES, FEW_MEAN_POSITIONS, ROUGH_CYCLE
        other.test_way, other.torque_step = FEW, ROUGH_TORQUE_STEP
        return other

    def forgetful(self) -> "Bench":
        """The same bench with few runs of its own, for searches among many that nobody asks for again."""
        other = copy.copy(self)
        other.__dict__["rougher"] = other
        other.runs = Once(FEW_RUNS)
        return other

    def allowed(self, record: Record) -> float:
        """What a prediction of this record may err; 0 where nothing is known of its noise."""
        return self.fineness.allowed.get((ERROR if record.quantity == ORDERS else record.quantity, record.condition), 0.0) if self.fineness else 0.0
