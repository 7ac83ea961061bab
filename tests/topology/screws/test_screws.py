import dataclasses

import numpy as np
import pytest

from assur.errors import UnknownNameError, UsageError
from assur.topology.notation import parse_chain
from assur.topology.screws.placing import place
from twist_chains import closure_jacobian, joint_twists, poses, residuals

PAPER = ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]")
EVERY_JOINT = ("R[x] P[0.6,0,0.8] H[y] C[z] U[x,z] S",)
DELTA = ("R[y] P(4S)[y]", "R[0.6,0.8,0] P(2US)[0.6,0.8,0]", "R[x] P(4U)[x]")
LOOP = ("R[x] P[0.6,0,0.8] C[z]", "H[y] U[x,z] S")
LINKAGES = [PAPER, LOOP, DELTA]


def _placed(texts, seed=0):
    return place([parse_chain(text) for text in texts], seed=seed)


def _from_platform(linkage):
    """The same linkage on its platform: most joints are now passed from child to parent."""
    return dataclasses.replace(linkage, base=linkage.platform, platform=linkage.base)


def _random(linkage, count=3, seed=1):
    total = sum(joint.type.freedoms for joint in linkage.joints.values())
    return np.random.default_rng(seed).uniform(-1.5, 1.5, (count, total))


def _differences(function, values, step=1e-5):
    """Central differences (..., n) by each joint value."""
    columns = []
    for column in range(values.shape[1]):
        moved = np.zeros(values.shape[1])
        moved[column] = step
        columns.append((function(values + moved) - function(values - moved)) / (2 * step))
    return np.stack(columns, axis=-1)


def test_a_planar_arm_is_where_trigonometry_puts_it():
    arm = _placed(["R[z] R[z] R[z]"], seed=4)
    angles = _random(arm, 5)
    points = [joint.point[:2] for joint in arm.joints.values()]
    spans = [end - start for start, end in zip(points, [*points[1:], arm.point[:2]], strict=True)]
    total, expected = np.zeros(5), np.tile(points[0], (5, 1))
    for turn, span in zip(angles.T, spans, strict=True):
        total = total + turn
        expected += np.stack(
            [np.cos(total) * span[0] - np.sin(total) * span[1], np.sin(total) * span[0] + np.cos(total) * span[1]], -1
        )
    rotation, shift = poses(arm, angles)["platform"]
    np.testing.assert_allclose((rotation @ arm.point + shift)[:, :2], expected, atol=1e-13)
    np.testing.assert_allclose(np.arctan2(rotation[:, 1, 0], rotation[:, 0, 0]), np.angle(np.exp(1j * total)))


def test_a_helix_advances_by_its_pitch_and_a_cylinder_by_its_translation():
    screw = _placed(["H[x]"])
    pitch = screw.joints["H1"].screws[0, 3]
    rotation, shift = poses(screw, np.array([[2 * np.pi]]))["platform"]
    np.testing.assert_allclose(rotation[0], np.eye(3), atol=1e-14)
    np.testing.assert_allclose(shift[0], [2 * np.pi * pitch, 0, 0], atol=1e-14)
    rotation, shift = poses(_placed(["C[y]"]), np.array([[0.7, 2 * np.pi]]))["platform"]
    np.testing.assert_allclose(rotation[0], np.eye(3), atol=1e-14)
    np.testing.assert_allclose(shift[0], [0, 0.7, 0], atol=1e-14)


@pytest.mark.parametrize("texts", LINKAGES)
def test_every_pose_is_a_displacement_and_home_is_none(texts):
    linkage = _placed(texts)
    values = _random(linkage)
    values[0] = 0.0
    found = poses(linkage, values)
    assert set(found) == set(linkage.links)
    for rotation, shift in found.values():
        np.testing.assert_allclose(rotation[0], np.eye(3), atol=1e-14)
        np.testing.assert_allclose(shift[0], 0, atol=1e-14)
        np.testing.assert_allclose(
            rotation @ rotation.swapaxes(1, 2), np.broadcast_to(np.eye(3), (3, 3, 3)), atol=1e-13
        )
        np.testing.assert_allclose(np.linalg.det(rotation), 1.0)


def test_seen_from_the_platform_the_base_moves_the_opposite_way():
    linkage = _placed(EVERY_JOINT)
    values = _random(linkage)
    rotation, shift = poses(linkage, values)["platform"]
    back, away = poses(_from_platform(linkage), values)["base"]
    np.testing.assert_allclose(back, rotation.swapaxes(1, 2), atol=1e-13)
    np.testing.assert_allclose(away, -np.einsum("Nji,Nj->Ni", rotation, shift), atol=1e-13)


@pytest.mark.parametrize("texts", [EVERY_JOINT, ("P(4R)[x] R[y]",)])
@pytest.mark.parametrize("turned", [False, True])
def test_joint_twists_are_the_derivatives_of_poses(texts, turned):
    linkage = _placed(texts)
    linkage = _from_platform(linkage) if turned else linkage
    linkage = dataclasses.replace(linkage, length=2.5, point=np.array([0.3, -0.2, 0.5]))
    values = _random(linkage)

    def matrices(at):
        return np.stack([np.concatenate([r, p[..., None]], -1) for r, p in poses(linkage, at).values()], 1)

    rates = _differences(matrices, values)  # (N, links, 3, 4, n)
    here = matrices(values)
    spin = np.einsum("Nlijn,Nlkj->Nlnik", rates[..., :3, :], here[..., :3])
    moved = np.moveaxis(rates[..., 3, :], -1, -2) - np.einsum("Nlnij,Nlj->Nlni", spin, here[..., 3])
    omega = np.stack([spin[..., 2, 1], spin[..., 0, 2], spin[..., 1, 0]], -1)
    found = np.concatenate([omega, moved], -1)  # (N, links, n, 6), of each link against the base
    links = list(poses(linkage, values))
    twists = joint_twists(linkage, values)
    compared = 0
    for joint in linkage.joints.values():
        place_of = linkage.slices[joint.name]
        relative = found[:, links.index(joint.child)] - found[:, links.index(joint.parent)]
        for column in range(place_of.start, place_of.stop):
            if np.any(relative[:, column]):  # a joint outside the tree moves nothing in poses
                np.testing.assert_allclose(twists[:, :, column], relative[:, column], atol=1e-8)
                compared += 1
    assert compared == len(values[0]) - len(linkage.groups)


@pytest.mark.parametrize("texts", LINKAGES)
@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("size", [0.02, 1.0])
def test_the_closure_jacobian_is_the_derivative_of_the_residuals_also_where_loops_are_open(texts, turned, size):
    linkage = _placed(texts)
    linkage = _from_platform(linkage) if turned else linkage
    linkage = dataclasses.replace(linkage, length=3.0)
    values = size * _random(linkage)
    expected = _differences(lambda at: residuals(linkage, at), values)
    np.testing.assert_allclose(
        closure_jacobian(linkage, values), expected, atol=2e-8 * max(1.0, np.max(np.abs(expected)))
    )


def test_the_papers_mechanism_has_seventeen_screws_and_four_loops_closed_at_home():
    linkage = _placed(PAPER)
    home = np.zeros((1, 17))
    assert residuals(linkage, home).shape == (1, 24)
    np.testing.assert_allclose(residuals(linkage, home), 0.0, atol=1e-15)
    assert np.max(np.abs(residuals(linkage, _random(linkage)))) > 0.1


def test_size_and_place_leave_residuals_as_they_are():
    linkage = _placed(PAPER)
    values = _random(linkage)
    shift, size = np.array([40.0, -70.0, 10.0]), 250.0
    joints = {}
    for name, joint in linkage.joints.items():
        screws = joint.screws.copy()
        turning = np.any(screws[:, :3], axis=1)
        screws[turning, 3:] *= size
        screws[turning, 3:] += np.cross(shift, screws[turning, :3])
        joints[name] = dataclasses.replace(joint, screws=screws, point=size * joint.point + shift)
    moved = dataclasses.replace(linkage, joints=joints, point=size * linkage.point + shift, length=size)
    lengths = np.array([size if joint.type.letter == "P" else 1.0 for joint in linkage.joints.values()])
    np.testing.assert_allclose(residuals(moved, values * lengths), residuals(linkage, values), atol=1e-12)


def test_misuse_is_named():
    linkage = _placed(["R[x] R[y]"])
    with pytest.raises(UnknownNameError, match="unknown link 'plattform'"):
        poses(dataclasses.replace(linkage, platform="plattform"), np.zeros((1, 2)))
    alone = dataclasses.replace(linkage.joints["R2"], parent="a", child="b")
    apart = dataclasses.replace(linkage, joints={"R1": linkage.joints["R1"], "R2": alone}, platform="link 1")
    with pytest.raises(UsageError, match="no joints connect the links a, b with the base"):
        poses(apart, np.zeros((1, 2)))
