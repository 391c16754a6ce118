"""Which surfaces an effect of wear acts on: every effect with a ``factor`` has a parameter EFFECT_surfaces."""

from dataclasses import replace

from fmu_src.effect import Effect, EffectParameter, Guard
from fmu_src.kernel import kernel
from fmu_src.variables import Variable

# Surfaces of the wear unit.  A flank and the pin that it meets are one contact, and wear each for itself.
FLANK, INNER, OUTER, PIN = 0, 1, 2, 3
# In the order of falling sums of flanks 1, pins 2, races 4; the first is all of them.
CHOICES = ("all", "pins and races", "flanks and races", "races", "flanks and pins", "pins", "flanks")
SUFFIX = "surfaces"
# Hooks that are called only for the chosen surfaces, see ``compose``.
GUARDS = {"factor": Guard("surface_worn", "wear_fmu.chosen_surfaces", "is_chosen", SUFFIX)}


@kernel
def is_chosen(choice, surface_worn):
    """Whether an effect whose parameter stands at ``choice`` acts on a surface."""
    share = 4
    if surface_worn == FLANK:
        share = 1
    elif surface_worn == PIN:
        share = 2
    return (7 - choice) // share % 2 == 1


def with_choice(name: str, effect: Effect) -> Effect:
    """The effect with its parameter."""
    variable = Variable(f"{name}_{SUFFIX}", "parameter", "1", "surfaces that the effect acts on", 0, choices=CHOICES, source="assumed: all")
    return replace(effect, parameters=(*effect.parameters, EffectParameter(variable, "choice")))
