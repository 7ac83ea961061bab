from pathlib import Path

import numpy as np
import pytest

import assur
from assur.kinematics.rates.velocity import printed_velocity_map, velocity_map, velocity_map_at
from assur.numerics import rotations
from dual_acceleration import coordinate_rates

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


def test_acceleration_is_known_where_a_kernel_has_no_derivative(paper):
    """At sin(alpha) = 0 the root of the kernel is one of zero; the joint graph has no roots."""
    pose = [80.0, -74.3479, 237.9038]
    here = velocity_map(paper, pose)
    assert (bool(here.singular_input), bool(here.singular_output)) == (True, False)
    velocity, acceleration = paper.acceleration(pose, [1.0, 2.0, 3.0], [0.0, 0.0, 0.0])
    assert np.all(np.isfinite(velocity))
    assert np.all(np.isfinite(acceleration))


def test_the_map_from_the_joint_graph_may_stand_for_that_of_the_closed_form(paper):
    poses = np.array([ROW_3, [0.0, 20.0, 400.0], [80.0, -74.3479, 237.9038]])
    here = velocity_map_at(paper, paper.inverse(poses, "++-++").joints[:, 0])
    form = velocity_map(paper, poses, "++-++")
    for name in ("singular_output", "singular_input", "exists"):
        np.testing.assert_array_equal(getattr(here, name), getattr(form, name))
    for name in ("matrix", "velocity_factors", "condition", "jp", "jq", "det_jp", "det_jq"):
        assert getattr(here, name).shape == getattr(form, name).shape
    for name in ("matrix", "velocity_factors", "condition"):
        np.testing.assert_allclose(getattr(here, name), getattr(form, name), rtol=1e-8, atol=1e-9)
    np.testing.assert_array_equal(
        np.sign(here.det_jp * here.det_jq)[:2],
        np.sign(form.det_jp * form.det_jq)[:2],
        "the only sign that means anything",
    )
    rates = np.random.default_rng(0).normal(size=(3, 3))
    np.testing.assert_allclose(here.output(rates), form.output(rates), atol=1e-9)
    np.testing.assert_allclose(here.input(rates), form.input(rates), atol=1e-9, equal_nan=True)


def test_joint_values_that_do_not_close_the_loops_are_labelled(paper):
    here = velocity_map_at(paper, np.array([paper.home_values, paper.home_values + 0.3]))
    assert here.exists.tolist() == [True, False]
    assert np.isfinite(here.condition[0])
    for number in (here.condition, here.det_jp, here.det_jq, here.output([1.0, 2.0, 3.0])[:, 0]):
        assert np.isnan(number[1])


def test_a_hexapod_has_six_rates_and_seven_coordinates():
    mechanism = assur.load(Path(__file__).parent / "hexapod.toml")
    here = velocity_map_at(mechanism, mechanism.home_values)
    assert (here.jp.shape, here.jq.shape, here.matrix.shape) == ((6, 6), (6, 6), (6, 6))
    rates = np.arange(6.0)
    np.testing.assert_allclose(here.input(here.output(rates)), rates, atol=1e-12)


def test_a_quaternion_changes_with_the_angular_velocity():
    """Against a rotation by a small angle about the angular velocity, in the base frame."""
    mechanism = assur.load(Path(__file__).parent / "hexapod.toml")
    rng = np.random.default_rng(4)
    quaternion = rng.normal(size=(5, 4))
    quaternion /= np.linalg.norm(quaternion, axis=-1, keepdims=True)
    poses, velocity = np.concatenate([rng.normal(size=(5, 3)), quaternion], axis=-1), rng.normal(size=(5, 6))
    found = coordinate_rates(mechanism, poses, velocity)
    np.testing.assert_array_equal(found[:, :3], velocity[:, :3])
    step, rotation = 1e-6, rotations.from_quaternion(quaternion)
    ahead, behind = (
        rotations.to_quaternion(rotations.from_vector(h * velocity[:, 3:]) @ rotation) for h in (step, -step)
    )
    sense = np.sign(np.sum(ahead * quaternion, axis=-1, keepdims=True))  # q and -q are one rotation
    np.testing.assert_allclose(found[:, 3:], sense * (ahead - behind) / (2 * step), atol=1e-9)
