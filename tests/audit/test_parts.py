"""What parts of a joint graph let a link do, beside the textbook's tables and the closed form's loop closure."""

import numpy as np
import pytest

from assur.audit import parts
from assur.audit.configurations import configurations, scaled_closure
from assur.audit.parts import called, link_motion, sampled, square, within
from assur.derived_topology import topology
from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.frames import screws
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import mobility
from assur.kinematics.home import home_values
from assur.model.registry import load_record
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.analysis import sample
from assur.topology.poc import Mark, PocSet
from assur.topology.screws.edges import closure, rank
from assur.topology.screws.recognition import recognised

RECORD = load_record("zeng2019")
RECORD_HOME = home_values(RECORD)
LOOP1 = ("P1", "B1", "C1", "C2", "B2", "P2")
HSOC1, HSOC2 = (*LOOP1, "D1", "D2"), ("P3", "Pa1", "Pa2")
X, Y = np.eye(3)[:1].T, np.eye(3)[1:2].T


@pytest.mark.parametrize(
    ("joints", "link", "expected"),
    [
        (("P1",), "slider1", (1, 0, 1)),
        (("P1", "B1"), "link9", (2, 1, 2)),
        (("P1", "B1", "C1"), "link11", (2, 1, 3)),
        (LOOP1, "link11", (2, 1, 3)),
        (("P3", "Pa1"), "linkS", (2, 0, 2)),
        (HSOC2, "platform", (3, 0, 3)),
        (HSOC1, "platform", (3, 2, 5)),
        ((*HSOC2, "R4", "R3"), "link11", (3, 1, 4)),
        ((), "platform", (3, 0, 3)),
    ],
    ids=str,
)
def test_numbers_of_a_poc_set(joints, link, expected):
    found = link_motion(RECORD, link, joints)
    assert (found.poc.t, found.poc.r, found.poc.dim) == expected
    assert found.refusal == ""


@pytest.mark.parametrize(
    ("joints", "link", "base", "expected"),
    [
        (LOOP1, "link11", "", "t^2(_|_{0}) r^1(||{0})"),
        (("D1", "D2"), "platform", "link11", "t^2(_|_R3) r^1(||R3)"),
        (("Pa1",), "linkS", "slider3", "t^1(||<>(Pa1)) r^0"),
        (("P3",), "slider3", "", "t^1(||P3) r^0"),
    ],
)
def test_directions_are_named_by_joints(joints, link, base, expected):
    found = link_motion(RECORD, link, joints, base)
    assert found.poc.text("ascii") == expected.format(*found.poc.r_mark.names)


def test_an_opened_loop_has_as_many_dimensions_as_equations():
    """Eq. (4) of the second loop, beside what it adds to the rank of the closure, collapsed and with every joint."""
    opened = link_motion(RECORD, "base", (*HSOC1, "Pa2", "Pa1", "P3"), opened="P3")
    here = sampled(RECORD)
    ranks = {
        names: rank(closure([edge for edge in here.joints if set(edge.joints) <= set(names)]))
        for names in (LOOP1, *(RECORD.generalised[name].joints for name in ("Pa1", "Pa2")))
    }
    assert opened.poc.dim == rank(closure(here.collapsed)) - ranks[LOOP1] == 5
    assert opened.poc.dim == rank(closure(here.joints)) - sum(ranks.values())
    assert within(opened.rotations, opened.axes(["B1", "R3"]))
    assert not within(opened.rotations, opened.axes(["R3", "R4"]))


def test_the_sample_has_the_rank_that_the_closed_form_leads_to():
    """Another place, other screws, all working modes: the same rank."""
    here = configurations(RECORD).values
    found = {int(np.linalg.matrix_rank(matrix, tol=1e-8)) for matrix in scaled_closure(RECORD, here)}
    assert found == {rank(closure(sampled(RECORD).joints))} == {int(mobility(RECORD, here[0]).rank)} == {14}


def test_axes_are_those_of_the_joint_graph():
    found = link_motion(RECORD, "link9", ("P1", "B1"))
    twists = screws(RECORD, RECORD_HOME)
    slices = joint_graph(RECORD).slices
    assert np.allclose(found.axes(["P1"])[..., 0], twists[3:, slices["P1"]].T)
    assert np.allclose(found.axes(["B1"])[..., 0], twists[:3, slices["B1"]].T)


def test_where_the_rules_refuse_the_twists_answer():
    """A rod of a parallelogram turns about its hinge, and is the end of no limb."""
    found = link_motion(RECORD, "link4a", ("Pa1",), base="slider3")
    assert found.refusal
    assert (found.poc.t, found.poc.r, found.poc.dim) == (1, 1, 1)
    assert within(found.rotations, found.axes(["B3a"]))


def test_a_disagreement_is_an_error_that_names_the_part(monkeypatch):
    monkeypatch.setattr(
        parts, "_rules", lambda *_: PocSet(2, 0, 2, t_mark=Mark("plane", ("P1", "P3"), ((1, 0, 0), (0, 1, 0))))
    )
    with pytest.raises(RoutesDisagreeError, match="linkS moved by P3 Pa1: the rules say t"):
        link_motion(RECORD, "linkS", ("P3", "Pa1"))
    with pytest.raises(RoutesDisagreeError, match="slider3 moved by P3: the rules say t2 r0"):
        link_motion(RECORD, "slider3", ("P3",))


def test_a_limb_that_its_mechanism_holds_has_the_numbers_that_it_has_there(monkeypatch):
    """A UPU limb turns freely by itself, and not under a platform that keeps its orientation."""
    linkage = topology("three_upu").linkage
    limb = [joint.name for joint in recognised(linkage)[0].joints]
    monkeypatch.setattr(parts, "sampled", lambda _: sample(linkage, "translation"))
    found = link_motion(RECORD, "platform", limb)
    assert (found.poc.t, found.poc.r, found.poc.dim, found.refusal) == (3, 2, 5, "")


def test_names_and_aliases_mean_the_same():
    assert called(RECORD, ["D1", "R4", "Pa1", "P9"]) == ("R3", "R4", "Pa1", "P9")


def test_one_sample_serves_every_number():
    assert sampled(RECORD) is sampled(RECORD)


@pytest.mark.parametrize(
    ("directions", "axes", "inside", "across"),
    [(X, X, True, False), (X, Y, False, True), (X + Y, np.hstack([X, Y]), True, False), (X, -X, True, False)],
)
def test_directions_beside_axes(directions, axes, inside, across):
    both = [np.stack([item, item]) for item in (directions, axes)]
    assert (within(*both), square(*both)) == (inside, across)


# ---- misuse ----------------------------------------------------------------------------------------------------


def test_an_unknown_joint_or_link_is_refused():
    with pytest.raises(UnknownNameError, match="P9"):
        link_motion(RECORD, "platform", ("P9",))
    with pytest.raises(UnknownNameError, match="link12"):
        link_motion(RECORD, "link12", ("P1", "B1"))
    with pytest.raises(UnknownNameError, match="linkS"):
        link_motion(RECORD, "link9", ("P1", "B1"), base="linkS")
    with pytest.raises(UnknownNameError, match="D1"):
        link_motion(RECORD, "link9", ("P1", "B1")).axes(["D1"])


def test_a_part_in_two_pieces_is_refused():
    with pytest.raises(UsageError, match="do not hang together"):
        link_motion(RECORD, "platform", ("P1", "D2"))


def test_only_a_joint_on_the_link_can_be_taken_off():
    joints = (*HSOC1, *HSOC2)
    with pytest.raises(UsageError, match="B1 is not on base"):
        link_motion(RECORD, "base", joints, opened="B1")
    with pytest.raises(UnknownNameError, match="P9"):
        link_motion(RECORD, "base", joints, opened="P9")
