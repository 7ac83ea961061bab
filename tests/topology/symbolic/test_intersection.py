import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.errors import UsageError
from assur.joints.cylindrical import CYLINDRICAL
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.topology.chains import Chain, ChainJoint, Parallelogram
from assur.topology.directions import unit
from assur.topology.notation import parse_chains
from assur.topology.screws.placing import place
from assur.topology.screws.twists import poc_dimensions
from assur.topology.symbolic.intersection import parallel, xi_of_next
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.union import serial
from examples import examples
from twist_chains import generic_edges

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def _around(text, count=3):
    """A limb with its axes turned about z, once for each limb; `<a>` in the text is a direction of the first limb."""
    limbs = []
    for index in range(count):
        cosine, sine = math.cos(2 * math.pi * index / count), math.sin(2 * math.pi * index / count)
        head, *pieces = text.split("<")
        for piece in pieces:
            vector, rest = piece.split(">")
            x, y, z = map(float, vector.split(","))
            head += f"{cosine * x - sine * y!r},{sine * x + cosine * y!r},{z!r}{rest}"
        limbs.append(head)
    return limbs


def _platform(limbs, mode="free"):
    motions = [serial(chain, mode) for chain in parse_chains(limbs)]
    return parallel(motions, mode)


def _numbers(motion):
    return motion.poc.t, motion.poc.r, motion.poc.dim


def _xi(limbs, mode="free"):
    motions = [serial(chain, mode) for chain in parse_chains(limbs)]
    so_far = [parallel(motions[: count + 1], mode) for count in range(len(motions))]
    return tuple(xi_of_next(so_far[i], motions[i + 1], so_far[i + 1]) for i in range(len(motions) - 1))


def _by_twists(chains, mode="free"):
    linkage = place(chains)
    hold = "orientation" if mode == "translation" else None
    return poc_dimensions(generic_edges(linkage, hold=hold), linkage.base, linkage.platform)


# poc-theory.md, section 5: limbs, mode, platform, dim, xi
PLANAR = "R[z] R[z] R[z]"
MECHANISMS = {
    "the paper's": (
        ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]"],
        "free",
        ("t³ r⁰", 3),
        (5,),
    ),
    "Delta with 4R parallelograms": (
        _around("R[<0,1,0>] R[<0,1,0>] P(4R)[<1,0,0>] R[<0,1,0>]"),
        "free",
        ("t³ r⁰", 3),
        (5, 4),
    ),
    "Delta with 4S parallelograms": (
        _around("R[<0,1,0>] P(4S)[<0,1,0>]"),
        "translation",
        ("t³ r⁰", 3),
        (6, 6),
    ),
    "linear Delta with 4S parallelograms": (
        _around("P[<1,0,1>] P(4S)[<0,1,0>]"),
        "translation",
        ("t³ r⁰", 3),
        (6, 6),
    ),
    "Orthoglide": (
        ["P[x] R[y] P(4R)[z] R[y]", "P[y] R[z] P(4R)[x] R[z]", "P[z] R[x] P(4R)[y] R[x]"],
        "free",
        ("t³ r⁰", 3),
        (5, 4),
    ),
    "linear Delta as P-R-Pa-R": (
        _around("P[z] R[<0,1,0>] P(4R)[<1,0,1>] R[<0,1,0>]"),
        "free",
        ("t³ r⁰", 3),
        (5, 4),
    ),
    "3-UPU": (
        _around("U[<0,1,0>,<0.6,0,0.8>] P[<-0.8,0,0.6>] U[<0.6,0,0.8>,<0,1,0>]"),
        "translation",
        ("t³ r⁰", 3),
        (6, 6),
    ),
    "tripteron": ([f"P[{u}] R[{u}] R[{u}] R[{u}]" for u in "xyz"], "free", ("t³ r⁰", 3), (5, 4)),
    "3-CRR": ([f"C[{u}] R[{u}] R[{u}]" for u in "xyz"], "free", ("t³ r⁰", 3), (5, 4)),
    "3-RRC": (_around("R[<0,1,0>] R[<0,1,0>] C[<0,1,0>]"), "free", ("t³ r⁰", 3), (5, 4)),
    "planar 3-RRR": ([PLANAR] * 3, "free", ("t²(⊥R1) r¹(∥R1)", 3), (3, 3)),
    "planar 3-RPR": (["R[z] P[x] R[z]"] * 3, "free", ("t²(⊥R1) r¹(∥R1)", 3), (3, 3)),
    "planar five-bar": (["R[z] R[z] R[z]", "R[z] R[z]"], "free", ("t²(⊥R1) r¹(∥R1)", 2), (3,)),
    "3-RPS": (_around("R[<0,1,0>] P[z] S"), "free", ("t³ r²(moving)", 3), (6, 6)),
    "6-UPS": (["U P S"] * 6, "free", ("t³ r³", 6), (6, 6, 6, 6, 6)),
    "3UPS&UP": (["U P S"] * 3 + ["U[x,y] P[z]"], "free", ("t³ r²(∥◇(U4))", 3), (6, 6, 6)),
}


@pytest.mark.parametrize("name", MECHANISMS)
def test_platform_of_section_5(name):
    limbs, mode, (printed, dim), _ = MECHANISMS[name]
    motion = _platform(limbs, mode)
    assert (str(motion.poc), motion.dim) == (printed, dim)


@pytest.mark.parametrize("name", MECHANISMS)
def test_xi_of_section_5(name):
    limbs, mode, _, xi = MECHANISMS[name]
    assert _xi(limbs, mode) == xi


@pytest.mark.parametrize("name", MECHANISMS)
def test_platform_of_section_5_by_twists(name):
    limbs, mode, _, _ = MECHANISMS[name]
    assert _numbers(_platform(limbs, mode)) == _by_twists(parse_chains(limbs), mode)


# poc-theory.md, section 4: what limbs have in common, dim of it
RULES = {
    "1 n 1 parallel": (["P[x]", "P[x]"], "t¹(∥P1) r⁰"),
    "1 n 1 not parallel": (["P[x]", "P[y]"], "t⁰ r⁰"),
    "1 n 2 in the plane": (["P[x]", "P[x] P[y]"], "t¹(∥P1) r⁰"),
    "1 n 2 not in the plane": (["P[z]", "P[x] P[y]"], "t⁰ r⁰"),
    "2 n 2 parallel planes": (["P[x] P[y]", "P[0.6,0.8,0] P[y]"], "t²(∥◇(P1, P2)) r⁰"),
    "2 n 2 along their common line": (["P[x] P[y]", "P[y] P[z]"], "t¹(∥P2) r⁰"),
    "3 n k": (["P[x] P[y] P[z]", "P[x] P[y]"], "t²(∥◇(P1, P2)) r⁰"),
    "0 n k": (["P[x] P[y] P[z]", "R[x]"], "t⁰ r⁰"),
    "X(u) n X(v) = T": (["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]"], "t³ r⁰"),
    "X(u) n X(u) = X(u)": (["P[x] R[x] R[x] R[x]"] * 2, "t³ r¹(∥R1)"),
    "G(u) n G(v) = t1(u x v)": (["R[x] R[x] R[x]", "R[y] R[y] R[y]"], "t¹(∥z) r⁰"),
    "G(u)G(v) n G(u)G(w) = X(u)": (
        ["R[x] R[x] R[x] R[y] R[y]", "R[x] R[x] R[x] R[z] R[z]"],
        "t³ r¹(∥R1)",
    ),
    "the same axis fixed in the platform": (
        ["R[y] R[y] R[x] R[x] R[x]", "R[z] R[z] R[x] R[x] R[x]"],
        "t³ r¹(∥R3)",
    ),
    "G(u)G(v) twice": (["R[x] R[x] R[x] R[y] R[y]"] * 2, "t³ r²(∥◇(R1, R4))"),
    # where location matters
    "two spherical sets share the line of their centres": (["S", "S"], "t¹(moving) r¹(moving)"),
    "spherical sets with one centre": (["S@A", "R[x]@A R[y]@A R[z]@A"], "t²(moving) r³"),
    "two R with different parallel axes share nothing": (["R[x]", "R[x]"], "t⁰ r⁰"),
    "two R on one axis": (["R[x]@A", "R[x]@A"], "t¹(⊥(R1, ρ)) r¹(∥R1)"),
    "two C share t1 only": (["C[x]", "C[x]"], "t¹(∥C1) r⁰"),
    "two C on one axis": (["C[x]@A", "C[x]@A"], "t²(moving) r¹(∥C1)"),
    "four-bar, its coupler": (["R[x] R[x]", "R[x] R[x]"], "t¹(moving) r¹(∥R1)"),
    "four-bar, its rocker": (["R[x] R[x] R[x]", "R[x]"], "t¹(⊥(R4, ρ)) r¹(∥R1)"),
    "an idle R": (["R[z] P[x]", "P[x]"], "t¹(∥P1) r⁰"),
    "limbs that turn about one axis only": (["R[y] R[y] R[y] S P[x]", "R[x] R[x] R[x]"], "t²(⊥R4) r¹(∥R4)"),
}


@pytest.mark.parametrize("name", RULES)
def test_rule_of_section_4(name):
    limbs, printed = RULES[name]
    assert str(_platform(limbs).poc) == printed


@pytest.mark.parametrize("name", [name for name in RULES if "@" not in "".join(RULES[name][0])])
def test_rule_of_section_4_by_twists(name):
    limbs, _ = RULES[name]
    assert _numbers(_platform(limbs)) == _by_twists(parse_chains(limbs))


@pytest.mark.parametrize(
    ("limbs", "reason"),
    [
        (["R[x] R[x] R[x] R[y] R[y]", "R[y] R[y] R[y] R[x] R[x]"], "several operation modes"),
        (["R[x]", "R[y] R[y] R[x] R[x] R[y] R[y]"], "several modes"),
        (["U[x,y] P[z] U[x,y] R[z]", "P[x] R[x]"], "more than three blocks"),
        (["C[x]@A R[y]", "C[x]@A R[z]"], "share a point"),
        (["P[y] S P[x]", "P[y] S P[x]", "C[y] R[x] R[y] R[y] R[y]"], "directions fixed in the platform"),
        (["R[x] P[x] P[y] U[z,y]", "R[x] P[x] P[y] U[z,y]", "R[x] R[x] U[z,x] R[x]"], "turn alike"),
        (["H[x]", "C[x]"], "pitch"),
    ],
)
def test_what_the_rules_refuse(limbs, reason):
    found = _platform(limbs)
    assert isinstance(found, Refusal), found
    assert reason in found.reason


DIRECTIONS = st.sampled_from([[X], [X, Y], [X, Y, Z], [X, Y, unit((0.3, 0.5, 0.8))]])


@st.composite
def mechanisms(draw):
    """Two or three limbs of blocks of parallel axes, slides and other joints, along a few directions."""
    directions = draw(DIRECTIONS)
    count = draw(st.sampled_from([2, 2, 3]))
    limbs = [draw(_limb(directions)) for _ in range(count)]
    if count == 3 and draw(st.booleans()):
        limbs[1] = limbs[0]
    return limbs


def _limb(directions):
    axes = st.sampled_from(directions)
    block = st.builds(lambda axis, count: [ChainJoint(REVOLUTE, (axis,))] * count, axes, st.integers(1, 3))
    single = st.one_of(
        st.builds(lambda axis: [ChainJoint(PRISMATIC, (axis,))], axes),
        st.builds(lambda axis: [ChainJoint(CYLINDRICAL, (axis,))], axes),
        st.builds(lambda axis: [Parallelogram("4R", axis)], axes),
        st.just([ChainJoint(SPHERICAL, ())]),
        st.just([ChainJoint(UNIVERSAL, (X, Y))]),
    )
    parts = st.lists(st.one_of(block, block, single), min_size=1, max_size=4)
    return parts.map(lambda found: Chain(tuple([joint for part in found for joint in part][:6])))


@examples(200)
@given(mechanisms())
def test_rules_and_twists_agree_on_random_mechanisms(chains):
    motion = parallel([serial(chain) for chain in chains])
    if isinstance(motion, Motion):
        assert _numbers(motion) == _by_twists(chains)


@examples(150)
@given(mechanisms())
def test_rules_and_twists_agree_in_translation_mode(chains):
    motions = [serial(chain, "translation") for chain in chains]
    if any(isinstance(motion, Refusal) for motion in motions):
        return
    motion = parallel(motions, "translation")
    if isinstance(motion, Motion):
        assert _numbers(motion) == _by_twists(chains, "translation")


@pytest.mark.parametrize(
    ("limbs", "mode", "numbers"),
    [
        # first and last axes stay parallel, for the platform turns about them only
        (["U[y,z]", "R[y] R[y] R[y] R[x] R[y] R[y]"], "free", (1, 1, 1)),
        # the platform turns about an axis that one limb has in its middle
        (["P[y] U[y,z] C[y] P[y]", "U[x,z] P(4R)[z]"], "free", (2, 1, 2)),
        (["R[z] R[x] R[x] C[z]", "R[x] C[y]"], "free", (2, 1, 2)),
        # behind a spherical joint, directions turn with the platform
        (["S R[x]", "P[y] R[x] R[x]"], "free", (2, 1, 2)),
        (["R[x] S R[x] R[x] R[x]", "P(4R)[x] P[x]"], "free", (1, 0, 1)),
        # an inner loop whose slide stands behind its turn
        (["{S R[y] P[y] | R[x] R[x] P[y]}", "P[y]"], "free", (1, 0, 1)),
        # outer axes that could turn against each other, and do not
        (["R[x] R[y] R[y] P[x] R[x]", "R[y] R[y]"], "translation", (2, 1, 2)),
        (["R[x] R[x]", "R[z] R[z] P[y] U[x,z]"], "translation", (0, 0, 0)),
        # an axis behind a spherical joint that turns only against it, in one limb and in two
        (["S P[y] R[0.3,0.5,0.8]", "S P[y]"], "translation", (3, 2, 3)),
        (["S P[y] R[0.3,0.5,0.8]", "S P[y] R[0.3,0.5,0.8]", "S P[y]"], "translation", (2, 1, 2)),
        # axes before a spherical joint: at rest the limb slides along them, or moves within itself
        (["R[x] P[u] S", "P[u] R[y] R[y] R[y] S", "R[x] P[u]"], "translation", (1, 0, 1)),
        (["P[u] R[y] P[u] S", "U[x,y]"], "translation", (1, 1, 1)),
        # two limbs whose outer axes turn for each other's sake: neither turns where both rest
        (["R[u] C[x] R[u]", "R[u] C[x] R[u]", "R[u] R[u] P[x] P[u] R[x] R[x]"], "translation", (3, 2, 3)),
        # parallel slides between axes that never turn: displaced at will the slides would part
        (["R[z] P[-0.5,0.8,1.1] R[z]"] * 3, "free", (1, 0, 1)),
        (["R[z] P[-0.5,0.8,1.1] R[z]"] * 3, "translation", (1, 0, 1)),
        (["R[z] P[1,0,2] R[z]"] * 4, "free", (1, 0, 1)),
        # an axis that all limbs share in direction, about which no two of them turn on one line
        (["R[z] C[-0.5,0.8,1.1] R[z]", "R[x] C[-0.5,0.8,1.1] R[x]"], "free", (2, 2, 2)),
    ],
)
def test_special_positions_that_last(limbs, mode, numbers):
    limbs = [limb.replace("u", "0.3,0.5,0.8") for limb in limbs]
    assert _numbers(_platform(limbs, mode)) == numbers
    assert _by_twists(parse_chains(limbs), mode) == numbers


def test_the_rules_seldom_refuse():
    """One chain in each place of a small catalogue: refusing everything would pass the laws above."""
    limbs = [
        "P[x] R[x] R[x]",
        "R[x] R[x] R[y]",
        "C[x] R[x] R[y] R[y]",
        "U[x,y] P[z] S",
        "R[y] P[z] S",
        "P[x] P[y] P[z]",
    ]
    answers = [_platform([first, second]) for first in limbs for second in limbs]
    assert sum(isinstance(answer, Motion) for answer in answers) >= 34


@examples(60)
@given(mechanisms())
def test_one_more_limb_takes_away(chains):
    """Eq. (2) is an intersection, and xi of Eq. (4) a number of equations."""
    motions = [serial(chain, "translation") for chain in chains]
    if any(isinstance(motion, Refusal) for motion in motions):
        return
    so_far = [parallel(motions[: count + 1], "translation") for count in range(len(motions))]
    if all(isinstance(motion, Motion) for motion in so_far):
        assert [motion.dim for motion in so_far] == sorted((motion.dim for motion in so_far), reverse=True)
        for index in range(len(motions) - 1):
            assert 0 <= xi_of_next(so_far[index], motions[index + 1], so_far[index + 1]) <= 6


def test_one_limb_is_a_platform_too():
    assert str(_platform(["R[x] R[x]"]).poc) == "t²(⊥R1) r¹(∥R1)"


def test_no_limb_is_an_error():
    with pytest.raises(UsageError, match="no limb"):
        parallel([])


def test_the_papers_intersection_as_printed():
    limbs, *_ = MECHANISMS["the paper's"]
    derivation = _platform(limbs).derivation
    assert derivation.whole.text() == "[t³; r²(∥◇(R12, R5))] ∩ [t³; r⁰] = [t³; r⁰]"
    assert derivation.conclusion == "so the platform has three translations and no rotations"
    assert [part.of for part in derivation.parts] == ["the chain", "the chain"]


@pytest.mark.parametrize(
    ("name", "rules"),
    [
        ("tripteron", ["linear rule", "containment"]),
        ("planar 3-RRR", ["containment", "containment"]),
        ("3-RPS", ["linear rule", "location"]),
    ],
)
def test_by_which_rule_it_was_decided(name, rules):
    limbs, mode, _, _ = MECHANISMS[name]
    assert [step.rule for step in _platform(limbs, mode).derivation.steps] == rules
