"""A mechanism with dimensions as topology sees it: screws of the closed home, limbs, common points."""

from pathlib import Path

import numpy as np
import pytest

from assur.kinematics.closure import loop_twists
from assur.kinematics.home import home_values
from assur.kinematics.structure import chains, linkage
from assur.model.registry import load_record, names
from assur.topology.chains import InnerLoop, Parallelogram

FILES = Path(__file__).parents[1] / "model"


def records():
    return [load_record(name) for name in names()] + [load_record(FILES / "file" / "delta.toml")]


@pytest.mark.parametrize("record", records(), ids=lambda record: record.name)
def test_the_screws_are_those_of_the_loop_closure_at_home(record):
    built = linkage(record)
    stacked = np.vstack([joint.screws for joint in built.joints.values()]).T
    closure = loop_twists(record, home_values(record)).reshape(-1, 6, stacked.shape[1])
    for loop in closure:
        used = np.any(loop != 0, axis=0)
        signs = np.sign(np.sum(loop * stacked, axis=0))
        assert np.allclose(loop[:, used], (signs * stacked)[:, used], atol=1e-9 * built.length)


def test_the_paper_has_a_hybrid_chain_with_an_inner_loop_and_one_with_two_parallelograms():
    first, second = chains(load_record("zeng2019"))
    loop = first.elements[0]
    assert isinstance(loop, InnerLoop)
    assert [[joint.name for joint in branch] for branch in loop.branches] == [["P1", "B1", "C1"], ["P2", "B2", "C2"]]
    assert [joint.name for joint in first.elements[1:]] == ["R3", "R4"]
    assert [type(element) for element in second.elements[1:]] == [Parallelogram, Parallelogram]
    assert [np.round(np.abs(element.axis), 9).tolist() for element in second.elements[1:]] == [[1, 0, 0], [0, 1, 0]]


def test_no_two_axes_of_the_paper_meet_so_no_point_is_labelled():
    assert not any(
        joint.point for chain in chains(load_record("zeng2019")) for joint in chain.joints if hasattr(joint, "point")
    )


MEETING = """
format = 1
name = "wrist"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "hand", pose = ["x", "y", "z"], orientation = "any" }
[links]
base = {}
one = {}
two = {}
hand = {}
[joints]
A = { type = "revolute", parent = "base", child = "one", at = [0, 0, 10], axis = "z" }
B = { type = "revolute", parent = "one", child = "two", at = [0, 0, 5], axis = "x" }
C = { type = "revolute", parent = "two", child = "hand", at = [%s, 0, 0], axis = "y" }
[inputs]
A = { name = "a" }
[home]
A = 20
B = 30
C = 40
"""


@pytest.mark.parametrize(("offset", "labelled"), [("7", [True, True, False]), ("0", [True, True, True])])
def test_neighbouring_axes_that_meet_share_a_label(tmp_path, offset, labelled):
    # the axis of C, 7 mm along x, runs along y past the point of A and B; with no offset it meets them there
    file = tmp_path / "wrist.toml"
    file.write_text(MEETING % offset, encoding="utf-8")
    (chain,) = chains(load_record(file))
    assert [bool(joint.point) for joint in chain.joints] == labelled
    assert len({joint.point for joint in chain.joints if joint.point}) == 1
