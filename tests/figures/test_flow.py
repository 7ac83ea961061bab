"""What the flow says must be what the numbers do: a step moves with an input only if an arrow leads there."""

import numpy as np
import pytest

import assur
from assur.figures.context import Context
from assur.figures.flow import FLOW, boxes
from assur.kinematics.position import direct
from assur.model.closed_form import Eliminant, PolynomialSystem

STEP = 1e-4


def upstream(found, name):
    wants = found[name].needs
    return {name}.union(*(upstream(found, want) for want in wants)) if wants else {name}


@pytest.fixture
def sensitive(context, data):
    """Quantity or pose coordinate -> the inputs that move it, by differences."""
    data("flow")
    record = context.record
    given = context.assemblies.given
    mode = record.modes.default_assembly

    def values(inputs):
        solved = direct(record, inputs, mode)
        found = {name: solved.poses[0, k] for k, name in enumerate(record.platform.pose)}
        names = [item.name for item in record.closed_form.quantity_list]
        return found | {name: solved.quantities(name)[0] for name in names}

    moved: dict[str, set[str]] = {}
    for k, item in enumerate(record.inputs):
        span = STEP * max(1.0, abs(given[k]))
        step = span * np.eye(len(given))[k]
        high, low = values(given + step), values(given - step)
        for name in high:
            rate = abs(high[name] - low[name]) / (2 * span)
            size = max(1.0, abs(high[name]))
            moved.setdefault(name, set())
            if rate > 1e-6 * size:
                moved[name].add(item.name)
    return moved


def test_nothing_moves_with_an_input_that_no_arrow_comes_from(context, sensitive):
    found = boxes(context)
    inputs = {item.name for item in context.record.inputs}
    shown = [name for name in sensitive if name in found]
    assert shown
    for name in shown:
        assert sensitive[name] <= upstream(found, name) & inputs, name


def test_the_pose_comes_from_the_inputs_that_move_it_and_no_others(context, sensitive):
    found = boxes(context)
    inputs = {item.name for item in context.record.inputs}
    for name in context.record.platform.pose:
        assert upstream(found, name) & inputs == sensitive[name], name


def test_arrows_lead_downwards_from_inputs_to_the_pose(context, data):
    found = data("flow")
    row = {node["name"]: node["row"] for node in found["nodes"]}
    assert all(row[start] < row[end] for start, end in found["arrows"])
    kinds = {node["name"]: node["kind"] for node in found["nodes"]}
    assert {name for name, kind in kinds.items() if kind == "input"} == {item.name for item in context.record.inputs}
    assert {name for name, kind in kinds.items() if kind == "pose"} == set(context.record.platform.pose)
    ends = {start for start, _ in found["arrows"]} | {end for _, end in found["arrows"]}
    assert ends == set(kinds)


def test_every_sign_of_the_direct_problem_is_chosen_once(every):
    chosen = sorted(box.sign for box in boxes(every).values() if box.sign)
    kernel = every.record.closed_form and every.record.closed_form.direct
    if isinstance(kernel, Eliminant):
        signs = kernel.signs
    elif kernel is None or isinstance(kernel, PolynomialSystem):
        signs = ()
    else:
        signs = every.record.modes.assembly
    assert chosen == sorted(signs)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("zeng2019", "choices of sign give"),
        ("planar_3rrr", "A polynomial of degree 6 is left: at most 6 poses."),
        ("three_rps", "A polynomial of degree 4 is left after 2 choices of sign: at most 16 poses."),
        ("gough_stewart", "The system of polynomials has 40 complex solutions."),
    ],
)
def test_the_caption_counts_what_the_closed_form_finds(name, said):
    assert said in FLOW.caption(Context(assur.load(name)))


def test_no_step_stands_alone(every):
    if FLOW.missing(every) == "":
        found = boxes(every)
        used = {want for box in found.values() for want in box.needs}
        assert [name for name, box in found.items() if not box.needs and name not in used] == []


def test_every_mechanism_with_a_closed_form_of_the_direct_problem_has_a_flow(every):
    form = every.record.closed_form
    assert (FLOW.missing(every) == "") == (form is not None and form.direct is not None)
