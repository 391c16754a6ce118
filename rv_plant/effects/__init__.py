"""Physical effects of the plant, one a file; the catalogue of what a real reducer may do beyond the ideal one.

Hooks, each a kernel of that name in an effect's file, in stages: all effects' ``warm`` runs before any effect's
``before``.  Within a stage the order of the effects does not matter, because each only adds to (or multiplies) fields
that the plant has cleared, and reads none of them:

    start(r)              once, at initialisation: the effect's own states
    prepare(r)            then, and whenever an amplitude is set during a run: errors of parts, compliance of supports
    warm(r)               before every equilibrium (in motion: every internal step): the temperature
    before(r)             after that: what depends on angle and temperature
    hold(r)               adds to residual and tangent of an equilibrium, see ``assembly``
    after(r)              when the contact forces are known: losses, vibration
    advance(r, duration)  moves the effect's states on through ``duration`` [s]
    heat(r, duration)     after that: the temperature reached through ``duration`` [s]
"""

from fmu_src.effect import OWN_STATES, Effect, effect_modules
from fmu_src.names import with_paths

HOOKS = {
    "start": ("r", ""), "prepare": ("r", ""), "warm": ("r", ""), "before": ("r", ""), "hold": ("r", ""), "after": ("r", ""),
    "advance": ("r, duration", ""), "heat": ("r, duration", ""),
}  # fmt: skip


def added(*fields: str) -> dict[str, str]:
    return dict.fromkeys(fields, "+=")


def scaled(*fields: str) -> dict[str, str]:
    return dict.fromkeys(fields, "*=")


# The fields that a hook may change, and how; the plant clears them before the stage.
ALLOWED = {
    "start": OWN_STATES,
    "prepare": OWN_STATES
    | added("pin_x", "pin_y", "pin_radius_added", "lobe_gap_added", "lobe_pitch_added", "profile_radius_added",
            "profile_circle_added", "roller_gap_added", "output_gap_added", "throw_added", "lobe_turn_added",
            "hole_tangential_added", "hole_radial_added", "seat_tangential_added", "seat_radial_added", "compliance")
    | scaled("pin_stiffness", "mesh_constant", "roller_constant", "output_constant", "mesh_damping_now", "roller_damping_now"),
    "warm": OWN_STATES | added("reducer_temperature"),
    "before": OWN_STATES
    | added("roller_gap_now", "ring_offset_x", "ring_offset_y", "tooth_gap", "tooth_gap_rate", "tooth_play", "tooth_play_rate",
            "crank_turn_added", "crank_turn_rate")
    | scaled("ring_scale", "grease_thinning"),
    # Evaluated many times for one equilibrium: nothing may be kept.
    "hold": added("residual_vector", "tangent"),
    "after": OWN_STATES | added("friction_power", "housing_force_x", "housing_force_y") | scaled("cage_share"),
    "advance": OWN_STATES,
    "heat": OWN_STATES | added("reducer_temperature"),
}  # fmt: skip
EFFECTS: dict[str, Effect] = {name: with_paths(name, module.EFFECT) for name, module in effect_modules(__name__).items()}
