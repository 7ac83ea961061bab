"""The Orthoglide's design rule: velocity factors between 1/2 and 2 over a cube, both bounds met at two corners."""

import numpy as np
import pytest

import assur
from assur.performance.indices import indices


@pytest.fixture(scope="module")
def orthoglide():
    return assur.load("orthoglide")


def corners(record):
    """Q2 and Q1 on the diagonal, from L alone."""
    return -record.values.L / np.sqrt(6), record.values.L / np.sqrt(18)


@pytest.mark.parametrize(("index", "factors"), [(0, [2, 2, 0.5]), (1, [2, 0.8, 0.8])], ids=["Q2", "Q1"])
def test_bounds_are_met_at_the_corners(orthoglide, index, factors):
    pose = [corners(orthoglide)[index]] * 3
    np.testing.assert_allclose(indices(orthoglide, pose).velocity_factors, factors, rtol=1e-12)


def test_the_origin_is_isotropic(orthoglide):
    np.testing.assert_allclose(indices(orthoglide, [0.0, 0.0, 0.0]).velocity_factors, [1, 1, 1], rtol=1e-12)


def test_the_edge_of_the_cube_and_the_range_of_the_inputs(orthoglide):
    low, high = corners(orthoglide)
    assert high - low == pytest.approx(orthoglide.values.cube, rel=1e-14)
    edge = np.linspace(low, high, 41)
    edge = np.append(edge, 0.0)  # an input is largest with the other two coordinates zero
    poses = np.stack(np.meshgrid(edge, edge, edge, indexing="ij"), axis=-1).reshape(-1, 3)
    inputs = orthoglide.inverse(poses, "+++").inputs
    assert inputs.min() == pytest.approx(126.794919, abs=5e-7)
    assert inputs.max() == pytest.approx(383.787935, abs=5e-7)


def test_factors_stay_within_the_bounds_over_the_cube_and_leave_them_beyond(orthoglide):
    low, high = corners(orthoglide)
    for grown, inside in ((1.0, True), (1.02, False)):
        edge = np.linspace(grown * low, grown * high, 25)
        poses = np.stack(np.meshgrid(edge, edge, edge, indexing="ij"), axis=-1).reshape(-1, 3)
        factors = indices(orthoglide, poses).velocity_factors
        assert (factors.min() > 0.5 - 1e-12 and factors.max() < 2.0 + 1e-12) == inside


@pytest.mark.parametrize(
    ("index", "inputs", "outputs"),
    [(0, 1 / np.sqrt(1.5), 1 / np.sqrt(4.125)), (1, 1 / np.sqrt(1.125), 1 / np.sqrt(1.98))],
    ids=["Q2", "Q1"],
)
def test_transmission_at_the_corners(orthoglide, index, inputs, outputs):
    """With t beside the unit diagonal of J^-1: rows of length sqrt(1 + 2 t^2), and the columns of its inverse."""
    found = indices(orthoglide, [corners(orthoglide)[index]] * 3)
    np.testing.assert_allclose(found.transmission.inputs, inputs, rtol=1e-12)
    np.testing.assert_allclose(found.transmission.outputs, outputs, rtol=1e-12)
