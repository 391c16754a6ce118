"""What yields, rubs and has play beside the contacts: numbers of the reducer, and what effects add to them.

A support of compliance 0 is rigid, as in both sources.  Compliances and friction are zero unless the reducer file gives them; the
effects ``support_compliance``, ``first_stage_error``, ``stribeck_friction`` and ``drag`` are what is missing beyond the file, and say how
friction depends on speed and viscosity.
"""

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable
from rv_plant.gear_stage import planet_radius
from rv_plant.mesh import ring_coordinate

RIGID = "assumed: rigid, as in both sources"
LOSSLESS = "assumed: none, as in both sources"


def yielding(name: str, path: str, unit: str, text: str, high: float) -> Variable:
    return Variable(name, "parameter", unit, text, 0.0, minimum=0.0, maximum=high, nominal=1e-9 if unit == "m/N" else 1e-7, source=RIGID, path=path)


def rubbing(name: str, path: str, unit: str, text: str, high: float) -> Variable:
    return Variable(name, "parameter", unit, text, 0.0, minimum=0.0, maximum=high, source=LOSSLESS, path=path)


def variables(sizes: Sizes) -> list[Variable]:
    return [
        yielding("crank_seat_compliance", "crank.support_compliance", "m/N", "bearings of one crank in the carrier, with their seats and"
                 " the crank's bending", 1e-3),
        yielding("carrier_seat_compliance", "carrier.bearing_compliance", "m/N", "bearings of the carrier in the housing", 1e-3),
        yielding("carrier_twist_compliance", "carrier.compliance", "rad/(N.m)", "twist between crank seats and output flange", 1e-2),
        yielding("ring_seat_compliance", "housing.compliance", "rad/(N.m)", "turning of the pin ring under its torque", 1e-2),
        yielding("tooth_compliance", "first_stage.compliance", "m/N", "one tooth contact of sun and planet along its normal, with the"
                 " crank's torsion", 1e-3),
        Variable("tooth_backlash", "parameter", "m", "play between the flanks of sun and planet, along the normal", 0.0, minimum=0.0, maximum=1e-3,
                 nominal=1e-6, source=LOSSLESS, path="first_stage.backlash", display="um"),
        rubbing("mesh_friction", "mesh.friction", "1", "friction coefficient of disc and pin, sliding", 0.5),
        rubbing("mesh_friction_excess", "mesh.friction_excess", "1", "static friction of disc and pin above that of sliding", 0.5),
        rubbing("roller_friction", "roller.friction", "1", "friction coefficient of the needle bearings, at the inner race", 0.1),
        rubbing("input_seal_torque", "input.seal_torque", "N.m", "drag of the seals at the input, whatever the load", 100.0),
        rubbing("input_churning_torque", "input.churning_torque", "N.m", "drag of the grease at the input, at its reference speed and"
                " temperature (effects.drag)", 100.0),
    ]  # fmt: skip


@kernel
def take_supports(r):
    """Compliance of each coordinate by the reducer file; effects add theirs."""
    discs, cranks = r.throw_added.shape
    carrier = 3 * discs
    for i in range(r.compliance.shape[0]):
        r.compliance[i] = 0.0
    r.compliance[carrier + 1] = r.compliance[carrier + 2] = r.carrier_seat_compliance
    for c in range(cranks):
        crank = carrier + 3 + 3 * c
        r.compliance[crank] = r.compliance[crank + 1] = r.crank_seat_compliance
        r.compliance[crank + 2] = crank_turn_of_teeth(r, r.tooth_compliance)
    r.compliance[ring_coordinate(r)] = r.ring_seat_compliance


@kernel
def crank_turn_of_teeth(r, compliance):
    """Turning of a crank per moment on it [rad/(N m)] where a tooth contact yields by ``compliance`` [m/N] along its normal."""
    lever = planet_radius(r.crank_circle_radius, r.first_stage_ratio) * r.pressure_cosine
    return compliance / (lever * lever) if lever > 0.0 else 0.0


@kernel
def teeth_yield(r):
    """Compliance of one tooth contact [m/N]."""
    return r.tooth_compliance + r.first_stage_compliance


@kernel
def twist_compliance(r):
    """Twist of the carrier per torque at the flange [rad/(N m)]."""
    return r.carrier_twist_compliance + r.carrier_compliance


@kernel
def sliding_friction(r):
    """Coefficient of disc and pin, sliding."""
    return r.mesh_friction + r.friction_coefficient


@kernel
def sticking_friction(r):
    """What the coefficient of disc and pin has at rest above that of sliding."""
    return r.mesh_friction_excess + r.friction_excess
