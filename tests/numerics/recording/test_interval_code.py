"""The interpreter's own steps: in the order of the program's names, and a program that uses its places again."""

from __future__ import annotations

import numpy as np

from assur.numerics.intervals.interval import Interval
from assur.numerics.recording import interval_code
from assur.numerics.recording.interval_program import STEPS, IntervalProgram, _planned
from assur.numerics.recording.tape import Recorder

NAMES = {"varying": "_VARYING", "store": "_STORE", "+": "_PLUS", "-": "_MINUS", "*": "_TIMES", "/": "_OVER"}


def test_steps_have_the_numbers_of_their_names():
    for number, name in enumerate(STEPS):
        own = NAMES.get(name, "_" + name.upper().replace(" ", "_"))
        assert getattr(interval_code, own) == number


def test_a_long_program_needs_few_places():
    recorder = Recorder()
    x, y = recorder.varying("x"), recorder.varying("y")
    total = x
    for _ in range(300):
        total = recorder.sqrt(total * total + y)
    tape = recorder.tape({"f": total, "x": x})
    assert _planned(tape).places < 8 < len(_planned(tape).steps)
    numbers = [Interval.of([0.1, -2.0], [0.2, 1.0]), Interval.of([0.0, -1.0], [1.0, 3.0])]
    one, two = (IntervalProgram(tape)(numbers, [], engine)["f"] for engine in ("compiled", "numpy"))
    np.testing.assert_array_equal(one.low, two.low)
    np.testing.assert_array_equal(one.high, two.high)
