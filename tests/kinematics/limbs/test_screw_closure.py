"""Values of a screw beside turns and slides: those from which places were made, and as many as samples tell."""

import numpy as np
import pytest

from assur.kinematics.limbs.point_closure import MovingLimbError, point_closure
from assur.kinematics.limbs.screw_closure import screw_closure
from assur.kinematics.limbs.serial import ElementaryMotion, NotSerialError, applied

X, Y, Z = np.eye(3)


def turn(axis, point):
    return ElementaryMotion("turn", np.asarray(axis, dtype=float), np.asarray(point, dtype=float), 1, 1)


def slide(axis):
    return ElementaryMotion("slide", np.asarray(axis, dtype=float), np.zeros(3), 2, 1)


SCREW = ElementaryMotion("screw", Z, np.zeros(3), 0, 1, advance=0.2)
CENTRE = np.array([0.5, 0.3, 0.2])
OTHERS = {
    "turns that meet": ([turn(X, CENTRE), turn(Y, CENTRE)], lambda p: np.linalg.norm(p - CENTRE, axis=-1)),
    "parallel turns": ([turn([0.6, 0, 0.8], CENTRE), turn([0.6, 0, 0.8], X)], lambda p: p @ [0.6, 0, 0.8]),
    "slides": ([slide(X), slide([0, 0.6, 0.8])], lambda p: p @ [0, -0.8, 0.6]),
    "a turn and a slide": ([slide(Y), turn([0.6, 0, 0.8], X)], lambda p: p @ [0.6, 0, 0.8]),
}
"""Two motions, and what they leave as it is of a point."""


def moved(motions, values, point):
    for motion, value in reversed([*zip(motions, values, strict=True)]):
        point = applied(motion, np.asarray(value), point)
    return point


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("last", [False, True])
@pytest.mark.parametrize("others", OTHERS)
def test_no_value_is_missing(others, last, sense):
    own, kept = OTHERS[others]
    screw = ElementaryMotion("screw", Z, np.array([0.1, -0.2, 0.0]), 0, sense, advance=0.2)
    motions = [*own, screw] if last else [screw, *own]
    for seed in range(2):
        random = np.random.default_rng(seed)
        known, point = random.uniform(-2, 2, 3), random.uniform(-1, 1, 3)
        place = moved(motions, known, point)
        closure = screw_closure(motions, 2 if last else 0, point, place, 1.0)
        reached = np.array([moved(motions, values, point) for values in closure.values])
        np.testing.assert_allclose(reached, np.broadcast_to(place, reached.shape), atol=1e-9)
        assert np.min(np.max(np.abs(closure.values - known), axis=1)) < 1e-8
        angles = np.linspace(-100.0, 100.0, 40_001)
        on_way, still = (point, place) if last else (place, point)
        back = screw if last else screw.back
        away = kept(applied(back, angles, on_way)) - kept(still)
        seen = closure.values[:, 2 if last else 0]
        assert np.max(np.abs(seen)) < 100.0
        for k in np.flatnonzero(np.diff(np.sign(away))):  # one that is not listed is out of the others' reach
            angle = angles[k] - away[k] * (angles[k + 1] - angles[k]) / (away[k + 1] - away[k])
            if np.min(np.abs(seen - angle)) > 1e-3:
                there = applied(back, np.asarray(angle), on_way)
                assert not len(point_closure(own, *((there, place) if last else (point, there)), 1.0).values)


def test_a_rod_that_just_reaches_is_met_twice_in_one_place_and_said_to_be_bent():
    turns = [turn(X, np.zeros(3)), turn(Y, np.zeros(3))]
    level = np.array([0.6, 0.8, 0.0])  # the ball is level with the nut
    closure = screw_closure([SCREW, *turns], 0, Z, level, 1.0)
    assert len(closure.values) > 0
    assert np.all(np.abs(closure.values[:, 0]) < 1e-3)
    assert np.all(closure.bent > 1e-6)


def test_out_of_reach_there_is_none():
    turns = [turn(X, np.zeros(3)), turn(Y, np.zeros(3))]
    assert len(screw_closure([SCREW, *turns], 0, Z, 3.0 * X, 1.0).values) == 0


def test_a_screw_whose_advance_the_others_take_up_closes_in_infinitely_many_ways():
    with pytest.raises(MovingLimbError):
        screw_closure([SCREW, slide(Z), slide(X)], 0, X + Y, X + Y, 1.0)


def test_what_is_no_distance_and_no_height_is_refused():
    with pytest.raises(NotSerialError, match="beside its axis"):
        screw_closure([SCREW, turn(X, CENTRE), turn([0, 0.6, 0.8], Y)], 0, X, Y, 1.0)
    with pytest.raises(NotSerialError, match="between two other motions"):
        screw_closure([turn(X, CENTRE), SCREW, turn(Y, CENTRE)], 1, X, Y, 1.0)
