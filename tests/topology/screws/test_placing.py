import dataclasses

import numpy as np
import pytest

from assur.errors import UnknownNameError, UsageError
from assur.topology.chains import Chain
from assur.topology.notation import parse_chain
from assur.topology.screws.placing import place


def _placed(*texts, **options):
    return place([parse_chain(text) for text in texts], **options)


def _moments(linkage):
    return {name: joint.screws for name, joint in linkage.joints.items()}


def _on_axis(joint, point, screw=0):
    """Distance of a point from the axis of a rotation."""
    axis, moment = joint.screws[screw, :3], joint.screws[screw, 3:]
    return np.linalg.norm(np.cross(point, axis) - moment)


def test_a_seed_gives_one_linkage_and_another_seed_another():
    text = "{P[y] R[x] R[x] | P[y] R[x] R[x]} P(4R)[y]"
    first, again, other = (_moments(_placed(text, seed=seed)) for seed in (3, 3, 4))
    assert all(np.array_equal(first[name], again[name]) for name in first)
    assert not all(np.array_equal(first[name], other[name]) for name in first)


def test_axes_are_as_written_and_equal_axes_are_distinct_lines():
    linkage = _placed("R[x] R[x] R[0,0.6,0.8] P[-y] R[x]")
    directions = [[1, 0, 0], [1, 0, 0], [0, 0.6, 0.8], [1, 0, 0]]
    turning = [joint for joint in linkage.joints.values() if joint.type.letter == "R"]
    np.testing.assert_allclose([joint.screws[0, :3] for joint in turning], directions)
    np.testing.assert_allclose(linkage.joints["P1"].screws, [[0, 0, 0, 0, -1, 0]])
    parallel = [turning[0], turning[1], turning[3]]
    for one in parallel:
        assert _on_axis(one, one.point) < 1e-15
        for other in parallel:
            assert one is other or _on_axis(one, other.point) > 1e-3


def test_a_label_is_one_point_in_all_limbs():
    first, second = (parse_chain("R[x]@A R[y]@B R[z]@A") for _ in range(2))
    joints = list(place([first, second]).joints.values())
    assert np.array_equal(joints[0].point, joints[2].point)
    assert not np.array_equal(joints[0].point, joints[1].point)
    assert np.array_equal(joints[0].point, joints[3].point)
    assert np.array_equal(joints[3].point, joints[5].point)


def test_a_label_reaches_into_the_branches_of_an_inner_loop():
    joints = list(_placed("{S@N R[x] S | S@N R[y] S} S").joints.values())
    assert np.array_equal(joints[0].point, joints[3].point)


def test_joints_with_several_freedoms_are_rows_of_screws_through_one_point():
    linkage = _placed("U[x,z] S C[y] H[z]")
    for name, axes in (("U1", [[1, 0, 0], [0, 0, 1]]), ("S1", np.eye(3))):
        joint = linkage.joints[name]
        np.testing.assert_allclose(joint.screws[:, :3], axes)
        assert all(_on_axis(joint, joint.point, row) < 1e-15 for row in range(len(axes)))
    cylinder, helix = linkage.joints["C1"], linkage.joints["H1"]
    np.testing.assert_allclose(cylinder.screws[0], [0, 0, 0, 0, 1, 0])
    np.testing.assert_allclose(cylinder.screws[1, :3], [0, 1, 0])
    assert _on_axis(cylinder, cylinder.point, 1) < 1e-15
    advance = helix.screws[0, 3:] - np.cross(helix.point, helix.screws[0, :3])
    np.testing.assert_allclose(advance[:2], 0, atol=1e-15)
    assert 0.3 <= abs(advance[2]) <= 0.6


@pytest.mark.parametrize("kind", ["4R", "4S", "4U", "2US"])
def test_a_parallelogram_has_two_equal_rods_and_two_equal_short_links(kind):
    linkage = _placed(f"P[z] P({kind})[0,0.6,0.8] P[x]", seed=2)
    (group,) = linkage.groups.values()
    a, b, c, d = (linkage.joints[name] for name in group.joints)
    assert (group.parent, group.child, group.kind) == ("link 1", "link 2", f"P({kind})")
    assert [(joint.parent, joint.child) for joint in (a, b, c, d)] == [
        (group.parent, a.child),
        (a.child, group.child),
        (d.child, group.child),
        (group.parent, d.child),
    ]
    axis = np.array([0, 0.6, 0.8])
    short, rod = d.point - a.point, b.point - a.point
    np.testing.assert_allclose(c.point - d.point, rod, atol=1e-15)
    np.testing.assert_allclose(c.point - b.point, short, atol=1e-15)
    lean = np.linalg.norm(np.cross(short, rod)) / np.linalg.norm(short) / np.linalg.norm(rod)
    assert lean > 0.7  # far from flat
    if kind == "4R":
        np.testing.assert_allclose([short @ axis, rod @ axis], 0, atol=1e-15)
    else:
        np.testing.assert_allclose(np.cross(short, axis), 0, atol=1e-15)
        assert abs(rod @ axis) > 1e-2  # a parallelogram in general, no rectangle


def test_the_joints_of_a_parallelogram_have_the_axes_that_keep_it_moving():
    normal = {}
    for kind in ("4R", "4U", "2US"):
        linkage = _placed(f"P({kind})[x]")
        a, b, c, d = linkage.joints.values()
        plane = np.cross(b.point - a.point, d.point - a.point)
        normal[kind] = plane / np.linalg.norm(plane), [joint.screws[:, :3] for joint in (a, b, c, d)]
    assert all(np.array_equal(axes, [[1, 0, 0]]) for axes in normal["4R"][1])
    across, (a, b, c, d) = normal["4U"]
    for near, far in ((a, b), (d, c)):
        np.testing.assert_allclose(near[0], [1, 0, 0])
        np.testing.assert_allclose(np.abs(near[1] @ across), 1.0)
        np.testing.assert_allclose(far, near[::-1])
    across, (a, b, c, d) = normal["2US"]
    assert [len(axes) for axes in (a, b, c, d)] == [2, 3, 3, 2]
    np.testing.assert_allclose(np.abs(a[1] @ across), 1.0)


def test_the_branches_of_an_inner_loop_join_the_same_two_links():
    linkage = _placed("R[z] {P[y] R[x] | {R[x] | R[x]} R[x]} R[y]")
    ends = [(joint.parent, joint.child) for joint in linkage.joints.values()]
    assert ends == [
        ("base", "link 1"),
        ("link 1", "link 3"),
        ("link 3", "link 2"),
        ("link 1", "link 4"),
        ("link 1", "link 4"),
        ("link 4", "link 2"),
        ("link 2", "platform"),
    ]


@pytest.mark.parametrize(
    ("text", "joint"),
    [
        ("R[x] R[y]", "R2"),
        ("R[z] P[x] P[y]", "R1"),
        ("R[x] S P[z]", "S1"),
        ("R[x] P(4R)[y]", "R1"),
        ("R[x] P(4S)[y]", "Pa1.b"),
        ("R[z] {P[y] | P[y] R[y]} P[x]", "R1"),
    ],
)
def test_the_base_point_of_a_chain_alone_is_on_its_last_axis_or_centre(text, joint):
    linkage = _placed(text)
    assert [name for name, item in linkage.joints.items() if np.array_equal(item.point, linkage.point)] == [joint]


@pytest.mark.parametrize("texts", [("R[x] R[y]", "R[x] R[y]"), ("R[z] {P[y] R[x] | P[y] R[x] R[x]} P[x]",)])
def test_the_base_point_of_several_limbs_or_of_a_loops_output_is_on_no_axis(texts):
    linkage = _placed(*texts)
    turning = [joint for joint in linkage.joints.values() if joint.type.letter == "R"]
    assert all(_on_axis(joint, linkage.point) > 1e-3 for joint in turning)


def test_joints_keep_unique_names_and_others_are_called_by_limb_and_place():
    limb = parse_chain("P[x] {R[x] R[x] | R[x] P(4R)[x]} R[x]")
    assert list(place([limb]).joints) != list(place([limb, limb]).joints)
    both = list(place([limb, limb]).joints)
    pattern = ["P{}.1", "R{}.2", "R{}.3", "R{}.4", *(f"Pa{{}}.5.{letter}" for letter in "abcd"), "R{}.6"]
    assert both == [name.format(number) for number in (1, 2) for name in pattern]
    named = [dataclasses.replace(joint, name=name) for joint, name in zip(limb.elements[:1], ["drive"], strict=True)]
    assert list(place([Chain(tuple(named))]).joints) == ["drive"]


def test_inputs_are_the_one_freedom_or_the_translation_or_the_first_hinge():
    limb = parse_chain("P[x] C[y] P(4R)[z] U[x,y] S")
    names = [joint.name for joint in limb.joints]
    linkage = place([limb], actuated=names[:4])
    joints = list(linkage.joints)
    assert linkage.inputs == tuple((name, 0) for name in (joints[0], joints[1], joints[2], joints[6]))
    assert np.array_equal(linkage.joints[linkage.inputs[1][0]].screws[0, :3], [0, 0, 0])
    with pytest.raises(UsageError, match=r"spherical joint .* cannot be actuated"):
        place([limb], actuated=names[4:])
    with pytest.raises(UnknownNameError, match="unknown joint 'R99'"):
        place([limb], actuated=["R99"])


def test_nothing_to_place_is_refused():
    with pytest.raises(UsageError, match="no chain"):
        place([])
    with pytest.raises(UsageError, match="no joints"):
        place([Chain(())])
