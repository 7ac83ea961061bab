"""Poses that leave coordinates open: all platforms that limbs allow, against a search, and all are known."""

import numpy as np
import pytest

from assur.cli.main import main
from assur.kinematics.closure import closure_error
from assur.kinematics.home import home_values
from assur.kinematics.limbs.inverse import inverse_by_limbs
from assur.kinematics.pose import pose_of
from assur.kinematics.search import distinct, search
from assur.model.pose import LENGTHS
from assur.model.registry import load_record

ARRANGEMENTS = {("3-RPS",): 8, ("3-SPR",): 32, ("3UPS&UP",): 16, ("3-PRS", "upright rails"): 8, ("3-RRS",): 8}
"""Shorthand, and how many assemblies there are at least beside home."""
QUICK = (("3-RPS",), ("3-SPR",))


@pytest.mark.parametrize(
    "words", [name if name in QUICK else pytest.param(name, marks=pytest.mark.deep) for name in ARRANGEMENTS]
)
def test_all_that_a_search_meets_and_no_other(words, tmp_path):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), *words]) == 0
    record = load_record(path)
    pose = pose_of(record, home_values(record))
    pose = pose + np.array([7.0 if name in LENGTHS else 0.08 for name in record.platform.pose]) * [1.0, -0.7, 0.9]
    solutions = inverse_by_limbs(record, pose)
    assert solutions.complete
    assert len(solutions.joints) >= ARRANGEMENTS[words]
    assert np.max(closure_error(record, solutions.joints)) < 1e-9
    assert np.allclose(pose_of(record, solutions.joints), pose, rtol=0, atol=1e-6)
    met = search(record, "inverse", pose).joints
    assert len(met) >= ARRANGEMENTS[words] // 2
    assert len(distinct(record, np.concatenate([solutions.joints, met]))) == len(solutions.joints)
