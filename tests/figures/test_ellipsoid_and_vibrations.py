"""Figures of stiffness: what they draw is what stiffness answers, and without springs the file is told which lack."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex

import assur
from assur.figures import catalogue as figures
from assur.figures.letters import dimension
from assur.figures.page import HIGHEST
from assur.figures.style import MILLIMETRE
from assur.machine.elasticity.stiffness import stiffness_at
from assur.model.machine_data import MachineData
from bending import bending
from own_machines import ELASTIC, own_machine

STRAINED = ("stiffness", "weakest", "vibrations")


@pytest.fixture(scope="module")
def drawn():
    return figures.Context(assur.load("zeng2019"))


def test_the_ellipsoid_has_the_axes_of_the_compliance(drawn):
    data = figures.drawing(drawn.record, "stiffness", drawn).data
    compliance = stiffness_at(drawn.record, drawn.drawn_joints[None]).compliance[0, :3, :3]
    for stiff, way in zip(data["stiffness"], data["directions"], strict=True):
        np.testing.assert_allclose(compliance @ way, way / stiff, rtol=1e-7, atol=1e-16)
    assert sum(data["links"].values()) == pytest.approx(1.0)
    assert f"{data['stiffness'][0] / 1e6:.4g}" in figures.spec(drawn.record, "stiffness", drawn).caption


def test_the_darkest_link_is_strained_most(drawn):
    figure, data = (getattr(figures.drawing(drawn.record, "stiffness", drawn), part) for part in ("figure", "data"))
    bars = figure.axes[1]
    names = [label.get_text() for label in bars.get_yticklabels()]
    printed = {dimension(name): name for name in [*data["links"], "actuators"]}
    names = [printed[name] for name in names]
    assert names[0] == max(data["links"], key=data["links"].get) == "link12"
    assert [bar.get_width() for bar in bars.patches] == pytest.approx([100 * data["links"][name] for name in names])
    assert sum(line.get_color() == "#800026" for line in figure.axes[0].lines) == 1
    drawn_links = {line.get_color() for line in figure.axes[0].lines}
    assert {
        to_hex(bar.get_facecolor()) for bar, name in zip(bars.patches, names, strict=True) if name != "actuators"
    } <= drawn_links


def test_vibrations_are_drawn_as_far_apart_as_they_move(drawn):
    made = figures.drawing(drawn.record, "vibrations", drawn)
    shapes = drawn.kept("mode shapes", lambda: pytest.fail("they are kept"))
    assert [item["frequency"] for item in made.data["shapes"]] == [shape.frequency for shape in shapes]
    for shape in shapes:
        ways, rest = shape.deflected(0.02), shape.deflected(0.0)
        gone = [np.linalg.norm(ways[link] - rest[link], axis=-1).max() for link in ways]
        assert max(gone) == pytest.approx(0.02)
        for link in shape.shares.links.keys() & ways.keys():
            assert ways[link].shape[1:] == (9, 3)


def test_a_file_without_springs_says_the_line_that_lacks(drawn):
    bare = figures.Context(replace(drawn.record, machine=MachineData()))
    why = figures.left_out(bare.record, bare)
    assert all("stiffness" in why[name] and "P1" in why[name] for name in STRAINED)


def _room_beside(figure):
    """Inches between what is drawn and the nearest edge of the page."""
    drawn_box = figure.get_tightbbox(FigureCanvasAgg(figure).get_renderer())
    (left, bottom), (right, top) = drawn_box.min, figure.get_size_inches() - drawn_box.max
    return min(left, bottom, right, top)


@pytest.mark.parametrize(
    "name", ["three_prr", *(pytest.param(name, marks=pytest.mark.deep) for name in ("par4", "hybrid", *ELASTIC))]
)
@pytest.mark.parametrize("width", [88.9, pytest.param(175.0, marks=pytest.mark.deep)])
def test_of_a_drafted_machine_they_are_drawn_on_the_page_in_colours_of_its_links(name, width):
    record = bending(own_machine(name))
    context = figures.Context(record, page=width)
    for kind in ("stiffness", "vibrations"):
        figure = figures.drawing(record, kind, context).figure
        assert _room_beside(figure) > -0.01
        assert figure.get_figheight() <= HIGHEST * MILLIMETRE + 1e-9
    whole = figures.drawing(record, "stiffness", context)
    machine, bars = whole.figure.axes[:2]
    shown = {line.get_color() for line in machine.lines} | {to_hex(face.get_edgecolor()) for face in machine.patches}
    named = zip((label.get_text() for label in bars.get_yticklabels()), bars.patches, strict=True)
    links = {dimension(link) for link in record.links}
    coloured = [to_hex(bar.get_facecolor()) for text, bar in named if text in links]
    assert len(coloured) > 2
    assert set(coloured) <= shown
