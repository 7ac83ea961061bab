import random

import pytest

from assur.model.topologies import load_topology
from assur.synthesis.assembly import Range, Sought, known_members
from assur.synthesis.classes import chosen_classes
from assur.synthesis.isomorphism import limb_key
from assur.synthesis.known_mechanisms import known_by_directions
from assur.synthesis.parasitic import arranged_classes, limb_classes, moved
from assur.synthesis.question import question
from assur.synthesis.required import PARASITIC
from assur.synthesis.shared_axes import sharing_ends
from assur.synthesis.synthesis import synthesis
from assur.topology.notation import parse_chain
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


def mechanisms(name, classes, lines):
    """Of a known mechanism's classes on such lines, in each arrangement: what is listed, if it is that one."""
    (known,) = (one for one in known_by_directions(RISING) if one.name == name)
    sought = Sought(RISING, Range(0, 99), (), members=1, known=[known.key])
    for one in arranged_classes(chosen_classes(classes, len(known.chains), RISING.dim), RISING):
        if dict(one.lines) == lines and known_members(one.chosen, [known.key]):
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
    (design,) = (design for designs in mechanisms("exechon", in_legs, {"base": None}) for design in designs)
    declared = load_topology("exechon").declared
    assert (design.dof, design.xi, design.coupling_degree) == (declared.dof, declared.xi, declared.coupling_degree)
    assert sorted("@O" in chain.text for chain in design.chains) == [False, True, True]
    assert not any(mechanisms("exechon", in_legs, {}))


def test_the_two_upr_and_two_rpu_need_a_line_of_the_base_and_one_of_the_platform(in_legs):
    keys = [limb_key(parse_chain(text), RISING, (1,)) for text in ("U[x,y] P[z] R[y]", "R[x] P[z] U[x,y]")]
    first, second = ((limb,) for key in keys for some in in_legs for limb in some if limb.type.key == key)
    (arranged,) = arranged_classes([(first, first, second, second)], RISING)
    assert arranged.lines == {"base": (0, 1), "platform": (2, 3)}
    (design,) = moved(arranged, Sought(RISING, Range(0, 99), (), members=1)).designs
    assert (design.dof, len(design.actuated), design.coupling_degree) == (3, 4, 1)
    assert [sharing_ends(chain) for chain in design.chains] == [(True, False)] * 2 + [(False, True)] * 2
    assert {len(part.drives) for part in design.determining} == {3}


def test_a_passive_limb_alone_constrains_what_free_limbs_drive():
    classes = limb_classes(RISING, "leg", passive=True)
    ((design,),) = mechanisms("three_ups_up", classes, {})
    assert design.actuated == ((2, 2), (3, 2), (4, 2))
    assert design.coupling_degree == load_topology("three_ups_up").declared.coupling_degree


def test_the_oracle_of_finite_motion_confirms_some_of_equal_limbs(equal):
    for number, design in enumerate(random.Random(5).sample(equal.designs, 2)):
        confirmed_by_the_oracle(design, number)


def confirmed_by_the_oracle(design, number):
    texts = [chain.text for chain in design.chains]
    poc = design.known.poc
    real = {(seen.freedoms, seen.t, seen.r, seen.dim) for seen in outcomes(texts, number, 3) if seen.real}
    assert real == {(design.dof, poc.t, poc.r, poc.dim)}, texts


@pytest.mark.deep
@pytest.mark.parametrize(("motion", "limbs", "place"), [("1T2R", 3, "leg"), ("1T2R", 4, "leg"), ("2R", 2, "base")])
def test_the_oracle_of_finite_motion_confirms_the_first_of_every_family(motion, limbs, place):
    found = synthesis(question(motion, limbs, actuators=place, members=1, parasitic=True))
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
