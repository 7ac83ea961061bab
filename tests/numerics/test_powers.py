"""Whole powers over every number type."""

import numpy as np
import pytest

from assur.numerics.dual import Dual
from assur.numerics.expanded import unknowns
from assur.numerics.intervals.interval import as_interval
from assur.numerics.powers import LARGEST, whole_power
from assur.numerics.recording.tape import Recorder


@pytest.mark.parametrize("exponent", range(-LARGEST, LARGEST + 1))
def test_a_power_of_a_float(exponent):
    assert whole_power(1.5, exponent) == pytest.approx(1.5**exponent, rel=1e-14)
    assert whole_power(np.array([1.5, -2.0]), exponent) == pytest.approx(np.array([1.5, -2.0]) ** exponent, rel=1e-14)


@pytest.mark.parametrize("exponent", [2, 3, 7, -2])
def test_a_power_in_every_number_type(exponent):
    assert (as_interval(1.5) ** exponent).contains(1.5**exponent)
    recorder = Recorder()
    tape = recorder.tape({"y": recorder.varying("x") ** exponent})
    assert tape.evaluate([1.5], [])["y"] == pytest.approx(1.5**exponent)
    dual = Dual(1.5, 1.0) ** exponent
    assert (dual.value, dual.derivative) == pytest.approx((1.5**exponent, exponent * 1.5 ** (exponent - 1)))


def test_a_power_of_a_polynomial():
    (t,) = unknowns(1)
    assert ((t + 1) ** 3).terms == {(3,): 1, (2,): 3, (1,): 3, (0,): 1}


@pytest.mark.parametrize("exponent", [0.5, LARGEST + 1, -LARGEST - 1, True, None, 2.0])
def test_what_is_no_small_whole_power_is_refused(exponent):
    with pytest.raises(TypeError, match="whole number"):
        whole_power(1.5, exponent)
    with pytest.raises(TypeError):
        as_interval(1.5) ** exponent
