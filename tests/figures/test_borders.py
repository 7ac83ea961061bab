import numpy as np
import pytest

from assur.figures.borders import kinds, on_margin, vanishing
from assur.kinematics.status import scale
from assur.model.pose import is_angle
from assur.workspace.fields import at_points


@pytest.fixture
def border(context):
    """Poses on the border of the workspace, with the margin that is zero there or ""."""
    found = context.workspace
    corners = found.vertices[found.faces]
    if len(found.box.names) == 3:
        poses = corners.mean(axis=1)[:: max(1, len(corners) // 400)]
    else:
        polygon = found.projection(*found.box.names).polygons[0]
        poses = (polygon + np.roll(polygon, -1, axis=0)) / 2
    return poses, kinds(context, poses)


def test_a_border_is_that_of_the_box_or_of_a_margin(context, border):
    poses, names = border
    scales = {item.name: scale(context.record, item.scale) for item in context.record.closed_form.inverse_margins}
    low, high = np.array(context.workspace.box.intervals).T
    assert {name for name in names if name} != set()
    for pose, name in zip(poses, names, strict=True):
        on_box = np.min(np.minimum(pose - low, high - pose) / (high - low)) < 1e-6
        if name:
            value = at_points(context.workspace.margins[name], len(pose), pose[None])[0]
            coarse = any(map(is_angle, context.workspace.box.names))  # cells of 15 degrees
            assert abs(value) < (0.1 if coarse else 0.01) * scales.get(name, 1.0)
        else:
            assert on_box


def test_what_is_said_to_vanish_vanishes_and_ends_the_working_mode(context, border):
    poses, names = border
    form = context.record.closed_form
    latex = {item.latex or item.name: item for item in form.factor_list}
    for name in dict.fromkeys(name for name in names if name in {item.name for item in form.inverse_margins}):
        pose = poses[names.index(name)]
        there = on_margin(context, name, pose)
        value = at_points(context.workspace.margins[name], len(pose), there[None])[0]
        margin = next(item for item in form.inverse_margins if item.name == name)
        assert abs(value) < 1e-9 * scale(context.record, margin.scale)
        assert np.linalg.norm(there - pose) < 0.05 * np.linalg.norm(np.ptp(context.workspace.box.intervals, axis=1))
        found = vanishing(context, name, pose)
        # two working modes merge where a margin is zero, so a factor of det Jq vanishes (or of both)
        assert "serial" in {latex[text].kind for text in found}
