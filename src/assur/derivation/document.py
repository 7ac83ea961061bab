r"""A derivation as a LaTeX document, in two columns as journals have them; it needs amsmath and nothing else."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from assur.derivation.flow_figure import flow_figure
from assur.derivation.formula_latex import COLUMN, width
from assur.derivation.letters_of_names import joint_letter, plain
from assur.derivation.phrases import listed
from assur.derivation.printed_derivation import PrintedDerivation, PrintedExample, PrintedProblem
from assur.derivation.printed_velocities import PrintedVelocities
from assur.derivation.reasons import left_out
from assur.derivation.written_parts import Block, WrittenFormula
from assur.results.plain_text import signed
from assur.topology.facts import Topology

HEAD = r"""\documentclass[10pt,a4paper,twocolumn]{article}
\usepackage{amsmath,amssymb}
\setlength{\textwidth}{176mm}\setlength{\oddsidemargin}{-8.4mm}\setlength{\columnsep}{7mm}
\setlength{\textheight}{240mm}\setlength{\topmargin}{-14mm}
\allowdisplaybreaks
\sloppy
"""
TITLES = {"direct": "Direct problem: the pose at given inputs", "inverse": "Inverse problem: the inputs at a pose"}
CLOSE = {
    True: "each closes every loop, held against them modulo a prime of 160 bits, and no other exists where the "
    "conditions hold, since every step is an equivalence",
    False: "NOT ALL of them close every loop",
}
NUMBER = 8
"""Letters that the number of a formula takes."""
WIDE = 3
"""Columns of numbers for which a table has room in its usual size."""
ROWS = 16
"""Branches in a table."""


def document(derivation: PrintedDerivation, topology: Topology | None = None) -> str:
    """The whole document; the theory's loops and degrees where a topology is given.

    >>> from assur.derivation.derivation import derive
    >>> from assur.model.registry import load_record
    >>> text = document(derive(load_record("fivebar")).printed())
    >>> text.count("begin{document}"), "KaTeX" in text
    (1, False)
    """
    return "\n".join([HEAD, *_lines(derivation, topology)]) + "\n"


def _lines(derivation: PrintedDerivation, topology: Topology | None) -> Iterator[str]:
    record = derivation.record
    yield rf"\title{{{plain(record.title or record.name)}: analytic position solution}}"
    yield r"\author{}\date{}"
    yield r"\begin{document}"
    yield r"\maketitle"
    yield r"\section*{Nomenclature}"
    yield from _nomenclature(derivation)
    if record.generalised:
        names = listed([f"${joint_letter(name)}$" for name in record.generalised])
        yield "Assumed: " + (
            f"the parallelogram {names} stays one." if len(record.generalised) == 1
            else f"the parallelograms {names} stay such."
        )  # fmt: skip
    if relations := {text: None for own in derivation.problems for text in own.written.printed.relations}:
        yield f"For {listed([*relations])} only, as without it no loop closes."
    if topology is not None and topology.loops:
        yield r"\section{Loops}"
        yield from _topology(topology, {joint.alias: joint.name for joint in record.joints.values() if joint.alias})
    before: tuple[str, ...] = ()
    for own in derivation.problems:
        yield rf"\section{{{TITLES[own.problem]}}}"
        reasons = own.written.reasons()
        yield from _orientations(reasons, before)
        before = reasons
        yield from _problem(own)
    if derivation.velocities is not None:
        yield from _velocities(derivation.velocities)
    for problem, why in derivation.why.items():
        yield rf"\section{{{TITLES[problem]}}}"
        yield f"Not derived: {plain(why)}."
    yield r"\end{document}"


def _nomenclature(derivation: PrintedDerivation) -> Iterator[str]:
    rows = {own.latex: own for part in derivation.problems for own in part.written.printed.nomenclature}
    if not rows:
        return
    yield r"\begin{description}\setlength{\itemsep}{0pt}\setlength{\parskip}{0pt}"
    for own in rows.values():
        meaning = own.meaning if "$" in own.meaning else plain(own.meaning)
        yield rf"\item[${own.latex}$] {meaning}{f' ({plain(own.unit)})' if own.unit else ''}"
    yield r"\end{description}"


def _topology(topology: Topology, aliases: Mapping[str, str]) -> Iterator[str]:
    """The loops as single open chains, with constraint degrees, and the coupling degree."""
    for number, loop in enumerate(topology.loops, start=1):
        joints = ", ".join(f"${joint_letter(aliases.get(name, name))}$" for name in loop.joints)
        yield (
            rf"\noindent SOC$_{{{number}}}$: {joints}; $\xi_{{L_{{{number}}}}} = {loop.xi}$, "
            rf"$\Delta_{{{number}}} = {signed(loop.delta)}$.\par"
        )
    if topology.coupling_degree is not None:
        yield rf"\noindent Coupling degree $\kappa = {topology.coupling_degree}$.\par"


def _orientations(reasons: tuple[str, ...], before: tuple[str, ...]) -> Iterator[str]:
    """Why links do not turn, numbered; those of the problem before are not said again."""
    if reasons and reasons == before:
        yield "The same links do not turn. "
    elif reasons:
        yield "Orientations, before any equation:"
        yield r"\begin{enumerate}"
        yield from (rf"\item {text}" for text in reasons)
        yield r"\end{enumerate}"


def _problem(own: PrintedProblem) -> Iterator[str]:
    nodes = own.written.flow
    if len(nodes) > 1:
        name = f"fig:{own.problem}"
        yield rf"Figure~\ref{{{name}}} shows the order of solution."
        yield r"\begin{figure}[htb]\centering"
        yield flow_figure(nodes)
        yield rf"\caption{{Flow of information of the {own.problem} problem.}}\label{{{name}}}"
        yield r"\end{figure}"
    for part in own.written.parts():
        yield rf"\subsection{{{plain(part.title)}}}"
        yield from map(_block, part.blocks)
    yield r"\subsection{Branches, and an example}"
    yield from _example(own)


def _block(block: Block) -> str:
    return block if isinstance(block, str) else aligned(block)


def aligned(formulas: tuple[WrittenFormula, ...], numbered: bool = True) -> str:
    r"""Formulas one under another, each with a number unless none are wanted.

    >>> print(aligned((WrittenFormula("B_{1}", ("l_{3} - y_{1}", "+ y_{2}")),)))
    \begin{align}
      B_{1} &= l_{3} - y_{1} \notag \\
      &\quad + y_{2}
    \end{align}
    """
    if (
        max(width(own.left) for own in formulas) + max(width(row) for own in formulas for row in own.rows)
        > COLUMN - NUMBER
    ):
        return _gathered(formulas)
    lines = []
    for own in formulas:
        first, *others = own.rows
        lines.append(" \\notag \\\\\n  &\\quad ".join([f"{own.left} &{own.relation} {first}", *others]))
    body = " \\\\\n  ".join(lines)
    kind = "align" if numbered else "align*"
    return f"\\begin{{{kind}}}\n  {body}\n\\end{{{kind}}}"


def _gathered(formulas: tuple[WrittenFormula, ...]) -> str:
    """The same, each in its own place, where left and right sides have no room beside one another."""
    lines = []
    for own in formulas:
        rows = " \\\\\n  &\\quad ".join([f"{own.left} &{own.relation} {own.rows[0]}", *own.rows[1:]])
        plain_line = f"{own.left} {own.relation} {own.rows[0]}"
        lines.append(plain_line if len(own.rows) == 1 else f"\\begin{{aligned}}\n  {rows}\n\\end{{aligned}}")
    body = " \\\\\n  ".join(lines)
    return f"\\begin{{gather}}\n  {body}\n\\end{{gather}}"


def _velocities(own: PrintedVelocities) -> Iterator[str]:
    """The equations between rates, and where a determinant vanishes."""
    yield r"\section{Velocities and singular configurations}"
    yield r"The loop equations, differentiated and without the rates of passive joints, are"
    yield aligned(own.equations)
    for kind, matrix, word in (("parallel", "p", "parallel"), ("serial", "q", "serial")):
        factors = [factor for factor in own.factors if factor.kind == kind]
        side = "left" if kind == "parallel" else "right"
        yield rf"\noindent The determinant of the {side} side, $\det J_{matrix}$, "
        if not factors:
            yield rf"never vanishes: there is no {word} singularity.\par"
            continue
        yield rf"vanishes in a {word} singularity, where"
        yield r"\begin{itemize}\setlength{\itemsep}{0pt}"
        for k, factor in enumerate(factors):
            end = "." if k + 1 == len(factors) else ","
            formula = f"${factor.formula} = 0$: " if factor.formula else ""
            yield rf"\item[$\bullet$] {formula}{factor.meaning}{end}"
        yield r"\end{itemize}"
    yield from (
        rf"\noindent The platform is no longer kept from turning where {factor.meaning}.\par"
        for factor in own.factors
        if factor.kind == "constraint"
    )


def _example(own: PrintedProblem) -> Iterator[str]:
    example, solution = own.example, own.written.solution
    held = CLOSE[own.closes]
    omitted = [*left_out(solution.placed, solution.loops.cranks)]
    held += ", but for what is left out" if omitted else ""
    yield f"There {'is one branch' if solution.branches == 1 else f'are {solution.branches} branches'}; {held}."
    yield from (f"Left out: {plain(text)}." for text in omitted)
    if solution.eliminant is not None:
        yield "They are counted over complex numbers; how many are real depends on what is given."
    if not example.branches:
        return
    given = ", ".join(f"${value.latex} = {value.number}$ {plain(value.unit)}" for value in example.given)
    real = [branch for branch in example.branches if branch.values]
    yield f"At {given} {len(real)} of {solution.branches} {'is' if len(real) == 1 else 'are'} real:"
    yield from _table(own, example)


def _table(own: PrintedProblem, example: PrintedExample) -> Iterator[str]:
    shown = [branch for branch in example.branches if branch.values][:ROWS] or list(example.branches[:ROWS])
    if len(example.branches) <= ROWS:
        shown = list(example.branches)
    heads = next((branch.values for branch in shown if branch.values), ())
    small = r"\small" if len(heads) <= WIDE else r"\footnotesize\setlength{\tabcolsep}{2.5pt}"
    yield rf"\begin{{center}}{small}"
    yield rf"\begin{{tabular}}{{c{'r' * max(len(heads), 1)}}}\hline"
    signs = ", ".join(own.written.printed.signs[root.symbol][0] for _, root in sorted(
        zip(own.order, own.written.solution.roots, strict=True), key=lambda pair: pair[0]))  # fmt: skip
    head = "root" if own.written.solution.eliminant is not None else ""
    head = f"{head} ${signs}$" if signs else head
    yield " & ".join([head.strip(), *(f"${value.latex}$ ({plain(value.unit)})" for value in heads)]) + r" \\ \hline"
    for branch in shown:
        mode = branch.mode.replace("-", "{-}").replace("+", "{+}")
        if branch.values:
            yield " & ".join([f"${mode}$", *(f"${value.number}$" for value in branch.values)]) + r" \\"
        else:
            yield rf"${mode}$ & \multicolumn{{{max(len(heads), 1)}}}{{c}}{{not real: ${branch.negative} < 0$}} \\"
    yield r"\hline\end{tabular}"
    yield r"\end{center}"
    left = sum(bool(branch.values) for branch in example.branches) - sum(bool(branch.values) for branch in shown)
    if left > 0:
        yield f"and {left} more."
