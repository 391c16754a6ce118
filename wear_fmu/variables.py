"""Every variable of the wear unit, declared once."""

from dataclasses import dataclass

from fmu_src.variables import Table, Variable

from wear_fmu.effects import EFFECTS
from wear_fmu.kinematics import SLIDING_FORMS
from wear_fmu.wear_laws import LAWS

FILE = "reducer file"


@dataclass(frozen=True)
class Resolution:
    """Number of bins of a surface: flank of one lobe, contact side of a pin, raceway."""

    flank: int = 180
    pin: int = 180
    raceway: int = 360


def wear_table(topology, resolution: Resolution = Resolution()) -> Table:
    """The wear unit's variables; ``topology`` has discs, cranks, pins, lobes, rollers."""
    t, bins = topology, resolution
    mesh, bearing = (t.discs, t.pins), (t.discs, t.cranks)
    roller = (*bearing, t.rollers)
    mesh_axes, bearing_axes, roller_axes = ("disc", "pin"), ("disc", "crank"), ("disc", "crank", "roller")

    inputs = [
        Variable("crank_angle", "input", "rad", "angle of the cranks in the housing"),
        Variable("crank_speed", "input", "rad/s", "speed of the cranks in the housing"),
        Variable("output_angle", "input", "rad", "angle of the carrier"),
        Variable("cage_angle", "input", "rad", "angle of the roller cages against the discs"),
        Variable("temperature", "input", "K", "temperature of the contacts", 293.15, minimum=200.0, maximum=500.0,
                 nominal=300.0, source="assumed: room temperature"),
        Variable("mesh_force", "input", "N", "force between disc and pin, mean over the communication step",
                 shape=mesh, axes=mesh_axes, nominal=100.0),
        Variable("roller_force", "input", "N", "force on a roller, mean over the communication step",
                 shape=roller, axes=roller_axes, nominal=100.0),
    ]

    def parameter(name, unit, text, start, minimum=None, maximum=None, source=FILE, **more):
        return Variable(name, "parameter", unit, text, start, minimum=minimum, maximum=maximum, source=source, **more)

    parameters = [
        parameter("pin_radius", "m", "radius of the pins", 2e-3, 1e-5, nominal=1e-3),
        parameter("pin_circle_radius", "m", "radius of the circle of the pins' centres", 52e-3, 1e-4, nominal=1e-2),
        parameter("eccentricity", "m", "throw of the cranks", 0.9e-3, 1e-6, nominal=1e-3),
        parameter("mesh_width", "m", "width of one disc", 8.82e-3, 1e-5, nominal=1e-2),
        parameter("inner_race_radius", "m", "radius of the crank's lobe", 10.25e-3, 1e-4, nominal=1e-2),
        parameter("outer_race_radius", "m", "radius of the hole in the disc", 13.25e-3, 1e-4, nominal=1e-2),
        parameter("roller_radius", "m", "radius of the needle rollers", 1.5e-3, 1e-5, nominal=1e-3),
        parameter("roller_length", "m", "length of the needle rollers", 8e-3, 1e-5, nominal=1e-2),
        parameter("elastic_modulus", "Pa", "Young's modulus of all parts", 207e9, 1e6, nominal=1e11),
        parameter("poisson_ratio", "1", "Poisson's ratio of all parts", 0.3, 0.0, 0.5),
        parameter("hardness", "Pa", "hardness of the worn surfaces", 7e9, 1e6, nominal=1e9),
        parameter("mesh_wear_law", "1", "wear law of flanks and pins", 1, choices=LAWS, source="BX-40E document"),
        parameter("raceway_wear_law", "1", "wear law of the raceways", 2, choices=LAWS,
                  source="needle-bearing document, law restored after Janakiraman et al. 2014"),
        parameter("sliding_form", "1", "sliding of flank on pin", 0, choices=SLIDING_FORMS,
                  source="exact kinematics; the printed form is garbled"),
        parameter("mesh_wear_coefficient", "1", "dimensionless wear coefficient of flanks and pins, run in",
                  5e-9, 0.0, 1.0, nominal=1e-8),
        parameter("raceway_wear_coefficient", "1", "the same for the raceways (laws other than Janakiraman)",
                  3e-9, 0.0, 1.0, nominal=1e-8),
        parameter("run_in_ratio", "1", "wear coefficient when new over run in", 5.0, 0.0, 1e3),
        parameter("run_in_time", "s", "decay time of running-in at run_in_crank_speed (it goes by distance slid)",
                  300 * 3600.0, 1.0, nominal=1e6),
        parameter("run_in_crank_speed", "rad/s", "speed of the cranks that run_in_time holds for", 67.5, 1e-6),
        parameter("load_exponent", "1", "exponent of the load dependence", 0.3, -1.0, 5.0),
        parameter("reference_line_load", "N/m", "load per width at which the coefficient holds", 5e4, 1e-3,
                  nominal=1e4),
        parameter("roughness", "m", "composite roughness Rq of roller and raceway, and of disc and pin", 0.4e-6,
                  1e-9, 1e-4, nominal=1e-6),
        parameter("pressure_viscosity", "1/Pa", "pressure-viscosity coefficient of the grease at its reference"
                  " temperature", 1.8e-8, 1e-10, 1e-6, nominal=1e-8),
        parameter("pressure_viscosity_slope", "1/K", "relative fall of it with temperature", 0.005, 0.0, 0.1,
                  source="assumed: about 0.5 % per kelvin"),
        parameter("reference_temperature", "K", "temperature that pressure_viscosity holds for", 293.15, 200.0,
                  500.0, source="assumed: room temperature"),
        parameter("slip_ratio_inner", "1", "slip of the rollers on the inner raceway", 0.05, 0.0, 1.0),
        parameter("slip_ratio_outer", "1", "slip of the rollers on the outer raceway", 0.05, 0.0, 1.0),
        parameter("pins", "1", "whether the pins turn in their grooves and wear all round, or stand", 0,
                  choices=("turn", "stand"), source="assumed: they turn, which agrees with ten times less wear than"
                  " the disc"),
        parameter("acceleration", "1", "wear, time and distance count this many times", 1.0, 0.0, tunable=True,
                  source="chosen by the master"),
        parameter("contact_lead", "1", "profile errors are given for the contact this many communication steps"
                  " ahead; 0 gives the present contact", 1.0, 0.0, 10.0, tunable=True,
                  source="1 makes the exchange of plant and wear second order in the step"),
    ]

    def output(name, unit, text, shape=(), axes=(), **more):
        return Variable(name, "output", unit, text, 0.0, shape, axes, **more)

    outputs = [
        output("mesh_profile_error", "m", "what disc and pin lack at their contact", mesh, mesh_axes, nominal=1e-6),
        output("roller_profile_error", "m", "what both raceways lack at a roller", roller, roller_axes, nominal=1e-6),
        output("operating_time", "s", "time that the wear stands for", nominal=1e6),
        output("crank_travel", "rad", "turning of the cranks that the wear stands for", nominal=1e9),
        output("flank_depth", "m", "deepest wear on a disc's flanks", (t.discs,), ("disc",), nominal=1e-6),
        output("flank_phase", "rad", "its place: 0 root, pi tip, 2 pi next root", (t.discs,), ("disc",)),
        output("flank_lobe", "1", "its lobe, from 1", (t.discs,), ("disc",), integer=True),
        output("pin_depth", "m", "deepest wear on a pin", mesh, mesh_axes, nominal=1e-6),
        output("inner_race_depth", "m", "deepest wear of the crank's raceway", bearing, bearing_axes, nominal=1e-6),
        output("inner_race_angle", "rad", "its place, from the lobe's eccentric direction", bearing, bearing_axes),
        output("outer_race_depth", "m", "deepest wear of the disc's raceway", bearing, bearing_axes, nominal=1e-6),
        output("outer_race_angle", "rad", "its place, from the hole's outward radial", bearing, bearing_axes),
        output("flank_volume", "m^3", "material lost by the flanks: integral of K F ds/H", nominal=1e-9),
        output("pin_volume", "m^3", "material lost by the pins", nominal=1e-9),
        output("inner_race_volume", "m^3", "material lost by the cranks' raceways", nominal=1e-9),
        output("outer_race_volume", "m^3", "material lost by the discs' raceways", nominal=1e-9),
    ]

    def state(name, unit, text, shape=(), axes=(), **more):
        return Variable(name, "state", unit, text, 0.0, shape, axes, **more)

    def surface(name, text, shape, axes):
        return state(name, "m", text, shape, axes, nominal=1e-6, profile=True)

    states = [
        state("effects_on", "1", "whether any effect acts on the wear coefficient", integer=True),
        state("standing", "1", "share of a pin's wear that stays in place"),
        state("crank_angle_before", "rad", "crank angle at the last step"),
        state("output_angle_before", "rad", "carrier angle at the last step"),
        state("cage_angle_before", "rad", "cage angle at the last step"),
        surface("disc_wear", "depth on a disc's circumference, lobe after lobe, each from root over tip to root",
                (t.discs, t.lobes * bins.flank), ("disc", "bin")),
        surface("pin_wear", "depth on a standing pin, from -90 to +90 degrees of its inward radial, per disc",
                (*mesh, bins.pin), ("disc", "pin", "bin")),
        surface("pin_even_wear", "depth all round a turning pin, per disc", mesh, mesh_axes),
        surface("inner_race_wear", "depth on a crank's lobe", (*bearing, bins.raceway), (*bearing_axes, "bin")),
        surface("outer_race_wear", "depth in a disc's hole", (*bearing, bins.raceway), (*bearing_axes, "bin")),
        state("slide", "m", "sliding length of a contact within a bin of a lobe", (bins.flank,), ("bin",)),
        state("slide_before", "m", "its sum up to the bin", (bins.flank,), ("bin",)),
        state("arc", "m", "flank length of a bin", (bins.flank,), ("bin",)),
    ]
    effects = [v for effect in EFFECTS.values() for v in effect.variables()]
    return Table("RvWear", "RV reducer: wear of flanks, pins and needle-bearing raceways",
                 inputs + parameters + effects + outputs + states, starts_from_nothing=True)


