"""Sets that leave three quadrics, in whose askew coordinate no root is double by symmetry alone."""

import shutil

import numpy as np
import pytest

from assur.derivation.derivation import derive
from assur.derivation.solution import analytic_solution
from assur.derivation.three_quadrics import three_quadrics
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.position import direct
from assur.model.registry import load_record

pytestmark = pytest.mark.deep


def of(name):
    solution = analytic_solution(load_record(name), "direct")
    part = next(part for part in solution.sets if part.eliminant is not None)
    return solution, three_quadrics(part, solution.symbols.witness)


@pytest.mark.parametrize(("name", "values", "conditions"), [("three_rrc", 3, []), ("h4_robot", 11, ["a4", "a5"])])
def test_every_root_of_the_polynomial_is_on_the_three_quadrics(name, values, conditions):
    """At a root modulo a prime all sums of squares are one, and all other unknowns are what is said."""
    solution, three = of(name)
    assert [str(own) for own in three.conditions] == conditions
    assert len(three.values) == values
    witness = solution.witness_before(len(solution.sets), seed=3)
    assert all(witness.is_zero(own.symbol - own.formula) for own in three.values)
    for forms in three.sums:
        squares = [sum(share * key for key, share in form.items()) ** 2 for form in forms]
        assert witness.is_zero(sum(squares) - 1)


@pytest.mark.parametrize("name", ["planar_3rrr", "planar_3rpr", "three_rps"])
def test_a_set_of_more_unknowns_keeps_its_angle(name):
    assert of(name)[1] is None


@pytest.mark.parametrize(("name", "low", "high"), [("three_rrc", 2.0, 2.7), ("h4_robot", -0.2, 0.5)])
def test_where_inputs_are_alike_nothing_is_undecided_and_no_pose_is_lost(name, low, high, tmp_path):
    """Two poses have the angle of a link in common there, and its polynomial has double roots; this one has none."""
    written = load_record(name)
    shutil.copy(written.file, tmp_path / "mechanism.toml")
    (tmp_path / "closed_form.py").write_text(derive(written).closed_form())
    given = np.random.default_rng(0).uniform(low, high, size=(100, len(written.inputs)))
    given[:, -1] = given[:, 0]
    given[:50] = given[:50, :1]
    first, second = (direct(record, given) for record in (written, load_record(tmp_path)))
    for answer in (first, second):
        assert answer.complete
    assert np.sum(first.exists) > 200
    for row in range(len(given)):
        poses, others = (own.poses[row][own.exists[row]] for own in (first, second))
        gaps = np.max(np.abs(poses[:, None] - others), axis=-1) / characteristic_length(written)
        assert len(poses) == len(others)
        assert np.all(np.min(gaps, axis=1, initial=np.inf) < 1e-7)
