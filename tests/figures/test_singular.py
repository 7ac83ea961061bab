"""The geometry that a factor's meaning claims, checked on the joint graph's points of the drawn configuration."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from assur.figures import catalogue as figures
from assur.figures.meaning import named, typeset
from assur.figures.singular import _value, symbol_of
from assur.joint_graph.points import point
from assur.kinematics.closure import closure_error
from assur.kinematics.position import inverse
from assur.kinematics.status import FACTOR_TOLERANCE, relative_factors
from assur.scene.skeleton import skeleton
from catalogue import each


def test_every_example_is_drawn_once(context, data):
    drawn = [item for name in ("serial", "parallel", "singular") for item in data(name)["examples"]]
    assert sorted(item["factor"] for item in drawn) == sorted(item.factor.name for item in context.examples)


def test_the_examples_of_the_source_have_their_own_figures(context, data):
    for kind in ("serial", "parallel"):
        (item,) = data(kind)["examples"]
        assert item["kind"] == kind
        drawn = {"zeng2019": {"serial": "u3", "parallel": "u1_minus_u2"}}.get(context.record.name, {})
        assert item["factor"] == drawn.get(kind, item["factor"])


def test_the_factor_vanishes_in_an_assembly(context):
    for seen in context.examples:
        solved = inverse(context.record, seen.pose, seen.mode)
        assert abs(relative_factors(context.record, solved.factors)[seen.factor.name][0]) <= FACTOR_TOLERANCE
        assert seen.status == solved.status[0]
        assert closure_error(context.record, seen.joints) < 1e-6 * context.skeleton.size


def test_what_is_called_collinear_or_parallel_is(context):
    checked = 0
    for seen in context.examples:
        body = skeleton(context.record, context.companion, seen.joints)
        meaning = seen.factor.meaning
        lines = [np.array([point(context.record, name, seen.joints) for name in run]) for run in _runs(meaning, body)]
        if "collinear" in meaning and lines:
            for line in lines:
                spread = np.linalg.svd(line - line.mean(axis=0), compute_uv=False)
                assert spread[1] < 1e-5 * body.size, meaning
            checked += 1
        if len(lines) == 2 and ("parallel:" in meaning or meaning.endswith("are parallel")):
            first, second = (line[1] - line[0] for line in lines)
            assert np.linalg.norm(np.cross(first, second)) < 1e-5 * body.size**2, meaning
            checked += 1
    assert checked >= 2 or context.record.name != "zeng2019"


@pytest.mark.parametrize("context", each(["fivebar", "zeng2019", "delta_4s"], ["fivebar", "zeng2019"]), indirect=True)
def test_no_text_is_a_cut_of_its_data_and_all_of_it_is_on_the_page(context):
    for figure in ("serial", "parallel", "singular"):
        drawing = figures.drawing(context.record, figure, context)
        page = drawing.figure.axes[0]
        said = " ".join(item.get_text() for item in page.texts)
        for item in drawing.data["examples"]:
            assert typeset(item["meaning"], context.skeleton) in said
            assert symbol_of(next(f.factor for f in context.examples if f.factor.name == item["factor"]))[1:-1] in said
        renderer = FigureCanvasAgg(drawing.figure).get_renderer()
        whole = drawing.figure.bbox
        for text in page.texts:
            box = text.get_window_extent(renderer)
            assert whole.x0 <= box.x0 <= box.x1 <= whole.x1, text.get_text()
            assert whole.y0 <= box.y0 <= box.y1 <= whole.y1, text.get_text()


@pytest.mark.parametrize("context", ["zeng2019"], indirect=True)
def test_factors_that_vanish_in_the_same_configuration_share_a_panel_headed_by_the_status_there(context):
    """Where u1 = 0 at the drawn configuration u2 = 0, too, so that the platform moves by itself."""
    drawing = figures.drawing(context.record, "singular", context)
    panels = {item["factor"]: item["panel"] for item in drawing.data["examples"]}
    assert panels["u1"] == panels["u2"]
    assert len(set(panels.values())) == len(panels) - 1
    (first, second) = (item for item in drawing.data["examples"] if item["factor"] in ("u1", "u2"))
    np.testing.assert_allclose(first["pose"], second["pose"], atol=1e-3)
    (heading,) = [item.get_text() for item in drawing.figure.axes[0].texts if item.get_text().startswith(panels["u1"])]
    assert "u_1 = 0" in heading
    assert "u_2 = 0" in heading
    assert heading.endswith("(self-motion)")


def _runs(meaning, body):
    found = named(meaning, body)
    places = {name: body.points[name] for name in found.letters}
    runs = []
    for line in found.lines:
        run = [next(name for name, at in places.items() if np.allclose(at, corner)) for corner in line if places]
        runs += [run] if len(run) > 1 else []
    return runs


@pytest.mark.parametrize(
    ("text", "lines", "letters"),
    [
        ("{0}{1} and {2}{3} are level", 2, 4),
        ("{0}, {1}, {2} are in line", 1, 3),
        ("{0} is alone", 0, 0),
        ("nothing is named", 0, 0),
    ],
)
def test_names_in_a_text(context, text, lines, letters):
    points = [name for name in context.skeleton.points if len(name) > 1][:4]
    found = named(text.format(*points), context.skeleton)
    assert (len(found.lines), len(found.letters)) == (lines, letters)


def test_the_caption_of_a_configuration_says_a_quaternion_to_four_digits():
    pose = ("x", "qw")
    record = SimpleNamespace(unit="mm", angle="deg", platform=SimpleNamespace(pose=pose))
    context = SimpleNamespace(record=record, skeleton=SimpleNamespace(size=500.0))
    assert [_value(context, name, 0.123456) for name in pose] == ["0.12 mm", "0.1235"]
