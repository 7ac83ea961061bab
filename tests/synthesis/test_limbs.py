from itertools import product

import numpy as np
import pytest

from assur.synthesis.isomorphism import limb_key
from assur.synthesis.limb_motions import verdict
from assur.synthesis.limbs import LimbType, limb_types
from assur.synthesis.required import MOTIONS
from assur.topology.notation import parse_chain, plain_text

SPACE = MOTIONS["3T"]


def letters(limb):
    return [joint.type.letter if hasattr(joint, "type") else "Pa" for joint in limb.chain.joints]


@pytest.fixture(scope="module")
def at_base():
    return limb_types(SPACE, 5, "base")


def test_no_limb_twice(at_base):
    keys = [limb.key for limb in at_base]
    assert len(keys) == len(set(keys))
    assert all(limb_key(limb.chain, SPACE, limb.driven) == limb.key for limb in at_base)


def test_driven_at_the_base_is_the_first_joint(at_base):
    assert {limb.driven for limb in at_base} == {(0,)}
    assert {letters(limb)[0] for limb in at_base} == {"R", "P", "C"}


def test_driven_in_the_leg_is_the_first_p_between_two_that_turn():
    for limb in limb_types(SPACE, 5, "leg"):
        found = letters(limb)
        turning = [place for place, letter in enumerate(found) if letter not in ("P", "Pa")]
        (driven,) = limb.driven
        assert found[driven] == "P"
        assert turning[0] < driven < turning[-1]
        assert "P" not in found[turning[0] : driven]


def test_no_more_joints_than_asked_for(at_base):
    assert max(limb.joints for limb in at_base) == 5
    assert {limb.joints for limb in limb_types(SPACE, 3, "base")} <= {1, 2, 3}
    assert limb_types(SPACE, 1, "base") == ()


def test_a_free_limb_has_one_ball_joint_and_three_joints(at_base):
    free = [limb for limb in at_base if limb.freedoms == 6]
    assert free
    assert {(letters(limb).count("S"), limb.joints) for limb in free} == {(1, 3)}


def test_a_p_along_a_neighbouring_r_is_written_as_c(at_base):
    texts = {plain_text(limb.chain) for limb in at_base}
    assert "P[x] R[x] R[x] R[x]" in texts, "a driven P is a joint of its own"
    assert not texts & {"R[x] R[x] P[x] R[x]", "R[x] R[x] R[x] P[x]"}
    assert {"R[x] C[x] R[x]", "R[x] R[x] C[x]"} <= texts


def test_a_limb_is_written_in_a_configuration_that_is_not_special():
    limbs = limb_types(MOTIONS["2T1R"], 3, "base")
    assert "P[x] R[z] P[y]" in {plain_text(limb.chain) for limb in limbs}


def test_the_column_of_the_driven_freedom():
    limb = LimbType(parse_chain("U[x,y] P[x] U[y,x]"), (1,), ())
    assert limb.driven_columns == (2,)


@pytest.mark.parametrize(
    ("count", "driven"), [(3, "base"), pytest.param(4, "base", marks=pytest.mark.deep), (4, "leg")]
)
def test_no_useful_limb_is_missed(count, driven):
    """Every word of R, P, C, P(4R) along x, y, z with so many freedoms, tried by twists and rules, with no pruning."""
    found = {limb.key for limb in limb_types(SPACE, 5, driven) if limb.freedoms == count and "U" not in letters(limb)}
    seen, missed = set(), []
    for text in _texts(count):
        chain = parse_chain(text)
        place = _driven(text.split(), driven)
        if place is None or _is_cylinder(text.split(), place):
            continue
        key = limb_key(chain, SPACE, (place,))
        if key in seen:
            continue
        seen.add(key)
        answer = verdict(LimbType(chain, (place,), key), SPACE, [np.eye(3)])
        assert not answer.disagreement
        if answer.limb and key not in found:
            missed.append(text)
    assert missed == []
    assert len(seen) > len(found)


def _texts(count):
    """Words that begin along x; every other is one of these with other names."""
    for cylinders in range(count // 2 + 1):
        for kinds in product(["R", "P", "P(4R)", "C"], repeat=count - cylinders):
            if kinds.count("C") == cylinders:
                for axes in product("xyz", repeat=len(kinds) - 1):
                    yield " ".join(f"{kind}[{axis}]" for kind, axis in zip(kinds, ("x", *axes), strict=True))


def _driven(words, where):
    if where == "base":
        return 0 if words[0][:2] in ("R[", "P[", "C[") else None
    turning = [place for place, word in enumerate(words) if word[0] in "RC"]
    inside = [place for place in range(len(words)) if words[place].startswith("P[") and turning]
    inside = [place for place in inside if turning[0] < place < turning[-1]]
    return inside[0] if inside else None


def _is_cylinder(words, driven):
    for place, word in enumerate(words):
        if word.startswith("P[") and place != driven:
            for step in (-1, 1):
                other = place + step
                while 0 <= other < len(words) and words[other][0] == "P":
                    other += step
                if 0 <= other < len(words) and other != driven and words[other][-3:] == word[-3:]:
                    return True
    return False
