"""Operation modes and sides of the platform: signs of what limbs hold a platform to, besides those of the limbs."""

from collections import Counter

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.frames import frames
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.kinematics.closing_blocks.platform_signs import FacingSign, OperationSign, _ends_in_singularities
from assur.kinematics.closure import assemble
from assur.kinematics.modes import mode_texts, without_letter
from assur.kinematics.naming import sign_meanings, signs_at
from assur.kinematics.position import inverse
from assur.model.registry import load_record
from assur.numerics.rotations import to_quaternion
from regular_walks import distances


def draft(folder, *words):
    path = folder / "own.toml"
    assert main(["new", str(path), *words]) == 0
    return load_record(str(path))


@pytest.fixture(scope="module")
def tilting(tmp_path_factory):
    return draft(tmp_path_factory.mktemp("drafts"), "3-SPR")


@pytest.fixture(scope="module")
def crossed(tmp_path_factory):
    return draft(tmp_path_factory.mktemp("drafts"), "2UPR-2RPU")


def by_mode(record, pose):
    answer = inverse(record, pose)
    joints = answer.joints[answer.exists]
    turn = to_quaternion(frames(record, joints)[record.platform.link][0])
    return [str(label) for label in answer.labels[answer.exists]], joints, turn


def test_a_platform_between_planes_of_its_own_has_two_operation_modes(tilting):
    """Its turn from home has no part about z, or half a turn about z comes before one that has none: x0 x3 = 0.

    In either mode one pose of four is on home's side of where legs lose the platform, or three are.
    """
    names = list(sign_meanings(tilting, "inverse"))
    place = names.index("platform")
    assert sign_meanings(tilting, "inverse")["platform"].endswith("about a line square to z")
    for pose in ([10.0, 20.0, 310.0], [150.0, 20.0, 100.0]):
        labels, _, turn = by_mode(tilting, pose)
        assert len(labels) == 64
        assert [label[place] == "+" for label in labels] == (np.abs(turn[:, 3]) < 1e-9).tolist()
        assert np.array_equal(np.abs(turn[:, 3]) < 1e-9, np.abs(turn[:, 0]) > 1e-9)
        assert sorted(Counter(map(without_letter, labels)).values()) == 16 * [1] + 16 * [3]


def test_letters_are_left_where_a_regular_path_joins_what_they_tell_apart(tilting):
    """Tilted about one foot and about the next: from one to the other on a way on which nothing is singular."""
    joints, target = (by_mode(tilting, [0.0, 0.0, 300.0])[k] for k in (1, 2))
    tilts = np.concatenate([np.full(30, -np.pi / 2), np.linspace(-np.pi / 2, np.pi / 6, 60), np.full(30, np.pi / 6)])
    heights = np.concatenate([np.linspace(-240.0, 0.0, 30), np.zeros(60), np.linspace(0.0, -240.0, 30)])
    poses = np.array([_between_planes(tilt, height) for tilt, height in zip(tilts, heights, strict=True)])
    turns = np.array([[1.0, 3.0 * np.cos(tilt), 3.0 * np.sin(tilt), 0.0] for tilt in tilts]) / np.sqrt(10.0)
    alike = signs_at(tilting, "inverse", joints)
    begun, ended = (
        np.flatnonzero((np.linalg.norm(target - turns[k], axis=1) < 1e-3) & np.all(alike[:, 1:4] > 0, axis=1))
        for k in (0, -1)
    )
    values = joints[begun[:1]]
    least = []
    for pose in [*poses, np.array([0.0, 0.0, 300.0])]:
        closed = assemble(tilting, values, poses=pose[None], near=True)
        assert closed.closed[0]
        values = closed.values
        least.append(float(distances(tilting, "inverse", values)[0]))
        assert np.array_equal(signs_at(tilting, "inverse", values)[0], alike[begun[0]])
    assert min(least) > 0.1 * np.median(distances(tilting, "inverse", assemblies_by_chance(tilting)))
    assert np.allclose(
        frames(tilting, values)["platform"][0], frames(tilting, joints[ended[:1]])["platform"][0], atol=1e-6
    )
    assert begun[0] != ended[0]


def _between_planes(tilt, height):
    """The point of a platform that is turned from home about a line square to z: its planes hold the feet."""
    feet, normals = (
        np.array([[np.cos(own), np.sin(own), 0.0] for own in np.radians([0.0, 120.0, 240.0]) + turned])
        for turned in (0.0, np.pi / 2)
    )
    w, x, y = 1.0, 3.0 * np.cos(tilt), 3.0 * np.sin(tilt)
    rotation = np.array(
        [
            [w * w + x * x - y * y, 2 * x * y, 2 * w * y],
            [2 * x * y, w * w - x * x + y * y, -2 * w * x],
            [-2 * w * y, 2 * w * x, w * w - x * x - y * y],
        ]
    ) / (w * w + x * x + y * y)
    rows = normals @ rotation.T
    return rows.T @ np.einsum("ki,ki->k", rows, 200.0 * feet) / 1.5 + height * rotation[:, 2]


def test_every_way_of_a_platform_that_hangs_on_crossed_hinges_has_a_name(crossed):
    """It is turned about x, then about its own y: on either side of x, and leaning to either side; four legs."""
    labels, _, turn = by_mode(crossed, [12.0, 20.0, 300.0])
    assert len({*labels}) == len(labels) == 64
    assert not any(label[-1].isalpha() for label in labels)
    meanings = sign_meanings(crossed, "inverse")
    place = [*meanings.values()].index("the platform's x axis is less than 90 deg from x")
    rotation_xx = 1.0 - 2.0 * np.sum(turn[:, 2:] ** 2, axis=1)
    assert [label[place] == "+" for label in labels] == (rotation_xx > 0.0).tolist()
    assert 0 < np.sum(rotation_xx > 0.0) < 64


def test_what_changes_where_nothing_is_singular_is_no_sign(crossed):
    """The platform's z axis may be square to the base's at regular assemblies, its x axis to the base's at none."""
    screws = ScrewColumns(crossed, assemblies_by_chance(crossed))
    at_home = frames(crossed, screws.values[:1])["platform"][0][0]
    kept = [_ends_in_singularities(FacingSign(k, k, float(at_home[k, k])), screws) for k in range(3)]
    assert kept == [True, False, False]


def test_where_operation_modes_meet_the_sign_is_zero(tilting):
    home, form = np.eye(3), np.diag([1.0, 0.0, 0.0, -1.0])
    sign = OperationSign(home, form, np.array([[0.0], [0.0], [1.0]]))
    values = assemblies_by_chance(tilting)
    signs = sign.signs(ScrewColumns(tilting, values, platform=False))
    assert {*signs.tolist()} == {-1, 1}
    assert mode_texts(signs[:1, None]).tolist() == ["+"]
