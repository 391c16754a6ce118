"""Conversion of units, and settings with units: there and back, by whatever way."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from properties import examples

from fmu_src.faults import InputFault
from fmu_src.units import FMI_BASE, BaseUnit, UnitError, conversion, fmi_base_unit, parse
from fmu_src.variables import Variable
from orchestrator.settings import parse_setting, parse_value

# Units of one kind each.
KINDS = {
    "length": ("m", "mm", "um", "km", "inch"),
    "angle": ("rad", "deg", "arcsec", "arcmin", "mrad"),
    "temperature": ("K", "degC", "degF"),
    "torque": ("N.m", "N.mm", "kN.m", "lbf.inch"),
    "pressure": ("Pa", "MPa", "N/mm^2", "bar"),
    "per pressure": ("1/Pa", "1/GPa"),
    "speed": ("rad/s", "rpm", "deg/s"),
    "time": ("s", "ms", "hour", "day"),
    "compliance": ("m/N", "um/kN"),
    "volume": ("m^3", "mm^3"),
    "number": ("1",),
}  # fmt: skip

kinds = st.sampled_from(sorted(KINDS))
of_one_kind = kinds.flatmap(lambda kind: st.tuples(*[st.sampled_from(KINDS[kind])] * 3))
# Numbers too small for all their digits lose some on the way.
numbers = st.just(0.0) | st.floats(1e-12, 1e6) | st.floats(-1e6, -1e-12)


def converted(value, source, target):
    factor, offset = conversion(source, target)
    return factor * value + offset


def near(value, *others):
    """Rounding of what is added on the way, absolute zero above all."""
    return pytest.approx(value, rel=1e-11, abs=1e-11 * max((abs(other) for other in others), default=0.0))


@examples(4)
@given(of_one_kind, numbers)
def test_there_and_back_is_the_same(units, value):
    first, second, _ = units
    between = converted(value, first, second)
    assert converted(between, second, first) == near(value, *converted_zeros(units))


@examples(4)
@given(of_one_kind, numbers)
def test_the_way_makes_no_difference(units, value):
    first, second, third = units
    by_way = converted(converted(value, first, second), second, third)
    assert by_way == near(converted(value, first, third), *converted_zeros(units))


def converted_zeros(units):
    return [converted(0.0, a, b) for a in units for b in units]


@given(kinds, kinds, st.data())
def test_units_of_other_kinds_are_refused(kind, other, data):
    # pint's angles are numbers.
    assume(len({kind, other} - {"angle", "number"}) + bool({kind, other} & {"angle", "number"}) == 2)
    source, target = (data.draw(st.sampled_from(KINDS[k])) for k in (kind, other))
    with pytest.raises(UnitError, match="does not fit"):
        conversion(source, target)


@examples(4)
@given(of_one_kind, numbers)
def test_definitions_in_si_convert_as_the_units_do(units, value):
    source, target, _ = units
    factor, offset = definition(source).conversion(definition(target))
    assert factor * value + offset == near(converted(value, source, target), *converted_zeros(units))


def definition(unit):
    base = fmi_base_unit(unit)
    exponents = tuple(base.get(name, 0) for name in FMI_BASE)
    return BaseUnit(exponents, base.get("factor", 1.0), base.get("offset", 0.0))


@given(st.text(max_size=12))
def test_any_text_is_a_unit_or_a_unit_error(text):
    try:
        parse(text)
    except UnitError as problem:
        assert repr(text) in str(problem)


# Texts of a number as people write them.
written = st.sampled_from((repr, "{:.17g}".format, "{:+.17e}".format, "{:.17E}".format, str))


@examples(4)
@given(st.floats(allow_nan=False, allow_infinity=False), written)
def test_a_written_number_is_read_to_the_last_bit(value, write):
    variable = Variable("x", "parameter", "m", "")
    assert parse_value(write(value), variable) == value


@examples(4)
@given(of_one_kind, numbers, st.sampled_from(("", " ", "  ")))
def test_a_number_with_a_unit_is_read_in_that_of_the_variable(units, value, space):
    unit, own, _ = units
    # A unit that begins with a figure stands apart.
    assume(unit != "1" and (space or not unit[0].isdigit()))
    variable = Variable("x", "parameter", own, "")
    assert parse_value(f"{value!r}{space}{unit}", variable) == converted(value, unit, own)


@given(st.data())
def test_a_setting_written_down_is_read_as_it_was(rv20e, data):
    tables = [rv20e.plant, rv20e.wear]
    table = data.draw(st.sampled_from(tables))
    variable = data.draw(st.sampled_from(table.of_role("parameter", "input")))
    name = data.draw(st.sampled_from(sorted(variable.element_names())[:7])) if variable.shape else variable.path
    if variable.choices:
        expected = data.draw(st.integers(0, len(variable.choices) - 1))
        text = variable.choices[expected]
    elif variable.is_integer:
        expected = data.draw(st.integers(math.ceil(variable.minimum), math.floor(min(variable.maximum, 2**53))))
        text = str(expected)
    else:
        expected = data.draw(st.floats(variable.minimum, variable.maximum))
        # With its unit: without, a length or a speed that no reducer has is asked for it.
        text = repr(expected) if variable.unit == "1" else f"{expected!r} {variable.unit}"
    owners = [t.by_name[variable.name] for t in tables if variable.path in t.by_path]
    assume(all(v.minimum <= expected <= v.maximum for v in owners))
    setting = parse_setting(f" {name} = {text} ", tables)
    assert (setting.name, setting.value) == (variable.name + name[len(variable.path) :], expected)
    assert type(setting.value) is (int if variable.is_integer else float)


@given(st.text(max_size=30))
def test_any_text_is_a_setting_or_bad_input_that_names_it(rv20e, text):
    try:
        parse_setting(text, [rv20e.plant, rv20e.wear])
    except InputFault as fault:
        assert repr(text) in str(fault)
