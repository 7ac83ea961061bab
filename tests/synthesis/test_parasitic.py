import random
from collections import Counter

import numpy as np
import pytest

import assur
from assur.model.topologies import load_topology
from assur.synthesis.arrangements import TURNS, arranged_classes
from assur.synthesis.assembly import Range, Sought, known_members
from assur.synthesis.classes import chosen_classes
from assur.synthesis.explanation import explanation
from assur.synthesis.home_constraints import constraints_of, home_twists, together
from assur.synthesis.known_mechanisms import known_by_directions, limbs_driven_by, placed_limbs
from assur.synthesis.parasitic import limb_classes, moved
from assur.synthesis.question import question
from assur.synthesis.required import PARASITIC
from assur.synthesis.synthesis import synthesis
from assur.topology.notation import parse_chains
from assur.topology.screws.configurations import ImmobileError, configurations
from assur.topology.screws.placing import place
from assur.topology.screws.screws import screw_tree
from assur.topology.screws.second_order import second_order
from assur.topology.screws.shared_points import common_end
from assur.topology.screws.twists import UnclearRankError, dimensions, edges, motion_space
from mobility_oracle import outcomes

RISING = PARASITIC["1T2R"]


@pytest.fixture(scope="module")
def in_legs():
    """Limbs with a drive inside."""
    return limb_classes(RISING, "leg", passive=False)


@pytest.fixture(scope="module")
def equal():
    """Three equal limbs that rise and tilt, driven inside."""
    return synthesis(question("1T2R", symmetric=True, actuators="leg", parasitic=True))


def mechanisms(name, classes, ends):
    """Of a known mechanism's classes on lines of such links, in each arrangement: what is listed, if it is that one."""
    (known,) = (one for one in known_by_directions(RISING) if one.name == name)
    sought = Sought(RISING, Range(0, 99), (), members=1, known=[known.key])
    for one in arranged_classes(chosen_classes(classes, len(known.chains), RISING.dim), RISING):
        if set(one.lines) == ends and known_members(one.chosen, [known.key]):
            yield [design for design in moved(one, sought).designs if known.is_like(design.limbs, design.chains)]


def test_the_three_rps_is_among_equal_limbs_evenly_about_z_alone(equal):
    (design,) = (design for design in equal.designs if design.names)
    assert design.names == ("three_rps",)
    assert design.places == (0, 2, 3)
    declared = load_topology("three_rps").declared
    assert (design.dof, design.xi, design.coupling_degree) == (declared.dof, declared.xi, declared.coupling_degree)
    assert (design.known.poc.t, design.known.poc.r, design.known.poc.dim) == (3, 2, 3)
    assert len(equal.families) == 2, "evenly, and one limb across the others"


def test_the_exechon_needs_the_line_that_its_two_u_share(in_legs):
    (design,) = (design for designs in mechanisms("exechon", in_legs, {"base"}) for design in designs)
    declared = load_topology("exechon").declared
    assert (design.dof, design.xi, design.coupling_degree) == (declared.dof, declared.xi, declared.coupling_degree)
    assert sorted("@O" in chain.text for chain in design.chains) == [False, True, True]
    assert not any(mechanisms("exechon", in_legs, set()))


TWO_UPR_TWO_RPU = ["U[x@O,y] P[z] R[y]", "U[x@O,y] P[z] R[y]", "R[x] P[z] U[x,y@Q]", "R[x] P[z] U[x,y@Q]"]


def test_the_two_upr_and_two_rpu_turn_about_a_line_of_the_base_and_one_of_the_platform(in_legs):
    """Its limbs are of one class, with others that no two lines hold."""
    given = placed_limbs("", limbs_driven_by(parse_chains(TWO_UPR_TWO_RPU), ["1.2", "2.2", "3.2", "4.2"]), RISING)
    (common,) = (some for some in in_legs if set(given.keys) <= {limb.type.key for limb in some})
    designs = [
        design
        for one in arranged_classes([(common,) * 4], RISING)
        if set(one.lines) == {"base", "platform"} and known_members(one.chosen, [given.key])
        for design in moved(one, Sought(RISING, Range(0, 99), (), members=1, known=[given.key])).designs
        if given.is_like(design.limbs, design.chains)
    ]
    assert {(design.dof, len(design.actuated), design.coupling_degree) for design in designs} == {(3, 4, 1)}
    assert {len(part.drives) for design in designs for part in design.determining} == {3}
    whole = designs[0]
    analysed = assur.topology(
        [chain.text for chain in whole.chains], actuate=[f"{limb}.{joint}" for limb, joint in whole.actuated]
    )
    assert [part.coupling_degree for part in whole.determining] == [
        part.coupling_degree for part in analysed.determining
    ]


@pytest.mark.deep
def test_an_explanation_says_that_the_two_upr_and_two_rpu_is_listed():
    limbs = limbs_driven_by(parse_chains(TWO_UPR_TWO_RPU), ["1.2", "2.2", "3.2", "4.2"])
    said = explanation(limbs, question("1T2R", parasitic=True, redundant=1, actuators="leg"))
    assert said.dropped_by == "", said.reason
    assert said.reason.startswith("in a family of 9 members, with κ = 1")


def test_what_the_second_order_blocks_is_lost_by_a_finite_amount(in_legs):
    every = list(arranged_classes(chosen_classes(in_legs, 3, RISING.dim), RISING))
    blocked = 0
    for one in random.Random(3).sample(every, 12):
        linkage = place(one.chains(one.simplest()[0]))
        order = second_order(linkage, np.zeros(len(screw_tree(linkage).scales)))
        if order.freedoms < order.instantaneous:
            blocked += 1
            assert freedoms_of_displaced(linkage) < RISING.dim, linkage
    assert 2 < blocked < 11


def freedoms_of_displaced(linkage):
    """Of the platform; none where no displacement closes the loops but in shaky configurations."""
    try:
        displaced = edges(linkage, configurations(linkage, 2))
        return dimensions(motion_space(displaced, linkage.base, linkage.platform))[2]
    except (ImmobileError, UnclearRankError):
        return 0


def test_an_arrangement_leaves_the_motion_whichever_limbs_of_its_classes_stand_in_it(in_legs):
    """Also on lines, on which limbs stand together that they hold alike; by limbs and places other than those tried."""
    chance = random.Random(7)
    ends = Counter()
    for one in arranged_classes(chosen_classes(in_legs, 3, RISING.dim), RISING):
        on = {number: end for end, numbers in one.lines.items() for number in numbers}
        limbs = [chance.choice(some) for some in one.chosen]
        wrenches = [
            constraints_of(home_twists(limb.type.chain, TURNS[place], 10 + slot, on.get(slot, ""))).wrenches
            for slot, (limb, place) in enumerate(zip(limbs, one.places, strict=True))
        ]
        assert together(wrenches).leave(RISING), one.chains(limbs)
        ends[frozenset(one.lines)] += 1
    assert min(ends[frozenset()], ends[frozenset({"base"})], ends[frozenset({"platform"})]) > 10


def test_arrangements_share_no_more_lines_than_they_need(in_legs):
    """Whatever limb is taken off its line, more is resisted."""
    for one in arranged_classes(chosen_classes(in_legs, 3, RISING.dim), RISING):
        limbs = [some[0] for some in one.chosen]
        for end, numbers in one.lines.items():
            for off in numbers:
                on = dict.fromkeys(set(numbers) - {off}, end)
                wrenches = [
                    constraints_of(home_twists(limb.type.chain, TURNS[place], 10 + slot, on.get(slot, ""))).wrenches
                    for slot, (limb, place) in enumerate(zip(limbs, one.places, strict=True))
                ]
                assert not together(wrenches).leave(RISING), one.chains(limbs)


def test_a_passive_limb_alone_constrains_what_free_limbs_drive():
    classes = limb_classes(RISING, "leg", passive=True)
    ((design,),) = mechanisms("three_ups_up", classes, set())
    assert design.actuated == ((2, 2), (3, 2), (4, 2))
    assert design.coupling_degree == load_topology("three_ups_up").declared.coupling_degree


def test_the_oracle_of_finite_motion_confirms_some_of_equal_limbs(equal):
    for number, design in enumerate(random.Random(5).sample(equal.designs, 2)):
        confirmed_by_the_oracle(design, number)


def confirmed_by_the_oracle(design, number):
    texts = [chain.text for chain in design.chains]
    poc = design.known.poc
    real = {(seen.freedoms, seen.t, seen.r, seen.dim) for seen in outcomes(texts, number, 3) if seen.real}
    t = translations_of_a_general_point(design.chains) if common_end(design.chains) else poc.t
    assert real == {(design.dof, t, poc.r, poc.dim)}, texts


def translations_of_a_general_point(chains):
    """Where limbs end on a line of the platform, the POC set tells those of a point of that line."""
    linkage = place(chains)
    space = motion_space(edges(linkage, configurations(linkage, 2)), linkage.base, linkage.platform)
    at_point = np.cross(space[:, :3], np.array([0.4, -0.7, 0.5])[None, :, None], axis=1) + space[:, 3:]
    return dimensions(np.concatenate([space[:, :3], at_point], axis=1))[0]


@pytest.mark.deep
@pytest.mark.parametrize(("motion", "limbs", "drives"), [("1T2R", 3, "leg"), ("1T2R", 4, "leg"), ("2R", 2, "base")])
def test_the_oracle_of_finite_motion_confirms_the_first_of_every_family(motion, limbs, drives):
    found = synthesis(question(motion, limbs, actuators=drives, members=1, parasitic=True))
    assert found.families
    for number, family in enumerate(found.families):
        confirmed_by_the_oracle(family.designs[0], number)


def test_a_member_of_classes_that_stand_alike_is_counted_once(in_legs):
    for one in arranged_classes(chosen_classes(in_legs, 3, RISING.dim), RISING):
        members = one.simplest()
        if len(members) < 1000:  # else only the simplest are written
            assert len(members) == one.members


def test_what_comes_along_is_more_than_what_is_independent(equal):
    for design in equal.designs:
        poc = design.known.poc
        assert poc.t + poc.r > poc.dim == design.dof == 3
