"""xi by the rules against the rank of the closure: where it is compared, and where no POC set stands for a loop."""

from __future__ import annotations

import dataclasses
from functools import lru_cache

import pytest

from assur.topology.agreement import RoutesDisagreeError
from assur.topology.counting.coupling import coupling, coupling_of
from assur.topology.counting.inputs import default_inputs
from assur.topology.linkages.placing import place
from assur.topology.linkages.twists import generic_edges
from assur.topology.notation import parse_chains
from assur.topology.routes import check_xi
from assur.topology.rules.union import serial

HYBRID = "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"
INNER = "P[z] {P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"
BARE = "{P[y] R[x] R[x] | P[y] R[x] R[x]}"
SLIDES = "P[y] P(4R)[x] P(4R)[y]"


@lru_cache
def closed(texts, order=None):
    """The limbs, their motions by the rules, and the loops by the rank of the closure."""
    chains = parse_chains(texts)
    given = generic_edges(place(chains, actuated=default_inputs(chains)))
    loops = (coupling_of(given, order) if order else coupling(given)).loops
    return chains, [serial(chain) for chain in chains], loops


def compared(texts, order=None):
    """What is said of each loop whose xi is compared, by its number: where another xi is noticed."""
    chains, motions, loops = closed(texts, order)
    found = {}
    for index, loop in enumerate(loops):
        wrong = [*loops[:index], dataclasses.replace(loop, xi=loop.xi - 1), *loops[index + 1 :]]
        try:
            check_xi(chains, motions, wrong, held=False)
        except RoutesDisagreeError as error:
            found[index + 1] = error.message
    return found


@pytest.mark.parametrize(
    ("texts", "loops"),
    [
        (("P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"), [1, 2]),
        (("R[z] R[z] R[z]",) * 3, [1, 2]),
        ((HYBRID, SLIDES), [2]),  # the first loop is inside a limb
        ((HYBRID, SLIDES, "U P S"), [2, 3]),
        (("U P S",) * 6, [1, 2, 3, 4, 5]),
    ],
)
def test_loops_that_close_whole_limbs_are_compared(texts, loops):
    check_xi(*closed(texts), held=False)
    found = compared(texts)
    assert list(found) == loops
    for number, message in found.items():
        loop = closed(texts)[2][number - 1]
        said = f"the rules say xi = {loop.xi}, the rank of the closure {loop.xi - 1}"
        assert message == f"loop {number} ({', '.join(loop.edges)}): {said}"


@pytest.mark.parametrize(
    ("texts", "order"),
    [
        ((INNER, SLIDES), None),
        ((INNER, "U P S"), None),
        ((INNER, INNER, INNER), None),
        ((HYBRID, HYBRID), None),
        ((BARE, "R[x] R[x] R[x]"), None),
        ((INNER, SLIDES), (("P1", "P2", "R1", "R2", "R5", "R6", "Pa2", "Pa1", "P4"), ("P3", "R3", "R4"))),
        (("R[x] R[x] R[x]", BARE), (("R1", "R2", "R3", "R5", "R4", "P1"), ("P2", "R6", "R7"))),
    ],
)
def test_a_branch_that_comes_after_its_limb_was_passed_is_not_taken_for_the_limb(texts, order):
    check_xi(*closed(texts, order), held=False)


def test_after_such_a_branch_whole_limbs_are_compared_again():
    texts = (INNER, SLIDES, "R[z] R[z] R[z] R[x] R[x]")
    order = (
        ("P1", "P2", "R1", "R2", "R5", "R6", "Pa2", "Pa1", "P4"),
        ("P3", "R3", "R4"),
        ("R7", "R8", "R9", "R10", "R11"),
    )
    check_xi(*closed(texts, order), held=False)
    assert list(compared(texts, order)) == [3]


def test_nothing_is_compared_where_a_limb_is_not_known():
    chains, motions, loops = closed((HYBRID, SLIDES))
    wrong = [dataclasses.replace(loop, xi=1) for loop in loops]
    check_xi(chains, [motions[0], None], wrong, held=False)
