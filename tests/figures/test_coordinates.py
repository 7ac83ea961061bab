import numpy as np
import pytest

import assur
from assur.figures import catalogue as figures
from assur.figures.coordinates import angle_ticks, axis_title, drawn_span, held_words, plane_words, shown, value_words
from assur.workspace.region import workspace


def test_an_angle_is_drawn_as_long_as_the_lengths_and_shown_in_degrees():
    record = assur.load("planar_3rrr")
    given = figures.Context(record, workspace(record, resolution=8))
    x, y, phi = (drawn_span(given, name) for name in given.workspace.box.names)
    assert phi == pytest.approx((x + y) / 2)
    assert shown(given, "phi", np.pi) == pytest.approx(180)
    assert value_words(given, "phi", -np.pi / 2) == "−90°"


def test_lengths_alone_are_drawn_as_they_are(context):
    box = context.workspace.box
    if set(box.names) <= set("xyz"):
        assert [drawn_span(context, name) for name in box.names] == pytest.approx(np.subtract(box.high, box.low))


def test_units_and_planes(context):
    for name in context.workspace.box.names:
        assert axis_title(context, name).endswith("(mm)" if name in "xyz" else "(°)")
    assert plane_words("x", "z") == "XOZ"
    assert plane_words("x", "phi") == r"$x$ and $\phi$"


def test_what_is_held_stands_in_words():
    record = assur.load("planar_3rrr")
    given = figures.Context(record, workspace(record, resolution=8, held={"phi": np.pi / 6}))
    assert held_words(given) == r" with $\phi$ = 30° held"


@pytest.mark.parametrize(("low", "high"), [(-np.pi, np.pi), (-0.1, 0.2), (0.0, 1.0)])
def test_ticks_are_round_and_inside(low, high):
    ticks = angle_ticks(low, high)
    assert 2 <= len(ticks) <= 9
    assert np.all((np.degrees(low) - 1e-9 <= ticks) & (ticks <= np.degrees(high) + 1e-9))
    assert np.allclose(np.diff(ticks), np.diff(ticks)[0])
