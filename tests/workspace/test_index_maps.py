"""Index maps: the indices at their nodes, whatever the plane; outside the workspace nothing; files that read back."""

import csv
import dataclasses
import io
import json
from functools import cache

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.status import Status
from assur.performance.indices import INDICES, indices, indices_at
from assur.results.json_text import json_text
from assur.singularity.distance import distance
from assur.workspace.index_maps import index_maps
from assur.workspace.region import workspace


@cache
def case(name, plane, nodes=7, **held):
    record = assur.load(name)
    region = workspace(record, resolution=12)
    return record, region, index_maps(record, region, plane, held, nodes)


def poses_of(record, found):
    """Poses (..., m) of the nodes."""
    grids = np.meshgrid(*(nodes for _, nodes in found.axes), indexing="ij")
    nodes = {name: grid for (name, _), grid in zip(found.axes, grids, strict=True)}
    shape = found.status.shape
    return np.stack([np.broadcast_to(nodes.get(n, found.held.get(n)), shape) for n in record.platform.pose], axis=-1)


@pytest.mark.parametrize(
    ("name", "plane"),
    [("zeng2019", ("z", "x")), ("planar_3rrr", ("x", "phi")), ("fivebar", None), ("zeng2019", ("y",))],
)
def test_the_maps_are_the_indices_and_the_distance_at_their_nodes(name, plane):
    record, region, found = case(name, plane)
    poses = poses_of(record, found)
    there = found.status != Status.unreachable
    expected = indices(record, poses, region.mode, found.length)
    assert list(found.maps) == [*INDICES, "distance"]
    assert there.any()
    assert np.isfinite(found["condition"])[there].any()
    for key in INDICES:
        np.testing.assert_allclose(found[key][there], expected[key][there], rtol=1e-9)
        assert found.maps[key].unit == INDICES[key].unit(expected)
    away = distance(record, poses[there], region.mode)
    np.testing.assert_allclose(found["distance"][there], away.value, rtol=1e-9)
    assert found.factor[there].tolist() == away.factor.tolist()
    for key, item in found.maps.items():
        assert np.isnan(item.values[~there]).all(), key


def test_means_and_extremes_are_those_of_the_values_and_where_they_are():
    record, _, found = case("zeng2019", ("x", "z"), y=20.0)
    assert found.coordinates == ("x", "y", "z")
    for key, item in found.maps.items():
        known = item.values[np.isfinite(item.values)]
        assert item.mean == pytest.approx(known.mean())
        assert (item.least.value, item.most.value) == (known.min(), known.max())
        for end in (item.least, item.most):
            assert end.at[1] == 20.0
            pose = np.array(end.at)
            one = distance(record, pose).value if key == "distance" else indices(record, pose)[key]
            assert float(one) == pytest.approx(end.value, rel=1e-9)


def test_a_stroke_takes_nodes_away():
    record = assur.load("fivebar")
    free = case("fivebar", None)[2]
    name = record.inputs[0].name
    bound = index_maps(record, workspace(record, strokes={name: (1.5, 2.5)}, resolution=12), nodes=7)
    reached = [item.status != Status.unreachable for item in (free, bound)]
    assert 0 < reached[1].sum() < reached[0].sum()
    assert not np.any(reached[1] & ~reached[0])
    np.testing.assert_array_equal(np.isfinite(bound["transmission"]), reached[1])


def test_without_closed_form_it_is_read_off_the_followed_joints_and_has_no_distance():
    record = assur.load("fivebar")
    record = dataclasses.replace(record, closed_form=None)
    region = workspace(record, record.modes.default_working, resolution=8)
    found = index_maps(record, region, nodes=6)
    beside = case("fivebar", None, 6)[2]
    assert list(found.maps) == list(INDICES)
    assert (found.reach, found.factor) == (None, None)
    both = np.isfinite(found["condition"]) & np.isfinite(beside["condition"])
    assert both.sum() > 10
    for key in INDICES:
        np.testing.assert_allclose(found[key][both], beside[key][both], rtol=1e-6)
    joints = region.joints(poses_of(record, found)[both])
    np.testing.assert_allclose(indices_at(record, joints, found.length)["condition"], found["condition"][both])


def test_json_csv_and_arrays_hold_the_same_numbers():
    found = case("planar_3rrr", ("x", "phi"))[2].in_degrees()
    assert found.angle == "deg"
    assert found.axes[1][1][-1] == pytest.approx(180.0)
    data = json.loads(json_text(found.answer()))
    rows = list(csv.DictReader(io.StringIO(found.csv())))
    stream = io.BytesIO()
    np.savez(stream, **found.arrays())
    stream.seek(0)
    arrays = np.load(stream, allow_pickle=False)
    assert len(rows) == found.status.size
    assert list(rows[0])[:3] == ["x [mm]", "phi [deg]", "status"]
    for key, item in found.maps.items():
        title = f"{key} [{item.unit}]" if item.unit else key
        column = [float(row[title]) if row[title] else np.nan for row in rows]
        np.testing.assert_array_equal(column, item.values.ravel())
        np.testing.assert_array_equal(arrays[key], item.values)
        plain = [np.nan if value is None else value for row in data["maps"][key]["values"] for value in row]
        np.testing.assert_array_equal(plain, np.where(np.isinf(item.values), np.nan, item.values).ravel())
    assert data["axes"]["phi"] == arrays["phi"].tolist()
    assert data["status"] == arrays["status"].tolist()
    assert found.in_degrees() is found


def test_in_degrees_moves_the_extremes_too():
    found = case("planar_3rrr", ("x", "phi"))[2]
    turned = found.in_degrees()
    at, was = turned.maps["condition"].most.at, found.maps["condition"].most.at
    np.testing.assert_allclose(at, [was[0], was[1], np.degrees(was[2])])
    assert turned.maps["distance"].unit == "mm"


def test_an_empty_workspace_has_maps_without_values():
    record = assur.load("fivebar")
    found = index_maps(record, workspace(record, box={"x": (800, 900)}, resolution=8), nodes=4)
    assert np.all(found.status == Status.unreachable)
    item = found.maps["distance"]
    assert (item.mean, item.least, item.most) == (None, None, None)
    assert found.csv().count("\n") == 17


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"nodes": 1}, "nodes: 1 is not"),
        ({"nodes": 200}, "2000000 are allowed"),
        ({"plane": ("x", "x")}, "not a choice of different coordinates"),
        ({"plane": ()}, "nothing is not a choice"),
        ({"plane": ("x", "z"), "held": {"x": 0.0}}, "x cannot vary and be held"),
        ({"plane": ("x", "z"), "held": {"y": 900.0}}, "y = 900 lies outside the box"),
        ({"plane": ("x", "z"), "reach": -1.0, "nodes": 3}, "reach: -1"),
    ],
)
def test_misuse_is_refused(words, message):
    record, region, _ = case("zeng2019", ("z", "x"))
    with pytest.raises(UsageError, match=message):
        index_maps(record, region, **words)


def test_unknown_names_are_refused():
    record, region, found = case("zeng2019", ("z", "x"))
    with pytest.raises(UnknownNameError):
        index_maps(record, region, ("x", "q"))
    with pytest.raises(UnknownNameError):
        found["beauty"]
