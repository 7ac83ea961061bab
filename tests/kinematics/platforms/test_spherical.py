"""Platforms about a fixed point: as many assemblies as a search meets, and all are known."""

import numpy as np
import pytest

from assur.cli.main import main
from assur.kinematics.closure import closure_error
from assur.kinematics.home import home_values
from assur.kinematics.platforms.direct import direct_by_conditions
from assur.kinematics.search import distinct, search
from assur.model.registry import load_record


@pytest.mark.parametrize("words", [("3-RRR", "spherical"), ("3-UPS/S",)])
def test_all_that_a_search_meets_and_no_other(words, tmp_path):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), *words]) == 0
    record = load_record(path)
    home = home_values(record)
    inputs = np.array([driven.printed(home[driven.coordinate.index]) for driven in record.inputs])
    inputs = inputs * [1.05, 0.97, 1.02] + [0.1, -0.05, 0.02]
    solutions = direct_by_conditions(record, inputs)
    assert solutions.complete
    assert len(solutions.joints) >= 2
    assert np.max(closure_error(record, solutions.joints)) < 1e-9
    met = search(record, "direct", inputs).joints
    assert len(distinct(record, np.concatenate([solutions.joints, met]))) == len(solutions.joints)
