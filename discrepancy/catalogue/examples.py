"""At which sizes an effect is shown: those that the physics audit names, else a few times its typical size."""

from collections.abc import Mapping
from dataclasses import dataclass

from discrepancy.effects import MODULES
from fmu_src.effect import Effect
from rv_plant.effects import EFFECTS as PLANT
from wear_fmu.effects import EFFECTS as WEAR

UM = 1e-6
HOUR = 3600.0


@dataclass(frozen=True)
class Case:
    """One strength of one effect: a title and the values of its parameters in SI units."""

    title: str
    values: Mapping[str, float]


CASES: dict[str, tuple[Case, ...]] = {
    "running_in": (Case("5 times the wear when new, 200 h", {"running_in_excess": 4.0, "running_in_time": 200 * HOUR}),),
    "debris_abrasion": (
        Case("gain 1 at 0.1 % iron", {"debris_gain": 1.0}),
        Case("the same, grease changed every 1,000 h", {"debris_gain": 1.0, "grease_change": 1000 * HOUR}),
    ),
    "lubrication_regime": (Case("a thick film spares 90 %", {"film_share": 0.9, "film_lambda": 0.2}),),
    "stribeck_friction": (
        Case("Coulomb friction 0.06", {"friction_coefficient": 0.06}),
        Case("Stribeck: 0.04, static excess 0.08, viscous 0.1 s/m",
             {"friction_coefficient": 0.04, "friction_excess": 0.08, "friction_viscous": 0.1}),
        Case("needle bearings 0.003", {"bearing_friction": 0.003}),
    ),
    "drag": (Case("seals 0.1 N m, churning 0.2 N m", {"seal_torque": 0.1, "churning_torque": 0.2}),),
    "thermal_expansion": (
        Case("pin circle grows 2e-6/K over the discs", {"thermal_expansion": 2e-6}),
        Case("the same, warming 0.5 K/W by friction 0.06",
             {"thermal_expansion": 2e-6, "thermal_resistance": 0.5, "friction_coefficient": 0.06}),
    ),
    "pin_position_errors": (
        Case("ring 5 um off centre", {"pin_ring_runout": 5 * UM}),
        Case("ring 5 um oval", {"pin_ring_ovality": 5 * UM}),
        Case("ring with three lobes of 5 um", {"pin_ring_trilobe": 5 * UM}),
        Case("one pin 5 um thicker", {"proud_pin": 5 * UM}),
        Case("random places, 2 um", {"pin_scatter": 2 * UM}),
        Case("four and six lobes of 2 um", {"pin_ring_cos_4": 2 * UM, "pin_ring_sin_6": 2 * UM}),
    ),
    "disc_tooth_errors": (
        Case("both discs 4 um off centre, opposed", {"disc_runout": 4 * UM}),
        Case("both discs 4 um off centre, as a pair", {"disc_runout": 4 * UM, "disc_pairing": 0.0}),
        Case("random pitch, 3 um", {"lobe_pitch_scatter": 3 * UM}),
    ),
    "profile_modification": (
        Case("20 um shift, 13 um equidistant", {"equidistant_added": -13 * UM, "shift_added": -20 * UM}),
    ),
    "needle_clearance": (
        Case("2.5 um less radial clearance (0)", {"needle_clearance_added": -2.5 * UM}),
        Case("2.5 um more (5)", {"needle_clearance_added": 2.5 * UM}),
        Case("7.5 um more (10)", {"needle_clearance_added": 7.5 * UM}),
    ),
    "raceway_wear": (
        Case("inner races 10 um", {"inner_race_worn": 10 * UM}),
        Case("outer races 10 um", {"outer_race_worn": 10 * UM}),
    ),
    "crank_lobe_errors": (
        Case("throw of one eccentric 3 um too large", {"lobe_throw_error_1": 3 * UM}),
        Case("one eccentric turned by 3 um", {"lobe_phase_error_1": 3.0 / 900.0}),
    ),
    "hole_position_errors": (
        Case("one hole of one disc 4 um back", {"disc_hole_shift_1": -4 * UM}),
        Case("one seat of the carrier 4 um back", {"carrier_seat_shift": -4 * UM}),
    ),
    "support_compliance": (
        Case("crank supports 1.4e8 N/m", {"crank_support_compliance": 1.0 / 1.4e8}),
        Case("output flange 100 N m/arcmin", {"carrier_compliance": 1.0 / (100.0 * 3437.75)}),
    ),
    "first_stage_error": (
        Case("tooth error 10 um", {"tooth_error": 10 * UM}),
        Case("sun 20 um off centre", {"sun_runout": 20 * UM}),
        Case("one planet 20 um off centre", {"planet_runout": 20 * UM}),
        Case("play 50 um", {"backlash": 50 * UM}),
    ),
    "load_exponent": (Case("exponent + 0.5", {"load_exponent_added": 0.5}),),
    "hardness_gradient": (Case("core at 54 % hardness, case 20 um", {"core_softness": 0.46, "case_depth": 20 * UM}),
                          Case("the same, case 2 um", {"core_softness": 0.46, "case_depth": 2 * UM})),
    "edge_loading": (Case("tilt 60 urad", {"misalignment": 6e-5, "roller_misalignment": 6e-5}),
                     Case("tilt 500 urad", {"misalignment": 5e-4, "roller_misalignment": 5e-4})),
    "roller_skidding": (Case("10 % at no load, gone beyond 500 N", {"skid_share": 0.1}),),
    "pin_rotation": (Case("pins stand half the time", {"pin_standing_share": 0.5}), Case("pins stand", {"pin_standing_share": 1.0})),
    "drive_friction": (Case("1 N m and a tenth of the load", {"drive_friction": 1.0, "drive_friction_share": 0.1}),),
    "output_play": (Case("0.1 mm; without output pins it shows nothing", {"output_play": 100 * UM}),),
    "unbalance": (Case("one disc of 0.387 kg at 0.9 mm", {"unbalance": 0.387 * 0.9e-3}),),
    "race_spall": (
        Case("pit of 10 um on an inner race", {"spall_depth": 10 * UM}),
        Case("pit of 10 um on an outer race", {"spall_depth_outer": 10 * UM}),
    ),
    "grease_ageing": (
        Case("viscosity doubles, wear triples in 10,000 h; churning 0.2 N m",
             {"grease_ageing": 0.693, "grease_starvation": 2.0, "churning_torque": 0.2, "grease_life": 10_000 * HOUR}),
    ),
    "arrhenius": (Case("30 kJ/mol", {"activation_energy": 3e4}),
                  Case("30 kJ/mol, on the races alone", {"activation_energy": 3e4, "arrhenius_surfaces": 3})),
    "pressure_threshold": (Case("no wear below 600 MPa", {"threshold_share": 1.0, "threshold_pressure": 6e8}),),
    "starvation": (Case("3 times the wear from 500 h on", {"starvation_growth": 2.0, "starvation_onset": 500 * HOUR}),),
    "wear_growth": (Case("half as much again each 1,000 h", {"wear_growth": 0.5}),),
    "ring_stiffness": (Case("10 % softer and stiffer", {"ring_stiffness_cos": 0.1}),),
    "unequal_discs": (
        Case("ring 2 um off centre for one disc, 2 um the other way for the other", {"disc_offset_x": 4 * UM}),
        Case("teeth of the second disc 4 um thinner", {"disc_gap_difference": 4 * UM}),
        Case("the same in a ring 5 um off centre", {"disc_gap_difference": 4 * UM, "pin_ring_runout": 5 * UM}),
        Case("clearance of the second disc's bearings 2 um larger", {"disc_clearance_difference": 2 * UM}),
    ),
    "tilting_moment": (
        Case("twice the load torque", {"tilting_share_x": 2.0}),
        Case("300 N m, whatever the load", {"tilting_moment_x": 300.0}),
    ),
    "first_stage_play": (Case("20 um more and less", {"first_stage_play_cos": 20 * UM}),),
    "pin_seats": (
        Case("seats yield 1e-8 m/N", {"pin_seat_compliance": 1e-8}),
        Case("1e-9 m/N more and less, twice round", {"pin_seat_cos_2": 1e-9}),
    ),
    "carrier_stiffness": (
        Case("2e-8 rad/(N m) more and less over the carrier's turn", {"carrier_turn_cos": 2e-8}),
        Case("the same over the cranks' turn", {"carrier_crank_cos": 2e-8}),
    ),
    "friction_windup": (Case("1e-7 rad/(N m) at creeping speed", {"friction_windup": 1e-7}),),
    "support_hysteresis": (
        Case("100 N m/arcmin once it slips at 20 N m",
             {"support_slip_compliance": 1.0 / (100.0 * 3437.75), "support_slip_torque": 20.0}),
    ),
    "torsional_resonance": (
        Case("22 Hz, damping ratio 0.05", {"resonance_share": 1.0, "resonance_frequency": 22.0}),
        Case("11 Hz, half of the error over the spring", {"resonance_share": 0.5, "resonance_frequency": 11.0}),
    ),
    "encoder_eccentricity": (Case("5 um on 50 mm", {"encoder_cos1": 2e-4}),),
    "torque_ripple": (Case("order 156 at 54 Hz, 1e-8 rad/(N m)", {"ripple_cos": 1e-8}),),
    "locked_position": (
        Case("where the first component has twice its deviation", {"position_1": 2.0}),
        Case("where the second has", {"position_2": 2.0}),
    ),
    "encoder_distortion": (Case("10 arcsec, three screws", {"distortion_cos": 4.8e-5}),),
    "clock_slip": (Case("0.1 %", {"clock_slip": 1e-3}),),
    "sensor_gain": (Case("5 %", {"sensor_gain": 0.05}),),
    "sensor_offset": (Case("5 % of the mean", {"sensor_offset": 0.05}),),
    "sensor_drift": (Case("5 % of the mean in a run", {"sensor_drift": 0.05}),),
}  # fmt: skip

# What an effect is compared with, where it acts only on something that is off by default.
BACKGROUND: dict[str, Mapping[str, float]] = {"grease_ageing": {"churning_torque": 0.2}}

# Figures of the physics audit: effect, case, figure, condition, value.
AUDITED = (
    ("pin_position_errors", 0, "TE order 78", "rated", 1.8), ("pin_position_errors", 0, "TE order 78", "load 25 %", 3.9),
    ("pin_position_errors", 0, "TE order 2", "load 25 %", 2.7), ("pin_position_errors", 1, "TE order 78", "rated", 10.0),
    ("pin_position_errors", 3, "TE order 78", "rated", 0.46), ("pin_position_errors", 4, "TE order 78", "rated", 1.07),
    ("needle_clearance", 0, "TE peak to peak", "rated", 0.55), ("needle_clearance", 1, "TE peak to peak", "rated", 12.7),
    ("needle_clearance", 2, "TE peak to peak", "rated", 24.0), ("needle_clearance", 0, "mean TE (behind)", "rated", 26.5),
    ("needle_clearance", 1, "mean TE (behind)", "rated", 75.5), ("needle_clearance", 2, "mean TE (behind)", "rated", 120.0),
    ("raceway_wear", 0, "mean TE (behind)", "rated", 51.9 + 41.0), ("raceway_wear", 1, "mean TE (behind)", "rated", 51.9 + 51.0),
    ("raceway_wear", 0, "TE order 80", "rated", 4.69), ("raceway_wear", 1, "TE order 80", "rated", 0.87),
    ("crank_lobe_errors", 0, "TE order 40", "rated", 4.98), ("hole_position_errors", 0, "TE order 40", "rated", 6.05),
    ("hole_position_errors", 1, "mean TE (behind)", "rated", 51.9 - 15.0), ("unbalance", 0, "housing force order 39", "rated", 1.6),
)  # fmt: skip

# The picture that shows an effect best, see ``plots``.
PICTURES = {
    "running_in": "hours", "debris_abrasion": "hours", "grease_ageing": "hours", "lubrication_regime": "speed_wear",
    "stribeck_friction": "torque", "drag": "torque", "thermal_expansion": "loop", "profile_modification": "loop",
    "support_compliance": "loop", "raceway_wear": "loop", "load_exponent": "load_wear", "hardness_gradient": "hours",
    "edge_loading": "load_wear", "roller_skidding": "cage", "pin_rotation": "pin_print", "unbalance": "housing",
    "support_hysteresis": "loop", "arrhenius": "warm_wear", "pressure_threshold": "load_wear", "starvation": "hours", "wear_growth": "hours",
    "race_spall": "burst", "sensor_gain": "trace", "sensor_offset": "trace", "sensor_drift": "trace", "locked_position": "loop",
}  # fmt: skip


def cases(name: str, effect: Effect) -> tuple[Case, ...]:
    """The effect's cases; one per group of amplitudes for an effect that is not in the list (a user's own)."""
    if name in CASES:
        return CASES[name]
    groups = dict.fromkeys(p.group for p in effect.amplitudes())
    return tuple(
        Case(group or effect.title, {p.variable.name: float(p.variable.start) + (p.sign or 1) * p.scale
                                     for p in effect.amplitudes() if p.group == group})
        for group in groups
    )  # fmt: skip


def picture(name: str) -> str:
    return PICTURES.get(name, "orders")


def part_of(name: str) -> str:
    """Where an effect acts: plant, wear unit, both or measuring chain."""
    if name in MODULES:
        return "measuring chain"
    return "plant and wear unit" if name in PLANT and name in WEAR else "plant" if name in PLANT else "wear unit"
