"""Position: the closed form written down, every solution, and the source's tables beside them."""

from __future__ import annotations

from collections.abc import Sequence

from assur.kinematics.answers.at_border import inputs_at_border, pose_at_border, power
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.answers.style import given_words
from assur.kinematics.modes import Problem, written_quantities
from assur.kinematics.naming import described_signs
from assur.model.closed_form import Eliminant, Margin, PolynomialSystem, SelfMotion
from assur.model.mechanism import MechanismRecord
from assur.report.findings import Findings
from assur.report.formulas.latex import is_understood, latex_mathml
from assur.report.formulas.mathml import equation, inline, letter_mathml, named_formula, term_mathml
from assur.report.formulas.normal import text
from assur.report.formulas.reading import FormulaLine
from assur.report.formulas.symbols import GREEK
from assur.report.sections.analytic import analytic_solutions
from assur.report.sections.polynomial import polynomial, polynomial_words, system_words
from assur.report.sections.printed import solutions_beside
from assur.report.sections.proved import proof_words
from assur.report.sections.solutions import solutions
from assur.results.kinds import FLOATING, Formulas, PrintedFormula, Result, Section, Table
from assur.results.plain_text import count
from assur.results.typeset_text import short, shown_unit

READ = (
    "The formulas below are not written down by hand: they are what the closed form of this mechanism computes, "
    "read over symbols line by line, in the letters of the source. The same lines, read over floating-point "
    "numbers, give every solution and Jacobian in this report. Numbers in brackets are the source's equations; "
    "letters that only a number tells apart are shorthand for what would be too long to read."
)
SEARCHED = (
    "This mechanism has no closed form. Its assemblies are found on the joint graph itself; by what method, and how "
    "far such a list can be trusted, stands under Completeness."
)


def position(findings: Findings) -> Section:
    """Modes, the direct problem, the inverse problem, and what makes the answers complete."""
    form = findings.record.closed_form
    parts: list[Result | Section] = [*findings.picture("model", "planes"), *_modes(findings.record)]
    parts += [_direct(findings), _inverse(findings)]
    if form is not None and form.self_motion is not None:
        parts.append(_self_motion(findings, form.self_motion))
    parts += analytic_solutions(findings.record)
    parts.append(Section("Completeness", completeness(findings)))
    return Section("Position", READ if form else SEARCHED, parts)


def completeness(findings: Findings) -> str:
    """For which model the answers are complete, and by what right."""
    form = findings.record.closed_form
    worst = max(_residual(findings.direct), _residual(findings.inverse))
    closes = (
        f"Each solution closes every loop of the joint graph; the largest gap among those listed here is "
        f"{short(worst, 2)} {findings.record.unit}."
    )
    rights = f"Direct problem: {findings.direct.right}. Inverse problem: {findings.inverse.right}."
    if form is None:
        return f"{rights} {closes}"
    if form.complete_for == "joint_graph":
        whole = "What is complete is complete for the joint graph itself."
        return f"{rights} {whole} {closes}"
    because = f" ({form.reduced_because})" if form.reduced_because else ""
    return (
        f"{rights} What is complete is complete for the reduced model of the source. The joint graph has further "
        f"assemblies{because}; these are not listed. {closes}"
    )


def _residual(answer: SolutionSet) -> float:
    return max((solution.residual for solution in answer), default=0.0)


def _modes(record: MechanismRecord) -> list[Table]:
    written = record.modes.of_file
    defaults = written.default_working, written.default_assembly
    rows = []
    quantities = written_quantities(record, "inverse"), written_quantities(record, "direct")
    for what, signs, default in zip(("working", "assembly"), quantities, defaults, strict=True):
        for place, (name, formula) in enumerate(signs.items()):
            rows.append((what, named_formula(name), formula.text, default[place : place + 1] or None))
    own = _signs_of_blocks(record)
    if not rows:
        return own
    caption = (
        "A branch is named by the signs of these quantities of the joint graph, in this order: working modes are those "
        "of the inverse problem, assembly modes those of the direct problem."
    )
    return [Table("Names of modes", ("mode", "sign", "of the quantity", "default"), tuple(rows), caption), *own]


def _signs_of_blocks(record: MechanismRecord) -> list[Table]:
    """The signs that the joint graph gives to modes for which the file names no quantities."""
    kinds: dict[Problem, str] = {"inverse": "working", "direct": "assembly"}
    rows = tuple(
        (kind, named_formula(sign.letter), sign.name, sign.meaning)
        for problem, kind in kinds.items()
        for sign in described_signs(record, problem)
        if not sign.written
    )
    if not rows:
        return []
    caption = (
        "Modes for which the file names no quantities are named by the signs of closing blocks of the joint graph, in "
        "this order; each changes at singularities alone. Letters are those of the figures."
    )
    return [Table("Signs of the joint graph", ("mode", "letter", "sign", "+ where"), rows, caption)]


def _direct(findings: Findings) -> Section:
    style, record = findings.style, findings.record
    given = given_words(record, style, inputs_at_border(record, findings.inputs).tolist(), direct=True)
    table = findings.table("direct")
    origin = f"those of {table.source}" if table else "those of the assembled home configuration"
    said = f"Poses from inputs. At the inputs {given} ({origin}) {among(findings, 'direct')}."
    said += f"\n\n{proof_words(findings, 'direct')}"
    kernel = findings.kernel("direct")
    results: list[Result] = list(findings.picture("flow"))
    if isinstance(kernel, Eliminant):
        said += f"\n\n{polynomial_words(findings, kernel)}"
        results += polynomial(findings, kernel)
    elif isinstance(kernel, PolynomialSystem):
        said += f"\n\n{system_words(findings, kernel)}"
    elif kernel is not None:
        results += _formulas(findings, "direct")
    results += solutions(findings, "direct")
    return Section("Direct problem", said, [*results, *_beside(findings, "direct"), *findings.picture("solutions")])


def _inverse(findings: Findings) -> Section:
    record = findings.record
    given = findings.style.pose(record.platform.pose, pose_at_border(record, findings.pose).tolist())
    said = f"Inputs from a pose. At the pose {given} {among(findings, 'inverse')}."
    said += f"\n\n{proof_words(findings, 'inverse')}"
    results = [*(_formulas(findings, "inverse") if findings.kernel("inverse") else ()), *solutions(findings, "inverse")]
    return Section("Inverse problem", said, [*results, *_beside(findings, "inverse")])


def among(findings: Findings, problem: Problem) -> str:
    """How many solutions there are, and of what."""
    answer, kernel = (findings.direct if problem == "direct" else findings.inverse), findings.kernel(problem)
    if kernel is None and not answer.complete:
        return f"a search found {count(len(answer), 'solution')}"
    candidates = f" among {count(answer.candidates, noun(kernel))}" if kernel else ""
    verb = "is" if len(answer) == 1 else "are"
    return f"there {verb} {count(len(answer), 'real solution')}{candidates}"


def source_of(answer: SolutionSet) -> str:
    """How solutions were found where there is no kernel."""
    return "by solving loop after loop" if answer.complete else "found by search"


def noun(kernel: object) -> str:
    """What candidates for solutions are called."""
    if isinstance(kernel, Eliminant):
        return "root"
    return "complex solution" if isinstance(kernel, PolynomialSystem) else "branch"


def _self_motion(findings: Findings, motion: SelfMotion) -> Section:
    margin = next(entry for entry in findings.form.direct_margins if entry.name == motion.margin)
    angle = GREEK.get(motion.parameter, motion.parameter)
    said = (
        f"Where {margin.name} = 0 ({margin.meaning}) the inputs do not fix the platform: it moves on a curve while "
        "every input stands still. Such an answer is the description of that curve, run along by the angle "
        f"{angle}; it is never one sample of it."
    )
    return Section("Self-motion", said)


def _formulas(findings: Findings, problem: Problem) -> list[Result]:
    read = findings.formulas(problem)
    said: set[str] = set()
    lines = []
    for line in read.lines:
        written = equation(letter_mathml(line.letter), term_mathml(line.term), f"{_name(line)} = {text(line.term)}")
        new = line.letter.name not in said  # cosine and sine of an angle mean the same
        lines.append(PrintedFormula(written, line.equation if new else "", line.meaning if new else ""))
        said.add(line.letter.name)
    title = f"Closed form of the {problem} problem"
    caption = (
        "From the given numbers to the results, to every joint’s value and to the entries of the Jacobians, in the "
        "order of computation; rotations of spherical joints are left out."
    )
    found_formulas: list[Result] = [Formulas(title, tuple(lines), caption)]
    if read.named:
        found_formulas.append(_named(findings, problem, read.named))
    return [*found_formulas, _margins(findings, problem)]


def _name(line: FormulaLine) -> str:
    return f"{line.letter.function} {line.letter.name}".strip()


def _named(findings: Findings, problem: Problem, lines: Sequence[FormulaLine]) -> Table:
    """Quantities of the source beside those of the lines, with their values in the configuration."""
    solution = findings.solution
    kinds = {quantity.name: quantity for quantity in findings.form.quantity_list}
    rows = []
    for line in lines:
        quantity = kinds[line.letter.name]
        value = solution.quantities[quantity.name] if not line.letter.function else None
        unit = shown_unit(power(findings.record.unit, {"length": 1, "area": 2, "volume": 3}.get(quantity.kind, 0)))
        formula = PrintedFormula(inline(term_mathml(line.term), text(line.term)))
        rows.append(
            (
                PrintedFormula(inline(letter_mathml(line.letter), _name(line))),
                formula,
                line.equation,
                short(value, 8),
                unit,
            )
        )
    columns = ("quantity", "formula", "equation", "value", "unit")
    caption = "Values in the configuration that this report is about (see the solutions)."
    return Table(
        f"Also named by the source, {problem} problem", columns, tuple(rows), caption, folded=True, known_by=FLOATING
    )


def _margins(findings: Findings, problem: Problem) -> Table:
    form, read = findings.form, findings.formulas(problem)
    margins = form.direct_margins if problem == "direct" else form.inverse_margins
    rows = tuple(
        (margin.name, _condition(margin, term_mathml(read.margins[margin.name])), _zero(margin), margin.meaning)
        for margin in margins
    )
    columns = ("margin", "must be", "where it is zero", "where it fails")
    return Table(f"When a branch of the {problem} problem exists", columns, rows, folded=True)


def _condition(margin: Margin, formula: str) -> PrintedFormula:
    written = latex_mathml(margin.latex) if is_understood(margin.latex) else formula
    relation, zero = ("≥", "not negative") if margin.zero == "merge" else ("≠", "not zero")
    return PrintedFormula(inline(f"{written}<mo>{relation}</mo><mn>0</mn>", f"{margin.name} {zero}"))


def _zero(margin: Margin) -> str:
    return "two branches merge" if margin.zero == "merge" else "the formulas degenerate"


def _beside(findings: Findings, problem: Problem) -> list[Result | Section]:
    """The source's tables beside these solutions."""
    entries = findings.reference.entries[problem] if findings.reference else ()
    return [solutions_beside(findings, entry, findings.rows(problem)) for entry in entries]
