"""Radicands: every one is watched that may be negative."""

import numpy as np

from assur.numerics.recording.tape import Recorder
from assur.workspace.certified.programs import with_radicands


def recorded():
    recorder = Recorder()
    x, p, q = recorder.varying("x"), recorder.uniform("p"), recorder.uniform("q")
    side = recorder.sqrt(3) * p / q
    return recorder.tape({"m": x * x - side, "f": recorder.sqrt(x * x - side) / (q - p * p) + recorder.sqrt(x + q)})


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
