from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

import assur
from assur.figures import solutions
from assur.figures.canvas import canvas
from assur.figures.catalogue import drawing
from assur.figures.context import Context
from assur.joint_graph.points import point
from assur.kinematics.position import direct
from assur.model.registry import load_record
from spherical import spherical


def test_all_listed_direct_solutions_are_drawn_and_close(context, data):
    found = data("solutions")
    solved = list(direct(context.record, found["inputs"]))
    assert len(found["solutions"]) == len(solved) == len(context.assemblies)
    for item in found["solutions"]:
        match = next(other for other in solved if other.mode == item["mode"])
        np.testing.assert_allclose(item["pose"], match.pose)
        assert item["residual"] < 1e-6 * context.skeleton.size
        joints = np.array(list(match.joints.values()))
        for name, at in item["points"].items():
            np.testing.assert_allclose(at, point(context.record, name, joints), atol=1e-9)


def test_the_drawn_configuration_is_number_one(context, data):
    first = data("solutions")["solutions"][0]
    for name, at in first["points"].items():
        np.testing.assert_allclose(at, context.skeleton.points[name], atol=1e-6)


def test_driven_joints_stand_at_one_place_in_all(context, data):
    sliders = [item.coordinate.joint for item in context.record.inputs]
    solutions = data("solutions")["solutions"]
    for item in solutions:
        for name in sliders:
            np.testing.assert_allclose(item["points"][name], solutions[0]["points"][name], atol=1e-6)


def test_a_mechanism_whose_joints_are_in_one_point_is_drawn(tmp_path):
    record = assur.load(spherical(tmp_path))
    drawn = drawing(record, "solutions")
    assert np.all(np.isfinite(drawn.figure.get_size_inches()))
    assert len(drawn.data["solutions"]) == 8


@pytest.mark.parametrize("width", [80.0, 110.0, 175.0])
def test_columns_of_the_table_stand_apart_on_any_page(width, monkeypatch):
    context = Context(load_record("gough_stewart"))  # seven coordinates
    monkeypatch.setattr(solutions, "_signs", lambda _: ())
    pose = np.array([-128.48712, -117.60832, 1259.40973, 0.91145, -0.19302, -0.36271, 0.0183])
    item = SimpleNamespace(number=16, solution=SimpleNamespace(pose=pose, assembly_mode="+++a"), colour="black")
    page = canvas(width, 20.0)
    solutions._table(context, page, [item, item], width, 18.0)
    texts = [text for text in page.axes.texts if text.get_text()]
    assert len(texts) == 8 + 2 * 9
    renderer = FigureCanvasAgg(page.figure).get_renderer()
    boxes = [text.get_window_extent(renderer) for text in texts]
    assert all(box.x0 >= 0.0 and box.x1 <= page.figure.bbox.width for box in boxes)
    for k, box in enumerate(boxes):
        assert not any(box.overlaps(other) for other in boxes[:k]), texts[k].get_text()
