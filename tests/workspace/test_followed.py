"""Workspaces of mechanisms without closed form, against the closed forms that were taken away, and plain sampling."""

import json
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import KDTree

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.pose import pose_of
from assur.workspace import border_pieces
from assur.workspace.fields import closed_form_fields, sample
from assur.workspace.followed import over_grid
from assur.workspace.followed_field import continued_past, filled
from assur.workspace.grid import grid_over
from assur.workspace.region import workspace
from assur.workspace.slices import slice_at
from screw_mechanisms import FIVEBAR, loaded

PHI = {"phi": 0.2}


def stripped(name):
    return replace(assur.load(name), closed_form=None)


@lru_cache
def both(name, resolution, held=()):
    """The workspace by the closed form and by following."""
    options = {"resolution": resolution, "held": dict(held) or None}
    return workspace(assur.load(name), **options), workspace(stripped(name), **options)


@lru_cache
def fine_of(name, resolution, held=()):
    """The workspace by the closed form, each step a quarter."""
    return workspace(assur.load(name), resolution=4 * resolution, held=dict(held) or None)


# name, cells along each coordinate, what is held
CASES = [
    ("fivebar", 24, ()),
    ("planar_3rrr", 20, (("phi", 0.2),)),
    ("planar_3rrr", 40, (("x", 10.0), ("y", -5.0))),
    pytest.param("zeng2019", 12, (), marks=pytest.mark.deep),
    pytest.param("delta_4s", 6, (), marks=pytest.mark.deep),
    ("three_rps", 8, ()),
    ("three_rps", 20, (("z", 250.0),)),
]


@pytest.mark.parametrize(("name", "resolution", "held"), CASES)
def test_the_volume_is_that_of_the_closed_form_within_the_stated_errors(name, resolution, held):
    known, found = both(name, resolution, held)
    fine = fine_of(name, resolution, held)
    assert known.how == "closed form"
    assert found.how == "followed from home"
    assert found.unit == known.unit
    assert found.volume > 0.0
    # what is not stated is only how exactly a border is found, to 1e-6 of a step and better
    rounding = 1e-6 * fine.volume
    assert abs(found.volume - fine.volume) <= found.volume_error + fine.volume_error + rounding
    assert found.volume_error < 0.2 * found.volume


@pytest.mark.parametrize(("name", "resolution"), [("fivebar", 24), ("planar_3rrr", 12), ("zeng2019", 8)])
def test_exactly_the_nodes_are_reached_at_which_the_closed_form_exists(name, resolution):
    record, poses = assur.load(name), slice_at(assur.load(name))
    known, _ = both(name, resolution) if name == "fivebar" else (workspace(record, resolution=8), None)
    grid = grid_over(known.box, resolution)
    mode = record.modes.default_working
    over, how = over_grid(stripped(name), mode, poses, grid)
    margins = [
        np.broadcast_to(sample(field, grid), grid.shape) for field in closed_form_fields(record, mode)[0].values()
    ]
    least = np.min(margins, axis=0)
    inside, clear = least >= 0, np.abs(least) > 1e-9 * np.max(np.abs(least))
    size = grid.dimension
    inside, clear = (values[(..., *[0] * (3 - size))] for values in (inside, clear))
    assert how == "followed from home"
    np.testing.assert_array_equal(over.reached[clear], inside[clear])
    assert 50 < np.sum(over.reached) < over.reached.size


def test_sections_and_outlines_agree():
    known, found = both("zeng2019", 12)
    for first, second in zip(known.sections, found.sections, strict=True):
        assert second.area == pytest.approx(first.area, rel=0.02)
    assert found.projection("x", "z").area == pytest.approx(known.projection("x", "z").area, rel=0.02)


LOCI = [("fivebar", 24), ("planar_3rrr", 12), ("zeng2019", 12), pytest.param("delta_4s", 12, marks=pytest.mark.deep)]


@pytest.mark.parametrize(("name", "resolution"), LOCI)
def test_the_locus_of_the_determinant_is_that_of_all_parallel_factors(name, resolution):
    known, found = both(name, resolution)
    fine = fine_of(name, resolution)
    (locus,) = found.loci
    assert locus.factor == "output"
    assert not locus.everywhere
    area, error = (sum(getattr(item, key) for item in fine.loci) for key in ("area", "area_error"))
    assert abs(locus.area - area) <= locus.area_error + error
    if name == "fivebar":
        assert locus.area == area == 0.0
        return
    assert locus.area == pytest.approx(area, rel=0.2)
    assert (found.share is None) == (known.share is None)
    if known.share is not None:  # what is near a surface grows as the surface
        assert abs(found.share - fine.share) <= fine.share * (locus.area_error / locus.area + 0.02)


@pytest.mark.parametrize(("name", "resolution"), LOCI[1:])
def test_there_are_no_false_pieces_of_a_locus(name, resolution):
    """A piece that is more than a cell away from every true one would be false."""
    _, found = both(name, resolution)
    step = found.region.grid.step
    loci = [item for item in fine_of(name, resolution).loci if len(item.faces)]
    true = np.concatenate([item.vertices[item.faces].mean(axis=1) for item in loci])
    (locus,) = found.loci
    pieces = locus.vertices[locus.faces].mean(axis=1)
    gaps, _ = KDTree(true / step).query(pieces / step)
    assert np.quantile(gaps, 0.9) < 0.5
    assert np.max(gaps) < 1.5


def test_vertices_of_the_locus_are_on_it():
    _, found = both("zeng2019", 12)
    (locus,) = found.loci
    values = assur.load("zeng2019").inverse(locus.vertices, mode="++-++").factors
    nearest = np.min(np.abs([values[name][:, 0] / 280.0 for name in ("w", "v")]), axis=0)
    # the others are where facets are cut by the border
    assert np.nanquantile(nearest, 0.2) < 1e-6


def test_a_field_is_continued_beyond_the_border_as_the_root_goes_on():
    """a + b sqrt(d) becomes a - b sqrt(d); linear where three nodes of a square are known; else the nearest."""
    share = np.array([0.25, 0.5, 0.9])
    found = continued_past(2.0 + 3.0 * np.sqrt(share), np.full(3, 2.0), share)
    np.testing.assert_allclose(found, 2.0 - 3.0 * np.sqrt(1.0 - share))
    x, y, z = np.indices((4, 4, 4)).astype(float)
    plane = 1.0 + 2.0 * x - 3.0 * y + 0.5 * z
    hidden = np.where((x == 2) & (y == 1), np.nan, plane)
    np.testing.assert_allclose(filled(hidden), plane)
    corner = np.where((x > 0) & (y > 0) & (z > 0), np.nan, plane)
    np.testing.assert_allclose(filled(corner)[:2, :2, :2], plane[:2, :2, :2])
    row = np.array([1.0, 4.0, np.nan, np.nan])
    assert filled(row).tolist() == [1.0, 4.0, 4.0, 4.0]


def test_vertices_of_the_border_are_on_it():
    """The arms of the five-bar are stretched there: P is l1 + l2 away from one of the motors."""
    _, found = both("fivebar", 24)
    p = assur.load("fivebar").values
    low, high = np.array(found.box.intervals).T
    inner = np.all((found.vertices > low + 1e-6) & (found.vertices < high - 1e-6), axis=1)
    motors = np.array([[p.g, 0.0], [-p.g, 0.0]])
    gaps = p.l1 + p.l2 - np.linalg.norm(found.vertices[inner, None] - motors, axis=-1)
    assert np.sum(inner) > 20
    off = np.abs(np.min(gaps, axis=1)) / np.max(found.region.grid.step)
    assert np.quantile(off, 0.7) < 1e-5
    assert np.max(off) < 0.01  # where the box cuts a facet


def test_strokes_and_limits_cut_both_alike():
    stroke = {"yA1": (-200.0, 150.0)}
    record = assur.load("zeng2019")
    known = workspace(record, strokes=stroke, resolution=10)
    found = workspace(stripped("zeng2019"), strokes=stroke, resolution=10)
    assert known.volume < 0.9 * both("zeng2019", 12)[0].volume
    assert abs(found.volume - known.volume) <= found.volume_error + known.volume_error


def test_the_limit_of_a_passive_joint_cuts_both_alike():
    record = assur.load("planar_3rrr")
    joint = record.joints["leg1.B"]
    limited = replace(record, joints={**record.joints, "leg1.B": replace(joint, limits=((0.3, 1.5),))})
    options = {"resolution": 24, "held": PHI}
    known, found = workspace(limited, **options), workspace(replace(limited, closed_form=None), **options)
    assert known.volume < 0.9 * workspace(record, **options).volume
    assert abs(found.volume - known.volume) <= found.volume_error + known.volume_error


@pytest.mark.parametrize("held", [{"phi": 0.2}, {"x": 10.0, "y": -5.0}, {"y": 20.0}])
def test_slices_of_a_plane_platform_agree_with_plain_sampling(held):
    record = assur.load("planar_3rrr")
    found = workspace(record, held=held, resolution=96)
    _agree_with_sampling(record, found)


@pytest.mark.parametrize("held", [{"z": 250.0}, {"theta": 0.2, "psi": -0.3}, {}])
def test_slices_of_a_tilting_platform_agree_with_plain_sampling(held):
    record = assur.load("three_rps")
    strokes = {item.name: (200.0, 300.0) for item in record.inputs}
    found = workspace(record, held=held, strokes=strokes, resolution=48)
    _agree_with_sampling(record, found, strokes)


def _agree_with_sampling(record, found, strokes=None):
    rng = np.random.default_rng(7)
    low, high = np.array(found.box.intervals).T
    points = rng.uniform(low, high, size=(20_000, len(low)))
    solutions = record.inverse(found.slice.poses(points), mode=found.mode)
    inside = solutions.exists[:, 0]
    for k, item in enumerate(record.inputs):
        if strokes:
            with np.errstate(invalid="ignore"):
                value = solutions.inputs[:, 0, k]
                inside &= (value >= strokes[item.name][0]) & (value <= strokes[item.name][1])
    size = np.prod(high - low)
    deviation = max(np.std(inside) / np.sqrt(len(inside)), 1e-4) * size
    assert 0.02 < np.mean(inside) < 0.999
    assert abs(np.mean(inside) * size - found.volume) < 4 * deviation + found.volume_error


def test_it_follows_another_mode_from_a_solution_that_is_searched_for():
    record = assur.load("fivebar")
    known = workspace(record, "++", resolution=16)
    found = workspace(stripped("fivebar"), "++", resolution=16)
    assert found.how.startswith("followed from a solution at x = ")
    assert abs(found.volume - known.volume) <= found.volume_error + 1e-3 * known.volume


def test_where_it_was_followed_from_is_said_in_the_unit_of_the_file():
    said = {}
    for unit in ("deg", "rad"):
        how = workspace(replace(stripped("planar_3rrr"), angle=unit), "+-+", resolution=4).how
        value, said_unit = how.partition("phi = ")[2].split()
        assert said_unit == unit
        said[unit] = float(value)
    assert abs(said["deg"]) > 1
    assert said["deg"] == pytest.approx(np.degrees(said["rad"]), rel=1e-3)


def test_a_box_that_nothing_reaches_is_empty_and_says_so():
    found = workspace(stripped("fivebar"), box={"x": (900, 950), "y": (900, 950)}, resolution=8)
    assert found.volume == 0.0
    assert found.share is None
    assert "no pose" in found.how
    assert json.loads(json.dumps(found.to_json(), allow_nan=False))["how"] == found.how


def test_joint_values_inside_close_the_loops_and_are_missing_outside():
    _, found = both("fivebar", 24)
    points = np.array([[0.0, 220.0], [0.0, 900.0]])
    joints = found.joints(points)
    known = assur.load("fivebar").inverse(points[:1], mode=found.mode)
    np.testing.assert_allclose(np.cos(joints[0] - known.joints[0, 0]), 1.0, atol=1e-12)
    assert np.all(np.isnan(joints[1]))
    with pytest.raises(UsageError, match="has a closed form"):
        both("fivebar", 24)[0].joints(points)


def test_progress_counts_up_to_its_total_and_begins_early():
    seen = []
    workspace(stripped("fivebar"), resolution=8, progress=lambda done, total: seen.append((done, total)))
    assert [done for done, _ in seen] == list(range(1, len(seen) + 1))
    assert {total for _, total in seen} == {len(seen)}


def test_an_unknown_mode_is_refused():
    with pytest.raises(UnknownNameError, match="working mode of fivebar"):
        workspace(stripped("fivebar"), "+", resolution=8)


def test_the_total_workspace_agrees_with_plain_sampling():
    record = assur.load("planar_3rrr")
    box = {"x": (-120, 120), "y": (-120, 120), "phi": (-0.3, 0.3)}
    found = workspace(record, box=box, resolution=40)
    points = np.random.default_rng(2).uniform(-120, 120, size=(4000, 2))
    turns = np.linspace(-0.3, 0.3, 31)
    poses = np.concatenate([np.repeat(points, 31, axis=0), np.tile(turns, 4000)[:, None]], axis=1)
    there = record.inverse(poses, mode="+++").exists[:, 0].reshape(4000, 31)
    inside = np.any(there, axis=1)
    share, deviation = np.mean(inside), np.std(inside) / np.sqrt(4000)
    assert 0.03 < share < 0.97
    assert abs(found.projection("x", "y").area / 240**2 - share) < 4 * deviation + 0.01


@pytest.mark.parametrize("name", ["fivebar", "zeng2019"])
def test_points_inside_come_with_the_joint_values_that_following_found(name):
    known, found = both(name, {"fivebar": 24, "zeng2019": 12}[name])
    poses, joints = found.inside(600, np.random.default_rng(5))
    assert len(joints) == len(poses) > 50
    np.testing.assert_allclose(pose_of(assur.load(name), joints), poses, atol=1e-6)
    same, nothing = known.inside(600, np.random.default_rng(5))
    assert nothing is None
    np.testing.assert_array_equal(poses, same)


def test_a_locus_along_the_border_is_seen_though_it_is_thinner_than_a_cell():
    """The Delta's rods lie in one plane just before its arms stretch: a sliver of 0.15 % of the volume."""
    known, found = both("delta_4s", 10)
    assert sum(item.area for item in found.loci) > 0.4 * sum(item.area for item in known.loci)


def test_strokes_of_screws_bound_a_workspace_by_their_turns(tmp_path):
    """Four turns of 10 mm either way let the first slider of the five-bar go from x = -90 to -10 mm."""
    record = loaded(tmp_path, FIVEBAR)
    turns = 2 * np.pi * 4.0
    found = workspace(
        record, box={"x": (-60, 60), "y": (60, 125)}, strokes={"q1": (-turns, turns)}, resolution=16, sections=[]
    )
    y = np.linspace(60, 125, 20001)
    half = np.sqrt(130**2 - y**2)
    width = np.clip(np.minimum(60, half - 10) - np.maximum(-60, half - 90), 0, None)
    assert abs(found.volume - np.mean(width) * 65) < 3 * found.volume_error
    assert found.volume_error < 0.02 * found.volume


CORNERED = {"x": (-110.0, 90.0), "y": (200.0, 320.0)}


@pytest.mark.parametrize("resolution", [5, 16])
def test_two_borders_that_meet_give_an_edge(resolution):
    """The five-bar's arms, both stretched, meet over the middle between the motors: one border alone would cut it off.

    Tangents of arcs leave their curvature within a cell, of second order in its size.
    """
    record = assur.load("fivebar")
    p, found = record.values, workspace(stripped("fivebar"), box=CORNERED, resolution=resolution)
    fine = workspace(record, box=CORNERED, resolution=200)
    step = found.region.grid.step[:2]
    (outline,) = found.projection("x", "y").polygons
    corner = np.array([0.0, np.sqrt((p.l1 + p.l2) ** 2 - p.g**2)])
    arc = np.max(step) ** 2 / (p.l1 + p.l2)  # eight times the height of an arc over a chord of a cell
    assert np.min(np.linalg.norm(outline - corner, axis=1)) < 0.35 * np.max(step)
    assert abs(np.max(outline[:, 1]) - corner[1]) < arc
    # chords lie inside: the area is less by a sagitta of a cell along the border
    assert 0.0 <= fine.volume - found.volume < arc * (np.ptp(outline[:, 0]) + np.ptp(outline[:, 1]))


def test_an_edge_of_a_mechanism_without_closed_form_is_where_solutions_end():
    """At theta = 0 two borders are lines, with fewer solutions across each; their corner is not cut off."""
    mechanism = assur.load(Path(__file__).parents[1] / "kinematics" / "following" / "m2.toml")
    found = mechanism.workspace(held={"theta": 0.0}, resolution=8)
    (outline,) = found.projection("x", "z").polygons
    corner = outline.max(axis=0)
    assert np.all(corner < np.array(found.box.high) - 1.0)
    assert np.min(np.linalg.norm((outline - corner) / found.region.grid.step[:2], axis=1)) < 0.01
    inside, *beyond = (
        len(mechanism.inverse([*(corner + 0.1 * np.array(way)), 0.0])) for way in ((-1, -1), (1, -1), (-1, 1))
    )
    assert max(beyond) < inside


def test_a_border_whose_reasons_are_not_told_is_one_surface(monkeypatch):
    """It is cut off at the corner then, and the region is inside that with an edge there."""
    whole = workspace(stripped("fivebar"), box=CORNERED, resolution=5)
    monkeypatch.setattr(border_pieces, "FOREMOST", np.inf)
    cut_off = workspace(stripped("fivebar"), box=CORNERED, resolution=5)
    assert 0.9 * whole.volume < cut_off.volume < 0.995 * whole.volume
