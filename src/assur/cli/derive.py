"""`assur derive`: the analytic solution of a mechanism, from its joint graph alone."""

from __future__ import annotations

from typing import Annotated, Literal

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared


def derive(
    mechanism: MechanismName,
    /,
    *,
    problem: Annotated[
        Literal["direct", "inverse", "both"],
        Parameter(help="Which problem; both if left out."),
    ] = "both",
    output: Annotated[
        str | None,
        Parameter(name=("-o", "--output"), metavar="FILE", help="Write the closed form, a Python file that is read."),
    ] = None,
    latex: Annotated[
        str | None,
        Parameter(name="--latex", metavar="FILE", help="Write the derivation as a LaTeX document, for pdflatex."),
    ] = None,
    c: Annotated[
        str | None,
        Parameter(name="--c", metavar="FILE", help="Write the closed form as C99, in one file."),
    ] = None,
    prove: Annotated[
        bool, Parameter(negative=(), help="Write an identity for each step into the data, which `assur verify` checks.")
    ] = False,
    square_roots: Annotated[
        bool, Parameter(negative=(), help="Ask for square roots alone: 4 where it is proved that none will do.")
    ] = False,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Derive the analytic solution of a mechanism from its joint graph.

    It says why links do not turn, in which order the chains are solved, the loop
    equations of each, and the formulas that solve them: square roots, one for
    each choice of two. Every step is a linear elimination or the meeting of a
    line with a circle or a sphere, so no branch is missing where its conditions
    hold; then every branch is held against the loops, modulo a prime. Where
    links belong together, an angle of one of them is taken as known: the others
    follow linearly, and what is left over is one polynomial in that angle.

    The file that -o writes holds for any dimensions. Beside the mechanism's file
    as closed_form.py it makes every command fast, and `assur check` holds it
    against the joint graph. Exit codes: 0, square roots or one polynomial, and
    whether it is proved that no square roots would do; 5, a set of links
    resists: it is named, with its unknowns and, probably, its number of
    solutions, after what was solved before it. With --square-roots a polynomial
    is no answer: 4 where it is proved that square roots alone will not do, of
    one problem or of both, else 5. --latex writes what a paper prints: symbols, reasons,
    set by set the equations and their solution, branches, an example. --prove
    adds to --json why no branch is missing: each equation and each formula as a
    sum of multiples of those before it, for `assur verify`; what holds where a
    condition does not; and the solutions counted modulo two primes.

    For example:
        assur derive zeng2019
        assur derive fivebar --problem direct
        assur derive zeng2019 --latex zeng2019.tex
        assur derive my.toml -o closed_form.py --c my.c
        assur derive my.toml --prove --json > d.json
    """
    record = shared.mechanism(mechanism)
    from assur.cli import derive_answer
    from assur.cli.progress import progress

    with progress(f"deriving {record.name}", shared):
        return derive_answer.outcome(record, problem, output, latex, c, prove, square_roots)
