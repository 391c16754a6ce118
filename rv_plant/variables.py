"""Every variable of the plant, declared once."""

import math
from dataclasses import dataclass

from fmu_src.variables import Table, Variable

from rv_plant.assembly import coordinate_count
from rv_plant.constraints import constraint_count
from rv_plant.contact import DAMPINGS, LAWS, READINGS, STEP
from rv_plant.effects import EFFECTS

FILE = "reducer file"


@dataclass(frozen=True)
class Topology:
    """The counts that fix the sizes of a unit's arrays."""

    discs: int
    cranks: int
    pins: int
    lobes: int
    rollers: int
    # Pins with rollers in holes of the discs; 0: the output goes through the cranks, as in an RV reducer.
    output_pins: int = 0


def plant_table(topology: Topology) -> Table:
    """The plant's variables for one topology; numbers of a real reducer come from its file."""
    t = topology
    mesh, bearing = (t.discs, t.pins), (t.discs, t.cranks)
    roller = (*bearing, t.rollers)
    output_pin = (t.discs, max(1, t.output_pins))
    of_output = FILE if t.output_pins else "no output pins: without effect"
    mesh_axes, bearing_axes, roller_axes = ("disc", "pin"), ("disc", "crank"), ("disc", "crank", "roller")
    z, m = coordinate_count(t.discs, t.cranks), constraint_count(t.cranks)

    inputs = [
        Variable("input_speed", "input", "rad/s", "speed of the sun (of the cranks without a first stage)",
                 1.0, source=FILE),
        Variable("input_torque", "input", "N.m", "torque on the sun if drive is torque", 0.0,
                 source="as the system model has it"),
        Variable("load_torque", "input", "N.m", "torque on the carrier, positive against positive rotation",
                 0.0, nominal=100.0, source=FILE),
        Variable("temperature", "input", "K", "temperature of the reducer's surroundings", 293.15,
                 minimum=200.0, maximum=500.0, nominal=300.0, source="assumed: room temperature"),
        Variable("mesh_profile_error", "input", "m", "what disc and pin lack at their present contact",
                 shape=mesh, axes=mesh_axes, nominal=1e-6),
        Variable("roller_profile_error", "input", "m", "what both raceways lack at a roller",
                 shape=roller, axes=roller_axes, nominal=1e-6),
    ]

    def length(name, text, minimum=None, start=0.0, **more):
        return Variable(name, "parameter", "m", text, start, minimum=minimum, nominal=1e-3,
                        source=more.pop("source", FILE), **more)

    def deviation(name, text, shape, axes, source="ideal part"):
        return Variable(name, "parameter", "m", text, 0.0, shape, axes, minimum=-1e-3, maximum=1e-3,
                        nominal=1e-6, source=source)

    def mass(name, unit, text, start):
        return Variable(name, "parameter", unit, f"mass or inertia of {text}", start, minimum=1e-9,
                        source="assumed: plausible from geometry")

    parameters = [
        length("pin_radius", "radius of the pins", 1e-5, 2e-3),
        length("pin_circle_radius", "radius of the circle of the pins' centres", 1e-4, 52e-3),
        length("eccentricity", "throw of the cranks", 1e-6, 0.9e-3),
        length("mesh_width", "width of one disc", 1e-5, 8.82e-3),
        length("equidistant_modification", "added to the pin radius when the disc is generated (positive: gap)",
               -1e-3, maximum=1e-3),
        length("shift_modification", "added to the pin circle radius when the disc is generated (negative: gap)",
               -1e-3, maximum=1e-3),
        Variable("angle_modification", "parameter", "rad", "turning of both flanks of a tooth into it (positive: gap)",
                 0.0, minimum=-1e-2, maximum=1e-2, source="assumed: none"),
        length("crank_circle_radius", "radius of the circle of the cranks' centres (0: one central eccentric)", 0.0, 28e-3),
        length("inner_race_radius", "radius of the crank's lobe", 1e-4, 10.25e-3),
        length("outer_race_radius", "radius of the hole in the disc", 1e-4, 13.25e-3),
        length("roller_radius", "radius of the needle rollers", 1e-5, 1.5e-3),
        length("roller_length", "length of the needle rollers", 1e-5, 8e-3),
        length("bearing_clearance", "radial clearance of the needle bearings (half the diametral one)", -1e-4,
               maximum=1e-3),
        length("output_pin_radius", "radius of the output pins with their rollers", 1e-5, 5e-3, source=of_output),
        length("output_circle_radius", "radius of the circle of the output pins' centres", 1e-4, 20e-3, source=of_output),
        length("output_clearance", "hole in the disc beyond roller and eccentricity, in radius", -1e-3, maximum=1e-2,
               source=of_output),
        Variable("output_stiffness", "parameter", "N", "force of an output pin on its hole at 1 mm, exponent 10/9", 1e5,
                 minimum=1.0, nominal=1e5, source=of_output),
        Variable("first_stage_ratio", "parameter", "1", "teeth of planet over teeth of sun (0: no first stage)",
                 3.0, minimum=0.0, maximum=100.0, source=FILE),
        Variable("pressure_angle", "parameter", "rad", "pressure angle of the first stage", math.radians(20.0),
                 minimum=0.0, maximum=0.7, source="assumed: standard gearing"),
        Variable("elastic_modulus", "parameter", "Pa", "Young's modulus of all parts", 207e9, minimum=1e6,
                 nominal=1e11, source=FILE),
        Variable("poisson_ratio", "parameter", "1", "Poisson's ratio of all parts", 0.3, minimum=0.0, maximum=0.5,
                 source=FILE),
        Variable("contact_law", "parameter", "1", "law of force against penetration", 0, choices=LAWS,
                 source="both sources"),
        Variable("stiffness_reading", "parameter", "1",
                 "force at 1 mm, or the same digits in N/m as force at 1 m per thousand", 0, choices=READINGS,
                 source="assumed: Palmgren's constant for the printed length gives the SI reading"),
        Variable("mesh_stiffness", "parameter", "N", "force of disc on pin at 1 mm of penetration, exponent 10/9",
                 3.2e5, minimum=1.0, nominal=1e5, source=FILE),
        Variable("roller_stiffness", "parameter", "N",
                 "force of a roller between both races at 1 mm of approach, exponent 10/9", 5.1e5, minimum=1.0,
                 nominal=1e5, source=FILE),
        Variable("mesh_stiffness_lankarani", "parameter", "N", "the same for the Lankarani-Nikravesh law", 3.2e6,
                 minimum=1.0, nominal=1e6, source=FILE),
        Variable("roller_stiffness_lankarani", "parameter", "N", "the same for the Lankarani-Nikravesh law", 5.1e6,
                 minimum=1.0, nominal=1e6, source=FILE),
        Variable("exponent_lankarani", "parameter", "1", "exponent of the Lankarani-Nikravesh law", 1.5, minimum=1.0,
                 maximum=2.0, source="BX-40E document"),
        deviation("pin_position_error_radial", "pin centre outwards", (t.pins,), ("pin",)),
        deviation("pin_position_error_tangential", "pin centre along the circle", (t.pins,), ("pin",)),
        deviation("pin_radius_error", "pin radius above nominal", (t.pins,), ("pin",)),
        deviation("lobe_profile_error", "material missing on a lobe", (t.discs, t.lobes), ("disc", "lobe")),
        deviation("lobe_pitch_error", "lobe displaced along the pitch", (t.discs, t.lobes), ("disc", "lobe")),
        deviation("crank_eccentricity_error", "throw of a crank's lobe above nominal", bearing, bearing_axes),
        Variable("crank_phase_error", "parameter", "rad", "turning of a crank's lobe against nominal", 0.0, bearing,
                 bearing_axes, minimum=-0.1, maximum=0.1, source="ideal part"),
        deviation("disc_hole_error_radial", "hole in the disc outwards", bearing, bearing_axes),
        deviation("disc_hole_error_tangential", "hole in the disc along its circle", bearing, bearing_axes),
        deviation("carrier_hole_error_radial", "crank's seat in the carrier outwards", (t.cranks,), ("crank",)),
        deviation("carrier_hole_error_tangential", "crank's seat in the carrier along its circle", (t.cranks,),
                  ("crank",)),
        Variable("fidelity", "parameter", "1", "equilibrium at each angle, or bodies in motion", 0,
                 choices=("quasi-static", "dynamic"), source="as the system model needs it"),
        Variable("drive", "parameter", "1", "what moves the input in motion", 0, choices=("speed", "torque"),
                 source="as the system model needs it"),
        mass("disc_mass", "kg", "one disc", 0.387), mass("disc_inertia", "kg.m^2", "one disc", 5.7e-4),
        mass("crank_mass", "kg", "one crank with its planet", 0.131),
        mass("crank_inertia", "kg.m^2", "one crank with its planet", 1.26e-5),
        mass("carrier_mass", "kg", "the carrier", 0.715), mass("carrier_inertia", "kg.m^2", "the carrier", 7.8e-4),
        mass("sun_inertia", "kg.m^2", "sun with what is fixed to it", 3.6e-6),
        mass("ring_inertia", "kg.m^2", "pin ring on its housing", 1e-3),
        mass("load_inertia", "kg.m^2", "what the output flange carries", 5.0),
        Variable("sun_teeth", "parameter", "1", "teeth of the sun: order of the first stage's mesh", 12.0, minimum=4.0,
                 source="assumed: usual for a ratio of 3"),
        Variable("tooth_stiffness_variation", "parameter", "1", "first-stage tooth stiffness over its mean, amplitude"
                 " at mesh order", 0.0, minimum=0.0, maximum=0.9, source="assumed: constant"),
        Variable("joint_damping_time", "parameter", "s", "damping over stiffness of joints and teeth", 4e-6, minimum=0.0,
                 maximum=1.0, nominal=1e-6, source="assumed: ratio 0.045 at 3.5 kHz"),
        Variable("joints", "parameter", "1", "joints in motion: springs, or constraints with multipliers (then rigid)", 0,
                 choices=("compliant", "constrained"), source="needle-bearing document has constraints"),
        Variable("baumgarte_rate", "parameter", "1/s", "rate at which drift of a constraint is pulled back", 1e4,
                 minimum=0.0, maximum=1e8, nominal=1e4, source="assumed: faster than the cranks, slower than a step"),
        Variable("spectral_radius", "parameter", "1", "what the integrator leaves of frequencies far above its step",
                 0.5, minimum=0.0, maximum=1.0, source="assumed: between none and all"),
        Variable("dynamic_tolerance", "parameter", "1", "local error of a step over a deflection of 1 um", 3e-3,
                 minimum=1e-9, maximum=1.0, source="measured: forces within 1 %"),
        Variable("max_newton", "parameter", "1", "Newton iterations before a step is repeated shorter", 8,
                 integer=True, minimum=2, maximum=100, source="assumed"),
        Variable("damping_law", "parameter", "1", "damping of the contacts in motion", STEP, choices=DAMPINGS,
                 source="needle-bearing document: C c_c v"),
        Variable("mesh_damping", "parameter", "N.s/m", "coefficient C of disc and pin (law step)", 200.0, minimum=0.0,
                 nominal=100.0, source="assumed: 50 to 500 N s/m per tooth"),
        Variable("roller_damping", "parameter", "N.s/m", "coefficient C of a roller (law step)", 200.0, minimum=0.0,
                 nominal=100.0, source="assumed: as disc and pin"),
        Variable("damping_depth", "parameter", "m", "penetration at which damping is full (law step)", 1e-6,
                 minimum=1e-9, maximum=1e-3, nominal=1e-6, source="assumed: a third of the usual penetration"),
        Variable("restitution", "parameter", "1", "coefficient of restitution (law lankarani-nikravesh)", 0.8,
                 minimum=0.0, maximum=1.0, source="assumed: 0.7 to 0.9"),
        Variable("modal_damping_time", "parameter", "s", "time tau of the law modal: damping ratio omega tau/2", 4e-6,
                 minimum=0.0, maximum=1.0, nominal=1e-6, source="assumed: ratio 0.045 at 3.5 kHz"),
        Variable("largest_crank_step", "parameter", "rad", "a communication step is divided so that no crank"
                 " turns further between two equilibria", math.radians(5.0), minimum=1e-6, maximum=1.0,
                 source="assumed: 72 positions a turn"),
        Variable("tolerance", "parameter", "1", "out-of-balance force over load", 1e-9, minimum=1e-12,
                 maximum=1e-3, source="assumed: far below every other error"),
        Variable("max_iterations", "parameter", "1", "Newton iterations before an angle counts as failed", 60,
                 integer=True, minimum=1, maximum=1000, source="assumed"),
    ]

    def output(name, unit, text, shape=(), axes=(), **more):
        return Variable(name, "output", unit, text, 0.0, shape, axes, **more)

    outputs = [
        output("input_angle", "rad", "angle of the sun"),
        output("crank_angle", "rad", "angle of the cranks in the housing (mean of all cranks)"),
        output("crank_speed", "rad/s", "speed of the cranks in the housing"),
        output("cage_angle", "rad", "angle of the roller cages against the discs"),
        output("output_angle", "rad", "angle of the output flange"),
        output("output_speed", "rad/s", "speed of the output flange"),
        output("drive_torque", "N.m", "torque that holds or drives the input"),
        output("reaction_torque", "N.m", "torque with which the housing holds the pin ring"),
        output("transmission_error", "rad", "output angle minus input angle over ratio", nominal=1e-4),
        output("lag", "rad", "carrier behind its ideal angle for the present crank angle (second stage alone)",
               nominal=1e-4),
        output("loaded_teeth", "1", "pins that a disc touches", (t.discs,), ("disc",), nominal=10.0),
        output("contact_pressure", "Pa", "largest Hertz pressure p0 between disc and pins", nominal=1e9),
        output("largest_pin_force", "N", "largest force between a disc and a pin at the present angle", nominal=100.0),
        output("largest_roller_force", "N", "largest force on a roller at the present angle", nominal=100.0),
        output("mesh_force", "N", "force between disc and pin, mean over the communication step", mesh, mesh_axes,
               nominal=100.0),
        output("roller_force", "N", "force on a roller, mean over the communication step", roller, roller_axes,
               nominal=100.0),
        output("output_pin_force", "N", "force of an output pin on its hole at the present angle", output_pin,
               ("disc", "output pin"), nominal=100.0),
        output("tooth_force", "N", "tangential force of the sun on a planet", (t.cranks,), ("crank",),
               nominal=100.0),
        output("reducer_temperature", "K", "temperature of the contacts", nominal=300.0),
        output("power_loss", "W", "power lost: friction and drag, and in motion damping (mean of the last step)"),
        output("housing_force_x", "N", "force of the pins on their ring, with unbalance", nominal=100.0),
        output("housing_force_y", "N", "force of the pins on their ring, with unbalance", nominal=100.0),
        output("cage_speed", "rad/s", "speed of the roller cages against the discs"),
        output("energy_error", "1", "energy that the account in motion lacks, over what was turned over"),
        output("constraint_drift", "m", "largest violation of a joint's constraint (turnings in rad)"),
        output("residual", "1", "out-of-balance force over load at the last equilibrium"),
        output("iterations", "1", "equilibrium iterations of the last angle", integer=True),
        output("substeps", "1", "equilibria in the last communication step", integer=True),
    ]

    def state(name, unit, text, shape=(), axes=(), **more):
        return Variable(name, "state", unit, text, 0.0, shape, axes, **more)

    states = [
        # What effects add to the ideal parts, made in ``prepare``.
        state("pin_radius_added", "m", "added to the pins' radius", (t.pins,), ("pin",)),
        state("lobe_gap_added", "m", "material missing on a lobe", (t.discs, t.lobes), ("disc", "lobe")),
        state("lobe_pitch_added", "m", "lobe displaced along the pitch", (t.discs, t.lobes), ("disc", "lobe")),
        state("profile_radius_added", "m", "added to the pin radius that generates the profile"),
        state("profile_circle_added", "m", "added to the circle radius that generates the profile"),
        state("roller_gap_added", "m", "added to a bearing's clearance", roller, roller_axes),
        state("roller_gap_now", "m", "the same at the present angle, with what depends on it", roller, roller_axes),
        state("throw_added", "m", "added to a lobe's throw", bearing, bearing_axes),
        state("lobe_turn_added", "rad", "added to a lobe's direction", bearing, bearing_axes),
        state("hole_tangential_added", "m", "hole in the disc displaced along its circle", bearing, bearing_axes),
        state("hole_radial_added", "m", "hole in the disc displaced outwards", bearing, bearing_axes),
        state("seat_radial_added", "m", "crank's seat displaced outwards", (t.cranks,), ("crank",)),
        state("seat_tangential_added", "m", "crank's seat displaced along its circle", (t.cranks,), ("crank",)),
        state("tooth_gap", "m", "what sun and planet lack along the line of action", (t.cranks,), ("crank",)),
        state("tooth_gap_rate", "m", "its growth with the sun's turning against the carrier, per radian", (t.cranks,), ("crank",)),
        state("crank_turn_added", "rad", "a crank's turning by what its teeth lack", (t.cranks,), ("crank",)),
        state("crank_turn_rate", "1", "its growth with the sun's turning against the carrier", (t.cranks,), ("crank",)),
        state("ring_scale", "1", "pin circle radius over that at the reference temperature"),
        state("grease_thinning", "1", "viscosity of the grease over that of new grease"),
        state("friction_power", "W", "power lost by friction and drag at the last equilibrium"),
        state("friction_load", "N.m", "torque of friction and drag at the input, in motion"),
        state("cage_share", "1", "speed of the cages over that of pure rolling"),
        state("pressure_cosine", "1", "cosine of the first stage's pressure angle"),
        state("ideal_output", "rad", "output angle of ideal kinematics"),
        state("cage", "rad", "angle of the cages"),
        state("z", "1", "departures from ideal kinematics, see assembly", (z,), ("coordinate",)),
        state("z_before", "1", "z one equilibrium earlier", (z,), ("coordinate",)),
        state("advance_before", "rad", "turning of the ideal output between z_before and z"),
        state("phase_shift", "rad", "contact phase less the ideal one", mesh, mesh_axes),
        state("mesh_force_now", "N", "force of the last equilibrium", mesh, mesh_axes),
        state("roller_force_now", "N", "force of the last equilibrium", roller, roller_axes),
        state("q", "1", "places of the bodies, see dynamics", (z + 2,), ("coordinate",)),
        state("acceleration", "1", "accelerations of the bodies", (z + 2,), ("coordinate",)),
        state("smooth", "1", "the integrator's acceleration", (z + 2,), ("coordinate",)),
        state("mass", "1", "mass or inertia of each coordinate", (z + 2,), ("coordinate",)),
        state("length_scale", "1", "small change of each coordinate", (z + 2,), ("coordinate",)),
        state("multiplier", "N", "forces of the joints' constraints (moments in N m)", (m,), ("constraint",)),
        state("mesh_error_start", "m", "profile error at the last communication point", mesh, mesh_axes),
        state("roller_error_start", "m", "profile error at the last communication point", roller, roller_axes),
        state("drive_speed", "rad/s", "input speed at the last communication point"),
        state("internal_step", "s", "next step of the integrator"),
        state("mesh_force_before", "N", "force one internal step earlier", mesh, mesh_axes),
        state("roller_force_before", "N", "force one internal step earlier", roller, roller_axes),
        state("potential", "J", "energy of deformation"), state("dissipation", "W", "power lost in damping"),
        state("cage_power", "W", "power of the cages' prescribed motion"),
        state("input_energy", "J", "work of the input"), state("output_energy", "J", "work done on the load"),
        state("lost_energy", "J", "energy lost in damping"), state("cage_energy", "J", "work of the cages"),
        state("stored_energy", "J", "energy of motion and deformation at the start"),
        state("assemblies", "1", "evaluations of all forces in the last communication step", integer=True),
        state("rejected", "1", "internal steps repeated shorter", integer=True),
        state("v", "1", "velocities of the coordinates, sun and load", (z + 2,), ("coordinate",)),
        state("mesh_impact_speed", "m/s", "speed of penetration at first touch", mesh, mesh_axes),
        state("roller_impact_speed", "m/s", "speed of approach at first touch", roller, roller_axes),
        state("mesh_damping_now", "1", "coefficient of the chosen law for disc and pin"),
        state("roller_damping_now", "1", "coefficient of the chosen law for a roller"),
        state("compliance", "1", "compliance of each coordinate of z", (z,), ("coordinate",)),
        state("is_free", "1", "whether the coordinate is an unknown", (z,), ("coordinate",), integer=True),
        state("free", "1", "the unknown coordinates", (z,), ("unknown",), integer=True),
        state("free_count", "1", "number of unknowns", integer=True),
        state("mesh_constant", "1", "K of disc and pin in N/m^n"),
        state("mesh_exponent", "1", "n of disc and pin"),
        state("roller_constant", "1", "K of a roller in N/m^n"),
        state("roller_exponent", "1", "n of a roller"),
        state("output_gap_added", "m", "added to the clearance of the output pins"),
        state("output_constant", "1", "K of an output pin in N/m^n"),
        state("output_exponent", "1", "n of an output pin"),
        state("pin_angle", "rad", "nominal direction of a pin", (t.pins,), ("pin",)),
        state("pin_x", "m", "centre of a pin", (t.pins,), ("pin",)),
        state("pin_y", "m", "centre of a pin", (t.pins,), ("pin",)),
        state("pin_cos", "1", "nominal direction of a pin", (t.pins,), ("pin",)),
        state("pin_sin", "1", "nominal direction of a pin", (t.pins,), ("pin",)),
    ]

    def scratch(name, shape=(), **more):
        return Variable(name, "scratch", "1", "", 0.0, shape, ("",) * len(shape), **more)

    work = [
        # Two coordinates more than z in motion: sun and load.
        scratch("residual_vector", (z + 2,)), scratch("tangent", (z + 2, z + 2)), scratch("factor", (z + 2, z + 2)),
        scratch("factor_scale", (z + 2,)), scratch("direction", (z + 2,)),
        scratch("mesh_error_end", mesh), scratch("roller_error_end", roller),
        scratch("mesh_rate", mesh), scratch("roller_rate", roller), scratch("joint_index", (5,), integer=True),
        scratch("unknown", (z + 2,), integer=True),
        scratch("constraint", (m,)), scratch("constraint_rate", (m,)), scratch("constraint_bias", (m,)),
        scratch("constraint_jacobian", (m, z + 2)), scratch("multiplier_step", (m,)), scratch("multiplier_start", (m,)),
        scratch("schur", (m, m)), scratch("schur_scale", (m,)), scratch("schur_columns", (m, z + 2)),
        scratch("joint_gradient", (5,)), scratch("q_start", (z + 2,)), scratch("v_start", (z + 2,)),
        scratch("acceleration_start", (z + 2,)), scratch("smooth_start", (z + 2,)),
        scratch("mesh_phase", mesh), scratch("centre_curvature", mesh),
        scratch("crank_force", (t.cranks, 2)), scratch("crank_moment", (t.cranks,)),
        scratch("bearing_total", (3,)), scratch("bearing_tangent", (3, 3)), scratch("bearing_columns", (9, 4)),
        scratch("output_columns", (6, 2)),
    ]
    effects = [v for effect in EFFECTS.values() for v in effect.variables()]
    return Table("RvPlant", "RV reducer: equilibrium or motion of discs, pins, needle bearings and cranks",
                 inputs + parameters + effects + outputs + states + work)
