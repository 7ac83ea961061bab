"""Derivatives of the screws against central differences, over every joint type and every size of a rotation."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.joint_graph.frames import screws
from assur.kinematics.rates.screw_rates import screw_rates

HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def every():
    return assur.load(HERE / "every_type.toml")


def _differences(mechanism, values, rates, step=1e-6):
    ahead, behind = (screws(mechanism, at) for at in (values + step * rates, values - step * rates))
    return (ahead - behind) / (2 * step)


def test_every_joint_type_turns_with_its_own_link(every):
    rng = np.random.default_rng(0)
    values, rates = rng.normal(size=(2, 5, len(every.coordinates)))
    expected = _differences(every, values, rates)
    assert np.all(np.abs(expected).max(axis=(0, 1))[1:-1] > 0.1), "every screw but the base's own must move"
    np.testing.assert_allclose(screw_rates(every, values, rates), expected, atol=1e-7)


@pytest.mark.parametrize("size", [0.0, 1e-6, 0.1, 0.999, 1.001, 3.0, 6.0])
def test_a_spherical_joint_at_every_angle(every, size):
    """The series and the closed formula meet at one rad."""
    values = every.home.copy()
    values[-4:-1] = size * np.array([2.0, -1.0, 2.0]) / 3.0
    rates = np.random.default_rng(1).normal(size=len(values))
    # screws themselves use another series below 1e-4, so a step across it costs digits
    np.testing.assert_allclose(screw_rates(every, values, rates), _differences(every, values, rates, 1e-5), atol=2e-7)


def test_series_and_formula_agree_to_rounding_where_they_meet(every):
    values = np.tile(every.home, (2, 1))
    values[:, -4:-1] = np.array([[1 - 1e-12], [1 + 1e-12]]) * np.array([2.0, -1.0, 2.0]) / 3.0
    below, above = screw_rates(every, values, np.ones_like(values))
    np.testing.assert_allclose(below, above, atol=1e-10)
