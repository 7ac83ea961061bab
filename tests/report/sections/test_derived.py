"""The derived topology in the report says what the engine says."""

import re

from assur.report.findings import Findings
from assur.report.sections.derived import derived
from assur.results.kinds import Facts, Formulas, PrintedFormula, Scalar, Table


def parts(section, kind):
    return {getattr(item, "name", None) or item.title: item for item in section.results if isinstance(item, kind)}


def test_numbers_are_those_of_the_engine(findings):
    section, found = derived(findings), findings.topology
    values = {name: item.value for name, item in parts(section, Scalar).items()}
    assert values == {
        "dimension of the POC set": found.poc.dim,
        "degrees of freedom F": found.dof,
        "coupling degree κ": found.coupling_degree,
        "redundant constraints": found.redundant_constraints.collapsed,
        "redundant constraints, all joints": found.redundant_constraints.joint_graph,
    }
    assert str(found.poc) in section.text


def test_tables_are_those_of_the_engine(findings):
    tables, found = parts(derived(findings), Table), findings.topology
    assert [row[3] for row in tables["Limbs"].rows] == [str(limb.poc) for limb in found.limbs]
    assert [(row[1], row[4]) for row in tables["Loops and Assur chains"].rows] == [
        (" ".join(loop.joints), str(loop.xi)) for loop in found.loops
    ]
    assert [row[0] for row in tables["Decoupling"].rows] == list(found.decoupling.outputs)
    assert [tuple(cell == "×" for cell in row[1:]) for row in tables["Decoupling"].rows] == list(
        found.decoupling.depends
    )
    relaxed = tables["Joints that could be relaxed"]
    assert sum(len(str(row[3]).split()) for row in relaxed.rows) == len(found.relaxation.single)


def test_every_equation_is_typeset_and_none_has_a_number_of_a_paper(findings):
    (formulas,) = parts(derived(findings), Formulas).values()
    assert not any(line.equation for line in formulas.lines)
    for line in formulas.lines:
        assert line.mathml.startswith("<math")
        assert "\\" not in line.mathml
    assert sum("mtable" in line.mathml for line in formulas.lines) >= len(findings.topology.limbs) + 1


def test_the_plan_and_the_joints_are_in_words(findings):
    facts = parts(derived(findings), Facts)
    plan = facts["What the coupling degree means for the direct problem"]
    assert tuple(text for _, text in plan.items) == findings.topology.plan.words
    said = dict(facts["Joints"].items)
    assert said["idle joints"] == "none"
    assert all(name in said["actuated"] for name in findings.topology.inputs)


def test_each_step_of_the_derivation_has_its_rule_and_its_reason(findings):
    table = parts(derived(findings), Table)["The derivation, step by step"]
    steps = [row for row in table.rows if isinstance(row[1], PrintedFormula)]
    assert len(steps) >= 4
    assert all(re.fullmatch(r"(linear rule|criterion C[12]|containment|location): .+", row[2]) for row in steps)
    assert table.rows[-1][1].startswith("so the platform has three translations and no rotations")


def test_a_mechanism_without_closed_form_has_its_topology(fourbar):
    found = Findings(fourbar, resolution=12, illustrated=False)
    values = {name: item.value for name, item in parts(derived(found), Scalar).items()}
    assert values["degrees of freedom F"] == 1
