"""Identification: what poses tell is the rank of differences of poses, and what they do not is said in words."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.machine.calibration.chosen_poses import random_poses
from assur.machine.calibration.dimensions import dimensions
from assur.machine.calibration.identification import Identification, identification
from own_machines import own_machine


@pytest.fixture(scope="module")
def zeng():
    record = assur.load("zeng2019")
    return identification(record, random_poses(record, 5))


def test_dimensions_of_the_papers_mechanism_that_no_position_tells_apart(zeng):
    words = [own.words for own in zeng.unidentifiable]
    assert words[:3] == ["b and d act by their difference", "l5 does not act", "l7 and l8 act by their sum"]
    assert zeng.rank + len(words) == len(zeng.parameters)
    assert {"yA1", "yA2", "yA3"} < set(zeng.parameters)
    for own in zeng.unidentifiable:
        moved = zeng.matrix @ [own.combination.get(name, 0.0) for name in zeng.parameters]
        np.testing.assert_allclose(moved, 0.0, atol=1e-7)


def test_a_combination_that_is_not_told_leaves_poses_where_they_are():
    """Solved again: half the rocker's length, and inputs moved against each other."""
    record = assur.load("zeng2019")
    (pose,) = random_poses(record, 1, seed=3)
    inputs = record.errors(pose).values[list(record.input_indices)]
    other = assur.load("zeng2019", l3=141.0, b=151.0, d=51.0, l7=2.0, l5=95.0)
    solutions = other.direct(np.add(inputs, [0.5, -0.5, 0.0]))
    near = np.array([item for item in solutions.poses if np.all(np.isfinite(item))])
    moved = near[np.argmin(np.linalg.norm(near - pose, axis=1))]
    first = record.errors(pose).sensitivity["l7"][:3] * 2.0
    np.testing.assert_allclose(moved - pose, first, atol=0.05)


def test_the_frame_takes_what_it_can_and_indices_grow_with_what_is_measured():
    record = assur.load("fivebar")
    poses = random_poses(record, 6)
    own, framed = identification(record, poses), identification(record, poses, frame=True)
    assert (own.rank, framed.rank) == (5, 8)
    assert [part.words for part in framed.unidentifiable] == [
        f"frame.{name} does not act" for name in ("z", "rx", "ry")
    ]
    turned = identification(record, poses, ["x", "y", "rz"])
    assert turned.observability["O3"] >= own.observability["O3"] > 0
    assert str(own).splitlines()[0] == "5 of 5 told by 6 poses, x, y"


def test_base_parameters_are_what_is_told_in_truth(zeng):
    """Moving any parameter does what its part in the base parameters says."""
    base = zeng.base_parameters
    assert [own for own in base.values() if "l7" in own] == [{"l7": 1.0, "l8": pytest.approx(1.0)}]
    assert len(base) == zeng.rank
    told = zeng.matrix[:, [zeng.parameters.index(name) for name in base]]
    for place, name in enumerate(zeng.parameters):
        parts = [own.get(name, 0.0) for own in base.values()]
        np.testing.assert_allclose(told @ parts, zeng.matrix[:, place], atol=1e-7)


def test_a_dimension_that_alone_does_not_assemble_is_none_of_the_parameters(tmp_path):
    """All axes of a limb slope alike, and then it assembles; where one has a slope of its own it does not."""
    written = assur.load("three_crr")
    assert identification(written, random_poses(written, 2)).strained == ()
    text = written.file.read_text(encoding="utf-8")
    first, second = 'parent = "crank",', 'axis = [1, 0, "rise"]'
    before, after = text.split(first)
    text = f"{before}{first}{after.replace(second, second.replace('rise', 'slope'), 1)}"
    rise = next(line for line in text.splitlines() if line.startswith("rise ="))
    path = tmp_path / "sloping.toml"
    path.write_text(text.replace(rise, f"{rise}\n{rise.replace('rise =', 'slope =')}"), encoding="utf-8")
    record = assur.load(path)
    own = identification(record, random_poses(record, 2))
    assert own.strained == ("rise", "slope")
    assert not {"rise", "slope"} & set(own.parameters)


def test_heights_over_a_plate_do_not_tell_a_deltas_arms_where_the_gauge_begins_anywhere():
    """As large a Delta of the same shape has the same heights but for a constant."""
    record = assur.load("delta_4s")
    plate = np.array([[x, y, -0.9] for x in (-0.3, 0.0, 0.3) for y in (-0.3, 0.0, 0.3)])
    own = identification(record, plate, ["z"], frame=True)
    (size,) = [part.combination for part in own.unidentifiable if "frame.z" in part.combination]
    lengths = {name: record.parameters[name].value for name in ("L", "l", "wB", "uP")}
    assert size == pytest.approx(
        {"L": 1.0, "l": lengths["l"] / lengths["L"], "wB": (lengths["wB"] - lengths["uP"]) / lengths["L"]}
        | {"frame.z": -0.9 / lengths["L"]},
        rel=1e-6,
    )
    known = identification(record, plate, ["z"])
    assert not [part for part in known.unidentifiable if "L" in part.combination]


def test_each_limbs_and_each_links_own_dimensions_are_told_apart_or_said_to_act_together():
    """A Delta's limbs and its rods, of which each has a length of its own, by positions alone."""
    record = assur.load("delta_4s")
    poses = random_poses(record, 12)
    own = identification(record, poses, copies="limb")
    assert [part.words for part in own.unidentifiable] == [
        *(f"leg{number}.h does not act" for number in (1, 2, 3)),
        *(f"leg{number}.wB and leg{number}.uP act by their difference" for number in (1, 2, 3)),
    ]
    by_link = identification(record, poses, copies="link")
    rods = {f"leg{leg}.rod{rod}.l" for leg in (1, 2, 3) for rod in (1, 2)}
    assert rods < set(by_link.parameters)
    assert not any(rods & {*part.combination} for part in by_link.unidentifiable)
    for part in (own, by_link):
        for row in part.unidentifiable:
            moved = part.matrix @ [row.combination.get(name, 0.0) for name in part.parameters]
            np.testing.assert_allclose(moved, 0.0, atol=1e-6)


@pytest.mark.parametrize("name", ["zeng2019", "three_crr", "three_rps"])
@pytest.mark.parametrize("copies", ["limb", "link"])
def test_copies_together_are_the_dimension(name, copies):
    """All copies of one off by one are the dimension off by one; a whole stands where its copies are not all of it."""
    record = assur.load(name)
    errors = record.errors(random_poses(record, 1)[0])
    names = dimensions(record, copies)
    for whole in dimensions(record):
        if whole not in names and all(np.isfinite(errors.sensitivity[own]).all() for own in names):
            parts = [errors.sensitivity[own] for own in names if own.endswith(f".{whole}")]
            np.testing.assert_allclose(np.sum(parts, axis=0), errors.sensitivity[whole], atol=1e-6)
    assert len(set(names)) == len(names) >= len(dimensions(record))


def test_a_mechanism_of_no_dimensions_has_offsets_of_inputs_alone():
    record = own_machine("screws")
    assert dimensions(record) == dimensions(record, "link") == ()
    own = identification(record, random_poses(record, 4), copies="limb")
    assert own.parameters == tuple(item.name for item in record.inputs)


def test_nothing_told_is_nothing_observed():
    none = Identification(("a",), ("x",), np.zeros((1, 1)), np.zeros((1, 1)), np.ones(1))
    assert (none.rank, none.observability["O1"], none.unidentifiable[0].words) == (0, 0.0, "a does not act")


def test_bad_poses_are_told():
    record = assur.load("fivebar")
    with pytest.raises(UsageError, match=r"pose 2 of fivebar is not reached"):
        identification(record, np.array([[0.0, 224.0], [0.0, 900.0]]))
    with pytest.raises(UnknownNameError, match="measured coordinate"):
        identification(record, np.array([[0.0, 224.0]]), ["w"])
    boxed = replace(record, box={"x": (500.0, 600.0), "y": (500.0, 600.0)})
    with pytest.raises(UsageError, match="0 of 3 poses are met"):
        random_poses(boxed, 3)
