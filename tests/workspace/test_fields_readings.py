"""How often a closed form is read: once per pose for every margin, bound, factor and index."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.workspace.index_maps import index_maps
from assur.workspace.region import workspace


class RaysAsked(Exception):  # noqa: N818  # no error: what comes after the readings that are counted
    """The distance to singularities is asked for, which has readings of its own."""


def counted(record):
    """The mechanism with a kernel that counts at how many poses it is read, call by call."""
    form, sizes = record.closed_form, []

    def inverse(ns, p, pose, sign):
        parts = [part for item in pose for part in (item if isinstance(item, tuple) else (item,))]
        sizes.append(int(np.prod(np.broadcast_shapes(*map(np.shape, parts)))))
        return form.inverse(ns, p, pose, sign)

    return replace(record, closed_form=replace(form, inverse=inverse)), sizes


@pytest.mark.parametrize(("name", "strokes", "fields"), [("zeng2019", {"yA1": (-400, 300)}, 10), ("delta_4s", {}, 4)])
def test_a_workspace_reads_the_kernel_at_most_twice_a_node_with_every_vertex_of_its_surfaces(name, strokes, fields):
    record, sizes = counted(assur.load(name))
    found = workspace(record, strokes=strokes, resolution=32)
    nodes = int(np.prod(found.region.grid.shape))
    assert len(found.margins) + len(found.region.factors) == fields
    assert nodes < sum(sizes) <= 2 * nodes
    assert sizes.count(nodes) == 1


def test_an_index_map_reads_the_kernel_once_a_node_beside_the_search_for_the_distance(monkeypatch):
    record, sizes = counted(assur.load("fivebar"))
    found = workspace(record, resolution=8)
    sizes.clear()

    def rays(*_):
        raise RaysAsked

    monkeypatch.setattr("assur.workspace.index_maps.distance", rays)
    with pytest.raises(RaysAsked):
        index_maps(record, found, nodes=9)
    assert sizes == [81]
