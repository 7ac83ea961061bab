"""Ways to take a point to its place: that by which it was taken is among them, and they are all that Newton meets."""

import itertools

import numpy as np
import pytest

from assur.kinematics.limbs.point_closure import MovingLimbError, point_closure
from assur.kinematics.limbs.serial import ElementaryMotion, applied

KINDS = [*itertools.product(("turn", "slide"), repeat=3)]


def motion(kind, rng, upright):
    axis = np.eye(3)[rng.integers(3)] if upright else rng.normal(size=3)
    return ElementaryMotion(kind, axis / np.linalg.norm(axis), rng.normal(size=3), 0, int(rng.choice([-1, 1])))


def taken(motions, values, point):
    for own, value in zip(reversed(motions), reversed(values), strict=True):
        point = applied(own, np.asarray(value), point)
    return point


@pytest.mark.parametrize("upright", [False, True])
@pytest.mark.parametrize("kinds", KINDS)
def test_the_values_by_which_it_was_taken_are_among_them_and_all_do_it(kinds, upright):
    rng = np.random.default_rng(5)
    solved = 0
    for _ in range(12):
        motions = [motion(kind, rng, upright) for kind in kinds]
        values, point = rng.uniform(-1.5, 1.5, 3), rng.normal(size=3)
        place = taken(motions, values, point)
        try:
            closure = point_closure(motions, point, place, 3.0)
        except MovingLimbError:  # slides of one direction, or a point on its axis
            assert upright
            continue
        sure = closure.values[closure.bent == 0.0]
        assert np.min(np.max(np.abs(sure - values), axis=1)) < 1e-6
        assert all(np.allclose(taken(motions, row, point), place, rtol=0, atol=1e-9) for row in sure)
        solved += 1
    assert solved >= (12 if not upright else 1)


def test_they_are_all():
    """Against Newton's method from everywhere, for three turns about any axes: four at most."""
    rng = np.random.default_rng(3)
    counts = set()
    for _ in range(2):
        motions = [motion("turn", rng, upright=False) for _ in range(3)]
        point = rng.normal(size=3)
        place = taken(motions, rng.uniform(-3, 3, 3), point)
        closure = point_closure(motions, point, place, 3.0)
        angles = np.exp(1j * closure.values[closure.bent == 0.0])
        ours = {tuple(row) for row in np.round(np.concatenate([angles.real, angles.imag], axis=1), 5) + 0.0}
        met = set()
        for start in itertools.product(np.linspace(-2.6, 2.6, 4), repeat=3):
            values = np.array(start)
            for _ in range(25):
                gap = taken(motions, values, point) - place
                slopes = np.stack(
                    [(taken(motions, values + 1e-6 * e, point) - place - gap) / 1e-6 for e in np.eye(3)], 1
                )
                values = values - np.linalg.lstsq(slopes, gap, rcond=None)[0]
            if np.linalg.norm(taken(motions, values, point) - place) < 1e-10:
                turned = np.exp(1j * values)
                met.add(tuple(np.round([*turned.real, *turned.imag], 5) + 0.0))
        assert ours == met
        counts.add(len(ours))
    assert counts <= {2, 4}


def test_a_point_that_comes_onto_an_axis_leaves_its_turn_open():
    turns = [ElementaryMotion("turn", axis, np.zeros(3), k, 1) for k, axis in enumerate(np.eye(3)[[2, 0]])]
    with pytest.raises(MovingLimbError):
        point_closure(turns, np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]), 1.0)
    assert len(point_closure(turns, np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.8, 0.6]), 1.0).values) > 0
