"""Structure and topology: chains, loops, freedoms, and the declared numbers of the source beside ranks."""

from __future__ import annotations

from typing import cast

from assur.audit.rows import Row
from assur.audit.topology import PrintedDecomposition
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import mobility
from assur.kinematics.rates.instantaneous import instantaneous
from assur.model.mechanism import MechanismRecord
from assur.report.findings import Findings
from assur.report.formulas.latex import latex_mathml
from assur.report.formulas.mathml import display
from assur.report.sections.derived import derived
from assur.report.sections.printed import computed, number, quantity, verdict
from assur.results.kinds import EXACT, RANK, Formulas, PrintedFormula, Result, Scalar, Section, Table
from assur.results.plain_text import count
from assur.results.typeset_text import short

EQUATIONS = (
    (r"M_b=\bigcup_i M_{J_i}", "POC set of the end link of a branch: the union of those of its joints", ""),
    (r"M_{Pa}=\bigcap_i M_{b_i}", "POC set of the platform: what all branches have in common", ""),
    (
        r"F=\sum_i f_i-\sum_j\xi_{L_j}",
        "degrees of freedom: freedoms of the joints less loop equations",
        "freedom",
    ),
    (
        r"\xi_{L_j}=\dim\{(\bigcap_{i=1}^{j}M_{b_i})\cup M_{b_{j+1}}\}",
        "independent equations of loop j",
        "xi",
    ),
    (
        r"\Delta_j=\sum_i f_i-I_j-\xi_{L_j}",
        "constraint degree of the j-th single open chain, with I inputs",
        "delta",
    ),
    (r"\kappa=\frac{1}{2}\min\sum_j|\Delta_j|", "coupling degree of an Assur kinematic chain", "kappa"),
)
"""The method of POC sets: formula, what it says, and what a decomposition calls the number."""


def topology(findings: Findings) -> Section:
    """What is counted on the joint graph, and what the source prints."""
    results: list[Result | Section] = [*findings.picture("structure")]
    results += [_chains(findings.record)] if findings.record.chains else []
    results += [derived(findings), _mobility(findings), *_declared(findings)]
    return Section("Structure and topology", results=results)


def _chains(record: MechanismRecord) -> Table:
    rows = []
    for chain in record.chains.values():
        joints = (
            " ".join(chain.serial) or f"loop {' '.join(chain.loop)}, output {chain.output}, then {' '.join(chain.tail)}"
        )
        rows.append((chain.name, joints, chain.printed))
    rows += [
        (chain.name, " ".join(chain.joints), f"{chain.kind}, between {chain.parent} and {chain.child}")
        for chain in record.generalised.values()
    ]
    return Table("Chains and generalised joints", ("name", "joints", "as the source writes it"), tuple(rows))


def _mobility(findings: Findings) -> Section:
    record = findings.record
    free = mobility(record, findings.home)
    loops = len(joint_graph(record).cut)
    gap = (
        "nothing is dropped"
        if free.redundant == 0
        else f"kept over dropped singular values {short(float(free.gap), 2)}"
    )
    text = (
        "Mobility of the whole joint graph, no joints collapsed: the rank of the Jacobian of all loop closures at the "
        "assembled home configuration, by singular values."
    )
    internal = int(instantaneous(record, findings.home).ranks.internal)
    spins = f"; {internal} of them internal, which move neither platform nor inputs" if internal else ""
    scalars = [
        Scalar("loop equations", float(6 * loops), "", EXACT, note=f"6 for each of {count(loops, 'loop')}"),
        Scalar("rank", float(free.rank), "", RANK, note=gap),
        Scalar("degrees of freedom", float(free.freedoms), "", RANK, note=f"joint coordinates − rank{spins}"),
        Scalar("redundant constraints", float(free.redundant), "", RANK, note="loop equations − rank"),
    ]
    return Section("Mobility by rank", text, scalars)


def _declared(findings: Findings) -> list[Section]:
    """What the source says of the topology, where it says something."""
    title = f"Topology as the {findings.giver} states it"
    rows = (*findings.rows("poc"), *findings.rows("decomposition"))
    if not rows:
        return []
    text = (
        f"The POC sets, loops and degrees that the {findings.giver} prints, beside those that the rules derive from "
        "the joint graph and the rank of joint twists confirms, directions included. The coupling degree is the least "
        "over all orders of loops."
    )
    return [Section(title, text, [_method(findings), _table(findings, rows)])]


def _method(findings: Findings) -> Formulas:
    entries = findings.reference.entries["decomposition"] if findings.reference else ()
    where = cast("PrintedDecomposition", entries[0]).sources if entries else {}
    lines = tuple(
        PrintedFormula(display(latex_mathml(latex)), _number(where.get(name, "")), meaning)
        for latex, meaning, name in EQUATIONS
    )
    return Formulas("The method of POC sets", lines)


def _number(source: str) -> str:
    """Number of the equation that an address names, empty where it names none."""
    return source.removeprefix("Eq. ") if source.startswith("Eq. (") else ""


def _table(findings: Findings, rows: tuple[Row, ...]) -> Table:
    columns = ("where", "quantity", findings.given, "computed", "verdict", "how it is known")
    cells = tuple(
        (row.source, quantity(row), number(row.printed), computed(row), verdict(row), row.note) for row in rows
    )
    return Table(f"Topology, {findings.given} and computed", columns, cells, marks=tuple(row.verdict for row in rows))
