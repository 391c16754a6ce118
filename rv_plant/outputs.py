"""Outputs that follow from the contacts, at rest or in motion."""

from fmu_src.kernel import kernel

from rv_plant.contact import hertz_peak_pressure


@kernel
def publish_contacts(r):
    """Largest forces and contact pressure at the present angle."""
    discs, cranks, rollers = r.roller_force.shape
    pins = r.mesh_force.shape[1]
    circle = r.pin_circle_radius + r.shift_modification
    radius = r.pin_radius + r.equidistant_modification
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
