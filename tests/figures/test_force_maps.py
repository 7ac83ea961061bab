"""Maps of forces are those of the capacity over the workspace."""

import numpy as np
from matplotlib.contour import QuadContourSet
from matplotlib.path import Path

from assur.figures import catalogue as figures
from assur.machine.forces.capacity_maps import capacity_maps


def test_maps_are_those_of_the_workspace(context):
    drawing = figures.drawing(context.record, "forces", context)
    data = drawing.data
    (first, xs), (second, _) = data["axes"].items()
    maps = capacity_maps(context.record, context.workspace, [first, second], data["held"], len(xs))
    np.testing.assert_allclose(np.array(data["maps"]["sphere"]["values"], dtype=float), maps["sphere"], rtol=1e-9)
    assert "held in every direction" in figures.spec(context.record, "forces", context).caption
    assert_forces_end_at_the_contour_of_the_share(drawing, maps)


def assert_forces_end_at_the_contour_of_the_share(drawing, maps):
    """Where gravity alone asks for more than all: a node lies in the area of none exactly if its share is above 1."""
    (_, xs), (_, ys) = maps.axes
    spent = maps["gravity"] > 1.0
    areas = [item for axes in drawing.figure.axes for item in axes.collections if isinstance(item, QuadContourSet)]
    forces = [name for name, item in maps.maps.items() if item.unit == "N"]
    assert len(areas) == (len(forces) if spent.any() else 0)
    inner = np.isfinite(maps["gravity"][1:-1, 1:-1])  # nodes on the box lie on the area's own border
    points = np.stack(np.meshgrid(xs[1:-1], ys[1:-1], indexing="ij"), axis=-1)[inner]
    for area in areas:
        (path,) = area.get_paths()
        inside = np.sum([Path(part).contains_points(points) for part in path.to_polygons()], axis=0) % 2 == 1
        np.testing.assert_array_equal(inside, spent[1:-1, 1:-1][inner])
