"""Compliance of what holds and connects the contacts beyond that of the reducer file: springs in series.

    housing: turning = c_h M;  output: twist = c_o T;  each crank support: shift = c_s F;
    main bearings: shift = c_m F;  sun and planet: c_f along the tooth normal

Source: series springs; published torsional stiffness 60 to 110 N m/arcmin against some 380
of the contacts alone; supports about 1.4e8 N/m per crank.
"""

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel
from rv_plant.supports import crank_turn_of_teeth


def _spring(name, unit, text, scale, high, group):
    return amplitude(name, unit, text, scale, 0.0, high, sign=1, source="nothing beyond the reducer file", group=group)


EFFECT = Effect(
    14, "support compliance",
    "turning = c_h M, twist = c_o T, shift = c_s F, c_m F, c_f along the tooth normal",
    "series springs; catalogue stiffness 49 and 108 N m/arcmin",
    "linear in torque, without hysteresis and without change in time; lower stiffness and resonance; the contacts"
    " themselves stiffen with load and have a knee at the clearance",
    (
        _spring("carrier_compliance", "rad/(N.m)", "twist between crank seats and output flange", 1e-7, 1e-2, "carrier"),
        _spring("housing_compliance", "rad/(N.m)", "turning of the pin ring under its torque", 1e-7, 1e-2, "housing"),
        _spring("crank_support_compliance", "m/N", "bearings of one crank in the carrier", 1e-9, 1e-3, "crank supports"),
        _spring("main_bearing_compliance", "m/N", "bearings of the carrier in the housing", 1e-9, 1e-3, "main bearings"),
        _spring("first_stage_compliance", "m/N", "one tooth contact of sun and planet, along its normal", 1e-8, 1e-3, "first stage"),
    ),
    signals=("hysteresis", "lost_motion", "torsional_stiffness", "transmission_error", "vibration"),
)


@kernel
def prepare(r):
    discs, cranks = r.throw_added.shape
    carrier = 3 * discs
    r.compliance[carrier + 1] += r.main_bearing_compliance
    r.compliance[carrier + 2] += r.main_bearing_compliance
    for c in range(cranks):
        crank = carrier + 3 + 3 * c
        r.compliance[crank] += r.crank_support_compliance
        r.compliance[crank + 1] += r.crank_support_compliance
        r.compliance[crank + 2] += crank_turn_of_teeth(r, r.first_stage_compliance)
    r.compliance[r.z.shape[0] - 1] += r.housing_compliance
