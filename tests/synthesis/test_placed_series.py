import numpy as np
import pytest

from assur.errors import UsageError
from assur.synthesis.placed_series import at_point, best_of, following, series_of
from assur.topology.notation import parse_chain

HALF_TURN = np.array([[np.pi / 2, np.pi / 2, np.pi / 2]])


def series(text, seed=0):
    return series_of([parse_chain(text)], np.random.default_rng(seed))


def test_axes_through_the_point_leave_it_at_rest():
    rotation, place, twists = series("R[x]@O R[y]@O R[z]@O").at(HALF_TURN)
    assert np.allclose(place, 0.0)
    assert np.allclose(twists[:, 3:], 0.0)
    assert np.allclose(rotation, [[[0, 0, 1], [0, -1, 0], [1, 0, 0]]]), (
        "a quarter turn about x, then y, then z of the body"
    )


def test_slides_move_the_point_along_turned_directions():
    _, place, _ = series("R[z]@O P[x] P[y]").at(np.array([[np.pi / 2, 2.0, 3.0]]))
    assert np.allclose(place, [[-3.0, 2.0, 0.0]])


@pytest.mark.parametrize("text", ["R[x] U[y@O,z] P[x] R[x]@O", "C[z] S P[y]", "S@O P[x] R[y]"])
def test_twists_are_derivatives_of_poses(text):
    limb = series(text)
    values = np.random.default_rng(3).uniform(-0.5, 0.5, limb.turning.shape)
    _, place, twists = limb.at(values)
    step = 1e-6
    for joint in range(values.shape[1]):
        moved = values.copy()
        moved[:, joint] += step
        rates = (limb.at(moved)[1] - place) / step
        expected = twists[:, 3:, joint] + np.cross(twists[:, :3, joint], place)
        assert np.allclose(rates, expected, atol=1e-5)


@pytest.mark.parametrize(
    ("text", "leader", "follows"),
    [
        ("R[z] R[z] R[z]", "P[x] P[y] R[z]", True),
        ("R[x]@O R[y]@O R[z]@O", "R[z]@O R[x]@O", True),
        ("R[x]@O R[y]@O", "R[y]@O R[x]@O", False),
        ("R[x]@O R[z] R[z] R[z] R[y]@O", "R[x]@O R[y]@O R[z]@O", True),
        ("R[x]@O R[z] R[z] R[z] R[y]", "R[x]@O R[y]@O R[z]@O", False),
    ],
)
def test_a_series_follows_another_by_finite_displacements_or_not(text, leader, follows):
    lead = series(leader)
    values = np.random.default_rng(1).uniform(-0.1, 0.1, (3, lead.axes.shape[1]))
    limb = series(text)
    reached, joints = following(limb, lead, values)
    assert reached.tolist() == [follows]
    if follows:
        for pose, own in zip(values, joints[0], strict=True):
            for mine, other in zip(limb.at(own[None])[:2], lead.at(pose[None])[:2], strict=True):
                assert np.allclose(mine, other, atol=1e-9)


def test_the_drawing_that_is_farthest_from_losing_a_freedom_is_taken():
    draws = [series("R[z] R[z] R[z]", seed) for seed in range(3)]
    smallest = [np.linalg.svd(one.at(np.zeros((1, 3)))[2], compute_uv=False)[0, -1] for one in draws]
    assert np.array_equal(best_of(draws).points, draws[int(np.argmax(smallest))].points)


def test_velocities_are_told_at_another_point():
    twists = series("R[z]@O").at(np.zeros((1, 1)))[2]
    assert np.allclose(at_point(twists, np.array([1.0, 0.0, 0.0]))[0, :, 0], [0, 0, 1, 0, 1, 0])


def test_parallelograms_are_refused():
    with pytest.raises(UsageError, match="parallelogram"):
        series("P(4R)[x]")
