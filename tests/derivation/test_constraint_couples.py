"""Couples of parallelograms that are parallel to one plane: there, and nowhere else, the closure loses rank."""

import shutil

import numpy as np
import pytest

from assur.derivation.constraint_couples import coplanar_couples
from assur.derivation.derivation import derive
from assur.derivation.solution import analytic_solution
from assur.kinematics.position import inverse
from assur.model.registry import load_record


@pytest.mark.parametrize("name", ["orthoglide", "tsai_platform", "zeng2019", "tripteron"])
def test_none_where_limbs_turn_about_more_or_have_no_rods(name):
    assert coplanar_couples(analytic_solution(load_record(name), "inverse")) == {}


@pytest.mark.deep
@pytest.mark.parametrize("name", ["delta_4s", "linear_delta_4s"])
def test_the_derived_form_vanishes_with_the_written_one(name, tmp_path):
    """The built-in forms say these couples by hand; another formula with the same zeros."""
    written = load_record(name)
    shutil.copy(written.file, tmp_path / "mechanism.toml")
    (tmp_path / "closed_form.py").write_text(derive(written).closed_form())
    derived, rng = load_record(tmp_path), np.random.default_rng(0)
    assert ("couples",) in derived.closed_form.constraint_singular
    low, high = np.array([written.box[name] for name in written.platform.pose]).T
    pairs = []
    for pose in rng.uniform(low, high, (20, 3)):
        ours, theirs = (
            {own.mode: own.factors["couples"] for own in inverse(record, pose)} for record in (written, derived)
        )
        assert ours.keys() == theirs.keys()
        pairs += [(ours[mode], theirs[mode]) for mode in ours]
    ours, theirs = np.array(pairs).T
    assert len(ours) > 20
    assert np.ptp(ours) > 0.1
    assert np.allclose(theirs * ours[0], ours * theirs[0], rtol=0, atol=1e-12)
