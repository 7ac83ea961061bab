"""Mechanisms with their skeletons at home."""

from functools import cache
from types import SimpleNamespace

import pytest

import assur
from assur.kinematics.home import home_values
from assur.scene.companion import companion
from assur.scene.skeleton import skeleton
from catalogue import each


@cache
def at_home(name):
    record = assur.load(name)
    names = companion(record)
    return SimpleNamespace(record=record, companion=names, skeleton=skeleton(record, names, home_values(record)))


@pytest.fixture(params=each())
def every(request):
    """A mechanism's record, companion and skeleton at home."""
    return at_home(request.param)
