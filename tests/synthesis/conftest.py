"""Searches that several tests look at, each made once."""

import pytest

from assur.synthesis.question import question
from assur.synthesis.synthesis import synthesis


@pytest.fixture(autouse=True)
def _nothing_kept(monkeypatch, tmp_path):
    """What other tests found, some of it with parts of the code exchanged, is not read."""
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))


@pytest.fixture(scope="session")
def in_space():
    """Three translations, actuators at the base, equal and different limbs."""
    return synthesis(question("3T", 3, 5, members=3))


@pytest.fixture(scope="session")
def in_legs():
    """Three translations, actuators in the legs, equal limbs."""
    return synthesis(question("3T", 3, 5, symmetric=True, actuators="leg"))


@pytest.fixture(scope="session")
def small():
    """Three translations by limbs of three joints."""
    return synthesis(question("3T", max_joints=3, members=3))


@pytest.fixture(scope="session")
def of_two_limbs():
    """Three translations by two limbs, of which one begins with an inner loop."""
    return synthesis(question("3T", 2, 5, members=2))
