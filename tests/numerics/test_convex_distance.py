"""Distances of convex bodies: against faces known by hand, against another library's, and where bodies meet."""

import numpy as np
import pytest
from manifold3d import Manifold

from assur.numerics import rotations
from assur.numerics.convex_distance import convex_distance, nearest_points

CUBE = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
SMALL, LARGE = 0.02, 200.0


def at(*place):
    return np.eye(3)[None], np.array([place], dtype=float)


@pytest.mark.parametrize(
    ("place", "wanted"),
    [
        ((4.0, 0.2, 0.3), 3.0),  # face to face
        ((-4.0, 0.2, 0.3), 3.0),
        ((4.0, 5.0, 0.3), 5.0),  # edge to edge
        ((3.0, 4.0, 5.0), np.sqrt(4 + 9 + 16)),  # corner to corner
        ((0.5, 0.5, 0.5), 0.0),
        ((1.0, 0.5, 0.5), 0.0),  # they touch
        ((0.0, 0.0, 0.0), 0.0),
    ],
)
def test_cubes(place, wanted):
    assert convex_distance(CUBE, CUBE, *at(*place))[0] == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize("scale", [SMALL, 1.0, LARGE])
def test_random_bodies_are_as_far_apart_as_manifold_says(scale):
    rng = np.random.default_rng(5)
    for count in (4, 9, 40):
        first, second = scale * rng.normal(size=(count, 3)), scale * rng.normal(size=(count + 3, 3))
        turns = rotations.from_vector(rng.normal(size=(25, 3)))
        places = scale * rng.uniform(-5, 5, size=(25, 3))
        found = convex_distance(first, second, turns, places)
        one, other = Manifold.hull_points(first), Manifold.hull_points(second)
        moved = [other.transform(np.column_stack([turns[k], places[k]])) for k in range(25)]
        wanted = np.array([one.min_gap(item, 30 * scale) for item in moved])
        assert np.any(wanted == 0) or count == 4
        np.testing.assert_allclose(found, wanted, rtol=2e-5, atol=2e-5 * scale)


def test_flat_and_thin_bodies_do_no_harm():
    plate = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]])
    needle = np.array([[0.0, 0, 0], [0, 0, 3.0]])
    places = np.array([[1, 1, 0.5], [1, 1, -1], [5, 1, 0]])
    found = convex_distance(plate, needle, np.repeat(np.eye(3)[None], 3, axis=0), places)
    np.testing.assert_allclose(found, [0.5, 0.0, 3.0], atol=1e-9)


def test_the_two_bodies_may_be_exchanged():
    rng = np.random.default_rng(8)
    first, second = rng.normal(size=(12, 3)), rng.normal(size=(7, 3))
    turns, places = rotations.from_vector(rng.normal(size=(30, 3))), rng.uniform(-4, 4, size=(30, 3))
    back = np.swapaxes(turns, 1, 2)
    found = convex_distance(second, first, back, -np.einsum("kij,kj->ki", back, places))
    np.testing.assert_allclose(convex_distance(first, second, turns, places), found, rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("scale", [SMALL, 1.0, LARGE])
def test_nearest_points_are_in_the_bodies_and_as_far_apart_as_these(scale):
    rng = np.random.default_rng(11)
    for _ in range(30):
        first, second = scale * rng.normal(size=(30, 3)), scale * rng.normal(size=(9, 3))
        turn, place = rotations.from_vector(rng.normal(size=3)), scale * rng.uniform(-5, 5, size=3)
        wanted = convex_distance(first, second, turn[None], place[None])[0]
        pair = nearest_points(first, second @ turn.T + place)
        assert np.linalg.norm(pair[1] - pair[0]) == pytest.approx(wanted, rel=2e-5, abs=2e-5 * scale)
        for body, point in ((first, pair[0]), (second @ turn.T + place, pair[1])):
            way = rng.normal(size=(200, 3))  # no plane has all of the body on one side and the point on the other
            assert np.all(point @ way.T <= np.max(body @ way.T, axis=0) + 1e-9 * scale)
