from functools import lru_cache

import numpy as np
import pytest
from matplotlib.colors import LogNorm

import assur
from assur.errors import UsageError
from assur.figures import catalogue as figures
from assur.figures.index_maps import INDEX_MAPS, drawn, whole
from assur.figures.style import styled
from assur.performance.indices import INDICES, Index
from assur.results.json_text import plain
from assur.workspace.index_maps import index_maps
from assur.workspace.region import workspace


@lru_cache(maxsize=8)
def shared(name):
    record = assur.load(name)
    return figures.Context(record, workspace(record, resolution=12))


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "planar_3rrr"])
def test_every_index_has_a_map_on_the_same_axes(name):
    context = shared(name)
    drawing = figures.drawing(context.record, "indices", context)
    found = whole(context)
    assert found is whole(context)
    assert drawing.data == plain(found.answer())
    maps = [axes for axes in drawing.figure.axes if axes.get_xlabel()]
    assert len(maps) == len(found.maps) == len(INDICES) + 1
    assert len({(axes.get_xlim(), axes.get_ylim(), axes.get_xlabel(), axes.get_ylabel()) for axes in maps}) == 1
    titles = [text.get_text() for text in drawing.figure.texts]
    for item in found.maps.values():
        assert any(f"${item.symbol}$" in title for title in titles)
    for axes, (key, item) in zip(maps, found.maps.items(), strict=True):
        coloured = [mesh for mesh in axes.collections if mesh.get_array() is not None]
        assert len(coloured) == int(np.any(np.isfinite(item.values)))
        if key in INDICES and not INDICES[key].unbounded and coloured:
            assert coloured[0].get_clim() == (0.0, item.most.value)
            assert coloured[0].colorbar.extend == "neither"
        elif coloured:
            assert isinstance(coloured[0].norm, LogNorm) == (key in INDICES)
            clipped = np.nanmax(item.values) > coloured[0].get_clim()[1] * (1 + 1e-9)
            assert coloured[0].colorbar.extend == ("max" if clipped else "neither")
            assert coloured[0].get_clim()[1] <= item.most.value * (1 + 1e-12)


def test_the_axes_may_be_in_any_order_and_the_border_follows():
    context = shared("zeng2019")
    found = index_maps(context.record, context.workspace, ("z", "x"), {"y": 0.0}, 9)
    with styled():
        figure = drawn(context, found).figure
    axes = figure.axes[0]
    assert axes.get_xlabel().startswith("$z$")
    corners = axes.patches[0].get_path().get_extents()
    box = context.workspace.box
    assert box.low[2] - 1e-6 <= corners.x0 <= corners.x1 <= box.high[2] + 1e-6
    assert box.low[0] - 1e-6 <= corners.y0 <= corners.y1 <= box.high[0] + 1e-6


def test_what_is_not_a_plane_is_refused():
    context = shared("fivebar")
    with pytest.raises(UsageError, match="1 coordinates are not a plane"):
        drawn(context, index_maps(context.record, context.workspace, ("x",), nodes=3))


def test_the_caption_says_how_far_was_looked_and_what_lengths_are_divided_by():
    plain, mixed = INDEX_MAPS.caption(shared("fivebar")), INDEX_MAPS.caption(shared("planar_3rrr"))
    assert "within 194 mm" in plain
    assert "characteristic length" not in plain
    assert "characteristic length 200 mm" in mixed


def test_an_index_more_is_one_entry_and_its_map_its_title_and_the_caption_follow(monkeypatch):
    ratio = Index(r"\omega", "a ratio", 0, lambda found: found["condition"] ** 2, unbounded=False)
    growing = Index(r"\tau", "what grows", 1, lambda found: 2 * found["largest"], unbounded=True)
    monkeypatch.setitem(INDICES, "ratio", ratio)
    monkeypatch.setitem(INDICES, "growing", growing)
    context = figures.Context(shared("fivebar").record, shared("fivebar").workspace)
    drawing = figures.drawing(context.record, "indices", context)
    assert list(drawing.data["maps"])[-3:] == ["ratio", "growing", "distance"]
    titles = [text.get_text() for text in drawing.figure.texts]
    assert any(title.endswith(r"$\omega$") for title in titles)
    assert any(title.endswith(r"$\tau$ (mm/rad)") for title in titles)
    first, second = INDEX_MAPS.caption(context).split(";")[:2]
    assert r"LTI}$ and $\omega$ lie between" in first
    assert r"and $\tau$, by decades, end at" in second
    ends = [axes.collections[0].get_clim()[1] for axes in drawing.figure.axes if axes.get_xlabel()]
    assert ends[-3] == drawing.data["maps"]["ratio"]["most"]["value"]
    assert ends[-2] < drawing.data["maps"]["growing"]["most"]["value"]
