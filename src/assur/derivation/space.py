"""What of a solution turns in space: velocity equations do not reach it, and identities not all of it."""

from __future__ import annotations

from collections.abc import Iterator

from assur.derivation.solution import AnalyticSolution


def turning_in_space(solution: AnalyticSolution) -> Iterator[str]:
    """What a solution has of links that turn in space, in words.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> [*turning_in_space(analytic_solution(load_record("gough_stewart"), "inverse"))]
    ['directions that what is given turns in space', 'rods whose length is sought']
    >>> [*turning_in_space(analytic_solution(load_record("fivebar"), "inverse"))]
    []
    """
    yield from without_identities(solution)
    placed, loops = solution.placed, solution.loops
    if placed.named.definitions:
        yield "directions that what is given turns in space"
    if loops.shared:
        yield "axes that links share which turn in space"
    if any(own.kind == "rod" for own in loops.strokes.values()):
        yield "rods whose length is sought"


def without_identities(solution: AnalyticSolution) -> Iterator[str]:
    """What of it has no identities.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> [*without_identities(analytic_solution(load_record("h4_robot"), "direct"))]
    []
    """
    loops = solution.loops
    if loops.oblique:
        yield "sliders oblique to the axis about which they turn"
    if loops.framed:
        yield "loops in the frame of a link that turns"
