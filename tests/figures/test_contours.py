import numpy as np
import pytest
from matplotlib.path import Path

from assur.figures.contours import continued, draw_contours
from assur.figures.style import SMALL, new_figure


def test_colours_past_the_border_are_those_of_the_nearest_node():
    values = np.full((3, 4), np.nan)
    values[1, 1], values[1, 3] = 0.25, 0.75
    filled = continued(values)
    assert filled[1, 1] == filled[1, 0] == filled[0, 1] == 0.25
    assert filled[1, 3] == filled[2, 3] == 0.75


def test_a_plane_goes_on_straight_past_the_border():
    """So that contours run straight into it: those of the nearest node would turn to meet it at a right angle."""
    x, y = np.meshgrid(np.arange(12.0), np.arange(10.0))
    whole = 1.0 + 0.5 * x - 0.25 * y
    cut = np.where((x - 3) ** 2 + (y - 4) ** 2 < 30, whole, np.nan)
    filled, known = continued(cut), np.isfinite(cut)
    beside = ~known & ((x - 3) ** 2 + (y - 4) ** 2 < 38)
    assert np.sum(beside) > 3
    within = beside & (whole <= cut[known].max()) & (whole >= cut[known].min())
    np.testing.assert_allclose(filled[within], whole[within], atol=1e-12)
    assert np.all((filled >= cut[known].min()) & (filled <= cut[known].max()))


@pytest.fixture
def axes():
    figure = new_figure(80, 80)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-1, 1), ylim=(-1, 1))
    return axes


def drawn(axes, size, levels):
    """Contours of the distance from the middle inside a square of a half width."""
    nodes = np.linspace(-1, 1, 41)
    border = Path(size * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]), closed=True)
    draw_contours(axes, (nodes, nodes), np.hypot(nodes, nodes[:, None]), levels, border, {})
    return axes.texts


def test_each_level_has_its_number_on_its_line_away_from_the_border_and_from_others(axes):
    texts = drawn(axes, 0.95, [0.2, 0.5, 0.8])
    assert [text.get_text() for text in texts] == ["0.2", "0.5", "0.8"]
    places = np.array([text.get_position() for text in texts])
    np.testing.assert_allclose(np.hypot(*places.T), [0.2, 0.5, 0.8], atol=0.01)
    on_paper = axes.transData.transform(places)
    apart = np.linalg.norm(on_paper[:, None] - on_paper, axis=2)[np.triu_indices(3, 1)]
    assert np.min(apart) >= 20.0
    assert all(text.get_fontsize() == SMALL for text in texts)


def test_a_line_without_room_has_no_number(axes):
    assert not drawn(axes, 0.05, [0.02])
