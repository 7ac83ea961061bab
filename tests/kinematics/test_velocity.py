from __future__ import annotations

import numpy as np
import pytest

import assur
from assur.kinematics.velocity import printed_velocity_map, velocity_map

ROW_3 = [-15.4714, 9.6849, 456.3315]


@pytest.fixture(scope="module")
def paper():
    return assur.load("zeng2019")


def test_condition_is_that_of_the_velocity_map(paper):
    here = velocity_map(paper, ROW_3)
    matrix = np.linalg.inv(here.jp) @ here.jq
    assert here.condition == pytest.approx(np.linalg.cond(matrix), rel=1e-10)
    np.testing.assert_allclose(here.velocity_factors, np.linalg.svd(matrix, compute_uv=False), rtol=1e-10)


def test_condition_does_not_depend_on_the_form_of_the_rows(paper):
    assert velocity_map(paper, ROW_3).condition == pytest.approx(printed_velocity_map(paper, ROW_3).condition)


def test_the_two_ways_are_inverse(paper):
    here = velocity_map(paper, ROW_3)
    rates = np.random.default_rng(0).normal(size=(7, 3))
    np.testing.assert_allclose(here.input(here.output(rates)), rates, atol=1e-12)


def test_self_motion_mode_has_no_condition_and_labelled_numbers(paper):
    here = velocity_map(paper, ROW_3, "+++++")
    assert bool(here.singular_output)
    assert np.isinf(here.condition)
    assert np.all(np.isnan(here.output([1.0, 0.0, 0.0])))
    assert np.all(np.isfinite(here.input([1.0, 2.0, 3.0])))


def test_a_batch_keeps_regular_rows_beside_singular_and_unreachable_ones(paper):
    edge = [80.0, -74.3479, 237.9038]  # link 12 lies along X: sin(alpha) = 0
    here = velocity_map(paper, [ROW_3, edge, [500.0, 0.0, 300.0]])
    assert here.singular_input.tolist() == [False, True, False]
    assert here.exists.tolist() == [True, True, False]
    assert np.all(np.isfinite(here.matrix[0]))
    assert np.isinf(here.condition[1])
    for number in (here.condition, here.det_jp, here.det_jq, here.output([1.0, 2.0, 3.0])[:, 0]):
        assert np.isnan(number[2])


def test_mechanism_without_printed_jacobian_says_so():
    with pytest.raises(assur.UsageError, match="no printed Jacobian"):
        printed_velocity_map(assur.load("fivebar"), [0.0, 224.0])


def test_acceleration_is_labelled_where_a_kernel_has_no_derivative(paper):
    """At sin(alpha) = 0 the velocity map is regular and the acceleration is not known."""
    pose = [80.0, -74.3479, 237.9038]
    here = velocity_map(paper, pose)
    assert (bool(here.singular_input), bool(here.singular_output)) == (True, False)
    velocity, acceleration = paper.acceleration(pose, [1.0, 2.0, 3.0], [0.0, 0.0, 0.0])
    assert np.all(np.isfinite(velocity))
    assert np.all(np.isnan(acceleration))
