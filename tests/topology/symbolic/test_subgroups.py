"""Limbs as products of subgroups: which of them hold back nothing more, held against the rank of twists."""

import numpy as np
import pytest

from assur.topology.notation import parse_chain, parse_chains
from assur.topology.screws.limb_linkage import limb_linkage
from assur.topology.screws.placing import place
from assur.topology.screws.recognition import recognised
from assur.topology.screws.twists import poc_dimensions
from assur.topology.symbolic.subgroups import that_hold_back, within, word
from assur.topology.symbolic.union import serial
from twist_chains import generic_edges


def _word(text):
    return word(serial(parse_chain(text)).limb.chain)


@pytest.mark.parametrize(
    ("text", "letters"),
    [
        ("R[x]@O R[y] P[z] R[y]", 2),
        ("P[z] R[y] R[y] R[x]@Q", 2),
        ("S@O P[x] P[y]", 2),
        ("C[x]@O R[x]@O", 1),
        ("P[x] R[x] R[x] R[x]", 1),
        ("R[x] R[x] R[y]", 3),
    ],
)
def test_how_many_subgroups(text, letters):
    assert len(_word(text)) == letters


@pytest.mark.parametrize("text", ["R[x] P(4R)[y]", "P(4S)[x]"])
def test_what_is_no_product_of_subgroups(text):
    assert _word(text) is None


CONTAINED = [
    ("U[x@O,y] P[z] R[y]", "U[x@O,y] R[y] R[y]"),
    ("R[x]@O R[y] R[y] R[y]", "S@O R[y] R[y] R[y]"),
    ("R[x]@O R[y]@Q", "R[x]@O R[y] R[y] R[y]"),
    ("R[x]@O R[y]@Q", "C[x]@O P[z] R[y]@Q"),
    ("R[y] R[y] R[y]", "P[x] R[y] R[y] R[y] P[y]"),
]


@pytest.mark.parametrize(("one", "other"), CONTAINED)
def test_a_limb_within_another_one_is_the_platform(one, other):
    """Both together let the platform do what the first alone does, by twists; the other way round they need not."""
    assert within(_word(one), _word(other))
    chains = parse_chains([one, other])
    linkage = place(chains)
    alone = limb_linkage(linkage, chains[0])
    platform = poc_dimensions(generic_edges(linkage), linkage.base, linkage.platform)
    assert platform[1:] == poc_dimensions(generic_edges(alone), alone.base, alone.platform)[1:]


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("U[x@O,y] P[z] R[y]", "U[x,y] P[z] R[y]"),  # another line
        ("R[x]@O R[y]@Q", "R[y]@Q R[x]@O"),  # another order
        ("S@O", "U[x,y]@O"),
        ("P[x]", "R[x] R[y] R[z]"),
    ],
)
def test_limbs_that_are_not_within_each_other(one, other):
    assert not within(_word(one), _word(other))


def test_limbs_without_common_points_all_stay():
    limbs = [serial(chain).limb for chain in parse_chains(["R[z] R[z] R[z]"] * 3)]
    assert len(that_hold_back(limbs)) == 3


def test_a_limb_that_is_special_at_home_stays():
    limbs = [serial(chain).limb for chain in parse_chains(["R[x]@O P[z] R[y] P[z]", "R[x]@O P[z] R[y] P[z]"])]
    assert len(that_hold_back(limbs)) == 2


def test_recognised_limbs_share_what_was_written():
    """From places alone, as in files of mechanisms."""
    chains = recognised(place(parse_chains(["R[x]@O R[y] P[z] R[y]", "R[x]@O R[y] P[z] R[y]"])))
    limbs = [serial(chain).limb for chain in chains]
    assert len(that_hold_back(limbs)) == 1
    assert np.allclose(limbs[0].chain[0].direction, (1, 0, 0))
