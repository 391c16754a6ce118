"""Parts out of place in the drawing of a reducer: which, where, how many times enlarged, and what is not drawn."""

from dataclasses import replace

import numpy as np
import pytest

from reducers.reducer import load_reducer
from studies.report.assembly import assembly, outline, parts_off, zoom

UM = 1e-6


def drawn(**numbers: float):
    """RV20E-121 with numbers of effects [SI]."""
    reducer = load_reducer("RV20E-121")
    return replace(reducer, starts=reducer.starts | numbers)


def off_by(reducer) -> dict[str, list]:
    """How far parts are off [um], by kind."""
    return {parts.what: [1e3 * by for by in parts.by] for parts in parts_off(reducer)}


def middle(trace) -> complex:
    """Of a circle's points, its last one being its first and a gap behind it."""
    x, y = (np.array(trace[axis][:-2], float) for axis in "xy")
    return complex(x.mean(), y.mean())


def test_a_displaced_hole_is_drawn_out_of_place_with_the_factor_beside_the_picture():
    """It was nowhere in the picture of a model that had nothing else."""
    reducer = drawn(disc_hole_shift_2=6 * UM, disc_hole_disc=2, needle_clearance_added=2 * UM)
    assert list(off_by(reducer)) == ["holes of disc 2"]
    figure = assembly(reducer, None)
    ideal, moved = [trace for trace in figure.data if trace["line"]["color"] == "#a3195b"]
    assert moved["name"] == "holes of disc 2, up to 6.00 µm (drawn 200 times)" and moved["showlegend"] and not ideal["showlegend"]
    # The second crank stands at half a turn: along its circle, counter-clockwise, is downwards there.
    assert middle(moved) - middle(ideal) == pytest.approx(-1j * 200 * 6e-3, abs=1e-3)
    assert "Errors are drawn 200 times, in red beside the ideal part: holes of disc 2, up to 6.00 µm." in figure.caption
    assert figure.caption.endswith("Not drawn: needle clearance (added).") and "drawn 200 times" in zoom(figure, reducer).caption


def test_lobes_teeth_seats_and_pins_are_off_by_what_their_effects_say():
    lobes = off_by(drawn(lobe_throw_error_1=5 * UM, lobe_phase_error_2=1e-3))["eccentrics of the cranks at disc 1"]
    assert [by[0] for by in lobes] == pytest.approx([5.0, 0.9j], abs=1e-3)
    (seat,) = off_by(drawn(carrier_seat_shift=3 * UM, carrier_seat_crank=2))["seats of the cranks in the carrier"]
    assert seat[0] == pytest.approx(-3j)
    ring = off_by(drawn(pin_ring_ovality=4 * UM))["pins"]
    # Longer along x, shorter along y; the four between them stand where they should.
    assert len(ring) == 36 and ring[0][0] == pytest.approx(4.0) and ring[9][0] == pytest.approx(-4j)
    (proud,) = off_by(drawn(proud_pin=3 * UM, proud_pin_number=1))["pins"]
    assert np.abs(proud) == pytest.approx(3.0)
    reducer = drawn(disc_runout=5 * UM)
    (teeth,) = off_by(reducer)["teeth of disc 1"]
    contour = outline(reducer, 0) - 0.9
    # Material is missing on the side to which the run-out points: off centre the other way.
    side = teeth[:-1] * np.conj(contour / np.abs(contour))
    assert side.real == pytest.approx(-5.0 * np.cos(np.angle(contour)), abs=0.5) and side.imag == pytest.approx(0.0, abs=1e-9)


def test_errors_that_a_file_states_are_drawn_and_a_part_of_an_effect_that_is_not_is_named():
    stated = load_reducer("RV20E-121")
    assert list(off_by(replace(stated, starts=stated.starts | {"disc_hole_error_radial[1,2]": 2 * UM}))) == ["holes of disc 1"]
    caption = assembly(drawn(disc_gap_difference=4 * UM, disc_offset_x=3 * UM), None).caption
    assert "teeth of disc 1, up to 2.00 µm; teeth of disc 2, up to 2.00 µm." in caption and caption.endswith("Not drawn: unequal discs (disc offset x).")
    figure = assembly(stated, None)
    assert not parts_off(stated) and "Errors" not in figure.caption and "Not drawn" not in figure.caption


def test_a_pin_that_was_fitted_is_drawn_as_one_and_the_force_beside_it_is_that_of_one_angle():
    """At 19.002 pin 20 stood in red, too, and 19 with 6.00 um of 6.012."""
    reducer = drawn(proud_pin=6.01179 * UM, proud_pin_number=19.00239)
    (pin,) = off_by(reducer)["pins"]
    assert np.abs(pin) == pytest.approx(6.01179)
    # Between two it is both that the model has.
    assert len(off_by(drawn(proud_pin=6 * UM, proud_pin_number=19.4))["pins"]) == 2
    # 773 N beside 1,260 N of solve.
    caption = zoom(assembly(reducer, None), reducer).caption
    assert caption.startswith("At crank angle 0 the most loaded pin of disc 1 carries 773 N and ")
    assert "pins touch it; over a turn of the cranks it may be more: rvwear solve has the largest." in caption
