import random

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.model.topologies import load_topology
from assur.synthesis import limb_motions
from assur.synthesis.answers import answers
from assur.synthesis.isomorphism import mechanism_key
from assur.synthesis.question import question
from assur.synthesis.synthesis import synthesis
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.notation import parse_chain
from assur.topology.symbolic.union import serial
from mobility_oracle import least_sum_of_degrees, outcomes

KNOWN_AT_BASE = [
    "tsai_platform",
    "three_crr",
    "three_rrc",
    "tripteron",
    "orthoglide",
    "linear_delta_4r",
    "three_rrrp4r",
    "delta_4s",
    "linear_delta_4s",
    "three_p2us",
]


def named(found, name):
    return [design for design in found.designs if name in design.names]


@pytest.mark.parametrize("name", KNOWN_AT_BASE)
def test_known_mechanisms_with_actuators_at_the_base_are_found(in_space, name):
    """The Delta is tsai_platform, with rods delta_4s; what the catalogue declares of it is what is found."""
    (design,) = named(in_space, name)
    declared = load_topology(name).declared
    assert design.symmetric
    assert (design.dof, design.xi, design.coupling_degree) == (declared.dof, declared.xi, declared.coupling_degree)
    assert (design.known.poc.t, design.known.poc.r) == declared.poc
    assert (design.redundant.collapsed, design.redundant.joint_graph) == declared.redundant_constraints
    assert design.known.route == "both"


def test_of_two_limbs_the_papers_mechanism_is_one_family_behind_those_that_are_not_coupled(of_two_limbs):
    """The paper: F = 3 by loops with ξ = 3 and 5, κ = 1; 4 redundant constraints, 10 with its parallelograms."""
    degrees = [family.designs[0].coupling_degree for family in of_two_limbs.families]
    assert degrees == sorted(degrees)
    (place,) = (
        place for place, family in enumerate(of_two_limbs.families) if any(design.names for design in family.designs)
    )
    assert degrees[place] == 1
    assert degrees[0] == 0
    family = of_two_limbs.families[place]
    (design,) = (design for design in family.designs if design.names)
    assert design.names == ("zeng2019",)
    assert [joints for joints, _ in design.actuated] == [1, 2, 2]
    assert sorted(design.xi) == [3, 5]
    assert (design.dof, design.redundant.collapsed, design.redundant.joint_graph) == (3, 4, 10)
    whole = assur.topology("zeng2019")
    assert (whole.dof, whole.coupling_degree, whole.redundant_constraints) == (3, 1, design.redundant)
    assert family.members >= len(family.designs) == 3, "two simplest ones, and the known one"


def test_all_of_a_family_count_alike(of_two_limbs, in_space):
    for found in (of_two_limbs, in_space):
        for family in found.families:
            assert len({(design.coupling_degree, tuple(sorted(design.xi))) for design in family.designs}) == 1


def test_every_mechanism_of_two_limbs_has_three_drives_on_the_base(of_two_limbs):
    for design in of_two_limbs.designs:
        assert len(design.actuated) == 3
        for limb, joint in design.actuated:
            loop = design.limbs[limb - 1].type.loop
            assert joint == 1 or joint == len(loop.branches[0]) + 1


def confirmed_by_the_oracle(family, number):
    """Whether its best mechanism moves as it must, and its drives and loops count so, by finite motion alone."""
    design = family.designs[0]
    texts = [chain.text for chain in design.chains]
    met = outcomes(texts, number)
    real = {(seen.freedoms, seen.t, seen.r, seen.dim) for seen, count in met.items() if seen.real and count > 1}
    poc = design.known.poc
    assert (design.dof, poc.t, poc.r, poc.dim) in real, (texts, dict(met))
    if design.mode == "home":
        starts = np.cumsum([0, *(len(chain.joints) for chain in design.chains)])
        driven = [(int(starts[limb - 1]) + joint - 1, 0) for limb, joint in design.actuated]
        assert least_sum_of_degrees(texts, driven, number) == sum(abs(loop.delta) for loop in design.loops.loops), texts


def without_rods(found):
    """Families whose best mechanism the oracle can read."""
    return [
        family
        for family in found.families
        if all(limb.type.parallelograms == limb.type.hinged for limb in family.designs[0].limbs)
    ]


def test_the_oracle_confirms_some_families_of_two_limbs(of_two_limbs):
    for number, family in enumerate(random.Random(3).sample(without_rods(of_two_limbs), 4)):
        confirmed_by_the_oracle(family, number)


@pytest.mark.deep
@pytest.mark.parametrize(("motion", "joints", "count"), [("3T", 5, 27), ("2T1R", 4, 18), ("3T1R", 4, 14)])
def test_the_oracle_confirms_every_family_of_two_limbs(motion, joints, count):
    families = without_rods(synthesis(question(motion, 2, joints, members=1)))
    assert len(families) >= count
    for number, family in enumerate(families):
        confirmed_by_the_oracle(family, number)


@pytest.mark.deep
def test_h4_is_found_among_two_limbs_of_four_freedoms():
    found = synthesis(question("3T1R", 2, 4, members=2))
    (design,) = named(found, "h4_robot")
    declared = load_topology("h4_robot").declared
    assert (design.dof, design.coupling_degree) == (declared.dof, declared.coupling_degree)
    assert sorted(design.xi) == sorted(declared.xi)
    assert design.redundant.collapsed == 0


def test_the_three_upu_is_found_with_actuators_in_the_legs(in_legs):
    (design,) = named(in_legs, "three_upu")
    declared = load_topology("three_upu").declared
    assert (design.dof, design.xi, design.coupling_degree) == (declared.dof, declared.xi, declared.coupling_degree)
    assert design.actuated == ((1, 2), (2, 2), (3, 2))
    assert design.mode == "translation"


@pytest.mark.parametrize(
    "limb", ["P[x] U[x,y] U[y,x]", "R[x] U[x,y] U[y,x]", "R[x] R[x] R[x] R[y] R[y]", "P[x] P[y] P[z]"]
)
def test_known_limbs_are_found(in_space, limb):
    """P-U-U, R-U-U, R||R||R_|_R||R, P-P-P."""
    assert any(design.symmetric and design.limbs[0].text == limb for design in in_space.designs)


def test_no_mechanism_twice(in_space, in_legs):
    for found in (in_space, in_legs):
        keys = [mechanism_key(limb.type.key for limb in design.limbs) for design in found.designs]
        assert len(keys) == len(set(keys)) > 40


def test_limbs_of_p_r_and_c_are_those_found_by_hand(in_space):
    """X(u) with the first joint driven, by hand.

    With C: three places of C among two R, six orders of C, R and a P across. Without: PRRR; P along u driven, and
    two R with a P across in three orders (a P along u that is not driven is written as C).
    """
    texts = {limb.text for limb in in_space.limbs if limb.type.freedoms == 4 and not limb.type.parallelograms}
    assert len([text for text in texts if "C" in text]) == 3 + 6
    assert {text for text in texts if "C" not in text} == {
        "P[x] R[x] R[x] R[x]",
        "P[x] P[y] R[x] R[x]",
        "P[x] R[x] P[y] R[x]",
        "P[x] R[x] R[x] P[y]",
    }


def test_every_mechanism_is_known_by_both_routes(in_space, in_legs):
    for found in (in_space, in_legs):
        assert {design.known.route for design in found.designs} == {"both"}
        assert {(design.known.poc.t, design.known.poc.r, design.known.poc.dim) for design in found.designs} == {
            (3, 0, 3)
        }
        assert {limb.known.route for limb in found.limbs} == {"both"}


def test_every_limb_of_a_mechanism_is_driven_where_asked(in_space, in_legs):
    assert {place for design in in_space.designs for _, place in design.actuated} == {1}
    for design in in_legs.designs:
        for limb, place in design.actuated:
            assert design.chains[limb - 1].joints[place - 1].type.letter == "P"
            assert place > 1


@pytest.mark.parametrize("kind", ["equal limbs", "different limbs", "in legs", "two limbs"])
def test_the_engine_of_whole_mechanisms_agrees(in_space, in_legs, of_two_limbs, kind):
    """A placing of the whole linkage, moved along its own freedom, for a few mechanisms drawn at random."""
    found = {"in legs": in_legs, "two limbs": of_two_limbs}.get(kind, in_space)
    equal = kind in ("equal limbs", "in legs")
    wanted = [design for design in found.designs if design.symmetric == equal]
    for design in random.Random(kind).sample(wanted, 8):
        topology = assur.topology(
            [chain.text for chain in design.chains],
            actuate=[f"{limb}.{joint}" for limb, joint in design.actuated],
            mode=design.mode,
        )
        dof = topology.dof - topology.internal_freedoms
        assert (dof, topology.coupling_degree) == (design.dof, design.coupling_degree), design.chains
        assert sorted(topology.xi) == sorted(design.xi)
        assert topology.redundant_constraints == design.redundant
        assert topology.decoupling.depends == design.decoupling.depends
        assert (topology.poc.t, topology.poc.r, topology.poc.dim) == (3, 0, 3)
        assert [limb.poc.dim for limb in topology.limbs] == [limb.known.poc.dim for limb in design.limbs]
        assert topology.actuation.verdict == "valid"
        assert topology.idle_joints == ()


def count_as_the_whole_analysis_does(designs):
    """Sets of redundant drives that determine each mechanism, with their coupling degrees, loops and constraints."""
    for design in designs:
        numbers = [f"{limb}.{joint}" for limb, joint in design.actuated]
        topology = assur.topology([chain.text for chain in design.chains], actuate=numbers, mode=design.mode)
        assert (topology.actuation.verdict, topology.actuation.redundancy) == ("redundant", 1)
        names = topology.actuation.inputs
        sets = {tuple(map(names.index, part.drives)): part.coupling_degree for part in topology.determining}
        assert {part.drives: part.coupling_degree for part in design.determining} == sets
        assert (design.coupling_degree, design.decoupling) == (min(sets.values()), None)
        assert sum(abs(loop.delta) for loop in design.loops.loops) == 2 * design.coupling_degree
        assert topology.redundant_constraints == design.redundant


def test_redundant_drives_stand_in_one_limb_more_and_some_of_them_determine_the_mechanism():
    found = synthesis(question("2T1R", max_joints=3, symmetric=True, redundant=1))
    assert {len(design.limbs) for design in found.designs} == {4}
    assert "R[z] R[z] R[z]" in {design.chains[0].text for design in found.designs}
    count_as_the_whole_analysis_does(found.designs[:1])


@pytest.mark.deep
@pytest.mark.parametrize(
    "words",
    [
        {"motion": "3T", "limbs": 3, "max_joints": 3, "members": 1},
        {"motion": "3R", "symmetric": True},
        {"motion": "1T2R", "parasitic": True, "actuators": "leg", "members": 1},
    ],
    ids=["3T", "3R", "1T2R"],
)
def test_redundant_drives_of_every_kind_of_search_count_as_in_the_whole_analysis(words):
    found = synthesis(question(redundant=1, **words))
    assert found.designs
    count_as_the_whole_analysis_does(random.Random(1).sample(found.designs, min(6, len(found.designs))))


def test_coupling_degrees_are_those_asked_for(small):
    one = synthesis(question("3T", max_joints=3, coupling=(0, 1), members=3))
    assert {design.coupling_degree for design in one.designs} == {1}
    wanted = [design.order for design in small.designs if design.coupling_degree == 1]
    assert [design.order for design in one.designs] == wanted
    none = synthesis(question("3T", max_joints=3, coupling=(0, 0)))
    assert none.designs == ()
    assert min(none.tally.coupling_degrees) == 1


def test_equal_limbs_only_where_asked(small):
    equal = synthesis(question("3T", max_joints=3, symmetric=True))
    assert [design.order for design in equal.designs] == [d.order for d in small.designs if d.symmetric]
    assert equal.tally.combinations == len(equal.limbs) < small.tally.combinations


def test_the_same_question_has_the_same_answer(small):
    assert answers(synthesis(question("3T", max_joints=3, members=3))) == answers(small)


def test_steps_are_counted_up_to_the_end():
    seen = []
    synthesis(question("3T", max_joints=3, symmetric=True), step=lambda done, whole: seen.append(done / whole))
    assert seen == sorted(seen)
    assert seen[0] == 0
    assert 0.8 < seen[-1] < 1


@pytest.mark.parametrize(
    ("motion", "joints", "actuators", "name"),
    [("2T1R", 3, "base", "planar_3rrr"), ("2T1R", 3, "leg", "planar_3rpr")],
)
def test_planar_mechanisms(motion, joints, actuators, name):
    found = synthesis(question(motion, 3, joints, symmetric=True, actuators=actuators))
    (design,) = named(found, name)
    declared = load_topology(name).declared
    assert (design.dof, design.xi, design.coupling_degree) == (declared.dof, declared.xi, declared.coupling_degree)


def test_six_limbs_that_constrain_nothing():
    found = synthesis(question("3T3R", max_joints=3, symmetric=True, actuators="leg"))
    (design,) = named(found, "gough_stewart")
    declared = load_topology("gough_stewart").declared
    assert (design.dof, design.xi, design.coupling_degree) == (declared.dof, declared.xi, declared.coupling_degree)
    assert len(found.families) == 1


def test_four_limbs_for_three_translations_and_a_rotation():
    found = synthesis(question("3T1R", 4, 3, symmetric=True))
    assert found.designs
    for design in found.designs[:6]:
        topology = assur.topology([chain.text for chain in design.chains])
        assert (topology.dof, topology.poc.t, topology.poc.r) == (4, 3, 1)
        assert topology.coupling_degree == design.coupling_degree


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"motion": "3T", "limbs": 4}, "4 limbs for 3T; a limb has one actuator, or two"),
        ({"motion": "3T1R", "limbs": 1}, "1 limbs for 3T1R"),
        ({"limbs": 2, "actuators": "leg"}, "2 limbs for 3T with actuators in the legs"),
        ({"members": 0}, "0 members of each family"),
        ({"redundant": -1}, "-1 redundant drives"),
        ({"redundant": 1, "limbs": 5}, "5 limbs for 3T"),
        ({"max_joints": 0}, "at most 0 joints"),
        ({"coupling": (2, 1)}, r"coupling degrees 2\.\.1"),
        ({"coupling": (-1, 1)}, r"coupling degrees -1\.\.1"),
    ],
)
def test_misuse_is_refused(words, message):
    with pytest.raises(UsageError, match=message):
        synthesis(question(**words))


def test_unknown_names_are_refused():
    with pytest.raises(UnknownNameError, match="2T1R, 2T2R, 2T3R, 3R, 3T, 3T1R, 3T2R, 3T3R"):
        synthesis(question("6T"))
    with pytest.raises(UnknownNameError, match="any, base, leg"):
        synthesis(question(actuators="platform"))


def test_limbs_that_are_too_short_give_nothing():
    found = synthesis(question("3T", max_joints=1))
    assert (found.designs, found.limbs, found.tally.combinations) == ((), (), 0)


def test_disagreements_are_collected_and_raised(monkeypatch):
    """The rules are made to speak of another chain."""
    monkeypatch.setattr(limb_motions, "serial", lambda *_: serial(parse_chain("C[x] R[x] R[x]"), "translation"))
    with pytest.raises(RoutesDisagreeError) as raised:
        synthesis(question("3T", max_joints=3, symmetric=True))
    assert "P[x] P[y] P[z]: the rules say" in raised.value.message
    assert raised.value.message.count("the rules say") > 5
