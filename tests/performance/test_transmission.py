"""Transmission indices against sines of angles, against differences of the inverse solution, and at singularities."""

import numpy as np
import pytest

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import point
from assur.kinematics.closure import assemble
from assur.model.pose import LENGTHS
from assur.performance.transmission import transmission_at
from assur.singularity.examples import singular_examples
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains
from catalogue import each

TRANSLATIONAL = [name for name in assur.names() if set(assur.load(name).platform.pose) <= set(LENGTHS)]
SLIDES = [name for name in TRANSLATIONAL if {i.coordinate.kind for i in assur.load(name).inputs} == {"length"}]


def at_poses(mechanism, poses, mode=None):
    """Joint values and transmission indices at poses in a working mode."""
    joints = mechanism.inverse(poses, mode=mode or mechanism.modes.default_working).joints[:, 0]
    return joints, transmission_at(mechanism, joints)


def sine(first, second):
    """|sine| of the angle between vectors of a plane (..., 2)."""
    cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return np.abs(cross) / np.linalg.norm(first, axis=-1) / np.linalg.norm(second, axis=-1)


def places(mechanism, joints, *names):
    return [point(mechanism, name, joints) for name in names]


@pytest.mark.parametrize("mode", ["-+", "++", "+-"])
def test_five_bar_sines_of_the_angles_at_cranks_and_rods(mode, regular_poses):
    """B1 and B2 by the cosine rule, from nothing but the file's lengths."""
    mechanism = assur.load("fivebar")
    p = mechanism.values
    poses = regular_poses(mechanism, mode, 80)
    _, found = at_poses(mechanism, poses, mode)
    arms = []
    for k, side in enumerate((-1, 1)):
        away = poses - np.array([side * p.g, 0.0])
        distance = np.linalg.norm(away, axis=-1)
        at_motor = np.arccos((p.l1**2 + distance**2 - p.l2**2) / (2 * p.l1 * distance))
        turned = np.arctan2(away[:, 1], away[:, 0]) - (1 if mode[k] == "+" else -1) * at_motor
        crank = p.l1 * np.stack([np.cos(turned), np.sin(turned)], axis=-1)
        rod = away - crank
        np.testing.assert_allclose(np.linalg.norm(rod, axis=-1), p.l2, rtol=1e-12)
        np.testing.assert_allclose(found.inputs[:, k], sine(crank, rod), atol=1e-12)
        arms.append(rod)
    for k in range(2):
        np.testing.assert_allclose(found.outputs[:, k], sine(*arms), atol=1e-12)
    np.testing.assert_array_equal(found.local, np.min([found.inputs, found.outputs], axis=(0, 2)))
    np.testing.assert_array_equal(found.good, found.local >= 0.7)


@pytest.mark.parametrize("name", ["planar_3rrr", "planar_3rpr"])
def test_planar_mechanisms_by_the_instantaneous_centre(name, regular_poses):
    """With the other two inputs locked their rods turn about their first ends: the platform about where they meet."""
    mechanism = assur.load(name)
    joints, found = at_poses(mechanism, regular_poses(mechanism, mechanism.modes.default_working, 60))
    motors, ends = (of_link(mechanism, joints, link) for link in (mechanism.base, mechanism.platform.link))
    starts = motors if name == "planar_3rpr" else places(mechanism, joints, "leg1.B", "leg2.B", "leg3.B")
    motors, starts, ends = ([place[..., :2] for place in group] for group in (motors, starts, ends))
    rods = [end - start for end, start in zip(ends, starts, strict=True)]
    for k in range(3):
        i, j = (n for n in range(3) if n != k)
        system = np.stack([rods[i], -rods[j]], axis=-1)
        along = np.linalg.solve(system, (starts[j] - starts[i])[..., None])[:, 0]
        centre = starts[i] + along * rods[i]
        # the platform's corner runs across the line from the centre, the force along the rod
        np.testing.assert_allclose(found.outputs[:, k], sine(rods[k], ends[k] - centre), rtol=1e-8, atol=1e-10)
        expected = sine(starts[k] - motors[k], rods[k]) if name == "planar_3rrr" else 1.0
        np.testing.assert_allclose(found.inputs[:, k], expected, atol=1e-12)


def of_link(mechanism, joints, link):
    """Places of the joints that a link has, in the file's order."""
    names = [joint.name for joint in mechanism.joints.values() if link in (joint.parent, joint.child)]
    return places(mechanism, joints, *names)


@pytest.mark.parametrize("name", ["orthoglide", "linear_delta_4s", "linear_delta_4r", "three_p2us"])
def test_slides_that_drive_rods(name, regular_poses):
    """Input: cosine of the rod to its rail. Output: of the rod to what is across both others."""
    mechanism = assur.load(name)
    joints, found = at_poses(mechanism, regular_poses(mechanism, mechanism.modes.default_working, 40))
    rods, rails = (
        np.stack([one(mechanism, joints, k) for k in range(3)], axis=-2) for one in (rod_direction, input_direction)
    )
    for k in range(3):
        i, j = (n for n in range(3) if n != k)
        across = np.cross(rods[:, i], rods[:, j])
        expected = np.abs(np.sum(rods[:, k] * across, axis=-1)) / np.linalg.norm(across, axis=-1)
        np.testing.assert_allclose(found.outputs[:, k], expected, atol=1e-11)
        np.testing.assert_allclose(found.inputs[:, k], np.abs(np.sum(rods[:, k] * rails[:, k], axis=-1)), atol=1e-11)


@pytest.mark.parametrize("name", ["delta_4s", "fivebar", "three_rrc", "tsai_platform"])
def test_cranks_by_differences_of_the_inverse(name, regular_poses, slopes):
    """One unit of torque and the force f on the platform do the same work; the most that f could do is |f| |crank|."""
    mechanism = assur.load(name)
    poses = regular_poses(mechanism, mechanism.modes.default_working, 40)
    inverse = slopes(mechanism, poses, mechanism.modes.default_working)
    ok = np.all(np.isfinite(inverse), axis=(-1, -2))
    assert np.sum(ok) > 20
    joints, found = at_poses(mechanism, poses[ok])
    for k, item in enumerate(mechanism.inputs):
        motor = mechanism.joints[item.coordinate.joint]
        ends = [name for name, joint in mechanism.joints.items() if motor.child in (joint.parent, joint.child)]
        (start,) = places(mechanism, joints, motor.name)
        end = np.mean(places(mechanism, joints, *(name for name in ends if name != motor.name)), axis=0)
        axis = mechanism.frames(joints)[motor.parent][0] @ motor.axes[0]
        arm = np.linalg.norm(np.cross(axis, end - start), axis=-1)
        np.testing.assert_allclose(found.inputs[:, k], 1 / (np.linalg.norm(inverse[ok, k], axis=-1) * arm), rtol=1e-4)


@pytest.mark.parametrize("name", ["three_crr", "tripteron"])
def test_mechanisms_that_lose_nothing(name, regular_poses):
    mechanism = assur.load(name)
    _, found = at_poses(mechanism, regular_poses(mechanism, mechanism.modes.default_working, 20))
    np.testing.assert_allclose(found.local, 1.0, atol=1e-12)


def rod_direction(mechanism, joints, k):
    """Unit vector (N, 3) along a rod of one limb."""
    rod = next(link for link in mechanism.links if link.startswith(f"leg{k + 1}.") and "rod" in link)
    first, second = of_link(mechanism, joints, rod)
    return (second - first) / np.linalg.norm(second - first, axis=-1, keepdims=True)


def input_direction(mechanism, joints, k):
    """Direction (N, 3) in which a driven slide moves its link."""
    joint = mechanism.joints[mechanism.inputs[k].coordinate.joint]
    return mechanism.frames(joints)[joint.parent][0] @ joint.axes[0]


@pytest.mark.parametrize("name", TRANSLATIONAL)
def test_a_platform_that_does_not_turn_by_differences_of_the_inverse(name, regular_poses, slopes):
    """Force i is along row i of J^-1, motion i along column i of J: |cosine| = 1 / (|row i| |column i|)."""
    mechanism = assur.load(name)
    mode = mechanism.modes.default_working
    poses = regular_poses(mechanism, mode, 60)
    inverse = slopes(mechanism, poses, mode)
    ok = np.all(np.isfinite(inverse), axis=(-1, -2)) & (np.linalg.cond(np.nan_to_num(inverse) + 1e-300) < 1e3)
    assert np.sum(ok) > 30
    _, found = at_poses(mechanism, poses[ok])
    rows = np.linalg.norm(inverse[ok], axis=-1)
    columns = np.linalg.norm(np.linalg.inv(inverse[ok]), axis=-2)
    np.testing.assert_allclose(found.outputs, 1 / (rows * columns), rtol=1e-4)


@pytest.mark.parametrize("name", SLIDES)
def test_a_slide_that_drives_its_own_limb_by_differences_of_the_inverse(name, regular_poses, slopes):
    """One unit of force along the rail and the force f on the platform do the same work: cosine 1 / |row i of J^-1|."""
    mechanism = assur.load(name)
    poses = regular_poses(mechanism, mechanism.modes.default_working, 40)
    inverse = slopes(mechanism, poses, mechanism.modes.default_working)
    ok = np.all(np.isfinite(inverse), axis=(-1, -2))
    assert np.sum(ok) > 20
    _, found = at_poses(mechanism, poses[ok])
    cosines = 1 / np.linalg.norm(inverse[ok], axis=-1)
    own = [2] if name == "zeng2019" else [0, 1, 2]  # its slides 1 and 2 drive one hybrid chain
    np.testing.assert_allclose(found.inputs[:, own], cosines[:, own], rtol=1e-4)


@pytest.mark.parametrize("name", ["gough_stewart", "three_rps"])
def test_legs_push_along_themselves_on_what_moves_with_the_others_locked(name, regular_poses):
    """Output: cosine of a leg to the way of its ball joint, from assemblies with one leg a little longer, shorter."""
    mechanism = assur.load(name)
    poses = regular_poses(mechanism, mechanism.modes.default_working, 6)
    joints, found = at_poses(mechanism, poses)
    assert found.inputs == pytest.approx(1.0, abs=1e-9)
    held = list(mechanism.input_indices)
    step = 1e-6 * characteristic_length(mechanism)
    balls = [
        joint.name for joint in mechanism.joints.values() if mechanism.platform.link in (joint.parent, joint.child)
    ]
    for k, ball in enumerate(balls):
        ends = []
        for sign in (1.0, -1.0):
            start = joints.copy()
            start[:, held[k]] += sign * step
            near = assemble(mechanism, start, held=held, near=True)
            assert near.closed.all()
            ends.append(point(mechanism, ball, near.values))
        way = ends[0] - ends[1]
        leg = input_direction(mechanism, joints, k)
        cosine = np.abs(np.sum(way * leg, axis=-1)) / np.linalg.norm(way, axis=-1)
        np.testing.assert_allclose(found.outputs[:, k], cosine, rtol=1e-4)


@pytest.mark.parametrize("name", each())
def test_all_lie_between_0_and_1(name, regular_poses):
    mechanism = assur.load(name)
    _, found = at_poses(mechanism, regular_poses(mechanism, mechanism.modes.default_working, 30))
    for values in (found.inputs, found.outputs):
        assert np.all((values >= 0) & (values <= 1))
    assert np.ptp(found.local) > 1e-3 or name in ("three_crr", "tripteron")


@pytest.mark.parametrize("name", ["fivebar", "planar_3rrr", "tsai_platform", "zeng2019"])
def test_they_need_no_unit(name, regular_poses):
    mechanism = assur.load(name)
    joints, found = at_poses(mechanism, regular_poses(mechanism, mechanism.modes.default_working, 30))
    lengths = np.array([item.kind == "length" for item in mechanism.coordinates])
    bigger = mechanism.with_parameters(**{key: 2.54 * item.value for key, item in mechanism.parameters.items()})
    again = transmission_at(bigger, np.where(lengths, 2.54 * joints, joints))
    np.testing.assert_allclose(again.inputs, found.inputs, rtol=1e-7, atol=1e-10)
    np.testing.assert_allclose(again.outputs, found.outputs, rtol=1e-7, atol=1e-10)


@pytest.mark.parametrize("name", ["fivebar", "orthoglide", "planar_3rpr", "zeng2019"])
def test_they_go_to_zero_at_serial_and_parallel_singularities(name):
    mechanism = assur.load(name)
    seen = set()
    for example in singular_examples(mechanism):
        if example.status.name not in ("serial", "parallel"):
            continue
        joints = mechanism.inverse(example.pose, mode=example.mode).joints[0]
        found = transmission_at(mechanism, joints)
        worst = found.inputs if example.status.name == "serial" else found.outputs
        assert np.min(worst) < 1e-5
        seen.add(example.status.name)
    assert seen


def test_open_loops_have_no_indices_and_any_batch_has_its_shape():
    mechanism = assur.load("fivebar")
    home = mechanism.home_values
    values = np.stack([home, home + 0.1])
    found = transmission_at(mechanism, values)
    assert np.isfinite(found.local).tolist() == [True, False]
    assert not found.good[1]
    for batch in ((), (1,), (3, 1, 2), (0,)):
        assert transmission_at(mechanism, np.broadcast_to(home, (*batch, 5))).outputs.shape == (*batch, 2)
    assert np.isnan(found.inputs[1]).all()


def test_slides_in_series_to_the_platform_lose_nothing_whatever_a_passive_leg_does(tmp_path):
    """What the slides bear passes no passive joint; along x and y they move the platform as an input of its own."""
    path = tmp_path / "own.toml"
    path.write_text(drafted(parse_chains(["P[x] P[y]", "R[z] P[x] R[z]"]), path, actuate=["1.1", "1.2"]).text)
    mechanism = assur.load(path)
    found = [transmission_at(mechanism, mechanism.inverse(pose).joints[0]) for pose in ([0.0, 0.0], [40.0, 60.0])]
    np.testing.assert_allclose([[own.inputs, own.outputs] for own in found], 1.0, rtol=0, atol=1e-9)


def test_many_configurations_give_what_single_ones_give(monkeypatch, regular_poses):
    mechanism = assur.load("zeng2019")
    joints, whole = at_poses(mechanism, regular_poses(mechanism, "++-++", 20))
    monkeypatch.setattr("assur.performance.transmission.BLOCK", 7)
    np.testing.assert_allclose(transmission_at(mechanism, joints).inputs, whole.inputs, rtol=1e-12)
