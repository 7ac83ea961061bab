"""Straight lines over arrays: machine code has the bits of NumPy, whatever is asked of a tape."""

import numpy as np
import pytest

from assur.joint_graph.programs import program
from assur.kinematics.closure import closing_numbers
from assur.model.registry import load_record
from assur.numerics.recording.levels import levels
from assur.numerics.recording.straight_line import AT_ONCE, REPAID, WIDE, _Done, straight_line
from assur.numerics.recording.tape import Recorder


@pytest.fixture(scope="module")
def line():
    """Every operation, an output that is a given number, one that is a uniform one, one that is written, two alike."""
    recorder = Recorder()
    x, y, p = recorder.varying("x"), recorder.varying("y"), recorder.uniform("p")
    total = x * 2 + y / p - x * y
    outputs = {"t": total, "r": recorder.sqrt(total), "x": x, "p": p, "n": -y, "two": recorder.number(2.0), "u": total}
    return straight_line(recorder.tape(outputs))


@pytest.mark.parametrize("count", [1, AT_ONCE, AT_ONCE + 3])
def test_machine_code_has_the_bits_of_numpy(line, count):
    given = np.random.default_rng(0).normal(size=(2, count))
    given[:, 0] = [np.nan, np.inf]
    expected, found = np.zeros((9, count)), np.zeros((9, count))
    rows = [8, 0, 1, 2, 4, 5, 6]
    with np.errstate(all="ignore"):
        for row, numbers in zip(rows, line._run(list(given), [0.0], np.vectorize(root)), strict=True):
            expected[row] = numbers
    line.fill_by_code(found, rows, given, [0.0])
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("count", [1, 5, WIDE - 1, WIDE])
def test_levels_and_pythons_floats_have_the_bits_of_numpy(line, count):
    given = np.random.default_rng(0).normal(size=(2, count))
    given[0, 0], rows = -1e-300, [8, 0, 1, 2, 4, 5, 6]
    expected, found = np.zeros((9, count)), np.zeros((9, count))
    for row, numbers in zip(rows, line._run(list(given), [0.7], np.vectorize(root)), strict=True):
        expected[row] = numbers
    np.testing.assert_array_equal(line.levels.outputs_of(given, [0.7]), expected[rows])
    line.fill(found, rows, given, [0.7])
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("name", ["zeng2019", "h4_robot"])
def test_operations_of_one_level_are_few_and_need_none_of_their_own(name):
    tape = program(load_record(name), closing_numbers).line.tape
    own = levels(tape)
    assert 20 * len(own.steps) < len(tape.operations) or name == "zeng2019"
    assert all(np.max(np.frombuffer(rows, dtype=np.intp)) < first for _, first, _, rows in own.steps)
    assert sum(last - first for _, first, last, _ in own.steps) + own.steps[0][1] == own.size == len(tape.operations)


def root(number):
    return np.nan if np.isnan(number) else np.sqrt(max(number, 0.0))


def test_machine_code_is_loaded_once_as_much_was_done_without_it():
    done = _Done()
    assert not done.repaid(REPAID - 1)
    assert done.repaid(1) == done.compilable
