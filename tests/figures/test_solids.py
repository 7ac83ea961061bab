from __future__ import annotations

import numpy as np

from assur.figures.mesh import rgb
from assur.figures.solids import link_layers, model, unit


def test_links_that_are_hinged_together_lie_in_different_layers(every):
    layers = link_layers(every.skeleton)
    for mark in every.skeleton.marks:
        pair = {mark.joint.parent, mark.joint.child}
        if not mark.slides and every.record.base not in pair:
            parent, child = (layers[link] for link in pair)
            assert parent != child, mark.joint.name


def test_every_joint_is_inside_the_model(every):
    points = model(every.skeleton, every.companion).corners.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    for mark in every.skeleton.marks:
        assert np.all(mark.at > low - 1e-9)
        assert np.all(mark.at < high + 1e-9)
        assert np.min(np.linalg.norm(points - mark.at, axis=1)) < 4 * unit(every.skeleton)


def test_bars_are_as_long_as_the_joint_graph_says(every):
    """The farthest point of a link's bars along each bar is one radius beyond its joint."""
    size = unit(every.skeleton)
    for rod in every.skeleton.rods:
        if rod.size < 4 * size or rod.link == every.record.platform.link:
            continue
        mesh = model(every.skeleton, every.companion, {rod.link: "#010203"})
        own = mesh.corners[np.all(np.isclose(mesh.colour, rgb("#010203")), axis=1)].reshape(-1, 3)
        along = (rod.points[1] - rod.points[0]) / rod.size
        assert np.max((own - rod.points[0]) @ along) >= rod.size - 1e-6
        rods = [item for item in every.skeleton.rods if item.link == rod.link]
        if len(rods) == 1:
            assert np.max((own - rod.points[0]) @ along) <= rod.size + 1.2 * size
