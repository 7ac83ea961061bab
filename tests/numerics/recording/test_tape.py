"""Tapes: what they keep, share and leave out."""

import numpy as np

from assur.numerics.recording.tape import Recorder


def test_equal_operations_are_one_entry():
    recorder = Recorder()
    x, y = recorder.varying("x"), recorder.varying("y")
    tape = recorder.tape({"a": x * y + 1, "b": x * y - 1})
    assert [item.name for item in tape.operations] == ["varying", "varying", "*", "number", "+", "-"]


def test_what_the_outputs_do_not_need_is_left_out_but_what_is_given_stays():
    recorder = Recorder()
    x, y, p = recorder.varying("x"), recorder.varying("y"), recorder.uniform("p")
    assert (y / p).index == 3
    tape = recorder.tape({"a": x + x})
    assert [item.name for item in tape.operations] == ["varying", "varying", "uniform", "+"]
    assert tape.evaluate([1.5, np.nan], [np.nan]) == {"a": 3.0}


def test_nothing_is_reordered():
    recorder = Recorder()
    x = recorder.varying("x")
    tape = recorder.tape({"left": (x + 1e16) - 1e16, "right": x + (recorder.sqrt(1e32) - 1e16)})
    found = tape.evaluate([1.0], [])
    assert (found["left"], found["right"]) == (0.0, 1.0)


def test_every_operation_means_what_it_means_over_arrays():
    recorder = Recorder()
    x, p = recorder.varying("x"), recorder.uniform("p")
    tape = recorder.tape(
        {
            "sum": 1 + x,
            "less": 1 - x,
            "times": 2 * x,
            "over": 1 / x,
            "minus": -x,
            "size": abs(x),
            "root": recorder.sqrt(x),
            "there": (x >= p) & (x > -1),
        }
    )
    numbers = np.array([-2.0, 0.0, 3.0])
    found = tape.evaluate([numbers], [0.0])
    with np.errstate(divide="ignore"):
        wanted = [1 + numbers, 1 - numbers, 2 * numbers, 1 / numbers, -numbers, np.abs(numbers)]
    wanted += [np.sqrt([0.0, 0.0, 3.0]), [False, True, True]]
    for name, value in zip(found, wanted, strict=True):
        np.testing.assert_array_equal(found[name], value, err_msg=name)
    assert tape.logical == {"there"}
