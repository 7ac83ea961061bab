"""Laws of every built-in topology: what is declared is what is computed, and what the field expects is there."""

import re
from dataclasses import fields
from functools import lru_cache
from pathlib import Path

import pytest

import assur
from assur.model.registry import left_out, topology_names
from assur.model.topologies import load_topology
from assur.model.topology_description import Declared
from assur.topology.notation import plain_text
from catalogue import topology_of

CATALOGUE = (Path(__file__).parents[2] / "docs" / "catalogue.md").read_text(encoding="utf-8")

COMPUTED = {
    "poc": lambda facts: (facts.poc.t, facts.poc.r),
    "dim": lambda facts: facts.poc.dim,
    "dof": lambda facts: facts.dof,
    "xi": lambda facts: tuple(loop.xi for loop in facts.loops),
    "coupling_degree": lambda facts: facts.coupling_degree,
    "limbs": lambda facts: tuple((limb.poc.t, limb.poc.r) for limb in facts.limbs),
    "limb_dims": lambda facts: tuple(limb.poc.dim for limb in facts.limbs),
    "redundant_constraints": lambda facts: (
        facts.redundant_constraints.collapsed,
        facts.redundant_constraints.joint_graph,
    ),
    "internal_freedoms": lambda facts: (facts.internal_freedoms, len(facts.internal_joints)),
}
STATED = [
    (name, fact)
    for name in topology_names()
    for fact in COMPUTED
    if getattr(load_topology(name).declared, fact) is not None
]

NAMED_BY_THE_PAPER = {
    "Delta [1]": "delta_4s",
    "Delta with revolute joints": "tsai_platform",
    "linear Delta [2-4]": "linear_delta_4s",
    "linear Delta with revolute joints": "linear_delta_4r",
    "Tsai's platform [5]": "tsai_platform",
    "3-UPU [6, 10, 11]": "three_upu",
    "3-RRC [7, 8]": "three_rrc",
    "3-CRR [9]": "three_crr",
    "3-RRRP(4R) [13]": "three_rrrp4r",
    "Tri-pyramid [19-21]": "tri_pyramid",
    "3-[P2(US)] [23]": "three_p2us",
    "the paper's own": "zeng2019",
}
"""Translational mechanisms that the introduction of Zeng et al. 2019 names, by its references."""

EXPECTED = {
    "Orthoglide": "orthoglide",
    "tripteron": "tripteron",
    "planar five-bar": "fivebar",
    "planar 3-RRR": "planar_3rrr",
    "planar 3-RPR": "planar_3rpr",
    "3-RPS": "three_rps",
    "H4": "h4_robot",
    "Gough-Stewart": "gough_stewart",
    "3UPS&UP": "three_ups_up",
    "3-PRS": "three_prs",
    "Exechon": "exechon",
    "Agile Eye": "agile_eye",
    "4-RUU": "four_ruu",
    "Quadrupteron": "quadrupteron",
}


@pytest.mark.parametrize(("name", "fact"), STATED)
def test_what_is_declared_is_what_is_computed(name, fact):
    assert getattr(load_topology(name).declared, fact) == COMPUTED[fact](topology_of(name))


def test_every_declared_fact_is_tested():
    assert COMPUTED.keys() | {"source"} == {item.name for item in fields(Declared)}


@pytest.mark.parametrize("name", topology_names())
def test_an_entry_declares_everything_and_says_how_it_is_known(name):
    declared = load_topology(name).declared
    assert [item.name for item in fields(Declared) if getattr(declared, item.name) in (None, "")] == []


@pytest.mark.parametrize("name", topology_names())
def test_the_inputs_determine_the_platform(name):
    facts = topology_of(name)
    assert len(facts.inputs) == facts.dof - facts.internal_freedoms == facts.poc.dim
    assert facts.actuation.verdict == "valid"


@pytest.mark.parametrize("name", topology_names())
def test_both_routes_answer_and_agree(name):
    assert topology_of(name).routes_agree is True


@pytest.mark.parametrize("name", topology_names())
def test_redundant_constraints_loop_by_loop_are_those_of_the_joint_graph(name):
    facts = topology_of(name)
    assert sum(count for _, count in facts.redundant_by_loop) == facts.redundant_constraints.joint_graph
    of_loops = facts.redundant_by_loop[: len(facts.loops)]
    assert sum(count for _, count in of_loops) == facts.redundant_constraints.collapsed


@pytest.mark.parametrize("name", topology_names())
def test_chains_stand_in_the_plain_form(name):
    for chain in load_topology(name).chains:
        assert chain.text == plain_text(chain)


@pytest.mark.parametrize("name", sorted({*NAMED_BY_THE_PAPER.values(), *EXPECTED.values()}))
def test_what_the_field_expects_is_there_or_left_out_with_a_reason(name):
    reasons = {item.name: item.reason for item in left_out()}
    assert (name in {*assur.names(), *topology_names()}) + bool(reasons.get(name)) == 1


def test_nothing_is_left_out_that_is_there():
    assert {item.name for item in left_out()}.isdisjoint({*assur.names(), *topology_names()})


@pytest.mark.parametrize("name", [name for name in NAMED_BY_THE_PAPER.values() if name in topology_names()])
def test_translational_mechanisms_translate(name):
    assert load_topology(name).declared.poc == (3, 0)


@pytest.mark.parametrize("name", sorted({*assur.names()} & {*topology_names()}))
@pytest.mark.parametrize("fact", COMPUTED)
def test_a_mechanism_has_the_topology_that_stands_beside_it(name, fact):
    assert getattr(load_topology(name).declared, fact) == COMPUTED[fact](computed_of_joint_graph(name))


@lru_cache
def computed_of_joint_graph(name):
    return assur.topology(assur.load(name))


def rows():
    """The table of topologies: name -> its other cells."""
    lines = [line.strip().strip("|") for line in CATALOGUE.splitlines() if line.startswith("| `")]
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)] for line in lines]
    return {row[0].strip("`"): row[1:] for row in cells if len(row) == 6}


@pytest.mark.parametrize("name", topology_names())
def test_the_catalogue_gives_the_computed_numbers(name):
    facts, entry = topology_of(name), load_topology(name)
    shown = [entry.limb_types.replace("|", "\\|"), str(facts.dof), f"t{facts.poc.t} r{facts.poc.r}"]
    assert rows()[name][:4] == [*shown, str(facts.coupling_degree)]


def test_the_catalogue_has_no_other_rows_and_says_what_is_left_out():
    assert rows().keys() == set(topology_names())
    text = " ".join(CATALOGUE.split())
    for topology in left_out():
        assert re.search(rf"{topology.title}.*{topology.reason}", text)
