import itertools

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex, to_rgb
from matplotlib.patches import Circle, PathPatch, Polygon

import assur
from assur.derived_topology import topology
from assur.figures.encode import encoded
from assur.figures.graph import edges, graph_drawing
from assur.figures.style import ORANGE, SERIES, styled
from assur.joints.catalogue import JOINT_TYPES
from assur.model.registry import topology_names
from assur.results.answers.solution_order import AssurChain, Loop
from assur.topology.screws.linkage import Group, Linkage, LinkageJoint
from catalogue import each

TYPES = {item.letter: item for item in JOINT_TYPES.values()}


def joint(name, start, end, letter=None):
    kind = TYPES[letter or name[0]]
    return LinkageJoint(name, kind, start, end, np.zeros((kind.freedoms, 6)), np.zeros(3))


def linkage(joints, inputs=(), groups=()):
    named = {item.name: item for item in joints}
    return Linkage(named, "base", "platform", np.zeros(3), {item.name: item for item in groups}, tuple(inputs))


def limbs(*texts):
    """Joints of serial limbs, "UPS" -> U1.1, P1.2, S1.3."""
    joints = []
    for k, text in enumerate(texts, 1):
        links = ["base", *(f"{k}.{step}" for step in range(1, len(text))), "platform"]
        joints += [
            joint(f"{letter}{k}.{step}", *ends)
            for step, (letter, ends) in enumerate(zip(text, itertools.pairwise(links), strict=True), 1)
        ]
    return joints


def hexapod():
    joints = limbs(*["UPS"] * 6)
    names = [[item.name for item in joints[k : k + 3]] for k in range(0, 18, 3)]
    loops = [Loop((*names[0], *names[1]), 12, 2, 6)] + [Loop(tuple(part), 6, 1, 6) for part in names[2:]]
    driven = [(f"P{k}.2", 0) for k in range(1, 7)]
    return linkage(joints, driven), loops, [AssurChain((0, 1, 2, 3, 4), 4)]


def hybrid():
    """An inner loop on the base, and a limb of two parallelograms."""
    joints = [
        *(joint("P1", "base", "slider1"), joint("R1", "slider1", "output"), joint("P2", "base", "slider2")),
        *(joint("R2", "slider2", "output"), joint("R3", "output", "platform"), joint("P3", "base", "slider3")),
    ]
    groups = []
    for name, start, end in (("Pa1", "slider3", "middle"), ("Pa2", "middle", "platform")):
        rods = [f"{name}rod{side}" for side in "ab"]
        hinges = [
            joint(f"{name}{side}{k}", *ends, "R")
            for side, rod in zip("ab", rods, strict=True)
            for k, ends in enumerate(((start, rod), (rod, end)))
        ]
        joints += hinges
        groups.append(Group(name, "P(4R)", tuple(item.name for item in hinges), start, end))
    loops = [Loop(("P1", "R1", "R2", "P2"), 4, 2, 2), Loop(("R3", "Pa2", "Pa1", "P3"), 4, 1, 3)]
    return linkage(joints, [("P1", 0), ("P2", 0), ("P3", 0)], groups), loops, [AssurChain((0,), 0), AssurChain((1,), 0)]


def tangle():
    """A graph that does not reduce in series and in parallel, with a joint of which one freedom is driven."""
    joints = [
        *(joint("R1", "base", "1"), joint("R2", "base", "2"), joint("C1", "1", "2"), joint("S1", "1", "platform")),
        *(joint("R3", "2", "platform"), joint("R4", "2", "platform"), joint("P1", "2", "free")),
    ]
    return linkage(joints, [("C1", 0)]), [], []


CASES = {"hexapod": hexapod, "hybrid": hybrid, "tangle": tangle}
CATALOGUE = sorted({*assur.names(), *topology_names()})


def drawn(name):
    if name in CASES:
        found = CASES[name]()
    else:
        facts = topology(name)
        found = facts.linkage, facts.loops, facts.assur_chains
    with styled():
        return graph_drawing(*found)


def texts(drawing):
    return [item for item in drawing.figure.axes[0].texts if item.get_text()]


@pytest.mark.parametrize("name", [*CASES, *each(CATALOGUE)])
def test_nothing_lies_on_anything_else_or_outside_the_page(name):
    figure = drawn(name).figure
    renderer = FigureCanvasAgg(figure).get_renderer()
    axes = figure.axes[0]
    letters = [(item.get_text(), item.get_window_extent(renderer)) for item in axes.texts]
    discs = [item.get_window_extent(renderer) for item in axes.patches if isinstance(item, Circle)]
    outside = [pair for pair in letters if not any(_inside(pair[1], disc) for disc in discs)]
    bars = [item.get_window_extent(renderer) for item in axes.patches if isinstance(item, Polygon)]
    width, height = figure.get_size_inches() * figure.dpi
    for text, box in letters:
        assert min(box.x0, box.y0, width - box.x1, height - box.y1) >= 0, text
    for (a, first), (b, second) in itertools.combinations(letters, 2):
        assert not _overlap(first, second), (a, b)
    for first, second in itertools.combinations([*discs, *bars], 2):
        assert not _overlap(first, second)
    for (text, box), disc in itertools.product(outside, discs):
        assert not _overlap(box, disc), text


def _inside(box, disc):
    return disc.x0 <= box.x0 and box.x1 <= disc.x1 and disc.y0 <= box.y0 and box.y1 <= disc.y1


def _overlap(first, second):
    shared_x = min(first.x1, second.x1) - max(first.x0, second.x0)
    shared_y = min(first.y1, second.y1) - max(first.y0, second.y0)
    return min(shared_x, shared_y) > 0.5


@pytest.mark.parametrize("name", CASES)
def test_every_joint_has_a_line_and_every_link_a_name(name):
    found, drawing = CASES[name]()[0], drawn(name)
    lines = [item for item in drawing.figure.axes[0].patches if isinstance(item, PathPatch)]
    assert len(lines) == len(edges(found)) == len(drawing.data["joints"])
    links = {link for item in edges(found) for link in (item.start, item.end)}
    assert set(drawing.data["links"]) == links
    said = " ".join(item.get_text() for item in texts(drawing))
    assert all(link.rstrip("0123456789") in said for link in links)


def test_a_parallelogram_is_one_bold_line_that_names_its_joints():
    found = edges(hybrid()[0])
    assert [item.name for item in found] == ["P1", "R1", "P2", "R2", "R3", "P3", "Pa1", "Pa2"]
    bold = next(item for item in found if item.name == "Pa1")
    assert (bold.letter, bold.start, bold.end, len(bold.joints)) == ("4R", "slider3", "middle", 4)
    widths = [item.get_linewidth() for item in drawn("hybrid").figure.axes[0].patches if isinstance(item, PathPatch)]
    assert [width > 3 for width in widths] == [bool(item.joints) for item in found]


def test_actuated_joints_are_filled_and_only_they():
    for name, count in (("hexapod", 6), ("hybrid", 3), ("tangle", 1)):
        discs = [item for item in drawn(name).figure.axes[0].patches if isinstance(item, Circle)]
        filled = [item for item in discs if to_hex(item.get_facecolor()) == ORANGE and item.get_radius() > 5]
        assert len(filled) == count


def test_the_driven_freedom_of_a_joint_with_several_is_named():
    found = next(item for item in edges(tangle()[0]) if item.name == "C1")
    assert found.driven == ("translation",)
    assert "translation" in found.label


def test_each_assur_chain_has_its_colour_and_each_loop_its_tone():
    def colours(name):
        return [
            to_hex(item.get_edgecolor()) for item in drawn(name).figure.axes[0].patches if isinstance(item, PathPatch)
        ]

    found = colours("hybrid")
    assert found[:4] == [SERIES[0]] * 4
    assert found[4:] == [SERIES[1]] * 4
    tones = list(dict.fromkeys(colours("hexapod")))
    assert len(tones) == 5
    assert tones[0] == SERIES[0]
    lightness = [sum(to_rgb(tone)) for tone in tones]
    assert lightness == sorted(lightness)


def test_loops_are_numbered_at_their_joints_and_in_the_legend():
    said = [item.get_text() for item in texts(drawn("hexapod"))]
    assert [said.count(str(k)) for k in range(1, 6)] == [6, 3, 3, 3, 3]
    assert "Assur chain 1: $\\kappa$ = 4" in said
    assert "1: $\\xi$ = 6, $\\Delta$ = +4" in said
    assert "5: $\\xi$ = 6, $\\Delta$ = \N{MINUS SIGN}1" in said


@pytest.mark.parametrize("name", CASES)
def test_the_same_bytes_every_time(name):
    assert encoded(drawn(name).figure, "svg") == encoded(drawn(name).figure, "svg")
