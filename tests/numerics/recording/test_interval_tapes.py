"""Tapes made ready: the same bounds with fewer operations, slopes and derivatives as step by step."""

import numpy as np
import pytest

from assur.numerics.dual import Dual, DualIntervals
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.rates import ClampedIntervals
from assur.numerics.intervals.sloped import SlopedNumbers, coordinate
from assur.numerics.recording.interval_program import IntervalProgram
from assur.numerics.recording.interval_tapes import folded, sloped_program, with_derivatives
from assur.numerics.recording.tape import Recorder


def recorded():
    recorder = Recorder()
    x, p, q = recorder.varying("x"), recorder.uniform("p"), recorder.uniform("q")
    side = recorder.sqrt(3) * p / q
    return recorder.tape({"m": x * x - side, "f": recorder.sqrt(x * x - side) / (q - p * p) + recorder.sqrt(x + q)})


def test_a_folded_program_gives_the_same_bounds_with_fewer_operations():
    tape, numbers = recorded(), [as_interval(0.1), as_interval(7.0)]
    program, constants = folded(tape).varying, folded(tape).numbers(numbers)
    assert len(program.operations) < len(tape.operations) - 3
    assert {item.name for item in program.operations} >= {"varying", "uniform", "root"}
    x = Interval.of(np.array([2.0, 1.0, -3.0]), np.array([2.5, 4.0, 1.0]))
    for name in ("m", "f"):
        one = tape.evaluate([x], numbers, ClampedIntervals())[name]
        two = program.evaluate([x], constants, ClampedIntervals())[name]
        np.testing.assert_array_equal(one.low, two.low)
        np.testing.assert_array_equal(one.high, two.high)


def test_the_program_over_slopes_does_what_sloped_numbers_do():
    """Recorded and read from intervals, or step by step: the same enclosures, roots and magnitudes too."""
    parts = folded(recorded())
    tape, constants = parts.varying, parts.numbers([as_interval(0.1), as_interval(7.0)])
    x = Interval.of(np.array([2.0, 1.0, -3.0]), np.array([2.5, 4.0, 1.0]))
    numbers = [coordinate(x, x.middle, 0, 1)]
    step_by_step = tape.evaluate(numbers, constants, SlopedNumbers())
    found = sloped_program(tape, numbers, 1)(numbers, constants)
    for name, number in step_by_step.items():
        for one, two in zip(parts_of(number), parts_of(found[name]), strict=True):
            np.testing.assert_array_equal(one.low, two.low)
            np.testing.assert_array_equal(one.high, two.high)


def test_an_output_that_is_a_plain_number_is_enclosed_without_slopes():
    recorder, x = Recorder(), Interval.of(np.array([2.0]), np.array([2.5]))
    recorder.varying("x")
    numbers = [coordinate(x, x.middle, 0, 1)]
    found = sloped_program(folded(recorder.tape({"one": 1.0})).varying, numbers, 1)(numbers, [])["one"]
    assert (found.whole.low, found.whole.high, found.centre.low, found.slopes) == (1.0, 1.0, 1.0, (None,))


def parts_of(number):
    if isinstance(number, Interval):
        return [number]
    return [number.centre, number.whole, *(slope for slope in number.slopes if slope is not None)]


@pytest.mark.parametrize("engine", ["numpy", "compiled"])
def test_derivatives_are_those_of_dual_numbers(engine):
    recorder = Recorder()
    x, y, c, s = (recorder.varying(name) for name in ("x", "y", "cos t", "sin t"))
    kernel = {"f": recorder.sqrt(x * x + y) * c - x / (2 + s * y), "g": abs(x) * 3, "h": s * s + c}
    tape = with_derivatives(recorder.tape(kernel), {"t": ("cos t", "sin t")}, ["x", "y", "t"])
    assert "dg/dy" not in tape.outputs
    low = np.array([[1.0, -2.0, -1.0], [0.5, 0.0, -0.5], [0.6, 0.1, -1.0], [0.0, 0.2, 0.3]])
    numbers = [Interval.of(row, row + 0.25) for row in low]
    found = IntervalProgram(tape)(numbers, [as_interval(1.0)], engine)
    rates = {"x": [1.0, 0.0, 0.0, 0.0], "y": [0.0, 1.0, 0.0, 0.0], "t": [0.0, 0.0, -numbers[3], numbers[2]]}
    for name, own in rates.items():
        duals = [Dual(value, as_interval(rate)) for value, rate in zip(numbers, own, strict=True)]
        expected = recorder.tape(kernel).evaluate(duals, [], DualIntervals())
        for output in kernel:
            rate = found.get(f"d{output}/d{name}", as_interval(np.zeros(3)))
            known = as_interval(expected[output].derivative)
            np.testing.assert_allclose(rate.low, np.broadcast_to(known.low, 3), rtol=1e-12, atol=1e-12)
            np.testing.assert_allclose(rate.high, np.broadcast_to(known.high, 3), rtol=1e-12, atol=1e-12)
            defined = np.broadcast_to(known.defined, 3)
            np.testing.assert_array_equal(rate.defined, defined)


def test_the_derivative_of_a_root_is_not_defined_where_the_radicand_may_be_negative():
    recorder = Recorder()
    tape = with_derivatives(recorder.tape({"f": recorder.sqrt(recorder.varying("x"))}), {}, ["x"])
    found = IntervalProgram(tape)([Interval.of([-1.0, 0.0, 1.0], [1.0, 1.0, 2.0])], [as_interval(1.0)])
    assert found["df/dx"].defined.tolist() == [False, False, True]
