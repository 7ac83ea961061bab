"""Limbs that share points, or turn about axes of the platform: the rules seldom refuse them, and are never wrong."""

import math
import random

import pytest

from assur.derived_topology import topology
from assur.synthesis.positions import CYCLE, SWAP, turned
from assur.topology.notation import parse_chains, plain_text
from assur.topology.routes import by_rules, told_point
from assur.topology.screws.configurations import ImmobileError
from assur.topology.symbolic.refusals import Refusal
from sharing_limbs import random_sharing_mechanism

SEEDS = (19, 20, 21)
SELDOM = 0.05
SEVERAL = ("several modes", "several operation modes")
"""What the rules say where no one POC set stands for what can go on from home."""


def _around(text, count=3):
    """A limb for each of three directions; c and s stand for the cosine and sine of its angle."""
    angles = [2 * math.pi * number / count for number in range(count)]
    return [text.format(c=math.cos(angle), s=math.sin(angle), n=-math.sin(angle)) for angle in angles]


FIVE = {
    "Exechon": (["U[x@O,y] P[z] R[y]", "U[x@O,y] P[z] R[y]", "S P[z] R[x]"], (3, 2, 3)),
    "2UPR-RPU": (["U[x@O,y] P[z] R[y]", "U[x@O,y] P[z] R[y]", "R[x] P[z] U[x,y]"], (3, 2, 3)),
    "3-SPR": (_around("S P[z] R[{n},{c},0]"), (3, 2, 3)),
    "3-UPU wrist": (
        [
            "U[x@O; 0,1,1] P[0,1,-1] U[0,1,1; 1,2,0@O]",
            "U[y@O; 1,0,1] P[1,0,-1] U[1,0,1; 0,1,2@O]",
            "U[z@O; 1,1,0] P[1,-1,0] U[1,1,0; 2,0,1@O]",
        ],
        (0, 3, 3),
    ),
    "the wrist with its U apart": (
        [
            "R[x]@O R[0,1,1] P[0,1,-1] R[0,1,1] R[1,2,0]@O",
            "R[y]@O R[1,0,1] P[1,0,-1] R[1,0,1] R[0,1,2]@O",
            "R[z]@O R[1,1,0] P[1,-1,0] R[1,1,0] R[2,0,1]@O",
        ],
        (0, 3, 3),
    ),
    "4-URU": (["U[z,x] R[x] U[x,z]", "U[z,y] R[y] U[y,z]"] * 2, (3, 1, 4)),
}


@pytest.mark.parametrize("name", FIVE)
def test_mechanisms_of_the_literature_by_both_routes(name):
    limbs, numbers = FIVE[name]
    found = topology(limbs)
    assert (found.poc.t, found.poc.r, found.poc.dim) == numbers
    assert found.known.route == "both", found.known.refusal


@pytest.mark.parametrize("name", FIVE)
def test_the_rules_do_not_depend_on_the_order_of_limbs_or_on_the_names_of_axes(name):
    limbs, numbers = FIVE[name]
    for number, turn in enumerate((CYCLE, CYCLE @ CYCLE, SWAP @ CYCLE)):
        chains = [turned(chain, turn) for chain in parse_chains(limbs)]
        platform = _by_rules(chains[number:] + chains[:number])
        assert not isinstance(platform, Refusal), [plain_text(chain) for chain in chains]
        assert (platform.poc.t, platform.poc.r, platform.poc.dim) == numbers


def _drawn(count, seed=SEEDS[0]):
    rng = random.Random(seed)
    return [random_sharing_mechanism(rng) for _ in range(count)]


def _platform(limbs):
    return _by_rules(parse_chains(limbs))


def _by_rules(chains):
    return by_rules(chains, still=False, held=False, at=told_point(chains, held=False)).platform


def test_the_rules_seldom_refuse_limbs_that_share_points():
    answers = [_platform(limbs) for limbs in _drawn(60)]
    refused = [answer.reason for answer in answers if isinstance(answer, Refusal)]
    unknown = [reason for reason in refused if not any(several in reason for several in SEVERAL)]
    assert len(unknown) <= SELDOM * (len(answers) - len(refused) + len(unknown))


@pytest.mark.parametrize("limbs", _drawn(4), ids=" ; ".join)
def test_rules_and_twists_agree_on_limbs_that_share_points(limbs):
    assert topology(limbs).known.route in ("both", "twists")


@pytest.mark.parametrize("slides", ["P[z] P[x] S@Q", "P[z] P[x] R[y] S@Q", "P[z] R[y] R[y] S@Q"])
def test_a_limb_whose_part_the_others_allow_moves_on_by_that_part(slides):
    """The first axis rests: the limbs leave Q in one plane, which it would turn out of. Apart they have r³ together."""
    limbs = ["R[z] R[y] R[y] R[y] R[z]@Q", slides]
    found = topology(limbs)
    assert (found.known.route, found.poc.r, found.poc.dim) == ("twists", 2, 4)
    apart = topology([limb.replace("@Q", "") for limb in limbs])
    assert (apart.known.route, apart.poc.r, apart.poc.dim) == ("both", 3, 4)


def _moving(limbs):
    """What is found of limbs, nothing of those that do not move."""
    try:
        return topology(limbs)
    except ImmobileError:
        return None


@pytest.mark.parametrize(
    ("limbs", "numbers"),
    [
        (["R[z] R[y] R[y] R[y] R[z]", "R[x] P[y] R[z] R[z] R[1,1,0]"], (3, 3, 4)),
        (["R[z]@O R[x] P[y] U[x,z@Q]", "R[x]@O R[y] R[y] U[y,x@Q]"], (3, 3, 4)),
        (["R[z] P[x] R[y] R[z]@Q"] * 3, (2, 1, 3)),
        (["R[z]@O R[y] P[x] R[z]", "R[z]@O P[x] R[y] R[z]"], (2, 1, 3)),
    ],
    ids=["base and platform", "with points", "a line of the platform", "a line of the base"],
)
def test_what_limbs_resist_is_told_of_directions_of_both_and_of_one_line(limbs, numbers):
    found = topology(limbs)
    assert (found.known.route, found.poc.t, found.poc.r, found.poc.dim) == ("both", *numbers)


@pytest.mark.deep
@pytest.mark.parametrize("seed", SEEDS)
def test_rules_are_right_on_limbs_that_share_points_and_seldom_refuse(seed):
    """Over 600: where twists find one operation mode. A wrong rule raises."""
    known = [found for found in map(_moving, _drawn(600, seed)) if found and len(found.modes) < 2]
    refused = [found for found in known if found.known.route == "twists" and found.dof]
    assert len(refused) <= SELDOM * len(known)
