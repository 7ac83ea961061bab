"""Poses and inputs for sweeps, of every mechanism whose direct problem is told by branches of signs."""

import numpy as np
import pytest

import assur
from assur.kinematics.closed_form.sweep import inverse_sweep
from catalogue import each

COUNT = 4999  # odd, and no multiple of any block
WITH_BRANCHES = [name for name in assur.names() if callable(assur.load(name).closed_form.direct)]
"""Mechanisms whose direct problem is told by branches of signs, not by a polynomial or a search."""


@pytest.fixture(params=each(WITH_BRANCHES, ["zeng2019", "fivebar", "three_crr"]))
def mechanism(request):
    return assur.load(request.param)


@pytest.fixture
def zeng():
    return assur.load("zeng2019")


@pytest.fixture
def count():
    """How many poses and inputs there are unless a test asks for another number."""
    return COUNT


@pytest.fixture
def poses_of():
    """A function: random poses (m, N) in a mechanism's box."""
    return _poses


@pytest.fixture
def inputs_of():
    """A function: inputs (n, N) of poses that exist, and every third with a first input far from them."""
    return _inputs


def _poses(mechanism, count=COUNT):
    rng = np.random.default_rng(5)
    limits = [mechanism.box[name] for name in mechanism.platform.pose]
    return np.array([rng.uniform(low, high, count) for low, high in limits])


def _inputs(mechanism, count=COUNT):
    found = inverse_sweep(mechanism, _poses(mechanism, 6 * count))
    real = found["inputs"][:, found["exists"]]
    assert real.shape[1] > 50
    rng = np.random.default_rng(6)
    picked = real[:, rng.integers(real.shape[1], size=count)]
    picked[0, ::3] = rng.normal(real[0].mean(), 6 * real[0].std(), size=len(picked[0, ::3]))
    return picked
