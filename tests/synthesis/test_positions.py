import numpy as np
import pytest

from assur.synthesis.positions import in_words, placements, positions, turned, upright
from assur.synthesis.required import MOTIONS
from assur.topology.notation import parse_chain, plain_text


@pytest.mark.parametrize(("name", "limbs"), [("3T", 3), ("2T1R", 3), ("3T1R", 4)])
def test_positions_are_different_rotations(name, limbs):
    found = positions(MOTIONS[name], limbs)
    assert len(found) == limbs
    assert found[0] == pytest.approx(np.eye(3))
    for turn in found:
        assert turn.T @ turn == pytest.approx(np.eye(3), abs=1e-14)
        assert np.linalg.det(turn) == pytest.approx(1)
    if MOTIONS[name].axis is None:
        assert np.linalg.matrix_rank([turn @ (1, 0, 0) for turn in found]) == 3
    else:
        assert all(turn @ MOTIONS[name].axis == pytest.approx(MOTIONS[name].axis) for turn in found)
        assert np.linalg.matrix_rank([turn @ (1, 0, 0) for turn in found]) == 2


def test_a_turned_chain_is_read_back_with_parallel_axes():
    chain = parse_chain("R[y] U[y,z] P(4R)[x] S R[y]")
    for turn in positions(MOTIONS["2T1R"], 3):
        text = plain_text(turned(chain, turn))
        again = parse_chain(text)
        assert [element.axes for element in again.joints if element.name == "R1"]
        first, last = (np.array(again.joints[place].axes[0]) for place in (0, -1))
        assert first == pytest.approx(turn @ (0, 1, 0), abs=1e-14)
        assert np.cross(first, last) == pytest.approx(np.zeros(3), abs=1e-14)


@pytest.mark.parametrize(("name", "count"), [("3T", 4), ("3T1R", 3), ("2T1R", 3)])
def test_two_limbs_have_positions_to_choose_from(name, count):
    found = positions(MOTIONS[name], 2)
    assert placements(MOTIONS[name], 2) == tuple((0, other) for other in range(1, count))
    assert len(found) == count
    assert found[-1] == pytest.approx(found[0])
    assert found[1] @ (1, 0, 0) == pytest.approx((0, 1, 0), abs=1e-14)


def test_positions_in_words():
    assert in_words(MOTIONS["3T"], 3) == "each limb is the one before with x, y, z turned into y, z, x"
    assert in_words(MOTIONS["2T1R"], 3) == "each limb is the one before turned about z by 120°"
    assert in_words(MOTIONS["3T1R"], 4) == "each limb is the one before turned about z by 90°"
    assert in_words(MOTIONS["3T1R"], 2).startswith("the second limb is as written turned about z by 90°, or beside")


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("3T", "P[x] R[y] P(4R)[x] R[y]", "P[z] R[x] P(4R)[z] R[x]"),
        ("3T", "R[y] R[y] R[z] R[z] P[x]", "R[x] R[x] R[y] R[y] P[z]"),
        ("3T", "P[y] P[z] P[x]", "P[x] P[y] P[z]"),
        ("3T1R", "R[y] R[y] R[z] P[x] R[z]", "R[x] R[x] R[z] P[y] R[z]"),
        ("3T1R", "R[z] P[x] P[y] P[z]", "R[z] P[x] P[y] P[z]"),
    ],
)
def test_limbs_are_written_upright(name, text, expected):
    assert plain_text(upright(parse_chain(text), MOTIONS[name])) == expected
