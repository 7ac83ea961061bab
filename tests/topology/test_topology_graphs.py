"""Graphs of links and joints without lengths: chains between named links."""

from pathlib import Path

import pytest

from assur.derived_topology import topology
from assur.errors import UsageError
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import NotationError, parse_chains, plain_text

STEPHENSON = ["R[z] R[z] <coupler>", "R[z] R[z] <coupler>", "<coupler> R[z] <platform>", "R[z] R[z] <platform>"]
H4 = ["R[y] P(4S)[y] <left>"] * 2 + ["R[x] P(4S)[x] <right>"] * 2 + ["<left> R[z]", "<right> R[z]"]


def test_a_graph_that_has_limbs_is_that_of_its_limbs():
    graph, limbs = topology(["R[z] <crank>", "<crank> R[z] <platform>", "R[z] R[z]"]), topology(["R[z] R[z]"] * 2)
    assert (graph.poc.t, graph.poc.r, graph.dof, graph.xi) == (limbs.poc.t, limbs.poc.r, limbs.dof, limbs.xi)
    assert graph.known.route == "both"


@pytest.mark.parametrize(
    ("graph", "limb"),
    [
        (["R[z] <a>", "<a> R[x] <platform>"], "R[z] R[x]"),
        (["R[z] <a>", "<a> R[x]@A R[y]@A <b>", "<b> R[z]@A <platform>"], "R[z] R[x]@A R[y]@A R[z]@A"),
        (["R[z] <a>", *["<a> R[z] R[z] <b>"] * 2, "<b> R[x] <platform>"], "R[z] {R[z] R[z] | R[z] R[z]} R[x]"),
    ],
)
def test_a_graph_that_is_one_limb_is_seen_where_that_limb_is(graph, limb):
    by_graph, by_limb = topology(graph), topology(limb)
    assert (str(by_graph.poc), by_graph.dof, by_graph.known.route) == (str(by_limb.poc), by_limb.dof, "both")


@pytest.mark.parametrize(("driven", "kappa"), [("1.1", 0), ("4.1", 1)])
def test_a_stephenson_six_bar_by_its_drive(driven, kappa):
    """Driven in its four-bar it is two dyads, driven in the outer loop a triad."""
    found = topology(STEPHENSON, actuate=[driven])
    assert (found.dof, found.xi, found.coupling_degree) == (1, (3, 3), kappa)


def test_an_h4_with_bars_by_name():
    named, braced = topology(H4), topology("h4_robot")
    facts = [
        (found.poc.t, found.poc.r, found.dof, sorted(found.xi), found.coupling_degree) for found in (named, braced)
    ]
    assert facts[0] == facts[1]


def test_a_graph_without_limbs_is_told_by_twists():
    """Two rods between the bars, of any lengths: they hold the platform to the bars' orientation."""
    found = topology([*H4[:4], "<left> R[z]", "<right> R[z]", "<left> R[z] R[z] <right>"])
    assert (found.known.route, found.dof, found.poc.r) == ("twists", 3, 0)
    assert "does not reduce" in found.known.refusal


@pytest.mark.parametrize("text", ["<a> R[z] R[z] <b>", "<base> R[z] <rod>", "<rod> S <platform>"])
def test_written_and_read_back(text):
    assert plain_text(parse_chains([text])[0]) == text


@pytest.mark.parametrize(
    ("text", "position", "words"),
    [
        ("<a> R[z] <a>", 9, "two links"),
        ("R[z] <base>", 5, "two links"),
        ("R[z] <a> R[z]", 9, "a joint, a sign or the end"),
        ("<A> R[z]", 0, "a joint"),
    ],
)
def test_what_is_no_chain_between_links(text, position, words):
    with pytest.raises(NotationError, match=words) as error:
        parse_chains([text])
    assert error.value.position == position


def test_a_graph_without_base_or_platform():
    with pytest.raises(UsageError, match="no chain begins or ends at <platform>"):
        topology(["R[z] <a>", "<a> R[z] <b>"])


def test_graphs_are_not_drafted():
    with pytest.raises(UsageError, match="chain 1 leads from base to coupler"):
        drafted(parse_chains(STEPHENSON), Path("my.toml"))


@pytest.mark.parametrize(
    ("graph", "numbers"),
    [
        # a dyad drives the bar
        (["P(4R, rod)[z]", "R[z] R[z] R[z] <rod>"], (1, 1, 0, (3, 3))),
        # the platform is hinged to one link and held to the bar
        (["P(4R, rod)[z] R[z]", "<rod> R[z] R[z] <platform>"], (1, 1, 1, (3, 3))),
        # nothing leads to it: it is a generalised joint as ever
        (["P(4R, rod)[z]", "R[z] R[z] R[z]"], (1, 1, 0, (3,))),
    ],
)
def test_the_bar_of_a_parallelogram_by_name(graph, numbers):
    found = topology(graph)
    assert (found.dof, found.poc.dim, found.poc.r, found.xi) == numbers
    assert plain_text(parse_chains(graph[:1])[0]) == graph[0]


def test_a_pantograph_has_two_parallelograms_on_one_bar():
    """A parallelogram on the bar of another, and a dyad: two freedoms and two, less three of a plane loop."""
    found = topology(["P(4R, rod)[z] <coupler>", "<rod> P(4R)[z] <platform>", "<coupler> R[z] R[z] <platform>"])
    assert (found.known.route, found.dof) == ("twists", 1)


def test_only_a_parallelogram_of_four_hinges_has_a_bar():
    with pytest.raises(NotationError):
        parse_chains(["P(4S, rod)[z]"])
