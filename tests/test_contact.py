"""Contact laws against Palmgren, Hertz (Johnson 1985) and numerical derivatives."""

import numpy as np
import pytest
from scipy.integrate import quad
from stand import in_equilibrium
from twin import Twin, centre_curve

from rv_plant.contact import (
    LANKARANI,
    LINE,
    LITERAL,
    PALMGREN,
    SI,
    contact_force,
    hertz_half_width,
    hertz_peak_pressure,
    law_constants,
)

EXPONENT = 10.0 / 9.0
# 1/E* = 2 (1 - nu^2)/E for steel on steel; published as 113.7 GPa.
MODULUS = 207e9 / (1.0 - 0.3**2) / 2.0


def force_at(penetration, law=LINE, reading=SI, length=8e-3):
    constant, exponent = law_constants(law, reading, 5.1e5, 5.26e6, 1.5, length)
    return contact_force(penetration, constant, exponent)[0]


def test_palmgren_for_8_mm_is_the_roller_stiffness_in_print():
    constant, exponent = law_constants(PALMGREN, SI, 0.0, 0.0, 1.5, 8e-3)
    assert exponent == EXPONENT
    # N/m^(10/9) to N/mm^(10/9)
    assert constant / 1000.0**EXPONENT == pytest.approx(5.118e5, rel=1e-4, abs=0)


def test_palmgren_grows_with_length_to_the_power_of_eight_ninths():
    longer = force_at(1e-5, PALMGREN, length=12e-3) / force_at(1e-5, PALMGREN)
    assert longer == pytest.approx(1.5 ** (8 / 9), rel=1e-12, abs=0)


def test_literal_reading_is_softer_by_the_ninth_root_of_a_thousand():
    assert force_at(3e-6) / force_at(3e-6, reading=LITERAL) == pytest.approx(2.15443469, rel=1e-8, abs=0)


@pytest.mark.parametrize("law", [LINE, LANKARANI])
def test_stiffness_is_the_force_at_1_mm(law):
    assert force_at(1e-3, law) == pytest.approx({LINE: 5.1e5, LANKARANI: 5.26e6}[law], rel=1e-12, abs=0)


@pytest.mark.parametrize("exponent", [1.0, EXPONENT, 1.5])
@pytest.mark.parametrize("penetration", [1e-8, 3e-6, 4e-5])
def test_tangent_stiffness_is_the_slope_of_the_force(penetration, exponent):
    step = 1e-4 * penetration
    above, below = (contact_force(penetration + s, 7e8, exponent)[0] for s in (step, -step))
    assert contact_force(penetration, 7e8, exponent)[1] == pytest.approx((above - below) / (2 * step), rel=1e-8, abs=0)


@pytest.mark.parametrize("penetration", [0.0, -1e-12, -1e-4])
def test_a_contact_never_pulls(penetration):
    assert contact_force(penetration, 7e8, EXPONENT) == (0.0, 0.0)


@pytest.mark.parametrize("line_load, curvature", [(3e4, 500.0), (1.3e5, 17.0), (10.0, 2e3)])
def test_hertz_against_johnson(line_load, curvature):
    """Johnson eq. 4.43 to 4.45: a^2 = 4 P R/(pi E*), p0^2 = P E*/(pi R), p0 = E* a/(2 R)."""
    half_width = hertz_half_width(line_load, curvature, MODULUS)
    peak = hertz_peak_pressure(line_load, curvature, MODULUS)
    assert half_width == pytest.approx(np.sqrt(4 * line_load / (np.pi * curvature * MODULUS)), rel=1e-14, abs=0)
    assert peak == pytest.approx(np.sqrt(line_load * MODULUS * curvature / np.pi), rel=1e-14, abs=0)
    assert peak == pytest.approx(0.5 * MODULUS * half_width * curvature, rel=1e-14, abs=0)
    # The semi-ellipse of pressure carries the load.
    carried = quad(lambda x: peak * np.sqrt(1 - (x / half_width) ** 2), -half_width, half_width)[0]
    assert carried == pytest.approx(line_load, rel=1e-7, abs=0)


def test_no_load_no_pressure():
    assert hertz_peak_pressure(0.0, 500.0, MODULUS) == 0.0
    assert hertz_peak_pressure(-1.0, 500.0, MODULUS) == 0.0


@pytest.mark.parametrize("modification", [{}, {"equidistant_modification": -13e-6, "shift_modification": -20e-6}])
def test_contact_pressure_of_the_plant_is_the_largest_of_all_pins(rv20e, modification):
    record = in_equilibrium(rv20e.plant, 0.05, **modification)
    twin = Twin(record, 0.05)
    # Curvature of the disc's flank from derivatives of its centre curve.
    curve = (twin.lobes, twin.circle, record.eccentricity)
    first, second = (centre_curve(record.mesh_phase, *curve, k) for k in (1, 2))
    radius_of_centre = abs(first) ** 3 / (first.conj() * second).imag
    equivalent = 1.0 / record.pin_radius + 1.0 / (radius_of_centre - twin.radius)
    pressure = np.sqrt(record.mesh_force_now / record.mesh_width * MODULUS * equivalent / np.pi)
    # The plant takes the curvature at the last iterate of the contact's phase, within 1e-5 rad.
    assert record.contact_pressure == pytest.approx(pressure.max(), rel=1e-6, abs=0)
    assert 0.5e9 < record.contact_pressure < 1.5e9


@pytest.mark.parametrize("name, mesh_force, roller_force", [("rv20e", 240.0, 650.0), ("bx40e", 420.0, 1150.0)])
def test_lankarani_stiffness_gives_the_penetration_of_the_line_law_at_typical_force(
    request, name, mesh_force, roller_force
):
    starts = request.getfixturevalue(name).starts
    for contact, force in (("mesh", mesh_force), ("roller", roller_force)):
        line = (force / starts[f"{contact}_stiffness"]) ** (1 / EXPONENT)
        lankarani = (force / starts[f"{contact}_stiffness_lankarani"]) ** (1 / 1.5)
        assert lankarani == pytest.approx(line, rel=5e-3, abs=0)
