"""Which signs of a mode are those of roots, and that a form which is wrong in some modes alone is refused."""

import numpy as np
import pytest

from assur.kinematics.contract.exact import Trial, exactness
from assur.kinematics.contract.free_signs import taken_over
from assur.model.registry import load_record

TAKEN = {
    ("fivebar", "inverse"): [{0}, {1}],
    ("zeng2019", "inverse"): [{0}, {1}, {2, 3}, {4}],
    ("zeng2019", "direct"): [{0}, {1}, {2}],
    ("three_rrrp4r", "inverse"): [{0}, {1}, {2}],
    ("gough_stewart", "inverse"): [],
    ("delta_4s", "inverse"): [],
}


@pytest.mark.parametrize(("name", "problem"), TAKEN)
def test_roots_take_signs_over(name, problem):
    found, _ = taken_over(load_record(name), problem)
    assert list(map(set, found)) == TAKEN[name, problem]


def test_the_choices_that_are_left_are_met():
    trial = Trial(load_record("zeng2019"), "inverse", True, np.random.default_rng(2))
    assert trial.mismatch() is None
    assert trial.kinds == 2
    assert len(trial.met) == 2


def test_a_form_that_is_wrong_in_one_mode_is_refused(copied):
    """Where u1 and u2 have one sign the paper's mechanism is singular, and both determinants vanish."""
    form = "u1, u2, u3, w, v = core.u1, core.u2, core.u3, core.w, core.v\n    ca, sa, cb, sb"
    wrong = form.replace("\n    ca", "\n    v = v + (u1 + u2) * (u1 - u2 + 1)\n    ca")
    assert exactness(load_record(copied("zeng2019", (form, wrong)))).mismatches
