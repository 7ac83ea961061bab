import dataclasses
from dataclasses import replace
from itertools import pairwise

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

import assur
from assur.errors import UsageError
from assur.figures import catalogue as figures
from assur.figures.context import Context
from assur.figures.coordinates import dress
from assur.figures.encode import encoded
from assur.figures.page import HIGHEST, WIDTHS, page_width
from assur.figures.style import MILLIMETRE, SMALL, new_figure

LEAST = 7.0
"""Points of letters in print; their indices are smaller, as in every formula."""


def written(figure, monkeypatch):
    """What of the texts of a figure is really drawn: (text, its box in px), hidden ticks left out."""
    drawn, draw = [], Text.draw

    def noted(self, *arguments, **options):
        if self.get_visible() and self.get_text().strip():
            drawn.append(self)
        return draw(self, *arguments, **options)

    monkeypatch.setattr(Text, "draw", noted)
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    return [(text, text.get_window_extent(renderer)) for text in drawn]


def narrowed(context, width):
    """The same with what is worked out already, drawn for another page."""
    names = {item.name for item in dataclasses.fields(context)}
    twin = dataclasses.replace(context, page=width, _kept={})
    vars(twin).update({name: value for name, value in vars(context).items() if name not in names})
    return twin


QUICK = ("structure", "model", "solutions", "flow", "serial", "workspace", "dexterity", "transmission", "graph")
"""Of each way in which a figure is laid out one."""


@pytest.mark.parametrize(
    ("context", "width", "names"),
    [
        ("fivebar", "ieee", QUICK),
        ("zeng2019", "ieee", ("planes", "projections", "sections")),
        *(
            pytest.param(name, width, None, marks=pytest.mark.deep)
            for name in ("fivebar", "zeng2019", "planar_3rrr")
            for width in WIDTHS
        ),
    ],
    indirect=["context"],
)
def test_every_figure_fits_its_page_with_letters_that_can_be_read(context, width, names, monkeypatch):
    page = narrowed(context, WIDTHS[width])
    for name in names or figures.names(page.record, page):
        figure = figures.draw(page.record, name, page)
        wide, tall = figure.get_size_inches() / MILLIMETRE
        assert wide <= page.page + 0.1, name
        assert tall <= HIGHEST + 10.0, name
        texts = written(figure, monkeypatch)
        assert texts
        for text, box in texts:
            assert text.get_fontsize() >= LEAST, (name, text.get_text())
            inside = figure.bbox.padded(0.5)
            assert inside.contains(box.x0, box.y0), (name, text.get_text())
            assert inside.contains(box.x1, box.y1), (name, text.get_text())
        assert not touching(figure, texts), name


def touching(figure, texts):
    """Numbers at ticks of an axis across that are nearer to each other than half a letter is wide."""
    boxes = dict(texts)
    pairs = []
    for axes in figure.axes:
        row = sorted((boxes[label] for label in axes.get_xticklabels() if label in boxes), key=lambda box: box.x0)
        pairs += pairwise(row)
    return [(left, right) for left, right in pairs if right.x0 - left.x1 < 0.25 * SMALL / 72.0 * figure.dpi]


@pytest.mark.parametrize(("low", "high"), [(-1.0, 1.0), (-1e3, 1e3)])
def test_numbers_at_ticks_of_a_narrow_map_do_not_touch(low, high, monkeypatch):
    context = Context(assur.load("fivebar"))
    box = replace(context.workspace.box, low=(low, low), high=(high, high))
    figure = new_figure(60.0, 60.0)
    for k in range(3):
        dress(context, figure.add_axes((0.2, 0.1 + 0.3 * k, 0.28 + 0.1 * k, 0.15)), box, box.names)
    texts = written(figure, monkeypatch)
    assert len(texts) > 12
    assert not touching(figure, texts)


def test_the_walk_over_letters_sees_what_is_too_small_or_off_the_page(monkeypatch):
    context = Context(assur.load("fivebar"))
    figure = figures.draw(context.record, "structure", context)
    figure.text(0.99, 0.5, word := "a word too long", fontsize=4)
    ((text, box),) = [shown for shown in written(figure, monkeypatch) if shown[0].get_text() == word]
    assert text.get_fontsize() < LEAST
    assert box.x1 > figure.bbox.x1


def test_fonts_are_embedded_whole_letters_and_all():
    context = Context(assur.load("fivebar"), page=WIDTHS["ieee"])
    content = encoded(figures.draw(context.record, "structure", context), "pdf")
    assert content.count(b"/FontFile2") >= 1
    assert b"/Type3" not in content
    assert content.count(b"/FontDescriptor ") <= content.count(b"/FontFile2") * 3


@pytest.mark.parametrize("text", ["", *WIDTHS, "100"])
def test_widths_are_names_or_numbers(text):
    assert LEAST < page_width(text) <= 190.0


@pytest.mark.parametrize("text", ["acm", "-3", "79", "nan", "inf", "1e9", "88.9mm"])
def test_what_is_no_width_is_refused_with_those_there_are(text):
    with pytest.raises(UsageError) as caught:
        page_width(text)
    assert text in caught.value.message
    assert "elsevier1.5" in caught.value.hint


def test_letters_of_figures_are_at_least_so_large_by_their_style():
    assert SMALL >= LEAST
