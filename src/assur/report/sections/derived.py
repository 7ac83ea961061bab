"""Topology, derived: POC sets as matrices, Eqs. (1) to (6) in numbers, loops, the plan of solution, decoupling."""

from __future__ import annotations

import re

from assur.report.findings import Findings
from assur.report.formulas.latex import latex_mathml
from assur.report.formulas.mathml import display, inline
from assur.results.kinds import EXACT, RANK, Cell, Facts, Formulas, PrintedFormula, Result, Scalar, Section, Table
from assur.topology.answers import refusals, replacements_by_kind
from assur.topology.counting.decoupling import Decoupling
from assur.topology.facts import Topology
from assur.topology.latex import Equation, equations, step_latex
from assur.topology.symbolic.derivation import PocDerivation

KNOWN = {"both": "rules and twists", "twists": "twists alone"}
_DECIMALS = re.compile(r"-?\d+\.\d{5,}")
COLLAPSED = "parallelograms as one joint"
WHOLE = "the whole joint graph"
TWISTS = "rank of twists; the rules do not decide everything"


def derived(findings: Findings) -> Section:
    """What the topology engine says, each POC set by two routes."""
    topology = findings.topology
    said = (
        "Derived from the joint graph, not read from the source: POC sets by the rules of union and intersection, and "
        "by the rank of twists at random finite displacements; where the rules do not decide, the twists do, and it "
        f"says so. O' of a limb is on its last axis or joint centre. The platform has {topology.poc}."
    )
    results: list[Result | Section] = [*_numbers(topology), *findings.picture("graph"), _equations(topology)]
    results += [_limbs(topology)] if topology.limbs else []
    results += [_loops(topology)] if topology.loops else []
    results += [_facts("What the coupling degree means for the direct problem", topology.plan.words)]
    results += [_decoupling(topology.decoupling)] if topology.decoupling else []
    return Section(
        "Topology, derived", said, [*results, _joints(topology), *_relaxation(topology), *_derivation(topology)]
    )


COUNTED = "freedoms of the joints less those of the loops"


def _numbers(topology: Topology) -> list[Scalar]:
    routes = "exact: rules, and rank of twists agrees" if topology.routes_agree else TWISTS
    redundant = topology.redundant_constraints
    degree = None if topology.coupling_degree is None else float(topology.coupling_degree)
    internal = f", {topology.internal_freedoms} of them internal" if topology.internal_freedoms else ""
    return [
        Scalar("dimension of the POC set", float(topology.poc.dim), "", routes),
        Scalar(
            "degrees of freedom F",
            float(topology.dof),
            "",
            routes,
            note=COUNTED + internal,
        ),
        Scalar("coupling degree κ", degree, "", routes, note="least of all orders of loops"),
        Scalar("redundant constraints", float(redundant.collapsed), "", routes, note=COLLAPSED),
        Scalar("redundant constraints, all joints", float(redundant.joint_graph), "", RANK, note=WHOLE),
    ]


def _equations(topology: Topology) -> Formulas:
    lines = tuple(
        PrintedFormula(display(latex_mathml(f"{equation.left} = {equation.right}")), meaning=_meaning(equation))
        for equation in equations(topology)
    )
    return Formulas("POC sets, freedoms and degrees", lines, "dim M counts independent elements of t and r.")


def _meaning(equation: Equation) -> str:
    meaning = rounded(equation.meaning)
    return meaning if equation.dim is None else f"dim {equation.dim}; {meaning}"


def rounded(text: str) -> str:
    """A text with its long decimals to four significant digits.

    >>> rounded("R[-0.49999999999999994,0.8660254037844387,0] P(4S)")
    'R[-0.5,0.866,0] P(4S)'
    """
    return _DECIMALS.sub(lambda match: f"{float(match[0]):.4g}", text)


def _limbs(topology: Topology) -> Table:
    rows = tuple(
        (
            str(number),
            rounded(limb.text),
            limb.symbolic,
            str(limb.poc),
            str(limb.poc.dim),
            str(limb.poc.dependent),
            KNOWN[limb.known.route],
        )
        for number, limb in enumerate(topology.limbs, 1)
    )
    columns = ("limb", "plain form", "as the literature writes it", "POC set", "dim", "dependent", "known by")
    reasons = " ".join(
        f"{rounded(refusal.of)}: the rules refuse, because {refusal.reason}." for refusal in refusals(topology)
    )
    return Table("Limbs", columns, rows, reasons)


def _loops(topology: Topology) -> Table:
    internal = ["internal"] if any(loop.internal for loop in topology.loops) else []
    chain_of = {index: str(k) for k, chain in enumerate(topology.assur_chains, 1) for index in chain.loops}
    rows = tuple(
        (
            str(number),
            " ".join(loop.joints),
            str(loop.freedoms),
            *([str(loop.internal)] if internal else []),
            str(loop.inputs),
            str(loop.xi),
            f"{loop.delta:+d}".replace("-", "\N{MINUS SIGN}") if loop.delta else "0",
            chain_of.get(number - 1, ""),
        )
        for number, loop in enumerate(topology.loops, 1)
    )
    columns = ("loop", "joints that it adds", "Σf", *internal, "I", "ξ", "Δ", "Assur chain")
    caption = f"In the order that attains the coupling degree, {COLLAPSED}."
    return Table("Loops and Assur chains", columns, rows, caption, known_by=EXACT)


def _facts(title: str, lines: tuple[str, ...]) -> Facts:
    return Facts(title, tuple((f"step {number}", line) for number, line in enumerate(lines, 1)))


def _decoupling(matrix: Decoupling) -> Table:
    rows = tuple(
        (name, *("×" if used else "·" for used in row))
        for name, row in zip(matrix.outputs, matrix.depends, strict=True)
    )
    caption = "× the output depends on the input, · it does not: zeros of the Jacobian at every configuration."
    return Table("Decoupling", ("output", *matrix.inputs), rows, caption)


def _joints(topology: Topology) -> Facts:
    asked = topology.actuation
    moved = "; ".join(" ".join(joints) for joints in topology.internal_joints)
    items = [
        ("actuated", f"{', '.join(asked.inputs) or 'none'}: {asked}"),
        ("may be actuated", ", ".join(asked.in_some)),
        ("in every admissible set", ", ".join(asked.in_every)),
        ("idle joints", ", ".join(topology.idle_joints) or "none"),
        ("internal freedoms of F", str(topology.internal_freedoms)),
        ("moving with platform and inputs at rest", moved),
        ("notes", " ".join(topology.notes)),
    ]
    return Facts("Joints", tuple((label, text) for label, text in items if text))


def _relaxation(topology: Topology) -> list[Result]:
    asked = topology.relaxation
    if not asked.single:
        return []
    rows = tuple(
        (
            f"{replacement.old} to {replacement.new}",
            str(replacement.removed),
            str(replacement.internal),
            " ".join(names),
        )
        for replacement, names in replacements_by_kind(topology)
    )
    together = ", ".join(f"{replacement.joint} to {replacement.new}" for replacement in asked.together)
    caption = f"Together: {together}; that leaves {asked.left} of {asked.redundant}. The platform moves as before."
    columns = ("replacement", "redundant constraints less", "internal freedoms more", "any one of these joints")
    return [Table("Joints that could be relaxed", columns, rows, caption, known_by=RANK)]


def _derivation(topology: Topology) -> list[Result]:
    """Every step with its rule and its reason."""
    rows = tuple(row for derivation in topology.derivations for row in _steps(derivation))
    columns = ("of", "step", "because")
    return [Table("The derivation, step by step", columns, rows, folded=True)] if rows else []


def _steps(derivation: PocDerivation) -> list[tuple[Cell, ...]]:
    rows = [row for part in derivation.parts for row in _steps(part)]
    for step in derivation.steps:
        formula = PrintedFormula(inline(latex_mathml(step_latex(step)), step.text()))
        rows.append((rounded(derivation.of), formula, f"{step.rule}: {step.reason}"))
    return [*rows, (rounded(derivation.of), derivation.conclusion, f"O' {derivation.origin}")]
