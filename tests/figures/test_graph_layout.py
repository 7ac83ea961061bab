import itertools

import numpy as np
import pytest

from assur.figures.graph_layout import OVERHANG, ROW, Bond, plan

ROOM = (16.0, 30.0)
WIDTH = 34.0
LIMBS = {"A": ("base", "1"), "B": ("1", "top"), "C": ("base", "2"), "D": ("2", "3"), "E": ("top", "3")}
LOOP_INSIDE = {
    **{"P1": ("base", "a"), "P2": ("base", "b"), "R1": ("a", "c"), "R2": ("b", "c"), "R3": ("c", "top")},
    **{"P3": ("base", "d"), "R4": ("top", "d")},
}
BRIDGE = {"A": ("base", "1"), "B": ("base", "2"), "C": ("1", "2"), "D": ("1", "top"), "E": ("2", "top")}
PARALLEL_JOINTS = {**BRIDGE, "F": ("1", "2"), "G": ("base", "top"), "H": ("2", "free")}
GRAPHS = [LIMBS, LOOP_INSIDE, BRIDGE, PARALLEL_JOINTS]


def planned(edges):
    bonds = [Bond(name, *ends, ROOM) for name, ends in edges.items()]
    return plan(bonds, "base", "top", dict.fromkeys(itertools.chain(*edges.values()), WIDTH))


def apart(first, second):
    """Whether two boxes (left, right, low, high) have nothing in common."""
    return first[1] <= second[0] or second[1] <= first[0] or first[3] <= second[2] or second[3] <= first[2]


@pytest.mark.parametrize("edges", GRAPHS)
def test_joints_and_bars_keep_apart(edges):
    found = planned(edges)
    boxes = {link: (left, right, y - 6, y + 6) for link, (left, right, y) in found.links.items()}
    boxes |= {name: (x - ROOM[0], x + ROOM[1], y - 7, y + 7) for name, (x, y) in found.joints.items()}
    for (one, first), (other, second) in itertools.combinations(boxes.items(), 2):
        assert apart(first, second), (one, other)


@pytest.mark.parametrize("edges", GRAPHS)
def test_lines_run_from_bar_to_bar_upwards_through_the_joint(edges):
    found = planned(edges)
    for name, ends in edges.items():
        line = found.lines[name]
        assert np.all(np.diff(line[:, 1]) > 0)
        low, high = sorted(ends, key=lambda link: found.links[link][2])
        for link, end in ((low, line[0]), (high, line[-1])):
            left, right, height = found.links[link]
            assert end[1] == pytest.approx(height)
            assert left <= end[0] <= right
        at = found.joints[name]
        assert np.min(np.linalg.norm((line[:-1] + line[1:]) / 2 - at, axis=1)) < 1e-9 or at.tolist() in line.tolist()


@pytest.mark.parametrize("edges", GRAPHS)
def test_the_base_is_below_everything_and_the_platform_above(edges):
    found = planned(edges)
    heights = {link: bar[2] for link, bar in found.links.items()}
    assert heights["base"] == 0.0 == min(heights.values())
    assert all(0.0 < height < heights["top"] for link, height in heights.items() if link not in ("base", "top", "free"))


@pytest.mark.parametrize(("edges", "upright"), [(LIMBS, True), (LOOP_INSIDE, True), (BRIDGE, False)])
def test_a_series_parallel_graph_has_upright_lines_only(edges, upright):
    found = planned(edges)
    assert found.upright == upright
    assert upright == all(np.ptp(line[:, 0]) == 0.0 for line in found.lines.values())


def test_limbs_are_columns_in_the_order_of_their_joints():
    found = planned(LIMBS)
    assert found.joints["A"][0] == found.joints["B"][0] < found.joints["C"][0] == found.joints["E"][0]
    assert found.links["top"][2] == 3 * ROW
    assert found.links["1"][2] == 1.5 * ROW


def test_a_bar_spans_the_branches_that_end_on_it():
    found = planned(LOOP_INSIDE)
    left, right, _ = found.links["c"]
    assert left == pytest.approx(found.joints["R1"][0] - OVERHANG)
    assert right == pytest.approx(found.joints["R2"][0] + OVERHANG)
    assert found.joints["R3"][0] == pytest.approx((left + right) / 2)


@pytest.mark.parametrize("edges", GRAPHS)
def test_the_same_graph_is_placed_the_same(edges):
    first, second = planned(edges), planned(edges)
    assert first.links == second.links
    assert all(np.array_equal(first.lines[name], second.lines[name]) for name in edges)
