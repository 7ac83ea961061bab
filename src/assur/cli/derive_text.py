"""How the answer of `assur derive` reads."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rich.console import RenderableType
from rich.padding import Padding

from assur.cli.output import Verbatim, heading
from assur.results.answers.answer import ABSENT
from assur.results.answers.derivation import DerivationAnswer, DerivedFactor, DerivedProblem, DerivedRelation
from assur.results.plain_text import count

LONG = 1200
"""Letters of a factor's formula that are printed; --json has all."""


def shown(data: DerivationAnswer) -> Iterable[RenderableType]:
    """The lines of an answer."""
    for part in data.problems:
        derived = part.status == "derived"
        yield heading(
            f"{data.mechanism}, {part.problem}: {count(part.branches or 0, 'branch') if derived else 'not derived'}"
        )
        yield from (f"{k}. {own.text}" for k, own in enumerate(part.reasons, start=1))
        yield from (f"{name} is the vector from {start} to {end}" for name, (start, end) in part.sides.items())
        for own in part.sets:
            yield ""
            yield f"{' and '.join(own.links)}: {own.roots} roots"
            yield from (Verbatim(f"    {text}") for text in (*own.equations, *own.lines))
            yield from (Verbatim(f"    where {text}") for text in own.conditions)
            yield from (Verbatim(f"    {name} = {text}") for name, text in own.formulas.items())
            radicands = {choice.radicand for choice in own.choices}
            yield from (
                _meaning(f"{name} {'<' if name in radicands else '='} 0: {text}") for name, text in own.meanings.items()
            )
        if part.sets or part.reasons:
            yield ""
        yield from _end(part) if derived else resistance(part)
        yield from (f"for dimensions with {_relation(own)}" for own in part.relations)
        yield from (f"left out: {text}" for text in part.left_out)
        if part.vanish_at_home:
            where = " and ".join(f"{name} = 0" for name in part.vanish_at_home)
            yield f"at home {where}: with the file's dimensions the formulas degenerate there, or branches meet"
        yield from _cases(part)
        yield from _counted(part) if derived else ()
        yield ""
    loose = [factor for factor in data.factors if factor.kind == "constraint"]
    for factors, said in (
        ([factor for factor in data.factors if factor not in loose], "det Jp and det Jq are products of"),
        (loose, "the platform is no longer kept from turning where all of these vanish:"),
    ):
        yield from [said] if factors else []
        for factor in factors:
            yield Verbatim(f"    {factor.name} = {_formula(factor, factors)}")
            yield _meaning(f"{factor.name} = 0: {factor.meaning}")
    yield from [""] if data.factors else []
    if data.not_written is not ABSENT:
        yield f"no closed form is written: {data.not_written}"
    yield from (f"written: {name}" for name in (data.latex, data.c) if name is not ABSENT)
    if data.closed_form is not None:
        yield f"written: {data.closed_form}"
        yield "next: put it beside the mechanism's file as closed_form.py, and run assur check"


def _relation(own: DerivedRelation) -> str:
    """A dimension as others say that it is, and who says so."""
    stated = "as the file states" if own.stated else "which its numbers have, and no formula of the file states"
    return f"{own.dimension} = {own.formula} alone, {stated}"


def _formula(factor: DerivedFactor, factors: Iterable[DerivedFactor]) -> str:
    """That of a factor, or what it is of its determinant where that is too long to be read."""
    others = [own.name for own in factors if own.kind == factor.kind and own is not factor]
    if len(factor.formula) <= LONG or factor.kind == "constraint":
        return factor.formula
    name = "det Jp" if factor.kind == "parallel" else "det Jq"
    return f"{name}/({'*'.join(others)})" if others else name


def _meaning(text: str) -> Padding:
    """A sentence under the formulas that it is about, as far in as they are on each of its lines."""
    return Padding(text, (0, 0, 0, 4), expand=False)


def _end(part: DerivedProblem) -> Iterator[RenderableType]:
    """Results, and what is proved."""
    yield from (Verbatim(f"    where {text}") for text in part.conditions)
    yield from (Verbatim(f"    {name} = {text}") for name, text in {**part.lengths, **part.results}.items())
    proved = "every branch closes every loop" if part.closes else "SOME BRANCH DOES NOT CLOSE"
    yield f"{proved}, modulo a prime of 160 bits"
    if part.not_proved is not ABSENT:
        yield f"not proved that no branch is missing: {part.not_proved}"
    if part.proof is not ABSENT:
        yield "every step is an identity, in the data (--json): assur verify checks them"
    if part.proved:
        yield f"proved by factors modulo primes: {part.proved}"
    if part.components is not ABSENT:
        yield f"proved by exact factors: {part.components.proved}"


def _cases(part: DerivedProblem) -> Iterator[RenderableType]:
    """What holds where a condition does not."""
    for own in () if part.closed is ABSENT else part.closed:
        where = " and ".join(f"{text} = 0" for text in own.vanish)
        said = {
            "self-motion": f"a self-motion of {own.freedoms}: {' and '.join(own.links)} move, what is given stands",
            "roots": "solved alike, with no more roots",
            "no solution": "no solution",
            "apart": "at no solution, but for what is given so that the polynomial has a root in common with it",
            "open": "open: not derived",
        }[own.outcome]
        yield Verbatim(f"where {own.condition} = 0{f', as {where}' if where else ''}: {said}")


def resistance(part: DerivedProblem) -> Iterator[str]:
    """What is not solved, why, and how many solutions it probably has."""
    if part.resists is not ABSENT:
        unknowns = ", ".join(name for group in part.resists.unknowns for name in group)
        pose = part.count is not ABSENT and part.count.of == "poses"
        said = ", its quaternion e and the product g of this with its place" if pose else ""
        yield f"{' and '.join(part.resists.links)}: not solved for {unknowns}{said}"
    yield part.why
    yield from _counted(part)


def _counted(part: DerivedProblem) -> Iterator[str]:
    own = part.count
    if own is ABSENT:
        return
    how = f"modulo {' and '.join(map(str, own.primes))}, drawn by seeds {' and '.join(map(str, own.seeds))}"
    if own.solutions is None:
        yield f"{own.of} not counted: {own.why}"
        return
    same = "" if part.branches in (None, own.solutions) else f", AND NOT {part.branches}"
    yield (
        f"{own.solutions} {own.of} over complex numbers{same}, counted by {own.program} without this elimination "
        f"{how}: probable, not proved"
    )
