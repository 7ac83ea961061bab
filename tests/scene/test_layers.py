from dataclasses import replace

import numpy as np
import pytest

from assur.mechanism import load
from assur.scene.layers import FACES, layers, layers_note, region


@pytest.fixture(scope="module")
def zeng():
    return seen("zeng2019")


def seen(name, *args, **options):
    """The layers of a built-in mechanism."""
    record = load(name)
    return layers(record, region(record, *args, **options))


def of_kind(found, kind):
    return [item for item in found if item.kind == kind]


def test_the_workspace_encloses_its_volume(zeng):
    (solid,) = of_kind(zeng, "workspace")
    vertices, faces = solid.vertices, solid.faces
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    volume = float(np.sum(a * np.cross(b, c))) / 6
    assert volume == pytest.approx(22_814_586.4, rel=2e-3)  # by quadrature: see workspace's own example


def test_sections_lie_in_their_planes_and_close(zeng):
    found = of_kind(zeng, "section")
    assert [item.label.split(",")[0] for item in found] == [f"section z = {z} mm" for z in (300, 350, 400, 450)]
    for item, z in zip(found, (300, 350, 400, 450), strict=True):
        vertices, edges = item.vertices, item.faces
        assert np.allclose(vertices[:, 2], z)
        assert np.array_equal(np.bincount(edges.ravel()), np.full(len(vertices), 2))
        x, y, _ = vertices.T
        first, second = edges.T
        area = 0.5 * abs(float(np.sum(x[first] * y[second] - x[second] * y[first])))
        told = float(item.label.split("area about ")[1].split()[0])
        assert area == pytest.approx(told, rel=0.01)


@pytest.mark.parametrize("place", [0, 1])
def test_singular_surfaces_lie_where_their_factor_vanishes(zeng, place):
    record = load("zeng2019")
    item = of_kind(zeng, "singular")[place]
    vertices = item.vertices
    found = record.inverse(vertices, "++-++")
    value = found.factors[item.factor][found.exists]
    assert len(value) > 0.5 * len(vertices)
    assert np.max(np.abs(value)) < 0.05 * np.max(np.abs(record.inverse([0, 0, 400.0], "++-++").factors[item.factor]))


def test_a_plane_mechanism_has_a_flat_one():
    found = seen("fivebar")
    vertices = of_kind(found, "workspace")[0].vertices
    assert np.ptp(vertices[:, 2]) == 0
    found = seen("planar_3rpr")  # its angle is held as at home
    assert all(item.lines for item in of_kind(found, "singular"))
    assert of_kind(found, "singular")


def test_a_pose_of_angles_has_none():
    assert seen("three_rps") == ()


def test_no_layer_has_too_many_faces():
    for item in seen("orthoglide", resolution=48):
        assert len(item.faces) <= FACES


def test_progress_is_told():
    told = []
    region(load("zeng2019"), None, 12, lambda done, total: told.append((done, total)))
    assert told[-1][0] == told[-1][1]


def test_a_note_says_what_is_cut_by_the_box_and_why_there_is_nothing():
    """The planar 3-RRR lies inside its box; a box from which half of it is left out is named."""
    record = load("planar_3rrr")
    held = "All of it at phi = 0 deg."
    assert layers_note(record, region(record, resolution=16)) == held
    smaller = replace(record, box=record.box | {"x": (-200.0, 0.0)})
    note = layers_note(smaller, region(smaller, resolution=16))
    assert note == f"Seen inside the box of the file only, which cuts the workspace in x. {held}"
    away = replace(record, box=record.box | {"x": (5000.0, 5100.0)})
    looked = "Nothing was found on 16 cells along each coordinate: see the [workspace] box of the file."
    assert layers_note(away, region(away, resolution=16)) == looked
    for said, names in (((), "x, y"), (("x",), "y"), (("y",), "x")):
        unsaid = replace(record, box={name: record.box[name] for name in said})
        wanted = f"The file gives no [workspace] box for {names}: there is no workspace to be seen."
        assert layers_note(unsaid, region(unsaid)) == wanted


def test_a_note_claims_no_more_than_what_was_looked_at():
    """A workspace smaller than a cell is not found, and is there all the same."""
    record = replace(load("fivebar"), box={"x": (-1e5, 1e5), "y": (-1e5, 1e5)})
    assert record.inverse([0.0, 200.0], record.modes.default_working).exists
    assert layers_note(record, region(record)).startswith("Nothing was found on 32 cells along each coordinate")


def test_another_mode_has_other_singular_curves():
    """Poses of the five-bar are reached in every mode alike; where its elbows are decides what is singular."""
    one, other = (seen("fivebar", mode) for mode in ("-+", "++"))
    assert [found[0].label for found in (one, other)] == ["workspace of mode -+", "workspace of mode ++"]
    curves = [np.concatenate([item.vertices for item in of_kind(found, "singular")] or [[]]) for found in (one, other)]
    assert curves[0].shape != curves[1].shape or not np.allclose(*curves)


def turning(vertices, faces):
    """Mean angle by which the rims of a surface turn at their vertices, in rad."""
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    rim = edges[count == 1]
    beside = {}
    for one, other in rim:
        beside.setdefault(one, []).append(other)
        beside.setdefault(other, []).append(one)
    ways = np.array(
        [[vertices[k] - vertices[a], vertices[b] - vertices[k]] for k, (a, *rest) in beside.items() for b in rest[:1]]
    )
    cosine = np.sum(ways[:, 0] * ways[:, 1], axis=1) / np.maximum(np.prod(np.linalg.norm(ways, axis=2), axis=1), 1e-300)
    return float(np.mean(np.arccos(np.clip(cosine, -1.0, 1.0))))


def test_a_singular_surface_that_was_followed_lies_on_it_and_has_no_teeth():
    """In few cells it is cut finer, its new vertices on the surface; its rims turn far less than those of the cells."""
    record = replace(load("delta_4s"), closed_form=None)
    found = region(record, resolution=12)
    (locus,) = found.loci
    (item,) = of_kind(layers(record, found), "singular")
    assert len(item.faces) > 1.5 * len(locus.faces)
    assert turning(item.vertices, item.faces) < 0.6 * turning(locus.vertices, locus.faces)
    values = np.abs(found.region.factors[locus.factor].known(item.vertices))
    there = np.isfinite(values)
    assert np.mean(there) > 0.8
    assert np.median(values[there]) < 0.01
    assert np.quantile(values[there], 0.9) < 0.05  # a combed rim is off by a little
