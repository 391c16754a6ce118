"""What is judged of each life."""

from typing import NotRequired, TypedDict


class Outcome(TypedDict):
    """What came of one life: its recorded hours and figures, or the fault that stopped it."""

    number: int
    hours: NotRequired[list[float]]
    figures: NotRequired[dict[str, list[float]]]
    fault: NotRequired[str]


# Name -> what it is.
FIGURES = {
    "inner_raceway_um": "deepest wear of the cranks' eccentrics",
    "outer_raceway_um": "deepest wear of the discs' holes",
    "disc_flank_um": "deepest wear of the teeth",
    "pin_um": "deepest wear of the pins",
    "lost_motion_arcmin": "output's turning between +3 and -3 % of the torque, input held",
    "lag_arcsec": "carrier behind the cranks at the full torque, mean of a turn",
}
