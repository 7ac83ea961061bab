import dataclasses

import numpy as np
import pytest

import assur
from assur.figures import catalogue as figures
from assur.kinematics.answers.at_border import inputs_at_border
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import closure_error
from assur.workspace.region import workspace


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


def test_indices_of_a_followed_workspace_are_those_of_the_closed_form():
    record = assur.load("fivebar")
    bare = dataclasses.replace(record, closed_form=None)
    found = workspace(bare, resolution=16)
    points = found.box.spread(60, np.random.default_rng(2)).reshape(6, 10, 2)
    here, known = figures.Context(bare, found).indices_at(points), figures.Context(record).indices_at(points)
    for name in ("condition", "largest", "smallest", "transmission"):
        both = np.isfinite(here[name]) & np.isfinite(known[name])
        assert np.sum(both) > 30
        np.testing.assert_allclose(here[name][both], known[name][both], rtol=1e-6)


def test_singular_examples_without_closed_form_are_drawn_where_they_were_met():
    bare = figures.Context(dataclasses.replace(assur.load("fivebar"), closed_form=None))
    assert bare.examples
    for example in bare.examples:
        (item,) = figures.drawing(bare.record, example.factor.kind, bare).data["examples"]
        np.testing.assert_array_equal(item["pose"], example.pose)
        assert closure_error(bare.record, example.joints) < 1e-6 * bare.skeleton.size


def test_aspects_are_cut_so_coarsely_that_they_take_seconds():
    """In a plane as by default; in space as many parts along each length, and twice as many along each angle."""
    assert figures.Context(assur.load("fivebar")).aspects.finest == assur.load("fivebar").aspects().finest
    turning = figures.Context(assur.load("planar_3rpr")).aspects
    spans = {name: high - low for name, (low, high) in zip(turning.box.names, turning.box.intervals, strict=True)}
    assert {name: spans[name] / size for name, size in turning.finest.items()} == pytest.approx(
        {"x": 32, "y": 32, "phi": 64}
    )


def test_the_file_configuration_is_reached(every):
    inputs = every.companion.inputs
    if inputs:
        drawn = inputs_at_border(every.record, inputs_of(every.record, every.drawn_joints))
        angles = [item.coordinate.kind == "angle" for item in every.record.inputs]
        turn = np.where(angles, 360.0 if every.record.angle == "deg" else 2 * np.pi, 1e9)
        np.testing.assert_allclose((drawn - inputs + turn / 2) % turn, turn / 2, atol=1e-8)
