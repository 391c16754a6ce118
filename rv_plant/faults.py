"""What can be wrong with a reducer or a run, and the look at its geometry before the first step.

The codes are the status of the plant's entry points; the texts name variables of the record.
"""

import math

from fmu_src.kernel import kernel
from rv_plant.geometry import centre_curve_curvature
from rv_plant.output_pins import has_output_pins

QUASI_STATIC, DYNAMIC = 0, 1

NO_EQUILIBRIUM, PRIMED, UNDERCUT, PINS_OVERLAP, ROLLERS_OVERLAP, RING_OPEN, RACES_DO_NOT_FIT = range(1, 8)
NO_MOTION, TORQUE_AT_REST, LONG_STEP = range(8, 11)
OUTPUT_HOLES_OVERLAP, OUTPUT_HOLES_OPEN, OUTPUT_PINS_AT_REST, CRANKS_ON_AXIS, NO_START, BEARINGS_OVERLAP = range(11, 17)
FAULTS = {
    NO_EQUILIBRIUM: "no equilibrium at input angle {input_angle:.6g} rad, load {load_torque:.6g} N.m: residual"
    " {residual:.3g} of the load after {iterations} iterations, contacts at {reducer_temperature:.4g} K."
    " Lower the load, or check clearances and profile errors (they are in m, not um)",
    PRIMED: "the trochoid has loops: crank.eccentricity {eccentricity:.6g} m times the number of pins must be less than"
    " the generating pin circle radius {pin_circle_radius:.6g} m. Reduce crank.eccentricity or enlarge pin.circle_radius",
    UNDERCUT: "the profile is undercut: pin.radius {pin_radius:.6g} m plus disc.equidistant_modification exceeds the"
    " smallest convex radius of the centre curve. Reduce pin.radius or crank.eccentricity, or enlarge pin.circle_radius",
    PINS_OVERLAP: "neighbouring pins overlap: pin.radius {pin_radius:.6g} m is too large for"
    " pin.circle_radius {pin_circle_radius:.6g} m. Reduce pin.radius or the number of pins",
    ROLLERS_OVERLAP: "neighbouring rollers overlap: roller.radius {roller_radius:.6g} m is too large for the number of"
    " rollers between the races. Reduce roller.radius or the number of rollers",
    RING_OPEN: "the pins do not close the ring: a cycloid disc needs one pin more than it has lobes."
    " Correct pins or lobes in [topology]",
    NO_MOTION: "the integrator's step fell below 1e-10 s (crank angle {crank_angle:.6g} rad, {rejected} rejected steps)."
    " Loosen numerics.dynamic_tolerance, or check masses, damping and speeds: something moves impossibly fast",
    TORQUE_AT_REST: "drive = torque needs fidelity = dynamic: without inertia a torque sets no speed."
    " Set fidelity to dynamic, or drive to speed",
    OUTPUT_HOLES_OVERLAP: "holes for the output pins overlap each other or the bearing: output_pin.radius {output_pin_radius:.6g} m"
    " plus crank.eccentricity {eccentricity:.6g} m is too large on output_pin.circle_radius {output_circle_radius:.6g} m beside"
    " outer_race.radius {outer_race_radius:.6g} m. Reduce output_pin.radius, outer_race.radius or the number of output pins",
    OUTPUT_HOLES_OPEN: "holes for the output pins cut the flanks: output_pin.circle_radius {output_circle_radius:.6g} m plus"
    " output_pin.radius {output_pin_radius:.6g} m and eccentricity reaches the disc's roots."
    " Reduce output_pin.circle_radius or output_pin.radius",
    OUTPUT_PINS_AT_REST: "fidelity = dynamic is not there for output through pins in holes of the disc."
    " Set fidelity to quasi-static",
    CRANKS_ON_AXIS: "crank.circle_radius = 0: cranks on the axis carry no torque to the carrier. Enlarge"
    " crank.circle_radius, or give the reducer output_pins in [topology]",
    BEARINGS_OVERLAP: "holes for the cranks' bearings overlap each other or cut the flanks: outer_race.radius {outer_race_radius:.6g} m is too large"
    " for holes on crank.circle_radius {crank_circle_radius:.6g} m within pin.circle_radius {pin_circle_radius:.6g} m."
    " Reduce outer_race.radius with inner_race.radius, or correct crank.circle_radius",
    LONG_STEP: "the communication step takes more than 100,000 internal steps at input.speed {input_speed:.6g} rad/s."
    " Use a shorter communication step, a larger numerics.largest_crank_step than {largest_crank_step:.3g} rad,"
    " or in motion a looser numerics.dynamic_tolerance",
    NO_START: "the motion finds no start at input speed {input_speed:.6g} rad/s, load {load_torque:.6g} N.m: there is an equilibrium at rest, and none with"
    " the forces of inertia. Check masses, input.speed, backlash and tooth errors (they are in m, not um), or set fidelity to quasi-static",
    RACES_DO_NOT_FIT: "the rollers do not fit: outer_race.radius {outer_race_radius:.6g} m must equal"
    " inner_race.radius {inner_race_radius:.6g} m + 2 roller.radius {roller_radius:.6g} m within 0.1 mm;"
    " the clearance is bearing.clearance",
}

# Those about parts that cannot be made or put together.
OF_PARTS = frozenset(
    (PRIMED, UNDERCUT, PINS_OVERLAP, ROLLERS_OVERLAP, RACES_DO_NOT_FIT, OUTPUT_HOLES_OVERLAP, OUTPUT_HOLES_OPEN, BEARINGS_OVERLAP)
)


@kernel
def geometry_fault(r):
    """0, or the fault that makes this geometry impossible."""
    pins, lobes, rollers = r.pin_x.shape[0], r.lobe_pitch_error.shape[1], r.roller_force.shape[2]
    if pins != lobes + 1:
        return RING_OPEN
    if not r.pin_radius < r.pin_circle_radius * math.sin(math.pi / pins):
        return PINS_OVERLAP
    fit = r.outer_race_radius - r.inner_race_radius - 2.0 * r.roller_radius
    if not abs(fit) < 1e-4:
        return RACES_DO_NOT_FIT
    if not r.roller_radius < (r.inner_race_radius + r.roller_radius) * math.sin(math.pi / rollers):
        return ROLLERS_OVERLAP
    fault = output_fault(r)
    if fault != 0:
        return fault
    circle = r.pin_circle_radius + r.shift_modification
    k1 = r.eccentricity * pins / circle
    if not k1 < 1.0:
        return PRIMED
    radius = r.pin_radius + r.equidistant_modification
    for i in range(721):
        if not radius * centre_curve_curvature(math.pi * i / 720.0, lobes, circle, k1) < 1.0:
            return UNDERCUT
    return BEARINGS_OVERLAP if bearings_overlap(r) else 0


@kernel
def bearings_overlap(r):
    """Whether the disc's holes for the cranks leave nothing between each other or to its roots."""
    cranks = r.roller_force.shape[1]
    apart = cranks == 1 or r.outer_race_radius < r.crank_circle_radius * math.sin(math.pi / cranks)
    root = r.pin_circle_radius - r.eccentricity - r.pin_radius - r.equidistant_modification
    return not (apart and r.crank_circle_radius + r.outer_race_radius < root)


@kernel
def output_fault(r):
    """0, or the fault that keeps the load from reaching the discs."""
    if not has_output_pins(r):
        return CRANKS_ON_AXIS if r.crank_circle_radius == 0.0 else 0
    if r.fidelity == DYNAMIC:
        return OUTPUT_PINS_AT_REST
    pins = r.output_pin_force.shape[1]
    hole = r.output_pin_radius + r.eccentricity + r.output_clearance
    bearing = r.outer_race_radius + r.crank_circle_radius
    if not hole < r.output_circle_radius * math.sin(math.pi / pins) or not hole + bearing < r.output_circle_radius:
        return OUTPUT_HOLES_OVERLAP
    root = r.pin_circle_radius - r.eccentricity - r.pin_radius - r.equidistant_modification
    if not hole + r.output_circle_radius < root:
        return OUTPUT_HOLES_OPEN
    return 0
