"""Loops at complex inputs: on the real line they are those of the joint graph, and tangents are differences."""

import numpy as np
import pytest

from assur.joint_graph.frames import frames, placed_links
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.state import state_of, values_of
from assur.kinematics.home import home_values
from assur.kinematics.monodromy.complex_loops import ComplexLoops
from assur.kinematics.monodromy.paths import followed
from assur.model.registry import load_record


@pytest.fixture(params=["planar_3rpr", "three_rps", "delta_4s"])
def loops(request):
    record = load_record(request.param)
    inputs = home_values(record)[list(record.input_indices)]
    rng = np.random.default_rng(3)
    return ComplexLoops(record, "direct", inputs, rng.normal(size=len(inputs)) + 1j * rng.normal(size=len(inputs)))


def home_state(loops):
    return state_of(loops.record, home_values(loops.record)[:, None]).astype(complex)


def test_home_is_closed(loops):
    assert np.max(np.abs(loops.step(home_state(loops), np.zeros(1, dtype=complex)))) < 1e-9


def test_inputs_are_those_that_are_asked_at_zero(loops):
    state = home_state(loops)
    assert np.allclose(loops.at(state, np.zeros(1, dtype=complex)), state, rtol=0, atol=1e-9)


def test_an_angle_goes_by_twice_the_arc_tangent():
    record = load_record("delta_4s")
    inputs = home_values(record)[list(record.input_indices)]
    loops = ComplexLoops(record, "direct", inputs, np.array([0.3, 0.5, -0.2], dtype=complex))
    moved = values_of(record, loops.at(home_state(loops), np.ones(1, dtype=complex)).real)[:, 0]
    expected = inputs + 2 * np.arctan([0.3, 0.5, -0.2])
    assert np.allclose(moved[list(record.input_indices)], expected, rtol=0, atol=1e-12)


def test_tangents_are_differences_of_assemblies(loops):
    state, zero = home_state(loops), np.zeros(1, dtype=complex)
    rates = loops.tangent(state, zero)
    step = 1e-5 + 1e-5j
    ends = followed(loops, state, zero, zero + step)
    assert ends.arrived.all()
    straight = loops.moved(state, state, step * rates)
    assert np.max(np.abs(loops.places(ends.state) - loops.places(straight))) < 1e-7


def test_places_are_frames_of_links(loops):
    record = loops.record
    placed, length = frames(record, home_values(record)), characteristic_length(record)
    numbers = loops.places(home_state(loops)).reshape(-1, 12)
    own = [np.concatenate([placed[link][0].ravel(), placed[link][1] / length]) for link in placed_links(record)]
    for row in numbers:
        assert np.min(np.max(np.abs(np.array(own) - row), axis=1)) < 1e-12
