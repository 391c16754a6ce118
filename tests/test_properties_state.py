"""States that are saved, sent and restored: the same bits, and the same bits ever after."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from properties import examples

from fmu_src.state import HEADER_SIZE, State, StateFault, pack, unpack
from orchestrator.component import InProcess

UNITS = ("rv_plant", "wear_fmu", "rv_reducer")
CRANK_TURN = 2.0 * np.pi / 67.5
# A communication step as a share of a crank turn, and what a master sets before it.
loads = st.floats(10.0, 200.0) | st.floats(-200.0, -10.0)
steps = st.lists(
    st.tuples(st.floats(0.001, 0.2), loads, st.floats(280.0, 340.0), st.floats(0.0, 300.0)), min_size=1, max_size=3
)  # fmt: skip


@pytest.fixture(scope="module", params=UNITS)
def unit(request, rv20e):
    """Makes initialised instances of a unit with friction, an effect that has states."""
    def new():
        component = InProcess(request.param, rv20e.specification(request.param))
        if component.has("friction_coefficient"):
            component.set("friction_coefficient", 0.02)
        component.enter_initialisation(0.0)
        component.exit_initialisation()
        return component

    return new


def drive(component, moves, time=0.0):
    """Steps the unit; loads and motion are inputs, what there is of them."""
    for share, load, temperature, force in moves:
        duration = share * CRANK_TURN
        settings = {
            "load_torque": load, "temperature": temperature, "mesh_force": force, "roller_force": 0.5 * force,
            "crank_angle": -67.5 * (time + duration), "cage_angle": -20.0 * (time + duration), "acceleration": 1e6,
        }  # fmt: skip
        for name, value in settings.items():
            if name in component.signals and component.signals[name].causality in ("input", "parameter"):
                component.set(name, value)
        component.step(time, duration)
        time += duration
    return time


@given(steps, steps, steps)
def test_a_restored_unit_goes_on_as_if_nothing_had_been(unit, before, after, astray):
    component = unit()
    time = drive(component, before)
    saved, snapshot = component.save(), component.snapshot()
    drive(component, after, time)
    expected = component.save()
    component.restore(saved)
    assert component.save() == saved
    drive(component, after, time)
    assert component.save() == expected
    # After another way, by the other call, and in another instance.
    component.revert(snapshot)
    drive(component, astray, time)
    component.revert(snapshot)
    other = unit()
    other.restore(saved)
    for instance in (component, other):
        drive(instance, after, time)
        assert instance.save() == expected


cells = st.lists(st.binary(min_size=8, max_size=8), min_size=1, max_size=40).map(lambda words: np.frombuffer(b"".join(words), "f8"))
identities = st.text("0123456789abcdef-{}", min_size=1, max_size=38)
times = st.floats(allow_nan=False)


@examples(8)
@given(identities, cells, st.integers(0, 3), times)
def test_a_packed_state_is_the_same_unpacked(identity, values, phase, time):
    block = pack(identity, State(values, phase, time))
    state = unpack(identity, block, len(values))
    assert (state.cells.tobytes(), state.phase, state.time) == (values.tobytes(), phase, time)
    assert pack(identity, state) == block and len(block) == HEADER_SIZE + 8 * len(values)


@examples(8)
@given(identities, cells, st.integers(0, 3), times, st.data())
def test_a_damaged_state_is_refused(identity, values, phase, time, data):
    block = pack(identity, State(values, phase, time))
    place, bit = data.draw(st.integers(0, len(block) - 1)), data.draw(st.integers(0, 7))
    flipped = bytearray(block)
    flipped[place] ^= 1 << bit
    cut = data.draw(st.integers(0, len(block) - 1))
    # Two words that changed places leave their plain sum as it is.
    swapped = block[:HEADER_SIZE] + np.roll(values.view("u8"), 1).tobytes()
    for damaged in (bytes(flipped), block[:cut], block + block[cut:], *([swapped] if swapped != block else [])):
        with pytest.raises(StateFault):
            unpack(identity, damaged, len(values))
    with pytest.raises(StateFault):
        unpack(identity + "0", block, len(values))
    with pytest.raises(StateFault):
        unpack(identity, block, len(values) + 1)
