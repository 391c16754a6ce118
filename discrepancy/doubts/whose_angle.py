"""Whether an angle that is taken for the output's was the input's over the ratio: what turns unevenly is shown at itself by the one, not by the other."""

from dataclasses import replace

from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.joint import left_of
from discrepancy.prediction.conditions import LAG_SHARE, angle_zero, angles_of, zero_of
from discrepancy.prediction.curves import moved
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import ERROR
from fmu_src.arrays import Floats


def gained_as_input(model: PhysicalModel, space: Workspace, fit: Fit) -> float:
    """Chi-square by which the angle of transmission errors as the input's over the ratio explains them better than as the output's, after one linear step
    of all that was fitted; 0 where none is the output's.

    Only what turns by much tells: an order 80 of 20 arcsec is shown 0.08 arcsec otherwise, at order 160.
    """
    if LAG_SHARE not in fit.values:
        return 0.0
    shown: dict[int, Floats] = {}
    for i in space.training:
        record = space.records[i]
        if record.of_output and record.quantity == ERROR:
            # The same angles for both: what differs is how the error shows itself (``OverAngle.seen``).
            zero = zero_of(model.bench, record, model.for_record(record, fit.values))
            error = model.one(replace(record, of_output=False), {**fit.values, angle_zero(record): zero})
            shown[i] = moved(angles_of(model.bench, record, zero), error, error.mean() - error) - error
    return left_of(fit.residual, fit.jacobian) - left_of(fit.residual + space.whiten(shown), fit.jacobian)
