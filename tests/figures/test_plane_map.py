"""Ridges of maps: what grows without bound between two nodes is followed there."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from assur.figures.plane_map import plane_through, ridged, with_bar
from assur.workspace.domain import Box


def mapped(factor, nodes=12):
    """A square in which one parallel factor of x and y vanishes."""
    region = SimpleNamespace(factors={"f": lambda at: factor(*at)})
    workspace = SimpleNamespace(box=Box(("x", "y"), (-1.0, -1.0), (1.0, 1.0)), region=region)
    return plane_through(SimpleNamespace(workspace=workspace), ("x", "y"), {}, nodes)


def slanted(x, y):
    return x - 0.3 * y + 0.013


def test_a_ridge_has_no_beads():
    """Along the zeros of the factor all values are large, however far from nodes: from node to node they are not."""
    plane = mapped(slanted)
    fine, shown = ridged(plane, 1.0 / np.abs(slanted(*np.moveaxis(plane.points, -1, 0))))
    exact = 1.0 / np.abs(slanted(*np.moveaxis(fine.points, -1, 0)))
    along = exact > 8.0
    np.testing.assert_allclose(shown[along], exact[along], rtol=1e-6)


def test_far_from_a_ridge_values_are_those_of_the_nodes():
    plane = mapped(lambda x, y: x + y + 5.0)
    values = np.exp(plane.points[..., 0] + 2 * plane.points[..., 1])
    _, shown = ridged(plane, values)
    parts = (len(shown) - 1) // (len(values) - 1)
    np.testing.assert_allclose(shown[::parts, ::parts], values, rtol=1e-9)


@pytest.mark.parametrize("outside", [np.nan, np.inf])
def test_where_nothing_is_known_nothing_is_shown(outside):
    fine, shown = ridged(mapped(slanted), np.full((12, 12), outside))
    assert shown.shape == (len(fine.ys), len(fine.xs))
    assert not np.any(np.isfinite(shown))


def test_a_plane_says_at_what_the_orientation_is_held_as_coordinates_of_the_plane():
    workspace = SimpleNamespace(
        box=Box(("x", "y", "z"), (0.0,) * 3, (1.0,) * 3), slice=SimpleNamespace(held={"phi": 0.1})
    )
    context = SimpleNamespace(workspace=workspace, record=SimpleNamespace(unit="mm", angle="deg"))
    own, whole = (plane_through(context, ("x", "z"), held, 3).words for held in ({"y": 2.0}, {"phi": 0.1, "y": 2.0}))
    assert own == whole == r"XOZ, $\phi$ = 5.7296°, $y$ = 2 mm"


@pytest.mark.parametrize(("ends", "wanted"), [((1 / 1.2, 1.0), [1.0]), ((0.5, 4.2), [1.0, 2.0])])
def test_a_bar_by_decades_has_a_number_at_its_end_where_that_is_round(ends, wanted):
    """What is 1 everywhere is seen to be 1."""
    axes, bar = Figure().subplots(1, 2)
    image = axes.pcolormesh(np.ones((3, 3)), norm=LogNorm(*ends))
    with_bar((axes, bar), image, "")
    ticks = bar.get_yticks()
    assert set(wanted) <= set(ticks.tolist())
    assert max(ticks) <= ends[1]


def test_a_factor_towards_which_values_do_not_grow_is_no_ridge():
    """As of the ratio of two stiffnesses, which both vanish with one factor, but with different powers of another."""
    plane = mapped(slanted)
    plane.context.workspace.region.factors["other"] = lambda at: at[1] - 0.4
    x, y = np.moveaxis(plane.points, -1, 0)
    fine, shown = ridged(plane, (2.0 + y) / np.abs(slanted(x, y)))
    x, y = np.moveaxis(fine.points, -1, 0)
    exact = (2.0 + y) / np.abs(slanted(x, y))
    other = (np.abs(y - 0.4) < 0.1) & (exact < 10.0)  # a ridge there would be thousands high
    np.testing.assert_allclose(shown[other], exact[other], rtol=0.2)
    _, even = ridged(plane, 2.0 + plane.points[..., 1])
    np.testing.assert_allclose(even, 2.0 + y, rtol=0.05)
