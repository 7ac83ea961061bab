"""Legs that another synthesis lists, which looks for robots by their dimensions, are among the limbs of this one."""

import tomllib
from functools import cache
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest

from assur.derived_topology import topology
from assur.synthesis.following_limbs import INDEPENDENT, KINDS, following_words
from assur.synthesis.placed_series import DRAWS, SIZE, PlacedSeries, best_of, following
from assur.synthesis.question import question
from assur.synthesis.synthesis import synthesis
from assur.synthesis.virtual_chains import rows_named
from assur.topology.notation import parse_chain

PUBLISHED = tomllib.loads(Path(__file__).with_name("published_legs.toml").read_text(encoding="utf-8"))
MOTIONS = {"3T": "3T:PPP", "3T1R": "3T1R:PPPR", "3T2R": "3T2R:PPPU"}
FREEDOMS = (4, 5)
DOCS = Path(__file__).parents[2] / "docs" / "topology.md"


def numbered(directions):
    """Equal numbers for equal directions, in the order in which they first stand."""
    numbers = {}
    return tuple(numbers.setdefault(direction, len(numbers)) for direction in directions)


def of_revolute_joints(leg):
    """The order of the joints, and which R are parallel, whatever the P."""
    word, axes = leg
    return word, numbered([axis for letter, axis in zip(word, axes, strict=True) if letter == "R"])


def published(motion):
    """Order of joints and numbers of directions, of each class there."""
    classes = (key.split() for key in PUBLISHED[motion])
    return [(word, numbered(axes.split("-"))) for word, axes in classes]


@cache
def written(motion, *, idle):
    """The same of the limbs of this synthesis with at most one P, axes along x, y and z."""
    (row,) = rows_named(MOTIONS[motion])
    words = [word for freedoms in FREEDOMS if freedoms >= row.dim for word in following_words(row, freedoms, idle=idle)]
    legs = {("".join(KINDS[letter // 3] for letter in word), numbered(word % 3)) for word in words}
    return {(word, axes) for word, axes in legs if word.count("P") <= 1}


def follows(leg, motion, directions):
    """Whether the leg with these directions follows the motion, all freedoms independent at home, at random places."""
    word, axes = leg
    (row,) = rows_named(MOTIONS[motion])
    generator = np.random.default_rng(19)
    turning = np.array([[letter == "R" for letter in word]])
    lines = np.array([[directions[number] for number in axes]])
    series = best_of(
        [PlacedSeries(lines, generator.uniform(-SIZE, SIZE, (1, len(word), 3)), turning) for _ in range(DRAWS)]
    )
    smallest = np.linalg.svd(series.at(np.zeros(turning.shape))[2], compute_uv=False)[0, -1]
    return smallest > INDEPENDENT and bool(following(series, row.series, row.values)[0][0])


def follows_in_some_directions(leg, motion, others):
    """Whether it does with the platform's axes of rotation along some of its own, the rest in other directions."""
    (row,) = rows_named(MOTIONS[motion])
    count = max(leg[1]) + 1
    for numbers in permutations(range(count), len(row.rotations)):
        rest = iter(others)
        turns = dict(zip(numbers, row.rotations, strict=True))
        if follows(leg, motion, [np.array(turns[n]) if n in turns else next(rest) for n in range(count)]):
            return True
    return False


def oblique():
    drawn = np.random.default_rng(3).normal(size=(3, 3))
    return list(drawn / np.linalg.norm(drawn, axis=1, keepdims=True))


@pytest.mark.parametrize("motion", MOTIONS)
def test_each_published_leg_follows_the_motion_by_finite_displacements(motion):
    """With directions by chance where nothing is said of them."""
    assert [leg for leg in published(motion) if not follows_in_some_directions(leg, motion, oblique())] == []


@pytest.mark.parametrize("motion", MOTIONS)
def test_each_published_leg_is_a_limb_of_this_synthesis_or_needs_an_oblique_axis(motion):
    """One that does stands there by its R; its P, at right angles or parallel to these, would move nothing new."""
    limbs = written(motion, idle=True)
    others = [leg for leg in published(motion) if leg not in limbs]
    assert {of_revolute_joints(leg) for leg in others} <= set(map(of_revolute_joints, limbs))
    right = {"3T": np.eye(3), "3T1R": np.eye(3)[:2], "3T2R": np.eye(3)[2:]}[motion]
    assert [leg for leg in others if follows_in_some_directions(leg, motion, list(right))] == []


def table():
    """What docs say: the numbers of each motion, line by line."""
    counts = []
    for motion, legs in PUBLISHED.items():
        limbs, theirs = written(motion, idle=True), published(motion)
        rests = {*map(of_revolute_joints, limbs)} - {*map(of_revolute_joints, written(motion, idle=False))}
        ours, given = (set(map(of_revolute_joints, some)) for some in (limbs, theirs))
        numbers = {(key.split()[0], number) for key, value in legs.items() for number in value.split()}
        whole = {(word, number.partition("V")[0]) for word, number in numbers}
        counts.append(
            (
                *map(len, (numbers, whole, theirs, set(theirs) - limbs)),
                *map(len, (given, given & rests, ours, (ours - given) & rests)),
            )
        )
    return [" | ".join(map(str, line)) for line in zip(*counts, strict=True)]


def test_the_docs_have_the_numbers():
    text = DOCS.read_text(encoding="utf-8").partition("### Beside a published list")[2].partition("\n### ")[0]
    rows = [line.partition("| ")[2].partition(" | ")[2].removesuffix(" |") for line in text.splitlines() if "|" in line]
    assert rows[2:] == table()


@pytest.mark.parametrize(("motion", "more"), [("3T", []), ("3T2R", ["RRRRP"] * 3)])
def test_limbs_of_this_synthesis_alone(motion, more):
    ours, theirs = (set(map(of_revolute_joints, legs)) for legs in (written(motion, idle=True), published(motion)))
    last_across = {("RPRRR", (0, 0, 0, 1)), ("RRPRR", (0, 0, 0, 1))}
    assert last_across <= ours - theirs
    assert [word for word, _ in ours - theirs - last_across] == more


@pytest.mark.deep
def test_three_legs_of_each_published_class_make_a_mechanism():
    """By rules and twists, neither of which knows how limbs were looked for; and by the synthesis itself."""
    found = synthesis(question("3T:PPP", symmetric=True, idle=True, actuators="any", members=1))
    listed = {of_revolute_joints(_leg(design.chains[0].text)): design for design in found.designs}
    assert set(map(of_revolute_joints, published("3T"))) <= set(listed)
    for design in listed.values():
        whole = topology([chain.text for chain in design.chains], mode=design.mode)
        assert (whole.dof, whole.poc.t, whole.poc.r) == (3, 3, 0), design.chains


def _leg(text):
    joints = [(joint, axis) for joint in parse_chain(text).joints for axis in joint.axes]
    word = "".join("P" if joint.type.letter == "P" else "R" for joint, _ in joints)
    return word, numbered([axis for _, axis in joints])
