"""What follows from the parameters alone: ideal parts, and what effects add to them, at the start and where amplitudes are set."""

import math

from fmu_src.effect import compose
from fmu_src.kernel import kernel
from rv_plant.contact import HYSTERETIC, LINE, MODAL, law_constants
from rv_plant.effects import HOOKS
from rv_plant.equilibrium import list_free_coordinates
from rv_plant.faults import geometry_fault
from rv_plant.mesh import clear_flanks
from rv_plant.needle_bearing import clear_clearances
from rv_plant.poses import clear_places
from rv_plant.supports import take_supports

effects = compose("rv_plant.effects", HOOKS)
prepare_effects = effects.prepare
amplitudes_changed, keep_amplitudes = effects.amplitudes_changed, effects.keep_amplitudes


@kernel
def prepare(r):
    """Everything that follows from the parameters alone."""
    for j in range(r.pin_x.shape[0]):
        angle = 2.0 * math.pi * j / r.pin_x.shape[0]
        radial = r.pin_circle_radius + r.pin_position_error_radial[j]
        tangential = r.pin_position_error_tangential[j]
        r.pin_angle[j], r.pin_cos[j], r.pin_sin[j] = angle, math.cos(angle), math.sin(angle)
        r.pin_x[j] = radial * math.cos(angle) - tangential * math.sin(angle)
        r.pin_y[j] = radial * math.sin(angle) + tangential * math.cos(angle)
    r.mesh_constant, r.mesh_exponent = law_constants(
        r.contact_law, r.stiffness_reading, r.mesh_stiffness, r.mesh_stiffness_lankarani,
        r.exponent_lankarani, r.mesh_width,
    )
    r.mesh_damping_now, r.roller_damping_now = r.mesh_damping, r.roller_damping
    if r.damping_law == HYSTERETIC:
        r.mesh_damping_now = r.roller_damping_now = r.restitution
    elif r.damping_law == MODAL:
        r.mesh_damping_now = r.roller_damping_now = r.modal_damping_time
    r.roller_constant, r.roller_exponent = law_constants(
        r.contact_law, r.stiffness_reading, r.roller_stiffness, r.roller_stiffness_lankarani,
        r.exponent_lankarani, r.roller_length,
    )
    r.output_constant, r.output_exponent = law_constants(
        LINE, r.stiffness_reading, r.output_stiffness, r.output_stiffness, r.exponent_lankarani, r.mesh_width
    )
    r.pressure_cosine = math.cos(r.pressure_angle)
    clear_added(r)
    prepare_effects(r)
    keep_amplitudes(r)
    list_free_coordinates(r)


@kernel
def retune(r):
    """Amplitudes set during the run take effect; 0 or a fault."""
    if not amplitudes_changed(r):
        return 0
    fault = geometry_fault(r)
    if fault != 0:
        return fault
    prepare(r)
    # Where a support has become rigid nothing is left of its departure.
    for i in range(r.z.shape[0]):
        if not r.is_free[i]:
            r.z[i] = r.z_before[i] = 0.0
    return 0


@kernel
def clear_added(r):
    """No effect adds anything to the ideal parts and to the supports of the file."""
    clear_flanks(r)
    clear_places(r)
    clear_clearances(r)
    take_supports(r)
    r.output_gap_added = 0.0
