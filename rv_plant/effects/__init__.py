"""Physical effects of the plant, one a file; the catalogue of what a real reducer may do beyond the ideal one.

Hooks, each a kernel of that name in an effect's file:

    prepare(r)            once, when parameters are known: fills the arrays that stand for
                          part errors (``..._added``), which ``plant.prepare`` has cleared
    before(r)             before every equilibrium (in motion: every internal step)
    hold(r)               adds to residual and tangent of an equilibrium, see ``assembly``
    after(r)              when the contact forces are known: losses, vibration
    advance(r, duration)  moves the effect's states on through ``duration`` [s]
"""

from fmu_src.effect import Effect, effect_modules

HOOKS = {"prepare": ("r", ""), "before": ("r", ""), "hold": ("r", ""), "after": ("r", ""), "advance": ("r, duration", "")}
EFFECTS: dict[str, Effect] = {name: module.EFFECT for name, module in effect_modules(__name__).items()}
