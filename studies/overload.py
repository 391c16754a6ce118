"""Whether what is asked of a reducer lies beyond what it takes, from its settings and duty."""

from collections.abc import Sequence

from orchestrator.settings import Setting
from reducers.rated import Overload, overload_of
from reducers.reducer import Reducer
from studies.duty import Segment


def overload(reducer: Reducer, settings: Sequence[Setting], duty: Sequence[Segment] = ()) -> Overload | None:
    """Of the torque that is set last, or the file's; a duty has its own, which count instead."""
    if duty:
        return overload_of(reducer, [segment.torque for segment in duty])
    torque = next((setting.value for setting in reversed(settings) if setting.name == "load_torque"), reducer.starts["load_torque"])
    return overload_of(reducer, [torque])
