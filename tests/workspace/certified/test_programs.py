"""Programs made ready: the same bounds with fewer operations, every radicand watched."""

from __future__ import annotations

import numpy as np

from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.recording.tape import Recorder
from assur.workspace.certified.programs import folded, with_radicands
from assur.workspace.certified.sloped import ClampedIntervals


def recorded():
    recorder = Recorder()
    x, p, q = recorder.varying("x"), recorder.uniform("p"), recorder.uniform("q")
    side = recorder.sqrt(3) * p / q
    return recorder.tape({"m": x * x - side, "f": recorder.sqrt(x * x - side) / (q - p * p) + recorder.sqrt(x + q)})


def test_a_folded_program_gives_the_same_bounds_with_fewer_operations():
    tape, numbers = recorded(), [as_interval(0.1), as_interval(7.0)]
    program, constants = folded(tape, numbers)
    assert len(program.operations) < len(tape.operations) - 3
    assert {item.name for item in program.operations} >= {"varying", "uniform", "root"}
    x = Interval.of(np.array([2.0, 1.0, -3.0]), np.array([2.5, 4.0, 1.0]))
    for name in ("m", "f"):
        one = tape.evaluate([x], numbers, ClampedIntervals())[name]
        two = program.evaluate([x], constants, ClampedIntervals())[name]
        np.testing.assert_array_equal(one.low, two.low)
        np.testing.assert_array_equal(one.high, two.high)


def test_radicands_that_are_no_margins_are_outputs_and_constant_ones_are_not():
    tape, added, roots = with_radicands(recorded(), ["m"])
    assert len(added) == 1
    assert roots == ("m", *added)
    found = tape.evaluate([2.0], [0.1, 7.0])
    np.testing.assert_allclose(float(found[added[0]]), 9.0)


def test_a_constant_that_is_negative_is_not_left_out():
    recorder = Recorder()
    x = recorder.varying("x")
    _, added, _ = with_radicands(recorder.tape({"f": x + recorder.sqrt(-2.0)}), [])
    assert len(added) == 1
