"""One unit for the Jacobian: what a length does, the isotropic one against a scan, refusals."""

from functools import partial

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.rates.units import factor_unit, is_mixed, scaled
from assur.performance.scaling import chosen_length, isotropic_length

MIXED = {"gough_stewart", "h4_robot", "planar_3rpr", "planar_3rrr", "three_rps"}


def test_units_mix_where_a_pose_has_lengths_and_angles():
    assert {name for name in assur.names() if is_mixed(assur.load(name))} >= MIXED
    assert not any(is_mixed(assur.load(name)) for name in ("fivebar", "zeng2019", "orthoglide", "delta_4s"))


@pytest.mark.parametrize(
    ("name", "length", "unit"),
    [("orthoglide", None, ""), ("fivebar", None, "mm/rad"), ("fivebar", 2.0, ""), ("planar_3rrr", 50.0, "")],
)
def test_the_unit_of_a_velocity_factor(name, length, unit):
    assert factor_unit(assur.load(name), length) == unit


def test_a_change_of_unit_with_the_length_changes_nothing():
    """Twice the mechanism with twice the length has the same J_L."""
    small = assur.load("planar_3rrr")
    big = small.with_parameters(**{name: 2 * item.value for name, item in small.parameters.items()})
    pose = np.array([20.0, -30.0, 0.1])
    mode = small.modes.default_working
    first = scaled(small, small.velocity_map(pose, mode).matrix, 77.0)
    second = scaled(big, big.velocity_map([40.0, -60.0, 0.1], mode).matrix, 154.0)
    np.testing.assert_allclose(first, second, rtol=1e-12)


def test_the_default_is_the_mechanism_s_own_length_where_units_mix():
    for name in ("fivebar", "planar_3rrr"):
        record = assur.load(name)
        matrix = np.eye(len(record.inputs))[None]
        expected = characteristic_length(record) if is_mixed(record) else None
        assert chosen_length(record, None, matrix) == expected
        assert chosen_length(record, 12.5, matrix) == 12.5


def _mean_index(record, matrices, length):
    return np.mean(1 / np.linalg.cond(scaled(record, matrices, length)))


@pytest.mark.parametrize("name", ["planar_3rrr", "planar_3rpr", "h4_robot"])
def test_no_other_length_is_more_isotropic(name, regular_poses):
    record = assur.load(name)
    mode = record.modes.default_working
    matrices = record.velocity_map(regular_poses(record, mode, 5), mode).matrix
    for part in (matrices[:1], matrices):
        best = isotropic_length(record, part)
        mean = partial(_mean_index, record, part)
        assert chosen_length(record, "isotropic", part) == best
        scan = best * np.exp(np.linspace(-4, 4, 801))
        assert mean(best) >= max(mean(length) for length in scan) - 1e-9


def test_the_symmetric_pose_of_3_rrr_has_the_isotropic_length_in_closed_form():
    """By symmetry J^-1 has equal columns of length s, and a third of entries t: isotropic where s = t / L."""
    record = assur.load("planar_3rrr")
    matrix = record.velocity_map([0.0, 0.0, 0.0]).matrix
    inverse = np.linalg.inv(matrix)
    length = np.linalg.norm(inverse[:, 2]) / np.linalg.norm(inverse[:, 0])
    assert isotropic_length(record, matrix[None]) == pytest.approx(length, rel=1e-6)
    assert np.linalg.cond(scaled(record, matrix, length)) == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("length", [0.0, -1.0, np.nan, np.inf, True, "best"])
def test_a_length_that_is_none_is_refused(length):
    with pytest.raises(UsageError, match="characteristic length"):
        chosen_length(assur.load("planar_3rrr"), length, np.eye(3)[None])


def test_an_isotropic_length_needs_mixed_units_and_a_regular_pose():
    with pytest.raises(UsageError, match="units do not mix"):
        chosen_length(assur.load("fivebar"), "isotropic", np.eye(2)[None])
    with pytest.raises(UsageError, match="no isotropic length"):
        chosen_length(assur.load("planar_3rrr"), "isotropic", np.full((2, 3, 3), np.nan))
