"""Measures of the model figure: every parameter is drawn, at its own length, or it is said truly why it is not."""

import numpy as np
import pytest

from assur.figures.labels import formula_text
from assur.figures.letters import letter
from assur.figures.measures import measures, placements
from assur.figures.model import _camera
from assur.model.dimensions import with_parameters
from assur.model.formula import parse
from assur.scene.skeleton import link_point


@pytest.fixture
def shown(every):
    return measures(every.schematic, _camera(every))


def test_every_parameter_is_lettered_once_or_said_why_not(every, shown):
    rods = {name for rod in every.schematic.rods if rod.length for name in parse(rod.length).names}
    lettered = [name for part in shown.lettered for name in part.names]
    assert {*lettered} | rods | {*shown.undrawn} == {*every.record.parameters}
    assert not {*lettered} & {*shown.undrawn}
    assert len(shown.lettered) == len({part.latex for part in shown.lettered})


def test_steps_lead_from_the_origin_of_a_link_to_the_point(every):
    skeleton = every.schematic
    record, frames = skeleton.record, skeleton.frames
    for item in placements(skeleton):
        ends = [frames[item.link][1], *(step.points[1] for step in item.steps)]
        for start, step in zip(ends, item.steps, strict=False):
            np.testing.assert_array_equal(step.points[0], start)
        platform = frames[item.link][0] @ record.platform.point + frames[item.link][1]
        named = item.point in record.points or item.point in record.joints
        at = link_point(record, frames, item.link, item.point) if named else platform
        if all(formula.names or not float(np.abs(value)) for formula, value in _components(record, item)):
            np.testing.assert_allclose(ends[-1], at, atol=1e-9 * skeleton.size)


def _components(record, item):
    """Formulas and values of a placement: a number that no parameter enters has no step."""
    if item.point in record.joints:
        joint = record.joints[item.point]
        side = joint.written.at if item.link == joint.parent else joint.written.child_at
    else:
        side = record.points[item.point].written if item.point in record.points else record.platform.written
    return [(part, part.evaluate(vars(record.values))) for part in side.parts]


def test_a_step_with_one_letter_is_as_long_as_its_parameter(every, shown):
    parameters = every.schematic.record.parameters
    own = {formula_text(name)[1:-1]: name for name in parameters}
    for part in shown.lettered:
        if part.latex in own and part not in shown.arcs:
            np.testing.assert_allclose(part.size, abs(parameters[own[part.latex]].value), rtol=1e-9)
    for arc in shown.arcs:
        item = next(item for item in shown.placements if item.arc is arc)
        corner = every.schematic.frames[item.link][1]
        turned = np.cross(arc.points[:-1] - corner, arc.points[1:] - corner)
        small = np.linalg.norm(turned, axis=1) / np.sum((arc.points[1:] - corner) ** 2, axis=1)
        value = parameters[next(iter(arc.names))].inside
        np.testing.assert_allclose(np.sum(np.arcsin(small)), abs(value), rtol=1e-9)


def test_what_is_said_of_parameters_that_are_not_drawn_is_so(every, shown):
    record = every.record
    for name, reason in shown.undrawn.items():
        if reason == "zero":
            assert record.parameters[name].value == 0.0
            continue
        together = [other for other, own in shown.undrawn.items() if own == reason] if "axis" in reason else [name]
        changed = with_parameters(record, **{other: 1.01 * record.parameters[other].value + 0.1 for other in together})
        pairs = [(one, changed.joints[joint]) for joint, one in record.joints.items()]
        moved = [a.name for a, b in pairs if not (np.allclose(a.at, b.at) and np.allclose(a.child_at, b.child_at))]
        turned = [a.name for a, b in pairs if not np.allclose(a.axes, b.axes)]
        others = [other for other, one in changed.parameters.items() if one.value != record.parameters[other].value]
        assert bool(turned) == reason.startswith("direction of the axis"), (name, reason)
        assert (others != together) == reason.startswith("it is in"), (name, reason)
        if reason.startswith("coordinates of"):
            assert {reason} == {f"coordinates of {letter(joint)}" for joint in moved}
        elif reason != "seen end on":
            assert not moved or reason.startswith("it is in"), (name, reason)
