"""Torques beyond what a reducer is rated for: the model answers, and what it says is then said to be of no real one."""

from collections.abc import Iterable
from dataclasses import dataclass

from reducers.reducer import Reducer
from rv_reducer import judgement

MOST_RATED = judgement.MOST_RATED


@dataclass(frozen=True)
class Overload:
    """A torque on the output and the rated one [N m]."""

    torque: float
    rated: float

    @property
    def factor(self) -> float:
        return self.torque / self.rated

    def __str__(self) -> str:
        return (
            f"output.load_torque = {self.torque:.5g} N.m is {self.factor:.3g} times the rated torque, {self.rated:.5g} N.m, and catalogues allow"
            f" {MOST_RATED:g} times for a moment: in the model contacts stay elastic and bodies linear whatever the torque, real ones yield;"
            " contact pressures, stiffness, lost motion and wear are those of no real reducer"
        )

    def as_json(self) -> dict[str, float | str]:
        return {"torque_Nm": self.torque, "rated_torque_Nm": self.rated, "factor": self.factor, "warning": str(self)}


def overload_of(reducer: Reducer, torques: Iterable[float]) -> Overload | None:
    """The largest of ``torques`` [N m], of either sign, if it is more than any reducer takes; None where the file knows no rated torque."""
    rated, largest = reducer.starts.get("rated_torque", 0.0), max(map(abs, torques))
    return Overload(largest, rated) if largest > MOST_RATED * rated > 0.0 else None
