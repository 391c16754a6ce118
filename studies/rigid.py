"""Whether all that carries the gear is rigid, so that what is called its stiffness is that of the contacts alone."""

from collections.abc import Sequence

from orchestrator.settings import ArraySetting, Setting
from reducers.reducer import Reducer

# What yields beside the contacts, by the keys of a reducer file, the softest of real ones first; and the effect that adds to it.
KEYS = ("crank.support_compliance", "first_stage.compliance", "carrier.compliance", "housing.compliance", "carrier.bearing_compliance")
EFFECT = "effects.support_compliance."


def rigid_supports(reducer: Reducer, settings: Sequence[Setting | ArraySetting] = ()) -> str:
    """In words, with the keys that would make them yield; empty where one does."""
    springs = [v for v in reducer.plant.variables if v.path in KEYS or v.path.startswith(EFFECT)]
    given = {setting.name: setting.value for setting in settings}
    if any(given.get(v.name, v.start) != 0.0 for v in springs):
        return ""
    keys = [key for key in KEYS if key in {v.path for v in springs}]
    # Design rules are those of RV reducers.
    completing = "" if reducer.topology.output_pins else " (rvwear reducer new completes them)"
    return (
        "no support yields here, so the stiffness is that of the gear's contacts alone, several times that of a real one:"
        f" {', '.join(keys)} set what yields{completing}"
    )
