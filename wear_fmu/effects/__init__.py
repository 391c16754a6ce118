"""Physical effects of wear, one a file.

Hooks, each a kernel of that name in an effect's file:

    prepare(r)            at initialisation and whenever an amplitude is set during a run; adds 1 to ``r.effects_on`` if the effect is on
    factor(r, surface, line_load, radius, speed, depth)
                          by which the wear coefficient is multiplied at a contact: surface
                          0 flank and pin, 1 inner, 2 outer raceway; load per length [N/m], equivalent
                          radius [m], sliding speed [m/s], depth worn there so far [m]; changes nothing.  Only for
                          the surfaces that the parameter EFFECT_surfaces names, see ``chosen_surfaces``
    advance(r, duration)  moves the effect's states on through ``duration`` [s] of wear

Within a hook the order of the effects does not matter: each adds to fields that the wear unit has cleared, or
changes its own states, and reads none of what others change there.
"""

from fmu_src.effect import OWN_STATES, Effect, effect_modules
from fmu_src.names import with_paths
from wear_fmu.chosen_surfaces import with_choice

HOOKS = {
    "prepare": ("r", ""), "advance": ("r, duration", ""),
    "factor": ("r, surface, line_load, radius, speed, depth", "*"),
}  # fmt: skip
# The fields that a hook may change, and how; the wear unit clears them before.
ALLOWED = {"prepare": OWN_STATES | {"effects_on": "+=", "standing": "+="}, "advance": OWN_STATES, "factor": {}}
# A hook that is not called unless another has changed this field.
NEEDS = {"factor": "effects_on"}
EFFECTS: dict[str, Effect] = {
    name: with_paths(name, with_choice(name, module.EFFECT) if hasattr(module, "factor") else module.EFFECT)
    for name, module in effect_modules(__name__).items()
}
