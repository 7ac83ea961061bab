"""The answer of `assur derive`: the analytic solution of each problem, or what resists."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import Answer


@dataclass(frozen=True)
class DerivedSet:
    """Links solved for together: the loop equations in which they alone are unknown, formulas one after another.

    `conditions` must not vanish; `roots` is how many solutions there are for each of what was solved before.
    """

    links: tuple[str, ...]
    equations: tuple[str, ...]
    lines: tuple[str, ...]
    conditions: tuple[str, ...]
    formulas: Mapping[str, str]
    roots: int


@dataclass(frozen=True)
class DerivedProblem:
    """The direct or the inverse problem.

    `status` is "derived" or "not_derived"; `why` says what resists. `closes`: whether every branch closes every loop,
    modulo a prime that is drawn.
    """

    problem: str
    status: str
    why: str
    branches: int | None
    closes: bool | None
    reasons: tuple[str, ...]
    sets: tuple[DerivedSet, ...]
    results: Mapping[str, str]


@dataclass(frozen=True)
class DerivationAnswer(Answer):
    """What was derived of a mechanism, problem by problem, and the file that was written."""

    mechanism: str
    problems: tuple[DerivedProblem, ...]
    closed_form: str | None
