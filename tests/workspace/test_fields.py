"""Fields of a mode: margins, strokes of lengths and of angles, values that do not exist."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.modes import all_modes
from assur.kinematics.status import scale
from assur.workspace.domain import box_of
from assur.workspace.fields import at_points, closed_form_fields, sample
from assur.workspace.grid import grid_over
from assur.workspace.slices import slice_at
from catalogue import each

SPATIAL, PLANE = assur.load("zeng2019"), assur.load("fivebar")


def columns_of(mechanism, count=4000, seed=5):
    poses = slice_at(mechanism)
    box = box_of(mechanism, None, poses.free)
    points = np.random.default_rng(seed).uniform(box.low, box.high, size=(count, len(box.names)))
    return poses.poses(points), tuple(points.T)


@pytest.mark.parametrize("name", each())
def test_no_margin_is_negative_exactly_where_the_inverse_problem_has_a_solution(name):
    mechanism = assur.load(name)
    poses, columns = columns_of(mechanism, count=500)
    points = np.stack(columns, axis=-1)
    for mode in all_modes(mechanism, "inverse"):
        fields = closed_form_fields(mechanism, mode, {item.name: None for item in mechanism.inputs})[0]
        inside = np.all([at_points(field, len(columns), points) >= 0 for field in fields.values()], axis=0)
        np.testing.assert_array_equal(inside, mechanism.inverse(poses, mode=mode).exists[:, 0])


@pytest.mark.parametrize("name", each())
def test_factors_are_those_of_the_inverse_solution_where_there_is_one(name):
    mechanism = assur.load(name)
    poses, columns = columns_of(mechanism, count=500)
    points = np.stack(columns, axis=-1)
    mode = mechanism.modes.default_working
    found = mechanism.inverse(poses, mode=mode)
    exists = found.exists[:, 0]
    assert np.sum(exists) > 20
    fields = closed_form_fields(mechanism, mode)[1]
    assert set(fields) == {item.name for item in mechanism.closed_form.factor_list if item.kind == "parallel"}
    for factor, field in fields.items():
        size = scale(mechanism, next(item.scale for item in mechanism.closed_form.factor_list if item.name == factor))
        np.testing.assert_allclose(
            at_points(field, len(columns), points)[exists],
            found.factors[factor][exists, 0],
            rtol=1e-12,
            atol=1e-12 * size,
        )


@pytest.mark.parametrize(("low", "high"), [(-2.5, -0.5), (1.0, 2.0), (0.5, 4.5), (2.0, 7.0), (-1.0, 9.0)])
@pytest.mark.parametrize(("sign", "offset"), [(1.0, 0.0), (-1.0, 0.7)])
def test_the_stroke_of_an_angle_holds_the_angles_between_its_ends(low, high, sign, offset):
    inputs = tuple(replace(item, sign=sign, offset=offset) for item in PLANE.inputs)
    mechanism = replace(PLANE, inputs=inputs)
    poses, columns = columns_of(mechanism)
    name = mechanism.inputs[1].name
    fields = closed_form_fields(mechanism, "-+", {name: (low, high)})[0]
    bare = closed_form_fields(mechanism, "-+")[0]
    found = mechanism.inverse(poses, mode="-+")
    angle = found.inputs[:, 0, 1]
    # some whole number of turns brings the angle into the stroke
    wanted = np.ceil((low - angle) / (2 * np.pi)) * 2 * np.pi + angle <= high
    inside = np.all([field(columns) >= 0 for key, field in fields.items() if key not in bare], axis=0)
    exists = found.exists[:, 0]
    assert np.sum(exists) > 200
    np.testing.assert_array_equal(np.broadcast_to(inside, exists.shape)[exists], wanted[exists])


def test_the_stroke_of_a_length_is_that_of_the_printed_value():
    inputs = (replace(SPATIAL.inputs[0], sign=-1.0, offset=12.0), *SPATIAL.inputs[1:])
    mechanism = replace(SPATIAL, inputs=inputs)
    poses, columns = columns_of(mechanism)
    fields = closed_form_fields(mechanism, "++-++", {"yA1": (-350.0, -150.0)})[0]
    found = mechanism.inverse(poses, mode="++-++")
    exists, q = found.exists[:, 0], found.inputs[:, 0, 0]
    np.testing.assert_allclose(fields["yA1 >= -350"](columns)[exists], q[exists] + 350, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(fields["yA1 <= -150"](columns)[exists], -150 - q[exists], rtol=1e-12, atol=1e-9)


def test_an_open_end_of_a_stroke_is_no_margin():
    bare = closed_form_fields(SPATIAL, "++-++")[0]
    assert set(closed_form_fields(SPATIAL, "++-++", {"yA2": (-np.inf, 5.0)})[0]) - set(bare) == {"yA2 <= 5"}
    assert set(closed_form_fields(SPATIAL, "++-++", {"yA2": (-np.inf, np.inf)})[0]) == set(bare)


def test_margins_run_smoothly_past_where_an_inner_radicand_is_negative():
    # M12 holds sin(alpha), which does not exist for x > 80: across x = 80 it must neither jump nor stop
    x = np.linspace(79.0, 81.0, 2001)
    values = closed_form_fields(SPATIAL, "++-++")[0]["M12"]((x, 0 * x, 300 + 0 * x))
    assert np.all(np.isfinite(values))
    assert np.max(np.abs(np.diff(values))) < 0.05 * (np.max(values) - np.min(values))
    assert np.all(np.diff(values) < 0) or np.all(np.diff(values) > 0)


def test_a_field_is_not_allowed_where_it_does_not_exist():
    grid = grid_over(box_of(SPATIAL, None), 8)

    def field(columns):
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.broadcast_to((columns[0] - grid.low[0]) / (columns[0] - grid.low[0]), grid.shape)

    values = sample(field, grid)
    assert np.all(np.isfinite(values))
    assert np.all(values[1] == -1.0)
    assert np.all(values[2:] == 1.0)


def test_a_sample_does_not_depend_on_its_blocks(monkeypatch):
    grid = grid_over(box_of(SPATIAL, None), 12)
    field = closed_form_fields(SPATIAL, "++-++")[0]["M3"]
    whole = sample(field, grid)
    blocks = type(grid).blocks
    monkeypatch.setattr(type(grid), "blocks", lambda self: blocks(self, size=300))
    np.testing.assert_array_equal(sample(field, grid), whole)
