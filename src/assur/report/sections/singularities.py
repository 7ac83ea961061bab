"""Singularities: every factor with its meaning, an example of each, and what the rank of the joint graph says."""

from __future__ import annotations

from assur.kinematics.answers.at_border import inputs_at_border, pose_at_border, power
from assur.kinematics.answers.style import texts_of, titles_of
from assur.kinematics.closure import mobility
from assur.kinematics.rates.architecture import architecture_text
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.motions import general
from assur.model.closed_form import Factor
from assur.report.findings import Findings
from assur.report.formulas.latex import symbol_mathml
from assur.report.formulas.mathml import inline
from assur.results.kinds import FLOATING, RANK, Cell, Facts, PrintedFormula, Result, Scalar, Section, Table
from assur.results.typeset_text import short, shown_unit

KINDS = {
    "parallel": "parallel: det Jp",
    "serial": "serial: det Jq",
    "other": "neither determinant",
}


MEASURES = {
    "output": "smallest singular value of Jp: 0 where the platform moves with every input locked",
    "input": "smallest singular value of Jq: 0 where the platform loses a freedom",
    "closure": "smallest singular value of the closure that counts in general, as a share of that around home",
}
TYPES = {
    "RI": "redundant input",
    "RO": "redundant output",
    "IO": "impossible output",
    "II": "impossible input",
    "IIM": "increased instantaneous mobility",
    "RPM": "redundant passive motion",
}


def singularities(findings: Findings) -> Section:
    """The table of factors, the groups that matter together, and example configurations."""
    if findings.record.closed_form is None:
        return _judged(findings)
    said = (
        "A configuration is singular where a factor of a determinant vanishes: serial where det Jq = 0 (the platform "
        "loses a freedom), parallel where det Jp = 0 (it gains one while the inputs are locked), comprehensive where "
        "both are zero. The rank of the closure of the whole joint graph is a second opinion that knows nothing of the "
        "closed form: where it drops, the configuration is a constraint singularity."
    )
    parts: list[Result] = [
        _factors(findings),
        *_groups(findings),
        *findings.picture("serial", "parallel", "singular"),
        _examples(findings),
    ]
    return Section("Singularities", said, parts)


def _judged(findings: Findings) -> Section:
    """The verdict of the joint graph on one configuration, where no closed form names factors."""
    verdict = findings.verdict
    said = (
        "Without a closed form there are no factors. The joint graph itself is judged in the configuration of this "
        "report, by the ranks of its closure and of Jp and Jq; lengths count in units of the characteristic length, so "
        "each measure is 0 where singular and at most 1."
    )
    if architecture := architecture_text(findings.record):
        said += f" The mechanism is {architecture}."
    types = ", ".join(f"{TYPES[name]} ({name})" for name in verdict.types) or "none"
    gains = "yes" if verdict.platform_gains else "no"
    items = [
        ("kind", verdict.kind),
        ("near a singularity", "yes" if verdict.near else "no"),
        ("types of Zlatanov", types),
    ]
    items += [("platform gains a freedom", gains), ("rank of the closure", f"{verdict.rank} of {verdict.generic_rank}")]
    internal = int(instantaneous(findings.record, findings.joints).ranks.internal)
    items += [
        (
            "degrees of freedom",
            f"{verdict.freedoms}, {internal} of them internal" if internal else f"{verdict.freedoms}",
        )
    ]
    measures = [Scalar(name, value, "", FLOATING, note=MEASURES[name]) for name, value in verdict.relative.items()]
    parts: list[Result] = [Facts("The verdict", tuple(items)), *measures]
    parts += findings.picture("serial", "parallel", "singular")
    if all(name in findings.record.box for name in findings.record.platform.pose) and findings.examples:
        parts.append(_examples(findings))
    return Section("Singularities", said, parts)


def _factors(findings: Findings) -> Table:
    rows = tuple(
        (
            written(factor),
            KINDS[factor.kind],
            factor.meaning,
            factor.equation,
            short(findings.solution.factors[factor.name], 6),
            shown_unit(power(findings.record.unit, factor.unit)),
        )
        for factor in findings.form.factor_list
    )
    columns = ("factor", "divides", "zero where", "source", "value here", "unit")
    caption = "All factors of both determinants; “value here” is in the configuration of this report."
    return Table("Factors and their geometric meaning", columns, rows, caption, known_by=FLOATING)


def _groups(findings: Findings) -> list[Table]:
    form = findings.form
    items = {factor.name: factor for factor in form.factor_list}
    rows = [
        (_together([items[name] for name in group]), what, meaning)
        for groups, what, meaning in (
            (
                form.self_motion_singular,
                "self-motion",
                "the platform moves on a curve with every input locked",
            ),
            (form.constraint_singular, "constraint", "the closure of the whole joint graph loses rank"),
        )
        for group in groups
    ]
    columns = ("where", "kind", "what happens")
    return [Table("What a singularity is beyond the determinants", columns, tuple(rows))] if rows else []


def _together(factors: list[Factor]) -> PrintedFormula:
    content = "<mo>=</mo>".join(_mathml(factor) for factor in factors)
    return PrintedFormula(
        inline(f"{content}<mo>=</mo><mn>0</mn>", " = ".join(factor.name for factor in factors) + " = 0")
    )


def _examples(findings: Findings) -> Table:
    """One example for every factor that has one, with the rank of the joint graph there."""
    record, style = findings.record, findings.style
    usual = general(record).closure
    rows: list[tuple[Cell, ...]] = []
    for example in findings.examples:
        free = mobility(record, example.joints)
        values = [
            *texts_of(record, style, pose_at_border(record, example.pose).tolist(), direct=True),
            *texts_of(record, style, inputs_at_border(record, example.inputs).tolist(), direct=False),
        ]
        rank = f"{int(free.rank)} of {usual}"
        rows.append((written(example.factor), example.status.name.replace("_", " "), example.mode, *values, rank))
    inputs = titles_of(record, style, direct=False)[: len(record.inputs)]
    titles = (*titles_of(record, style, direct=True), *inputs)
    columns = ("vanishing factor", "kind", "mode", *titles, "rank of closure")
    how = (
        "Found by following a factor to its zero, not written down; the kind is the most severe of what all factors say"
        if record.closed_form
        else "Paths that began at home stop there; the kind is what the joint graph says"
    )
    caption = f"{how} there. A rank below {usual} is a constraint singularity of the joint graph.{_without(findings)}"
    return Table("Example configurations", columns, tuple(rows), caption, known_by=f"{FLOATING}; {RANK}")


def _without(findings: Findings) -> str:
    """The factors of which there is no example."""
    form = findings.record.closed_form
    named = {example.factor.name for example in findings.examples}
    without = [
        factor for factor in (form.factor_list if form else ()) if factor.kind != "other" and factor.name not in named
    ]
    return f" No example was found for {', '.join(plain(factor) for factor in without)}." if without else ""


def plain(factor: Factor) -> str:
    """A factor in words, as the source's letters where they are short: "cos_theta" as "cos theta"."""
    return factor.name.replace("_", " ")


def written(factor: Factor) -> PrintedFormula:
    """A factor as mathematics."""
    return PrintedFormula(inline(_mathml(factor), factor.name))


def _mathml(factor: Factor) -> str:
    return symbol_mathml(factor.latex, factor.name)
