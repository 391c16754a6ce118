"""Physical effects of wear, one a file.

Hooks, each a kernel of that name in an effect's file:

    prepare(r)            once, when parameters are known; sets ``r.effects_on`` to 1 if the effect is on
    factor(r, surface, line_load, radius, speed, depth)
                          by which the wear coefficient is multiplied at a contact: surface
                          0 flank and pin, 1 inner, 2 outer raceway; load per length [N/m], equivalent
                          radius [m], sliding speed [m/s], depth worn there so far [m]
    advance(r, duration)  moves the effect's states on through ``duration`` [s] of wear
"""

from fmu_src.effect import Effect, effect_modules

HOOKS = {
    "prepare": ("r", ""), "advance": ("r, duration", ""),
    "factor": ("r, surface, line_load, radius, speed, depth", "*"),
}  # fmt: skip
EFFECTS: dict[str, Effect] = {name: module.EFFECT for name, module in effect_modules(__name__).items()}
