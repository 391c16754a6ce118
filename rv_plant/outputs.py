"""What is the same at rest and in motion before and after the contacts are solved."""

from fmu_src.effect import compose
from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, output, state
from rv_plant.contact import hertz_peak_pressure
from rv_plant.contact_arrays import copy_contacts
from rv_plant.effects import HOOKS
from rv_plant.gear_stage import clear_teeth
from rv_plant.mesh import clear_offsets
from rv_plant.needle_bearing import take_clearances

effects = compose("rv_plant.effects", HOOKS)
warm_effects, before_effects, after_effects = effects.warm, effects.before, effects.after


def variables(sizes: Sizes) -> list[Variable]:
    return [
        output("contact_pressure", "Pa", "largest Hertz pressure p0 between disc and pins", nominal=1e9, path="mesh.contact_pressure"),
        output("largest_pin_force", "N", "largest force between a disc and a pin at the present angle", nominal=100.0, path="mesh.largest_force"),
        output("largest_roller_force", "N", "largest force on a roller at the present angle", nominal=100.0, path="roller.largest_force"),
        output("reducer_temperature", "K", "temperature of the contacts", nominal=300.0, path="heat.contact_temperature"),
        output("power_loss", "W", "power lost: friction and drag, and in motion damping (mean of the last step)", path="heat.power_loss"),
        state("grease_thinning", "1", "viscosity of the grease over that of new grease"),
        state("friction_power", "W", "power lost by friction and drag at the last equilibrium"),
    ]


@kernel
def prepare_position(r):
    """What effects add at the present angle: first to the temperature, then to what may follow from it."""
    r.reducer_temperature = r.temperature
    warm_effects(r)
    r.ring_scale = r.grease_thinning = 1.0
    take_clearances(r)
    clear_teeth(r)
    clear_offsets(r)
    before_effects(r)


@kernel
def publish_losses(r, input_speed):
    """Power of friction and drag; returns the torque that they ask of the input turning so [rad/s]."""
    r.friction_power = 0.0
    r.cage_share = 1.0
    after_effects(r)
    return r.friction_power / input_speed if abs(input_speed) > 1e-6 else 0.0


@kernel
def publish_contacts(r):
    """Forces, the largest of them and contact pressure at the present angle."""
    copy_contacts(r.mesh_force_now, r.roller_force_now, r.mesh_force, r.roller_force)
    discs, cranks, rollers = r.roller_force.shape
    pins = r.mesh_force.shape[1]
    radius = r.pin_radius + r.equidistant_modification + r.profile_radius_added
    modulus = 0.5 * r.elastic_modulus / (1.0 - r.poisson_ratio * r.poisson_ratio)
    worst = 0.0
    r.largest_pin_force = r.largest_roller_force = 0.0
    for d in range(discs):
        for c in range(cranks):
            for k in range(rollers):
                r.largest_roller_force = max(r.largest_roller_force, r.roller_force_now[d, c, k])
        for j in range(pins):
            force = r.mesh_force_now[d, j]
            r.largest_pin_force = max(r.largest_pin_force, force)
            if force > 0.0:
                centre = r.centre_curvature[d, j]
                curvature = 1.0 / r.pin_radius + centre / (1.0 - radius * centre)
                worst = max(worst, hertz_peak_pressure(force / r.mesh_width, curvature, modulus))
    r.contact_pressure = worst
