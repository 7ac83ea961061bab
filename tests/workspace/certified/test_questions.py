"""Questions: which factors they are about, and poses that certainly fail."""

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError
from assur.numerics.intervals.interval import Interval
from assur.workspace.certified.questions import asked_of, columns_of, violations
from assur.workspace.domain import Box

ZENG = assur.load("zeng2019")


def asked(*what):
    return asked_of(ZENG, None, None, None, what)


def test_reached_alone_asks_for_no_factor_and_regular_for_all():
    assert asked("reached").regular == ()
    assert set(asked("regular").regular) == {
        *asked("parallel").regular,
        *asked("serial").regular,
        *asked("constraint").regular,
    }
    with pytest.raises(UnknownNameError):
        asked("near")


def test_only_what_is_certain_counts_as_failing():
    question = asked("reached", "parallel")
    start = question.over([Interval.of([value]) for value in (-40.0, 0.0, 400.0)])
    # regular; not reached above; w and v have the other sign below, by the paper's two circles
    points = [np.array([-40.0, -40.0, -40.0]), np.zeros(3), np.array([400.0, 470.0, 190.0])]
    found = violations(question, points, start)
    assert found[0] == ""
    assert "not reached" in found[1]
    assert "changes sign" in found[2]
    inverse = ZENG.inverse(np.stack(points, axis=-1), "++-++")
    assert inverse.exists[:, 0].tolist() == [True, False, True]
    name = found[2].split()[0]
    assert inverse.factors[name][0, 0] * inverse.factors[name][2, 0] < 0


def test_coordinates_that_are_not_cut_are_in_their_middle():
    box = Box(("x", "y", "z"), (0.0, 2.0, 0.0), (1.0, 4.0, 1.0))
    x, y, z = columns_of(box, ("x", "z"), np.array([[0.1, 0.2], [0.3, 0.4]]))
    assert (x.tolist(), y.tolist(), z.tolist()) == ([0.1, 0.2], [3.0, 3.0], [0.3, 0.4])
