"""Paths of complex inputs: there and back is where they began; round a place where two meet, they change places."""

from itertools import pairwise

import numpy as np

from assur.joint_graph.state import state_of
from assur.kinematics.home import home_values
from assur.kinematics.loops.loops import solve_by_loops
from assur.kinematics.monodromy.complex_loops import ComplexLoops
from assur.kinematics.monodromy.paths import followed
from assur.model.registry import load_record


def test_there_and_back():
    record = load_record("planar_3rrr")
    inputs = home_values(record)[list(record.input_indices)] + np.array([0.05, -0.02, 0.03])
    joints = solve_by_loops(record, inputs).joints
    loops = ComplexLoops(record, "direct", inputs, np.array([0.3 + 0.2j, -0.4j, 0.5]))
    state = state_of(record, joints.T).astype(complex)
    near, far = np.zeros(len(joints), dtype=complex), np.full(len(joints), 0.4 + 0.5j)
    ends = followed(loops, state, near, far)
    assert ends.arrived.all()
    assert np.max(np.abs(loops.step(ends.state, far))) < 1e-9
    assert np.min(np.max(np.abs(loops.places(ends.state) - loops.places(state)), axis=1)) > 1e-3
    back = followed(loops, ends.state, far, near)
    assert np.max(np.abs(back.state - state)) < 1e-7


def test_round_the_place_where_they_meet_two_assemblies_change_places():
    """Of a five-bar, whose rods are in one line there; on the way to it one assembly is real, beyond it none."""
    record = load_record("fivebar", l2=100.0)
    inputs = home_values(record)[list(record.input_indices)]

    def solvable(t):
        return len(solve_by_loops(record, inputs + 2 * np.arctan(t * np.array([1.0, -1.0]))).joints) > 0

    low, high = 0.0, next(t for t in np.linspace(0.0, 3.0, 61) if not solvable(t))
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if solvable(middle) else (low, middle)
    joints = solve_by_loops(record, inputs).joints
    loops = ComplexLoops(record, "direct", inputs, np.array([1.0, -1.0], dtype=complex))
    begun = state_of(record, joints.T).astype(complex)
    state, zero = begun, np.zeros(2, dtype=complex)
    corners = [zero, zero + low + 0.1j, zero + low + 0.1, zero + low - 0.1j, zero]
    for start, end in pairwise(corners):
        ends = followed(loops, state, start, end)
        assert ends.arrived.all()
        state = ends.state
    assert np.allclose(state, begun[:, ::-1], rtol=0, atol=1e-6)
    assert not np.allclose(state, begun, rtol=0, atol=1e-2)
