"""Torques that no reducer takes, said before the work and in its JSON."""

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from fmu_src.unit_words import unit_on_screen

if TYPE_CHECKING:
    from orchestrator.settings import Setting
    from reducers.reducer import Reducer
    from studies.duty import Segment


def told_overload(reducer: "Reducer", settings: "Sequence[Setting]", duty: "Sequence[Segment]" = ()) -> dict[str, Any]:
    """The key ``overload`` of the JSON, which is there only where the torque is to doubt; that is said on stderr, too."""
    from studies.overload import overload

    beyond = overload(reducer, settings, duty)
    if beyond is None:
        return {}
    print(unit_on_screen(f"warning: {beyond}"), file=sys.stderr)
    return {"overload": beyond.as_json()}
