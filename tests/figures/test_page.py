import dataclasses

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

import assur
from assur.errors import UsageError
from assur.figures import catalogue as figures
from assur.figures.context import Context
from assur.figures.encode import encoded
from assur.figures.page import HIGHEST, WIDTHS, page_width
from assur.figures.style import MILLIMETRE, SMALL

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


def test_the_walk_over_letters_sees_what_is_too_small_or_off_the_page(monkeypatch):
    context = Context(assur.load("fivebar"))
    figure = figures.draw(context.record, "structure", context)
    figure.text(0.99, 0.5, "a word too long", fontsize=4)
    text, box = written(figure, monkeypatch)[-1]
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
