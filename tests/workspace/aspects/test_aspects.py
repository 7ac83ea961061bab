"""Aspects against a flood fill over a fine grid of the closed form's signs, and against what geometry says."""

import numpy as np
import pytest
from scipy import ndimage

from assur.errors import UsageError
from assur.kinematics.position import inverse
from assur.model.registry import load_record
from assur.workspace.aspects import neighbours as neighbours_module
from assur.workspace.aspects import search as search_module
from assur.workspace.aspects.adjacency import contacts
from assur.workspace.aspects.aspects import aspects
from assur.workspace.aspects.components import components
from assur.workspace.aspects.neighbours import neighbours
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.region import certified_workspace
from assur.workspace.slices import slice_at

FIVEBAR = load_record("fivebar")
ZENG = load_record("zeng2019")
WIDE = {"x": (-300.0, 300.0), "y": (-300.0, 300.0)}
PART = {"phi": (0.0, 1.2)}
COARSE = {"x": 2.5, "y": 2.5, "phi": 0.15}
"""Of the 3-RPR: where and at what size two parts of each sign are seen first, and necks between them later."""

CELLS = 400

SLICES = [
    pytest.param("fivebar", "-+", WIDE, None, None, id="fivebar -+"),
    pytest.param("fivebar", "++", WIDE, None, None, id="fivebar ++"),
    pytest.param("zeng2019", None, None, None, {"y": 0.0}, id="zeng2019"),
    pytest.param("planar_3rpr", None, None, None, {"phi": 0.3}, id="planar_3rpr"),
    pytest.param("planar_3rrr", None, None, None, {"phi": 0.2}, id="planar_3rrr"),
    pytest.param(
        "linear_delta_4r", None, {"x": (-250.0, 250.0), "y": (-250.0, 250.0)}, None, {"z": -300.0}, id="delta"
    ),
    pytest.param("fivebar", "-+", WIDE, {"theta1": (-0.5, 2.0)}, None, id="fivebar with a stroke"),
]


def flooded(record, found):
    """Parts of a fine grid in which the closed form has one set of signs: {signs: [area, ..]}, and the cell's area."""
    low, high = np.array(found.box.low), np.array(found.box.high)
    step = (high - low) / CELLS
    axes = [a + s * (np.arange(CELLS) + 0.5) for a, s in zip(low, step, strict=True)]
    points = np.stack([grid.ravel() for grid in np.meshgrid(*axes, indexing="ij")], axis=-1)
    answer = inverse(record, found.slice.poses(points), found.mode)
    there = answer.exists[:, 0]
    for k, item in enumerate(record.inputs):
        stroke = (found.strokes or {}).get(item.name)
        if stroke is not None:
            with np.errstate(invalid="ignore"):
                there = there & (answer.inputs[:, 0, k] >= stroke[0]) & (answer.inputs[:, 0, k] <= stroke[1])
    names = list(found.aspects[0].signs)
    signs = np.stack([np.sign(answer.factors[name][:, 0]) for name in names], axis=-1)
    parts = {}
    for value in np.unique(signs[there], axis=0):
        mask = (there & np.all(signs == value, axis=-1)).reshape(CELLS, CELLS)
        labels, count = ndimage.label(mask)
        sizes = ndimage.sum_labels(mask, labels, np.arange(1, count + 1)) * np.prod(step)
        parts[tuple(value.astype(int).tolist())] = sorted(sizes.tolist(), reverse=True)
    return parts, float(np.prod(step))


@pytest.mark.parametrize(("name", "mode", "box", "strokes", "held"), SLICES)
def test_aspects_are_the_parts_that_a_flood_fill_finds(name, mode, box, strokes, held):
    record = load_record(name)
    if box is None and held:
        box = {axis: record.box[axis] for axis in slice_at(record, held).free}
    found = aspects(record, mode, box, strokes, held)
    parts, cell = flooded(record, found)
    fine = {signs: [size for size in sizes if size > 60 * cell] for signs, sizes in parts.items()}
    expected = {signs: sizes for signs, sizes in fine.items() if sizes}
    ours = {}
    for item in found.aspects:
        ours.setdefault(tuple(item.signs.values()), []).append(item)
    assert found.told_apart
    assert {signs: len(items) for signs, items in ours.items()} == {signs: len(s) for signs, s in expected.items()}
    for signs, items in ours.items():
        for item, size in zip(items, expected[signs], strict=True):
            low, high = item.volume
            assert low < 1.02 * size + 40 * cell
            assert size < 1.02 * high + 40 * cell


def test_the_parallel_singularity_parts_a_working_mode_of_the_five_bar():
    """sin_rods = 0, the rods in line. With elbows to one side it cuts two crescents off, else it halves the reach."""
    found = {mode: aspects(FIVEBAR, mode, box=WIDE) for mode in ("++", "+-", "-+", "--")}
    assert {item.naming for item in found.values()} == {("sin_rods",)}
    assert all(item.told_apart for item in found.values())
    labels = {mode: [part.label for part in item.aspects] for mode, item in found.items()}
    assert labels == {"++": ["-", "+"], "+-": ["-", "+/1", "+/2"], "-+": ["+", "-/1", "-/2"], "--": ["+", "-"]}
    mirrored = str.maketrans("+-", "-+")
    for first, second in (("-+", "+-"), ("++", "--")):  # y -> -y changes every sign
        for item in found[first].aspects:
            other = found[second][item.label.translate(mirrored)]
            assert item.volume == pytest.approx(other.volume, rel=1e-9)


def test_volumes_of_aspects_make_up_the_workspace():
    found = aspects(ZENG, finest=2.0)
    whole = certified_workspace(ZENG, gap=1e-4, sections=()).volume
    assert [item.label for item in found.aspects] == ["-++-", "-+--", "--+-", "----"]
    assert sum(item.volume[0] for item in found.aspects) < whole[1]
    assert sum(item.volume[1] for item in found.aspects) > whole[0]
    assert sum(item.volume[0] for item in found.aspects) > 0.95 * whole[0]


def test_bounds_close_in_with_the_size():
    coarse, fine = (aspects(ZENG, finest=size) for size in (6.0, 1.5))
    for one, two in zip(coarse.aspects, fine.aspects, strict=True):
        assert one.label == two.label
        assert one.volume[0] <= two.volume[0] * (1 + 1e-12)
        assert two.volume[1] <= one.volume[1] * (1 + 1e-12)
        assert two.volume[1] - two.volume[0] < 0.5 * (one.volume[1] - one.volume[0])


def test_coordinates_on_which_nothing_depends_are_not_cut():
    found = aspects(ZENG)
    assert found.names == ("x", "z")
    shorter = aspects(ZENG, box={"y": (0.0, 50.0)})
    for one, two in zip(found.aspects, shorter.aspects, strict=True):
        assert two.volume == pytest.approx([value / 10 for value in one.volume], rel=1e-12)


def test_the_two_aspects_of_a_3rpr_are_proved_in_space():
    found = aspects(load_record("planar_3rpr"), box=PART, finest=COARSE)
    assert sorted(item.label for item in found.aspects) == ["+", "-"]
    assert found.told_apart


def test_what_is_not_proved_is_said(monkeypatch):
    """Without a further cut the two parts of one sign are neither joined nor parted."""
    monkeypatch.setattr(search_module, "ROUNDS", 0)
    found = aspects(load_record("planar_3rpr"), box=PART, finest=COARSE)
    assert not found.told_apart
    assert found["+/1"].perhaps == ("+/2",)
    assert "not told apart" in found.note
    assert found["+/1"].volume[1] == pytest.approx(found["+/2"].volume[1], rel=1e-12)


def test_a_coarse_size_finds_none_and_claims_nothing():
    found = aspects(FIVEBAR, "-+", WIDE, finest=600.0)
    assert len(found) == 0
    assert found.of([0.0, 200.0]).status == "undecided"
    assert found.told_apart


def test_corners_counted_for_faces_are_noticed(monkeypatch):
    """Mutation: with contacts in place of faces squares that meet at a corner make one part."""
    squares = Boxes(np.array([[0.0, 1.0], [0.0, 1.0]]), np.array([[1.0, 2.0], [1.0, 2.0]]))
    assert components(neighbours(squares, squares[:0])).tolist() == [0, 1]
    monkeypatch.setattr(neighbours_module, "shared_faces", lambda boxes, ends: (contacts(boxes, ends), None))
    assert components(neighbours(squares, squares[:0])).tolist() == [0, 0]


def test_signs_unlooked_at_would_be_noticed(monkeypatch):
    """Mutation: without the factors among what must not be zero, aspects run together."""
    whole = aspects(FIVEBAR, "-+", WIDE, finest=9.375)
    monkeypatch.setattr("assur.workspace.certified.criteria.Criteria.nonsingular", property(lambda self: self))
    assert any(0 in item.signs.values() for item in aspects(FIVEBAR, "-+", WIDE, finest=9.375).aspects)
    assert all(0 not in item.signs.values() for item in whole.aspects)


@pytest.mark.parametrize(
    ("options", "word"),
    [
        ({"mode": "+++"}, "working mode"),
        ({"box": {"x": (1.0, 0.0)}}, "turned round"),
        ({"box": {"q": (0.0, 1.0)}}, "pose coordinate"),
        ({"finest": 0.0}, "positive"),
        ({"finest": float("nan")}, "positive"),
        ({"finest": {"q": 1.0}}, "pose coordinate"),
        ({"held": {"q": 1.0}}, "pose coordinate"),
    ],
)
def test_misuse_is_refused(options, word):
    with pytest.raises(UsageError, match=word):
        aspects(FIVEBAR, **options)


def test_an_unknown_label_is_refused_with_those_there_are():
    with pytest.raises(UsageError, match=r"no aspect \* in mode -\+; it has \+, -"):
        aspects(FIVEBAR, "-+", WIDE, finest=9.375)["*"]
