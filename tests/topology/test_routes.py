"""xi by the rules against the rank of the closure: where it is compared, and where no POC set stands for a loop."""

import dataclasses
from functools import lru_cache

import pytest

import assur
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.counting.coupling import coupling, coupling_of
from assur.topology.counting.inputs import default_inputs
from assur.topology.notation import parse_chains
from assur.topology.routes import check_xi
from assur.topology.screws.placing import place
from assur.topology.screws.twists import ShakyError
from assur.topology.symbolic.union import serial
from twist_chains import generic_edges

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
        assert message == f"loop {number} ({', '.join(loop.joints)}): {said}"


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


TURNS = ((1.0, 0.0), (-0.5, 0.8660254037844386), (-0.5, -0.8660254037844386))
"""Three limbs turned about z: the cosine and sine of each."""


def three(text):
    """A limb written with axes a (radial), t (tangential), and its turns about z."""
    return [text.replace("a", f"{c},{s},0").replace("t", f"{-s},{c},0") for c, s in TURNS]


def test_three_limbs_whose_only_common_orientation_is_a_double_one_are_shaky():
    """C[t] R[t] U[t;a]: limb i asks t_i . R a_i = 0. With R = exp(w) and w along the angle b from x this is
    w_z + |w|^2 sin(2b - 2 phi_i) / 4 = 0 to second order: of three phi_i, 120 degrees apart, only w = 0 is left, twice.
    The rotations about x and y are instantaneous everywhere and lead nowhere; the routes used to disagree on rounding.
    """
    texts = three("C[t] R[t] U[t; a]")
    with pytest.raises(ShakyError, match="shaky"):
        assur.topology(texts)
    two = assur.topology(texts[:2])  # w_z can follow |w|^2: the platform turns
    assert two.poc.r > 0
    assert assur.topology(texts[:1]).poc.dim == 5


def test_the_rules_leave_a_platform_to_the_twists_where_the_mechanism_keeps_a_limb_special():
    """The axes of each limb lie on one line, all sliders stay where they are, and only the rods spin."""
    found = assur.topology([f"R[z]@{at} {slide} R[z]@{at}" for at, slide in zip("ABC", three("P[a]"), strict=True)])
    assert (found.poc.dim, found.known.route) == (0, "twists")
    assert "keeps limb 1 in a special position" in found.known.refusal


def test_limbs_whose_forces_may_run_through_a_shared_point_of_the_base_are_refused():
    """Each S@O C[u] resists one force, and it runs through O: the platform turns about O, and O' moves in t2."""
    found = assur.topology(["S@O C[x]", "S@O C[y]", "S@O C[z]"])
    assert (found.poc.t, found.poc.r, found.poc.dim) == (2, 3, 3)
    assert "share a point" in found.known.refusal


def test_xi_is_not_compared_where_fewer_limbs_would_not_hold_a_limb_special():
    """Three limbs y, y, z, y keep the platform unturned, each in the plane across its y; two of them do not."""
    found = assur.topology(three("R[t] U[t; 0,0,1] P[0,0,1] R[t]"))
    assert (found.poc.t, found.poc.r, found.known.route) == (1, 0, "both")
    assert found.xi[0] == 6  # the rules would have said xi = 4
