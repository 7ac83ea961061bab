import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from assur.figures.canvas import canvas
from assur.figures.placing import Letters, _length_inside
from assur.figures.style import styled


def boxes(page):
    renderer = FigureCanvasAgg(page.figure).get_renderer()
    return [item.get_window_extent(renderer) for item in page.axes.texts]


def test_labels_of_one_point_do_not_cover_one_another():
    with styled():
        page = canvas(60, 60)
        letters = Letters(page)
        for name in ("first", "second", "third", "fourth", "fifth"):
            letters.add(np.array([85.0, 85.0]), name)
        letters.place()
        found = boxes(page)
    for k, first in enumerate(found):
        for second in found[:k]:
            assert not first.overlaps(second)


def test_a_label_keeps_off_lines_and_near_its_own():
    with styled():
        page = canvas(60, 60)
        letters = Letters(page)
        own = np.array([[20.0, 60.0], [150.0, 60.0]])
        other = np.array([[20.0, 90.0], [150.0, 90.0]])
        letters.avoid(own)
        letters.avoid(other)
        letters.add_along(own, "between")
        letters.place()
        (box,) = boxes(page)
    middle = (box.y0 + box.y1) / 2
    assert abs(middle - 60.0) < abs(middle - 90.0)
    assert not box.y0 <= 60.0 <= box.y1


def test_of_several_points_a_label_stands_at_the_first_that_is_free():
    points = np.array([[40.0, 85.0], [85.0, 85.0], [130.0, 85.0]])
    middles = []
    for taken in (0, 1):
        with styled():
            page = canvas(60, 60)
            letters = Letters(page)
            for point in points[:taken]:
                letters.avoid_box(point + np.array([[-25.0, -60.0], [25.0, 60.0]]))
            letters.add(points, "s")
            letters.place()
            (box,) = boxes(page)
        middles.append(np.array([box.x0 + box.x1, box.y0 + box.y1]) / 2)
    nearest = [int(np.argmin(np.linalg.norm(points - middle, axis=1))) for middle in middles]
    assert nearest == [0, 1]


def test_length_of_lines_inside_boxes():
    lines = np.array(
        [
            [[0.0, 0.5], [2.0, 0.5]],
            [[0.5, -1.0], [0.5, 3.0]],
            [[5.0, 5.0], [6.0, 6.0]],
            [[0.0, 0.0], [1.0, 1.0]],
        ]
    )
    found = _length_inside(np.array([[0.0, 0.0, 1.0, 1.0], [10.0, 10.0, 11.0, 11.0]]), lines)
    np.testing.assert_allclose(found, [1.0 + 1.0 + np.sqrt(2), 0.0])
