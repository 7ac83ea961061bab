"""Every registered mechanism, and regular configurations of it, for laws that hold for all of them."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

import assur
from assur.kinematics.status import Status
from assur.singularity.examples import singular_examples as find_singular_examples


@pytest.fixture(params=assur.names())
def mechanism(request):
    return assur.load(request.param)


@pytest.fixture
def poses(mechanism):
    """Poses (60, m) from the mechanism's workspace box."""
    low, high = np.array([mechanism.box[name] for name in mechanism.platform.pose]).T
    return np.random.default_rng(1).uniform(low, high, size=(60, len(low)))


@pytest.fixture
def regular(mechanism, poses):
    """Regular solutions over all working modes: (pose, mode text, inputs, joint values)."""
    found = mechanism.inverse(poses)
    rows, branches = np.nonzero(found.exists & (found.status == Status.regular))
    assert len(rows) > 20, "the box of the file holds too few regular poses"
    modes = ["".join("+" if sign > 0 else "-" for sign in found.modes_asked[k]) for k in branches]
    return list(zip(poses[rows], modes, found.inputs[rows, branches], found.joints[rows, branches], strict=True))


@pytest.fixture
def singular_examples(mechanism):
    return _examples(mechanism.name)


@lru_cache(maxsize=8)
def _examples(name):
    return find_singular_examples(assur.load(name))
