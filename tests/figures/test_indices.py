from functools import lru_cache

import numpy as np
import pytest
from matplotlib.colors import LogNorm, to_rgba

import assur
from assur.figures import catalogue as figures
from assur.figures import indices as module
from assur.figures.indices import MANIPULABILITY, TRANSMISSION, field
from assur.figures.plane_map import DECADES, SHOWN
from assur.figures.singular import symbol_of
from assur.figures.style import ORANGE, styled
from assur.performance.indices import INDICES, indices
from assur.workspace.fields import at_points
from assur.workspace.region import workspace
from catalogue import each

NAMES = ("fivebar", "orthoglide", "zeng2019", "planar_3rrr", "three_rps", "gough_stewart")


@lru_cache(maxsize=8)
def shared(name):
    record = assur.load(name)
    return figures.Context(record, workspace(record, resolution=16))


@pytest.fixture(params=each(NAMES, ["fivebar", "zeng2019", "planar_3rrr", "gough_stewart"]), scope="module")
def context(request):
    return shared(request.param)


@lru_cache(maxsize=16)
def drawn(context, entry):
    assert entry.missing(context) == ""
    with styled():
        return entry.draw(context)


@pytest.mark.parametrize(("entry", "count"), [(TRANSMISSION, 3), (MANIPULABILITY, 3)], ids=["transmission", "jacobian"])
def test_the_maps_are_the_indices_at_their_nodes(context, entry, count):
    data = drawn(context, entry).data
    first, second = data["plane"]
    assert len(data["maps"]) == count
    rng = np.random.default_rng(5)
    names = context.workspace.box.names
    seen = 0
    for _ in range(60):
        i, j = rng.integers(0, len(data[second])), rng.integers(0, len(data[first]))
        node = {first: data[first][j], second: data[second][i], **data["held"]}
        point = np.array([[node[name] for name in names]])
        margins = [at_points(margin, len(names), point)[0] for margin in context.workspace.margins.values()]
        pose = context.workspace.slice.poses(point)
        found = indices(context.record, pose, context.workspace.mode, data["characteristic_length"])
        for name, item in data["maps"].items():
            # beyond a stroke there are values; the picture ends at the border of the region
            np.testing.assert_allclose(item["values"][i][j], found[name][0], rtol=1e-6)
            seen += min(margins, default=0.0) >= 0
    assert seen > 15


def test_the_plane_is_of_two_lengths_where_there_are_two(context):
    plane = field(context).plane
    lengths = [name for name in context.workspace.box.names if name in ("x", "y", "z")]
    assert len(lengths) < 2 or set(plane.names) <= set(lengths)
    assert set(plane.names) | set(plane.held) == set(context.workspace.box.names)


def maps_of(figure):
    """The maps of a figure, without their bars of colours."""
    return [axes for axes in figure.axes if axes.get_xlabel()]


def test_each_map_has_a_range_of_its_own_by_decades_where_it_has_no_bound(context):
    there = field(context)
    drawing = drawn(context, MANIPULABILITY)
    for axes, name in zip(maps_of(drawing.figure), module.JACOBIAN_MAPS, strict=True):
        values = there.indices[name]
        known = values[np.isfinite(values) & (values > 0)]
        image = next(item for item in axes.collections if item.get_array() is not None)
        low, high = image.get_clim()
        assert isinstance(image.norm, LogNorm) == INDICES[name].unbounded
        if INDICES[name].unbounded:
            assert np.mean(known <= high) == pytest.approx(SHOWN, abs=0.02)
            assert low == pytest.approx(max(np.min(known), high / DECADES))
        else:
            assert (low, high) == (0.0, np.max(known))


def test_the_thick_line_is_where_transmission_becomes_good(context):
    figure = drawn(context, TRANSMISSION).figure
    maps = maps_of(figure)
    for axes, name in zip(maps, module.TRANSMISSION_MAPS, strict=True):
        values = field(context).indices[name]
        known = values[np.isfinite(values)]
        lines = [
            item
            for item in axes.collections
            if len(item.get_edgecolor()) and np.allclose(item.get_edgecolor()[0], to_rgba(ORANGE))
        ]
        assert len(lines) == int(np.min(known) < 0.7 < np.max(known))
    assert not any(
        len(item.get_edgecolor()) and np.allclose(item.get_edgecolor()[0], to_rgba(ORANGE))
        for axes in drawn(context, MANIPULABILITY).figure.axes
        for item in axes.collections
    )


def test_captions_state_the_length_and_the_share(context):
    transmission, jacobian = TRANSMISSION.caption(context), MANIPULABILITY.caption(context)
    found = context.overall_indices
    share = f"in {100 * found.good.share:.1f} ± " if found.good.share else "nowhere among the poses sampled;"
    assert f"at least 0.7 {share}" in transmission
    assert "0.0 ± 0.0" not in transmission
    assert f"{found.values['transmission'].mean:.3f} ± " in transmission
    mixed = context.record.name in ("planar_3rrr", "three_rps", "gough_stewart")
    assert ("characteristic length" in jacobian) == mixed
    if context.record.name == "fivebar":
        titles = [text.get_text() for text in drawn(context, MANIPULABILITY).figure.texts]
        assert any("(mm/rad)$^2$" in title for title in titles)


def test_the_bar_of_colours_has_an_arrow_where_something_is_beyond_it(context):
    for entry in (TRANSMISSION, MANIPULABILITY):
        data, figure = drawn(context, entry).data, drawn(context, entry).figure
        for axes, item in zip(maps_of(figure), data["maps"].values(), strict=True):
            image = next(image for image in axes.collections if image.get_array() is not None)
            beyond = np.nanmax(item["values"]) > image.get_clim()[1] * (1 + 1e-9)
            assert image.colorbar.extend == ("max" if beyond else "neither")


def test_no_index_has_the_letter_of_a_factor_a_parameter_or_of_the_coupling_degree(context):
    form = context.record.closed_form
    taken = {symbol_of(factor) for factor in form.factor_list} | {f"${name}$" for name in context.record.parameters}
    assert not (taken | {r"$\kappa$"}) & {f"${index.symbol}$" for index in INDICES.values()}
