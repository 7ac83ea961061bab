"""Which route answers: closed form, loops in turn or a search, and that they agree."""

import numpy as np
import pytest

from assur.errors import UnknownNameError
from assur.kinematics.position import direct
from assur.model.registry import load_record


def test_what_the_roots_of_a_polynomial_leave_open_goes_to_the_loops():
    record, legs = load_record("three_rps", R=60.0, r=120.0), [255.3, 343.9, 304.3]
    assert not direct(record, legs, method="closed form").complete
    found, searched = direct(record, legs), direct(record, legs, method="search")
    assert (found.complete, found.right) == (True, direct(record, legs, method="loops").right)
    apart = np.linalg.norm(found.poses[:, None] - searched.poses, axis=-1)
    assert len(found) == len(searched) == 12
    assert np.all(np.min(apart, axis=1) < 1e-6)


def test_a_problem_that_the_roots_decide_stays_with_them():
    record = load_record("three_rps")
    found = direct(record, [255.3, 343.9, 304.3])
    assert found.complete
    assert found.right.startswith("closed form")


def test_an_unknown_method_is_refused():
    with pytest.raises(UnknownNameError, match="method 'newton'"):
        direct(load_record("fivebar"), [1.0, 2.0], method="newton")
