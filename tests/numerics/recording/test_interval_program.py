"""Interval programs: machine code and NumPy give the same bits, at ends that are zero, infinite, huge and tiny too."""

import numpy as np
import pytest

from assur.errors import UsageError
from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.recording import interval_code, interval_program
from assur.numerics.recording.interval_program import AT_ONCE, IntervalProgram
from assur.numerics.recording.tape import Recorder

ENDS = np.array([-np.inf, -1.7e308, -3.5, -1.0, -1e-200, -5e-324, 0.0, 5e-324, 1e-200, 0.1, 1.0, 7.0, 1.7e308, np.inf])


def every_pair():
    """Two lists of intervals with all pairs of ends, zero widths and whole lines among them, and every pair of both."""
    low, high = (part.ravel() for part in np.meshgrid(ENDS, ENDS))
    fit = (low <= high) & (low < np.inf) & (high > -np.inf)
    low, high = low[fit], high[fit]
    one, two = (part.ravel() for part in np.meshgrid(np.arange(len(low)), np.arange(len(low))))
    return Interval.of(low[one], high[one]), Interval.of(low[two], high[two])


def assert_same(found, expected, count):
    for part in ("low", "high"):
        one, two = (getattr(item, part) for item in (found, expected))
        assert one.shape == two.shape == (count,)
        bits = [np.ascontiguousarray(item).view(np.int64) for item in (one, two)]
        np.testing.assert_array_equal(bits[0][one != 0], bits[1][one != 0])
        assert np.all((one != 0) | (two == 0))
    np.testing.assert_array_equal(found.defined, expected.defined)


def both(program, varying, uniform=()):
    count = max(len(item.low) for item in varying if item.low.ndim)
    code, numpy = (program(varying, uniform, engine) for engine in ("compiled", "numpy"))
    assert list(code) == list(numpy)
    for name in code:
        assert_same(code[name], numpy[name], count)
    return code


def program_of(*names, clamped=False):
    recorder = Recorder()
    x, y = recorder.varying("x"), recorder.varying("y")
    return IntervalProgram(recorder.tape({name: OPERATIONS[name](recorder, x, y) for name in names}), clamped)


OPERATIONS = {
    "+": lambda _, x, y: x + y,
    "-": lambda _, x, y: x - y,
    "*": lambda _, x, y: x * y,
    "/": lambda _, x, y: x / y,
    "square": lambda _, x, *__: x * x,
    "negative": lambda _, x, *__: -x,
    "magnitude": lambda _, x, *__: abs(x),
    "root": lambda recorder, x, *_: recorder.sqrt(x),
    "sign rate": lambda recorder, x, *_: recorder.apply("sign rate", x),
    "root rate": lambda recorder, x, y: recorder.apply("root rate", x, y),
    "number": lambda _, x, y: 2 - 3 * x / 0.1 + 0 * y + 1 / y,
}


@pytest.mark.parametrize("clamped", [False, True])
@pytest.mark.parametrize("name", OPERATIONS)
def test_every_operation_has_the_bits_of_numpy(name, clamped):
    both(program_of(name, clamped=clamped), every_pair())


def test_the_operations_one_after_the_other_have_them_too():
    """Bounds that operations leave, not only those that somebody writes."""
    recorder = Recorder()
    x, y = recorder.varying("x"), recorder.varying("y")
    root = recorder.sqrt(x * x - y / 3)
    kernel = (root + abs(x - y)) / (y - x * root) - (-y) * (x / (1 + y * y))
    found = both(IntervalProgram(recorder.tape({"f": kernel, "g": root, "h": kernel * kernel})), every_pair())
    assert 0 < np.sum(found["f"].defined) < len(found["f"].low)


def test_what_is_not_defined_stays_so():
    x, y = every_pair()
    odd = Interval(x.low, x.high, np.arange(len(x.low)) % 3 > 0)
    found = both(program_of(*OPERATIONS), (odd, y))
    for name, answer in found.items():
        assert not np.any(answer.defined & ~odd.defined), name


@pytest.mark.parametrize("count", [1, AT_ONCE - 1, AT_ONCE, AT_ONCE + 1, 1000])
def test_any_number_of_elements(count):
    rng = np.random.default_rng(count)
    low = rng.normal(size=(2, count))
    both(program_of(*OPERATIONS), [Interval.of(row, row + rng.random(count)) for row in low])


def test_exact_zeros_among_what_is_given_make_exact_zeros():
    """An exact zero is one object for both bounds; times no bound it is zero, and an interval [0, 0] makes 2^-960."""
    recorder = Recorder()
    x, y, p = recorder.varying("x"), recorder.varying("y"), recorder.uniform("p")
    program = IntervalProgram(recorder.tape({"xy": x * y, "yx": y * x, "xp": x * p, "px": p * x, "0": x * 0}))
    whole = Interval.of([-np.inf, 1.0, 2.0], [np.inf, 2.0, 3.0])
    for exact in (as_interval(np.array([0.0, 0.0, 1.0])), Interval.of([0.0, 0.0, 1.0], np.array([0.0, 0.0, 2.0]))):
        for number in (as_interval(0.0), Interval.of(0.0, np.float64(0.0)), as_interval(2.0)):
            both(program, [whole, exact], [number])


def test_numbers_that_are_the_same_for_all_may_be_given_as_varying():
    x, _ = every_pair()
    both(program_of(*OPERATIONS), [x, Interval.of(-0.5, 2.0)])
    both(program_of(*OPERATIONS), [as_interval(3.0), x])


def test_an_output_may_be_what_is_given_and_two_may_be_one():
    recorder = Recorder()
    x, p = recorder.varying("x"), recorder.uniform("p")
    program = IntervalProgram(recorder.tape({"x": x, "p": p, "2": 2.0, "a": x + p, "b": x + p}))
    found = both(program, [Interval.of([1.0, 2.0], [3.0, 4.0])], [Interval.of(-1.0, 1.0)])
    assert (found["p"].high.tolist(), found["2"].low.tolist()) == ([1.0, 1.0], [2.0, 2.0])


@pytest.mark.parametrize("engine", ["compiled", "numpy"])
def test_where_nothing_given_is_an_array_nothing_found_is(engine):
    found = program_of("+", "number")([Interval.of(1.0), Interval.of(2.0)], [], engine)
    assert {item.shape for item in found.values()} == {()}


def test_a_processor_that_rounds_otherwise_is_refused(monkeypatch):
    def refuse():
        raise UsageError("not to nearest")

    x, y = every_pair()
    program = program_of("+")
    monkeypatch.setattr(rounding, "check_nearest", refuse)
    monkeypatch.setattr(interval_code, "run", lambda *_: pytest.fail("computed all the same"))
    with pytest.raises(UsageError, match="nearest"):
        program([x, y], [], "compiled")


def test_the_code_is_loaded_once_it_is_repaid(monkeypatch):
    calls = []
    monkeypatch.setattr(interval_program, "REPAID", 10_000)
    monkeypatch.setattr(interval_program, "_DONE", interval_program._Done())
    monkeypatch.setattr(IntervalProgram, "_by_code", lambda *_: calls.append(1) or {})
    program, x = program_of("+"), Interval.of([0.0, 1.0])
    for _ in range(12):
        program([x, x], [])
    assert 0 < len(calls) < 12
    monkeypatch.setattr(interval_program, "_DONE", interval_program._Done(compilable=False))
    calls.clear()
    for _ in range(12):
        program([x, x], [])
    assert calls == []
