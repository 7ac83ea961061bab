"""The answer of `assur derive`: the analytic solution of each problem, or what resists."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

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
    meanings: Mapping[str, str]


@dataclass(frozen=True)
class DerivedFactor:
    """A factor of det Jp ("parallel") or det Jq ("serial") in the inverse problem's unknowns, and where it vanishes.

    Beside them, of kind "constraint", what lowers the rank of the closure where it vanishes.
    """

    name: str
    kind: str
    formula: str
    meaning: str


Multiples = Mapping[str, str]
"""Name of an equation -> the formula by which it is multiplied."""


@dataclass(frozen=True)
class ProvedTriangle:
    """Three ball joints of a link, and the components of the vectors from each to the next."""

    link: str
    joints: tuple[str, ...]
    sides: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class ProvedOrientation:
    """How a link may be turned: not at all, on a circle about an axis, carried on a hinge by such a link, as a rod.

    It turns by `constant`, by cosine and sine of `circle` about `axis`. Of a rod `line` is its direction, after
    `constant`, and `hinge` one across it, that turns with the circle; it is along the unit vector `rod`. A carried link
    turns by cosine and sine of `second` about `hinge` first. One that three balls hold turns as the sides of their
    `triangle` do.
    """

    link: str
    kind: str
    constant: tuple[tuple[str, ...], ...]
    axis: tuple[str, ...] | None
    circle: tuple[str, ...] | None
    hinge: tuple[str, ...] | None
    line: tuple[str, ...] | None
    rod: tuple[str, ...] | None
    second: tuple[str, ...] | Absent = ABSENT
    triangle: ProvedTriangle | Absent = ABSENT


@dataclass(frozen=True)
class ProvedReason:
    """A link hangs on its carrier by axes along `first` and along `second`; so it is turned by `constant` alone.

    Where axes along `third` carry those along `second`, it may be turned in one way more.
    """

    link: str
    carrier: str
    first: tuple[str, ...]
    second: tuple[str, ...]
    constant: tuple[tuple[str, ...], ...]
    third: tuple[str, ...] | Absent = ABSENT


@dataclass(frozen=True)
class ProvedAxis:
    """A loop equation of an axis that links of `joint` share: the axis in one less that in the other, `along` this."""

    joint: str
    along: tuple[str, ...]


@dataclass(frozen=True)
class ProvedPolynomial:
    """The polynomial by whose roots a coupled set is solved.

    It is the formula `vanishes` in the cosine and the sine of `circle`, of `degree` in the tangent of half that angle.
    By `shares` it is a sum of lines and of `quadric`, called `q`, that is one of equations and squares by `given`; ""
    and nothing where there is none.
    """

    circle: tuple[str, str]
    vanishes: str
    degree: int
    quadric: str
    given: Multiples
    shares: Multiples


@dataclass(frozen=True)
class ProvedSet:
    """Of a set why its equations hold, its lines, and its formulas: each a sum of multiples of equations.

    `equations` are sums of loop equations; `lines` of `e1` .. and of squares `unit <link>`; what a symbol is less its
    formula, and the square of a root less its radicand, of these and of lines `l1` .., its quantity for a root. With a
    polynomial all of them hold modulo its circle.
    """

    equations: tuple[Multiples, ...]
    lines: tuple[Multiples, ...]
    formulas: Mapping[str, Multiples]
    polynomial: ProvedPolynomial | Absent = ABSENT


@dataclass(frozen=True)
class DerivationProof:
    """What `assur verify` checks of a derivation.

    `relations` are hypotheses: dimensions as what others say that they are, without which no loop closes. `named` are
    formulas of what is given, in order; `vectors` are components of lengths along directions that turn;
    `units` are squares that are 1; `loops` vanish, of which `axes` are those of axes that links share.
    """

    relations: Mapping[str, str]
    named: Mapping[str, str]
    orientations: tuple[ProvedOrientation, ...]
    reasons: tuple[ProvedReason, ...]
    sliding: Mapping[str, str]
    vectors: Mapping[str, str]
    units: Mapping[str, str]
    loops: Mapping[str, str]
    axes: Mapping[str, ProvedAxis]
    sets: tuple[ProvedSet, ...]
    lengths: Mapping[str, Multiples]


@dataclass(frozen=True)
class ResistingSet:
    """Links that are not solved for, and the unknowns of each, after the sets that are.

    Those of a platform that turns in space are its soma coordinates: a quaternion e, and its product g with the place.
    """

    links: tuple[str, ...]
    unknowns: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class CountedSolutions:
    """How many solutions the loop equations have over complex numbers, real ones among them: probable, not proved.

    Dimensions and inputs are drawn by `seeds`; `program` counted modulo `primes`. `why` says why nothing is counted.
    `of`: of a platform that turns in space poses are counted, in each of which limbs may stand in several ways.
    """

    solutions: int | None
    why: str
    primes: tuple[int, ...]
    seeds: tuple[int, ...]
    program: str
    of: Literal["poses", "solutions"] = "solutions"


@dataclass(frozen=True)
class DerivedCase:
    """What holds where a condition does not: where its factors `vanish` together, all else being general.

    `outcome` is "self-motion", of `freedoms`, where the first of `links` is free and others follow by `formulas`;
    "roots", at most as many as elsewhere; "no solution"; "open"; or "apart", of a determinant that vanishes at no
    solution, but where what is given lets a polynomial have a root in common with it.
    """

    condition: str
    vanish: tuple[str, ...]
    outcome: str
    freedoms: int
    links: tuple[str, ...]
    formulas: tuple[str, ...]


@dataclass(frozen=True)
class DerivedComponents:
    """A polynomial in the tangent of half an angle as a product, in that or in `unknown`, its cosine or sine.

    Of each factor, irreducible over dimensions and inputs, `degrees` has the degree; each root has `solutions`.
    """

    unknown: str | None
    degrees: tuple[int, ...]
    solutions: int
    proved: str


@dataclass(frozen=True)
class DerivedRelation:
    """A dimension as what others say that it is, without which no loop closes.

    `stated`: whether formulas of the file's parameters say so; else its numbers alone do, and others may not.
    """

    dimension: str
    formula: str
    stated: bool


@dataclass(frozen=True)
class DerivedProblem:
    """The direct or the inverse problem.

    `status` is "derived" or "not_derived"; `why` says what resists. `closes`: whether every branch closes every loop,
    modulo a prime that is drawn. `proved` says what roots its polynomial cannot have; `components` what it is a product
    of. `sides` are vectors from one ball joint of a link to another. `assumed` are the parallelograms that stay such;
    `left_out` says in which other way links may stand; `vanish_at_home` are conditions and radicands that are zero
    at the file's home; `lengths` are found after the sets, where their own `conditions` hold. `proof` is there
    where it is asked for, or `not_proved` says why it is not. `square_roots`: whether these alone solve it; "no" is
    proved. `resists` is the set that is not solved; `count` the number of solutions, found without any of the
    elimination; `closed` what holds where conditions do not, derived modulo a prime. `relations`: dimensions for
    which alone it holds.
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
    proof: DerivationProof | Absent = ABSENT
    not_proved: str | Absent = ABSENT
    square_roots: Literal["yes", "no", "open"] = "open"
    resists: ResistingSet | Absent = ABSENT
    count: CountedSolutions | Absent = ABSENT
    closed: tuple[DerivedCase, ...] | Absent = ABSENT
    left_out: tuple[str, ...] = ()
    vanish_at_home: tuple[str, ...] = ()
    components: DerivedComponents | Absent = ABSENT
    sides: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    relations: tuple[DerivedRelation, ...] = ()
    conditions: tuple[str, ...] = ()


@dataclass(frozen=True)
class DerivationAnswer(Answer):
    """What was derived of a mechanism, problem by problem, and the files that were written, or why none was.

    `format` and `version` are those that `assur verify` reads.
    `factors` are those of the velocity equations, where the inverse problem was asked for and derived.
    """

    mechanism: str
    problems: tuple[DerivedProblem, ...]
    closed_form: str | None
    not_written: str | Absent = ABSENT
    latex: str | Absent = ABSENT
    c: str | Absent = ABSENT
    format: str = "assur derivation"
    version: int = 1
    factors: tuple[DerivedFactor, ...] = ()


@dataclass(frozen=True)
class VerifiedProblem:
    """What is proved of one problem: its branches, of which `closed` were held against the joint graph, and where.

    They are all where `conditions` hold and the parallelograms `assumed` stay such. Links of `ways`, "<link> against
    <carrier>", may stand in two ways, of which one is taken. They hold for dimensions with `relations` alone, of which
    `unstated` are those that no formula of the file states.
    """

    problem: str
    branches: int
    conditions: tuple[str, ...]
    assumed: tuple[str, ...]
    ways: tuple[str, ...]
    closed: int
    relations: tuple[str, ...] = ()
    unstated: tuple[str, ...] = ()


@dataclass(frozen=True)
class VerifiedDerivation(Answer):
    """A derivation that holds; `not_proved` are problems of which it proves nothing."""

    verified: Literal[True]
    mechanism: str
    problems: tuple[VerifiedProblem, ...]
    not_proved: tuple[str, ...]
    seconds: float
