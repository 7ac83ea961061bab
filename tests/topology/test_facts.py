"""The facts of a topology: what is read off others, and what is computed only when asked for."""

import dataclasses

import pytest

from assur.results.answers.solution_order import Loop
from assur.results.answers.topology import RedundantConstraints
from assur.topology.counting.solution_plan import SolutionPlan
from assur.topology.facts import Known, LimbFacts, Topology
from assur.topology.poc import PocSet
from assur.topology.screws.linkage import Linkage

AGREED = Known(PocSet(3, 0, 3), "both")
REFUSED = Known(PocSet(3, 2, 5), "twists", "a pitch")


def topology(**changes):
    limb = LimbFacts("P[x]", "-P-", 1, Known(PocSet(3, 1, 4), "both"))
    found = Topology(
        name="",
        title="",
        source="",
        mode="home",
        limbs=(limb, limb),
        known=AGREED,
        dof=3,
        internal_freedoms=0,
        internal_joints=(),
        idle_joints=(),
        loops=(Loop(("P1", "R1"), 8, 2, 5), Loop(("P2",), 4, 1, 4, internal=1)),
        assur_chains=(),
        coupling_degree=1,
        redundant_constraints=RedundantConstraints(3, 3),
        redundant_by_loop=(),
        inputs=("P1",),
        decoupling=None,
        plan=SolutionPlan(()),
        linkage=Linkage({}, "base", "platform", None),
    )
    return dataclasses.replace(found, **changes)


def test_what_is_read_off_other_facts():
    found = topology()
    assert found.poc is AGREED.poc
    assert found.limbs[0].poc == PocSet(3, 1, 4)
    assert found.xi == (5, 4)
    assert found.delta == (1, -2)


@pytest.mark.parametrize(
    ("known", "limbs", "agree"),
    [
        (AGREED, (AGREED, AGREED), True),
        (AGREED, (), True),
        (REFUSED, (AGREED, AGREED), None),
        (AGREED, (AGREED, REFUSED), None),
        (REFUSED, (), None),
    ],
)
def test_routes_agree_where_the_rules_answered_everywhere(known, limbs, agree):
    found = topology(known=known, limbs=tuple(LimbFacts("P[x]", "-P-", 1, item) for item in limbs))
    assert found.routes_agree is agree


@pytest.mark.parametrize(
    ("fact", "source"), [("actuation", "actuate"), ("relaxation", "relax"), ("derivations", "derive")]
)
def test_what_takes_long_is_computed_when_asked_for_and_once(fact, source):
    asked = []

    def compute():
        asked.append(fact)
        return (fact,)

    found = topology(**{source: compute})
    assert asked == []
    assert getattr(found, fact) == getattr(found, fact) == (fact,)
    assert asked == [fact]


def test_without_rules_there_is_no_derivation():
    assert topology().derivations == ()
