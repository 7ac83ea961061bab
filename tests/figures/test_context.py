from __future__ import annotations

import numpy as np
import pytest

import assur
from assur import figures
from assur.kinematics.closure import closure_error


@pytest.mark.parametrize("share", [0.9, 1.1])
def test_other_dimensions_are_drawn_as_they_are(context, share):
    """What cannot be reached any more is replaced by home, never by nothing."""
    lengths = {name: share * item.value for name, item in context.record.parameters.items() if item.unit != "deg"}
    first = next(iter(lengths))
    record = context.record.with_parameters(**{first: lengths[first]})
    other = figures.Context(record)
    for skeleton in (other.skeleton, other.schematic):
        assert closure_error(skeleton.record, skeleton.values) < 1e-6 * skeleton.size
    assert skeleton.record.parameters[first].value in (
        lengths[first],
        other.companion.schematic.parameters.get(first),
    )


def test_the_schematic_of_a_companion_is_reached():
    for name in assur.names():
        record = assur.load(name)
        if not figures.Context(record).companion.schematic.parameters:
            continue
        plan = figures.Context(record).companion.schematic
        assert figures.Context(record).schematic_note
        pose = dict(zip(record.platform.pose, plan.pose, strict=True))
        drawn = figures.Context(record).schematic
        origin = drawn.frames[record.platform.link][1]
        np.testing.assert_allclose([pose[axis] for axis in "xyz"], origin, atol=1e-6)
