"""Poses under conditions: no more than forty by sums of spheres, and the same by another homotopy."""

import numpy as np

from assur.kinematics.platforms import poses
from assur.kinematics.platforms.conditions import Conditions
from assur.kinematics.platforms.soma import PAIRS, SIZE, STUDY, norm_of, products, soma_of, spheres
from assur.numerics.homotopy import PathEnd, solve
from assur.numerics.rotations import from_quaternion


def test_the_sum_over_the_forty_moves_on_a_straight_line():
    """Only all points of an irreducible variety do so while a section of it moves in parallel (the trace test)."""
    quadrics, known = poses.start()
    assert len(known) == poses.MOST
    assert np.max(np.abs(products(known) @ quadrics.T)) < 1e-12
    first = (products(known) @ spheres().T / norm_of(known)[:, None]).sum(axis=0)
    shift = np.outer(np.random.default_rng(3).normal(size=6), spheres()[-1])
    traces, parts = [first], [first[: len(known) // 2]]
    for share in (0.5, 1.0):
        ends = solve(poses._between(quadrics, quadrics + share * shift), known)
        assert np.all(ends.end == PathEnd.regular)
        traces.append((products(ends.x) @ spheres().T / norm_of(ends.x)[:, None]).sum(axis=0))
        parts.append((products(ends.x[:39]) @ spheres().T / norm_of(ends.x[:39])[:, None]).sum(axis=0))
    size = np.max(np.abs(traces[2] - traces[0]))
    assert np.max(np.abs(traces[0] - 2 * traces[1] + traces[2])) < 1e-8 * size
    parts[0] = (products(known[:39]) @ spheres().T / norm_of(known[:39])[:, None]).sum(axis=0)
    assert np.max(np.abs(parts[0] - 2 * parts[1] + parts[2])) > 1e-4 * size  # without one of them it does not


def test_the_file_is_what_monodromy_gives():
    sums, known = poses.start_from_nothing(0)
    quadrics, stored = poses.start()
    assert np.allclose(sums @ spheres(), quadrics, rtol=0, atol=1e-12)
    assert len(known) == poses.MOST
    overlap = np.abs(known.conj() @ stored.T)
    assert np.all(np.max(overlap, axis=1) > 1 - 1e-9)


def drawn(rng, count):
    """Conditions that a pose by chance meets: distances of points, as many as asked for."""
    quaternion = rng.normal(size=4)
    rotation, place = from_quaternion(quaternion / np.linalg.norm(quaternion)), rng.normal(size=3)
    rows = []
    for a, b in rng.normal(size=(count, 2, 3)):
        square = np.sum((place + rotation @ b - a) ** 2)
        sums = np.concatenate([[1.0], -2 * a, 2 * b, -2 * np.outer(a, b).ravel(), [a @ a + b @ b - square]])
        rows.append(sums @ spheres())
    rows = np.array(rows) - np.outer(np.array(rows) @ STUDY, STUDY)
    return Conditions(np.zeros((0, SIZE)), np.linalg.qr(rows.T)[0].T), rotation, place


def test_one_distance_more_leaves_the_pose_alone():
    conditions, rotation, place = drawn(np.random.default_rng(4), 7)
    solved = poses.poses_under(conditions, 1.0)
    assert (solved.complex, len(solved.frames), solved.sure, solved.most) == (1, 1, True, 2 ** (SIZE - 1))
    assert np.allclose(solved.frames[0][0], rotation, rtol=0, atol=1e-9)
    assert np.allclose(solved.frames[0][1], place, rtol=0, atol=1e-9)


def test_six_have_forty_and_those_of_all_squares_are_the_same():
    conditions, _, place = drawn(np.random.default_rng(4), 6)
    solved = poses.poses_under(conditions, 1.0)
    assert (solved.complex, solved.most, solved.sure) == (40, 40, True)
    assert min(np.abs(own[1] - place).max() for own in solved.frames) < 1e-9
    forms = poses._restricted(np.concatenate([conditions.quadrics, STUDY[None]]), np.eye(SIZE))
    zeros = poses._followed(*poses._from_squares(forms.astype(complex), np.random.default_rng(0)), np.eye(SIZE))
    finite = zeros.values[zeros.regular & (np.abs(norm_of(poses._scaled(zeros.values))) > zeros.infinite)]
    assert len(finite) == 40


def test_five_leave_infinitely_many():
    assert poses.poses_under(drawn(np.random.default_rng(4), 5)[0], 1.0) is None


def test_linear_forms_alone_are_enough_for_a_known_pose():
    rng = np.random.default_rng(6)
    quaternion, place = rng.normal(size=4), rng.normal(size=3)
    soma = soma_of((from_quaternion(quaternion / np.linalg.norm(quaternion))[None], place[None]))
    linear = np.linalg.svd(soma)[2][1:]
    solved = poses.poses_under(Conditions(linear, np.zeros((0, len(PAIRS)))), 2.0)
    assert np.allclose(solved.frames[0][1], 2.0 * place, rtol=0, atol=1e-12)


def test_as_many_linear_forms_as_coordinates_leave_no_pose():
    none = poses.poses_under(Conditions(np.eye(SIZE), np.zeros((0, len(PAIRS)))), 1.0)
    assert (none.complex, none.frames, none.sure) == (0, (), True)
