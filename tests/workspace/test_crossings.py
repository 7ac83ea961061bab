"""Where a field is zero on an edge: smooth fields in a few readings, others by halving, beside what stops to exist."""

import numpy as np
import pytest

from assur.workspace.crossings import CLOSE, GridEdges, root_of

FIELDS = {
    "a line": lambda t, c: t - c,
    "a quartic": lambda t, c: (t - c) * (1 + 0.05 * t + 0.005 * t**3),
    "a sphere of 16 cells": lambda t, c: (t + 9) ** 2 - (c + 9) ** 2,
    "a root that runs on": lambda t, c: np.copysign(np.sqrt(np.abs(t - c)), t - c),
    "a cube, flat where it is zero": lambda t, c: (t - c) ** 3,
    "a kink": lambda t, c: np.where(t < c, 0.01 * (t - c), 30 * (t - c)),
    "a jump": lambda t, c: np.where(t < c, -1e-3, 7.0),
    "a wave": lambda t, c: np.sin(2.4 * (t - c)),
}


def read(name, places):
    """Shares that are found, how often each field was read, and the zeros, of one field with its zero at places."""
    count = 0

    def at(points):
        nonlocal count
        count += len(points)
        return FIELDS[name](points[:, 0], points[:, 1])

    start, end = np.stack([0 * places, places, 0 * places], 1), np.stack([0 * places + 1, places, 0 * places], 1)
    nodes = np.stack([FIELDS[name](np.full_like(places, node), places) for node in (-1.0, 0.0, 1.0, 2.0)], axis=1)
    return root_of(at)(GridEdges(start, end, nodes.astype(np.float32).astype(float))), count / len(places)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("name", FIELDS)
def test_every_crossing_is_met(name, turned, monkeypatch):
    if turned:
        own = FIELDS[name]
        monkeypatch.setitem(FIELDS, name, lambda t, c: own(1 - t, 1 - c))
    places = np.random.default_rng(3).uniform(0.001, 0.999, 500)
    shares, _ = read(name, places)
    np.testing.assert_allclose(shares, places, rtol=0, atol=2 * CLOSE)


@pytest.mark.parametrize(("name", "most"), [("a line", 1.0), ("a quartic", 2.0), ("a sphere of 16 cells", 1.0)])
def test_smooth_fields_are_read_once_or_twice(name, most):
    assert read(name, np.linspace(0.003, 0.997, 400))[1] <= most


def test_a_node_at_zero_is_the_crossing_and_no_change_of_sign_is_none():
    around = np.array([[-4.0, -1.0, 0.0, -1.0], [1.0, 0.0, -1.0, -4.0], [1.0, 2.0, 3.0, 4.0]])
    shares = root_of(lambda points: np.full(len(points), np.nan))(GridEdges(np.zeros((3, 3)), np.ones((3, 3)), around))
    np.testing.assert_array_equal(shares, [1.0, 0.0, np.nan])


def test_beyond_where_a_field_exists_it_counts_as_negative():
    def at(points):
        return np.where(points[:, 0] < 0.3, 2.0 + points[:, 0], np.nan)

    edges = GridEdges(np.zeros((1, 3)), np.array([[1.0, 0.0, 0.0]]), np.array([[1.0, 2.0, -1.0, -1.0]]))
    assert root_of(at)(edges)[0] == pytest.approx(0.3, abs=2 * CLOSE)
