"""Every joint of a mechanism has its own name."""

import pytest

from assur.topology.chains import InnerLoop
from assur.topology.notation import parse_chain, parse_chains


def names(*texts):
    return [[joint.name for joint in chain.joints] for chain in parse_chains(texts)]


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        (["P R R", "P C"], [["P1", "R1", "R2"], ["P2", "C1"]]),
        (["U P S", "H Pa P(4S)"], [["U1", "P1", "S1"], ["H1", "Pa1", "Pa2"]]),
        (["{P R|P R} R", "R"], [["P1", "R1", "P2", "R2", "R3"], ["R4"]]),
        (["R R2 R", "R1"], [["R3", "R2", "R4"], ["R1"]]),
        (["R1 R2", "R1 R2"], [["R1", "R2"], ["R3", "R4"]]),
        (["R1 R", "R1 R2"], [["R1", "R3"], ["R4", "R2"]]),
        (["Pa2 Pa", "R_{i1} R_a R3'"], [["Pa2", "Pa1"], ["Ri1", "Ra", "R3'"]]),
    ],
)
def test_names_are_written_or_counted(texts, expected):
    found = names(*texts)
    assert found == expected
    flat = [name for limb in found for name in limb]
    assert len(set(flat)) == len(flat)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("{P[y] R[x] R[x] | P[y] R[x] R[x]}", ["R12"]),
        ("R12 {P[y] R[x] R[x] | P[y] R[x] R[x]}", ["R34"]),
        ("{R[x] | R[y]}", [""]),
        ("{P[y] P[z] R[x] | P[y] R[x] R[x]}", ["R23"]),
        ("{P[y] R[x] R[x] | {P[y] R[x] R[x] | P[y] R[x] R[x]}}", ["R34", ""]),
        ("HSOC{-◇(P1(2P4R), P2(2P4R)) ⊥ R(2P4R) ⊥ R3 ∥ R4-}", ["R12"]),
    ],
)
def test_a_planar_loop_is_called_by_its_hinges(text, expected):
    assert list(loop_names(parse_chain(text).elements)) == expected


def loop_names(elements):
    """Of the inner loops, the innermost first."""
    for loop in elements:
        if isinstance(loop, InnerLoop):
            for branch in loop.branches:
                yield from loop_names(branch)
            yield loop.name
