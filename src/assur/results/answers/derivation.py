"""The answer of `assur derive`: the analytic solution of each problem, or what resists."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import ABSENT, Absent, Answer


@dataclass(frozen=True)
class DerivedReason:
    """Why a link does not turn against its carrier: axes along two directions join them, each with its joints."""

    text: str
    link: str
    carrier: str
    axes: tuple[str, str]
    joints: tuple[tuple[str, ...], tuple[str, ...]]


@dataclass(frozen=True)
class DerivedChoice:
    """A choice of two: `root` is the root of `radicand` with either sign, and is `quantity` of the unknowns."""

    root: str
    radicand: str
    quantity: str


@dataclass(frozen=True)
class DerivedSet:
    """Links solved for together: the loop equations in which they alone are unknown, formulas one after another.

    `lines` follow of `equations` and of the sums of squares of each link's unknowns, which are 1. `conditions` must not
    vanish; `roots` is how many solutions there are for each of what was solved before, one for each of its `choices`.
    """

    links: tuple[str, ...]
    unknowns: tuple[tuple[str, ...], ...]
    equations: tuple[str, ...]
    lines: tuple[str, ...]
    conditions: tuple[str, ...]
    formulas: Mapping[str, str]
    choices: tuple[DerivedChoice, ...]
    roots: int


@dataclass(frozen=True)
class DerivedProblem:
    """The direct or the inverse problem.

    `status` is "derived" or "not_derived"; `why` says what resists. `closes`: whether every branch closes every loop,
    modulo a prime that is drawn. `proved` says what roots its polynomial cannot have. `assumed` are the
    parallelograms that stay such; `lengths` are found after the sets.
    """

    problem: str
    status: str
    why: str
    branches: int | None
    closes: bool | None
    reasons: tuple[DerivedReason, ...]
    assumed: tuple[str, ...]
    sets: tuple[DerivedSet, ...]
    lengths: Mapping[str, str]
    results: Mapping[str, str]
    proved: str = ""


@dataclass(frozen=True)
class DerivationAnswer(Answer):
    """What was derived of a mechanism, problem by problem, and the files that were written, or why none was."""

    mechanism: str
    problems: tuple[DerivedProblem, ...]
    closed_form: str | None
    not_written: str | Absent = ABSENT
    latex: str | Absent = ABSENT
    c: str | Absent = ABSENT
