import numpy as np

from assur.figures.dimensions import arcs


def test_an_arc_turns_by_its_angle_about_the_joint_from_where_the_value_is_zero(every):
    skeleton = every.skeleton
    found = arcs(skeleton, 0.1 * skeleton.size)
    drawn = {part.link for part in (*skeleton.rods, *skeleton.plates)}  # a shaft in one place shows no angle
    turned = [item.coordinate for item in every.record.inputs if item.coordinate.kind == "angle"]
    turning = [item for item in turned if every.record.joints[item.joint].child in drawn]
    assert found or not (turning or every.record.angles)
    marks = {mark.joint.name: mark for mark in skeleton.marks}
    for arc in found:
        coordinate = every.record.angles.get(arc.name) or next(
            item.coordinate for item in every.record.inputs if item.name == arc.name
        )
        axis = marks[coordinate.joint].axes[0]
        zero, now = arc.sides
        turned = np.arctan2(np.cross(zero, now) @ axis, zero @ now)
        np.testing.assert_allclose(np.exp(1j * turned), np.exp(1j * arc.value), atol=1e-9)
        radius = np.linalg.norm(arc.points - arc.corner, axis=1)
        np.testing.assert_allclose(radius, radius[0])
        np.testing.assert_allclose((arc.points[-1] - arc.corner) / radius[0], now, atol=1e-9)
        np.testing.assert_allclose((arc.points[0] - arc.corner) / radius[0], zero, atol=1e-9)


def test_the_zero_direction_stands_still_when_only_that_joint_moves(every):
    from assur.scene.skeleton import skeleton as skeleton_at

    for arc in arcs(every.skeleton, 10.0):
        coordinate = every.record.angles.get(arc.name) or next(
            item.coordinate for item in every.record.inputs if item.name == arc.name
        )
        values = every.drawn_joints.copy()
        values[coordinate.index] += 0.3
        moved = skeleton_at(every.record, every.companion, values)
        other = next(item for item in arcs(moved, 10.0) if item.name == arc.name)
        np.testing.assert_allclose(other.sides[0], arc.sides[0], atol=1e-9)
        assert np.linalg.norm(other.sides[1] - arc.sides[1]) > 0.1
