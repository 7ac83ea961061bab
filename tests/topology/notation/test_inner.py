"""Tagged elements become the real planar loop, with the freedoms that they stand for."""

import numpy as np
import pytest

from assur.topology.chains import InnerLoop
from assur.topology.directions import parallel, perpendicular
from assur.topology.notation import NotationError, parse_chain, plain_text

Z = (0.0, 0.0, 1.0)


def planar_rank(branch, rng):
    """Rank of the planar twists of a branch, its R in random places: an oracle without the engine."""
    columns = []
    for joint in branch:
        if joint.type.letter == "R":
            x, y = rng.normal(size=2)
            columns.append((1, y, -x))
        else:
            columns.append((0, *joint.axes[0][:2]))
    return np.linalg.matrix_rank(np.array(columns))


@pytest.mark.parametrize(
    ("tag", "expected"),
    [
        ("6R", "RRR|RRR"),
        ("P5R", "PRR|RRR"),
        ("1P5R", "PRR|RRR"),
        ("2P4R", "PRR|PRR"),
        ("3P3R", "PPR|PRR"),
        ("4P2R", "PPR|PPR"),
    ],
)
@pytest.mark.parametrize(
    "form", ["◇(P({0}), P({0})) ⊥ R[z]({0})", "P({0}) ⊥ R[z]({0}) ∥ R({0})", "R[z]({0})-R({0})-R({0})"]
)
def test_every_tag_is_a_loop_that_moves_its_link_freely_in_the_plane(tag, expected, form):
    (loop,) = parse_chain(form.format(tag)).elements
    assert isinstance(loop, InnerLoop)
    assert "|".join("".join(joint.type.letter for joint in branch) for branch in loop.branches) == expected
    for branch in loop.branches:
        assert all(parallel(joint.axes[0], Z) for joint in branch if joint.type.letter == "R")
        assert all(perpendicular(joint.axes[0], Z) for joint in branch if joint.type.letter == "P")
        assert planar_rank(branch, np.random.default_rng(1)) == 3
    heads = [branch[0] for branch in loop.branches if branch[0].type.letter == "P"]
    assert len(heads) < 2 or parallel(heads[0].axes[0], heads[1].axes[0])


def test_the_axes_that_are_placed():
    text = "HSOC{-◇(P1[y](2P4R), P2(2P4R)) ⊥ R[x](2P4R) ⊥ R3[y] ∥ R4-}"
    assert plain_text(parse_chain(text)) == "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"


def test_heads_may_be_placed_or_related_otherwise():
    placed = "◇(P1[y](2P4R), P2[x](2P4R)) ⊥ R[z](2P4R)"
    assert plain_text(parse_chain(placed)) == "{P[y] R[z] R[z] | P[x] R[z] R[z]}"
    related = "P1[y](2P4R) ⊥ P2(2P4R) ⊥ R[z](2P4R)"
    assert plain_text(parse_chain(related)) == "{P[y] R[z] R[z] | P[x] R[z] R[z]}"
    coaxial = "P1[y](2P4R) / P2(2P4R) ⊥ R[z](2P4R)"
    assert plain_text(parse_chain(coaxial)) == "{P[y] R[z] R[z] | P[y] R[z] R[z]}"


def test_names_go_to_the_joints_of_the_loop():
    loop = parse_chain("◇(P7(2P4R), P8(2P4R)) ⊥ R12(2P4R) ⊥ R1").elements[0]
    assert loop.name == "R12"
    assert [joint.name for branch in loop.branches for joint in branch] == ["P7", "R2", "R3", "P8", "R4", "R5"]
    loop = parse_chain("R7(6R) ∥ R(6R) ∥ R9(6R)").elements[0]
    assert [joint.name for branch in loop.branches for joint in branch] == ["R7", "R1", "R9", "R2", "R3", "R4"]


@pytest.mark.parametrize(
    "text",
    [
        "◇(P[x](2P4R), P(2P4R)) ⊥ R[x](2P4R)",
        "◇(P(2P4R), P(2P4R)) ∥ R(2P4R)",
        "P(2P4R) ∥ R(2P4R) ∥ R(2P4R)",
        "R(6R) ⊥ R(6R) ∥ R(6R)",
        "R[x](6R) - R[y](6R) - R(6R)",
    ],
)
def test_what_contradicts_the_plane(text):
    with pytest.raises(NotationError, match="a contradiction"):
        parse_chain(text)
