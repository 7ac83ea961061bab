"""Recorded legs say what legs say, by machine code and by NumPy, about boxes of any size."""

import numpy as np
import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.certified.boxes import direct_by_boxes
from assur.kinematics.certified.domain import pose_box
from assur.kinematics.certified.legs import Legs
from assur.kinematics.certified.recorded_legs import RecordedLegs
from assur.model.pose import has_quaternion
from assur.model.registry import names
from assur.numerics.branch_and_prune import Existing
from assur.numerics.dual import DualIntervals
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.shapes import broadcast
from assur.numerics.krawczyk import derivative, parts
from assur.numerics.number_types import Intervals
from assur.numerics.recording import interval_program
from catalogue import each

BY_LEGS = [name for name in names() if not has_quaternion(assur.load(name).platform.pose)]


def problem(name):
    """Legs at home, and boxes about poses of all that they may reach with a working mode for each."""
    record = assur.load(name)
    legs = Legs(record, inputs_of(record, record.home_values) * 1.013)
    rng = np.random.default_rng(3)
    low, high = pose_box(record, legs.inputs)
    middle = low + rng.random((90, len(low))) * (high - low)
    reach = np.repeat([0.1, 1e-3, 0.0], 30)[:, None] * (high - low)
    return legs, Interval.of(middle - reach, middle + reach), rng.integers(0, len(legs.modes), 90)


@pytest.fixture(params=["numpy", "compiled"])
def engine(request, monkeypatch):
    done = interval_program._Done(interval_program.REPAID, request.param == "compiled")
    monkeypatch.setattr(interval_program, "_DONE", done)


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("name", each(BY_LEGS, ("zeng2019", "planar_3rrr", "three_rps")))
@pytest.mark.parametrize("ns", [Existing(), Intervals()], ids=["existing", "strict"])
def test_conditions_have_the_same_bounds(name, ns):
    """Or closer ones: what is worked out once is one number, so that its product with itself is a square."""
    legs, boxes, labels = problem(name)
    one, two = (kernel(ns, parts(boxes), labels) for kernel in (legs, RecordedLegs(legs)))
    same = []
    for first, second in zip((*one[0], *one[1]), (*two[0], *two[1]), strict=True):
        known = broadcast(as_interval(first), (90,))
        assert np.all((known.low <= second.low) & (second.high <= known.high))
        assert np.all(second.defined | ~known.defined)
        same.append((known.low == second.low) & (second.high == known.high))
    assert np.mean(same) > 0.8


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize("name", each(BY_LEGS, ("zeng2019", "planar_3rrr", "three_rps")))
def test_derivatives_bound_the_same(name):
    """Where those of dual numbers have bounds they have too, no wider but for rounding."""
    legs, boxes, labels = problem(name)
    found, known = (
        derivative(lambda ns, x, kernel=kernel: kernel(ns, x, labels)[0], boxes)
        for kernel in (RecordedLegs(legs), legs)
    )
    sound = known.defined & np.isfinite(known.width)
    assert np.all(found.defined[sound])
    size = 1e-9 * (1 + known.magnitude[sound])
    assert np.all(found.low[sound] >= known.low[sound] - size)
    assert np.all(found.high[sound] <= known.high[sound] + size)
    assert np.mean(sound) > 0.05
    narrow = sound & (known.width < 1e-6 * (1 + known.magnitude))
    off = np.abs(found.middle[narrow] - known.middle[narrow])
    assert np.all(off <= known.width[narrow] + 1e-9 * (1 + known.magnitude[narrow]))


def test_a_dual_of_theirs_has_every_derivative():
    legs, boxes, labels = problem("fivebar")
    zero, _ = RecordedLegs(legs)(DualIntervals(), parts(boxes), labels)
    assert [value.derivative.shape for value in zero] == [(2, 90)] * 2


@pytest.mark.usefixtures("engine")
def test_the_search_finds_the_same_with_either():
    record = assur.load("zeng2019")
    found = direct_by_boxes(record, np.array([162.6907, -143.3209, -24.6776]))
    assert (found.complete, len(found.solutions), found.undecided) == (True, 4, ())
