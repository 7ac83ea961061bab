"""A derivation checked: its loop equations are those of the mechanism file, and each step is an identity.

Every solution of the loop equations has the values that the formulas give, since each unknown less its formula is a
sum of multiples of the loop equations, whose multipliers are divided by nothing that may vanish where the conditions
hold. Every choice of roots is a solution, since its values close the file's joint graph, modulo a prime that is drawn.
A polynomial in an angle vanishes at every solution, by such a sum too; it has no more roots than its degree says.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from assur.verifier.derivations.assembly import LENGTHS, QUATERNION, FileAssembly, given_names, has_quaternion
from assur.verifier.derivations.branches import closing_branches
from assur.verifier.derivations.known_formulas import KnownFormulas, Multiples
from assur.verifier.derivations.orientations import OrientationCheck
from assur.verifier.derivations.relations import Relations
from assur.verifier.derivations.terms import Term, WrittenNumbers, divisors, symbol, term
from assur.verifier.derivations.turning import ClaimedTurn
from assur.verifier.formula import AngleSum
from assur.verifier.mechanism import FileMechanism, mechanism
from assur.verifier.reading import MalformedError, RefusedError, printable, require
from assur.verifier.vectors import ONE, dot

FORMAT, VERSION = "assur derivation", 1


@dataclass(frozen=True)
class ProvedProblem:
    """What is proved of a problem: these branches, and no others where the conditions hold.

    Attributes:
        problem: "direct" or "inverse".
        branches: how many.
        conditions: what must not vanish, as written.
        assumed: parallelograms of the file that are taken to stay such.
        ways: "<link> against <carrier>" of links of whose two ways to stand one is taken.
        closed: branches that were held against the joint graph.
        relations: of dimensions for which alone it is proved; `unstated` those that no formula of the file says.
    """

    problem: str
    branches: int
    conditions: tuple[str, ...]
    assumed: tuple[str, ...]
    ways: tuple[str, ...]
    closed: int
    relations: tuple[str, ...] = ()
    unstated: tuple[str, ...] = ()


def is_derivation(data: bytes) -> bool:
    """Whether a file says that it is a derivation."""
    try:
        document = json.loads(data.decode("utf-8"))
    except (ValueError, RecursionError):
        return False
    return isinstance(document, dict) and document.get("format") == FORMAT


def problems_of(data: bytes) -> tuple[str, tuple[str, ...]]:
    """The name of a derivation's mechanism, and the problems of which it proves nothing. Errors: MalformedError."""
    document = _read(data)
    without = (own["problem"] for own in document["problems"] if "proof" not in own)
    return printable(document["mechanism"]), tuple(map(printable, without))


def left_out_of(data: bytes) -> dict[str, tuple[str, ...]]:
    """Problem -> in which other ways links may stand, as the derivation says. Errors: MalformedError."""
    problems = _read(data)["problems"]
    try:
        return {printable(own["problem"]): tuple(map(printable, own.get("left_out", ()))) for own in problems}
    except (ValueError, TypeError) as error:
        raise MalformedError(f"no derivation: {error}") from error


def verify_derivation(data: bytes, text: str) -> list[ProvedProblem]:
    """Check a derivation against a mechanism's file: what is proved of each problem that has identities.

    Errors:
        MalformedError: it is no derivation with identities.
        RefusedError: something does not hold, or it is that of another mechanism.
    """
    document = _read(data)
    try:
        own = mechanism(text)
        solved = [problem for problem in document["problems"] if "proof" in problem]
        return [_ProblemCheck(own, problem).findings() for problem in solved]
    except (ValueError, KeyError, TypeError, IndexError, AttributeError, ArithmeticError, RecursionError) as error:
        raise RefusedError(f"it does not fit the mechanism file: {type(error).__name__}: {error}") from error


def _read(data: bytes) -> dict[str, Any]:
    try:
        document: dict[str, Any] = json.loads(data.decode("utf-8"))
        if document["format"] != FORMAT or document["version"] != VERSION:
            raise MalformedError(f"its format is not {FORMAT!r}, version {VERSION}")
        printable(document["mechanism"])
        if not any("proof" in own for own in document["problems"]):
            raise MalformedError("it has no identities; `assur derive --prove --json` writes them")
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise MalformedError(f"no derivation: {type(error).__name__}: {error}") from error
    return document


class _ProblemCheck(KnownFormulas):
    def __init__(self, own: FileMechanism, problem: Mapping[str, Any]) -> None:
        self.mechanism, self.problem = own, problem
        self.proof, self.name = problem["proof"], str(problem["problem"])
        if self.name not in ("direct", "inverse"):
            raise MalformedError(f"no such problem: {self.name[:40]!r}")
        numbers = WrittenNumbers()
        parameters: dict[str, Any] = {
            name: AngleSum({name: 1}) if unit else symbol(name) for name, (_, unit) in own.parameters.items()
        }
        self.relations = Relations(own, self.proof["relations"])
        self.relations.held_by_numbers()
        free, parameters = parameters, self.relations.among(parameters, numbers)
        lengths, angles = given_names(own, self.name)
        given: dict[str, Any] = {name: symbol(name) for name in lengths}
        for name in angles:
            cosine, sine = symbol(f"cos_{name}"), symbol(f"sin_{name}")
            numbers.squares[f"sin_{name}"] = 1 - cosine * cosine
            given |= {f"cos_{name}": cosine, f"sin_{name}": sine}
        if has_quaternion(own, self.name):
            w, x, y, z = map(symbol, QUATERNION)
            numbers.squares[QUATERNION[-1]] = 1 - w * w - x * x - y * y
            given |= zip(QUATERNION, (w, x, y, z), strict=True)
        super().__init__(numbers, {**parameters, **given}, own.positive)
        self.unstated = self.relations.unstated(free, numbers, self.zero)
        self.conditions: list[str] = []
        self.circles: set[str] = set()
        claims = self.proof["orientations"]
        self.assembly = FileAssembly(own, self.name, numbers, parameters, given, self.zero, claims)
        self.orientations = OrientationCheck(self.assembly, self, self.proof)
        graph = self.assembly.graph
        axes = [part for joint in graph.joints.values() for axis in (*joint.axes, *joint.turn) for part in axis]
        self.allowed += divisors(part for part in axes if isinstance(part, Term))  # a direction has a length

    def findings(self) -> ProvedProblem:
        """What is proved."""
        self._named()
        turns = self.orientations.turns()
        self._unknowns(turns)
        self._loops(turns)
        require(len(self.problem["sets"]) == len(self.proof["sets"]), "sets without identities")
        for given, proved in zip(self.problem["sets"], self.proof["sets"], strict=True):
            self._set(given, proved)
        self._lengths()
        self._results(turns)
        missing = self.unknowns - self.earlier.keys() - self.circles
        require(not missing, f"nothing says what {', '.join(sorted(missing))} is")
        count = math.prod(own["roots"] for own in self.problem["sets"])
        require(self.problem["branches"] == count, f"not as many branches follow of the roots as claimed, but {count}")
        checked = closing_branches(self.mechanism, self.problem, self.conditions)
        assumed = tuple(own.name for own in self.mechanism.parallelograms)
        return ProvedProblem(
            self.name, count, tuple(self.conditions), assumed, tuple(self.orientations.ways), checked,
            self.relations.texts, self.unstated,
        )  # fmt: skip

    def _named(self) -> None:
        """Formulas of what is given, by names."""
        for name, text in self.proof["named"].items():
            require(name not in self.known, f"{name} has two formulas")
            self.names[name] = self.checked(text)
            self.known[name] = symbol(name)

    # unknowns and loops

    def _unknowns(self, turns: Mapping[str, ClaimedTurn]) -> None:
        """Unknowns of orientations with their squares, lengths that are sought, and components of vectors of these."""
        circles = {group for own in turns.values() for group in (own.circle, own.second) if group}
        self.turning = circles
        own_ones = dict.fromkeys((*circles, *(own.rod for own in turns.values() if own.rod)), term(1))
        for own in turns.values():
            if own.triangle is not None:
                own_ones |= zip(
                    own.triangle.sides, (term(dot(side, side)) for side in own.triangle.vectors), strict=True
                )
        sliding = dict(self.proof["sliding"])
        names = [name for group in own_ones for name in group] + [*sliding.values()]
        require(len({*names}) == len(names) and not {*names} & self.known.keys(), "two unknowns of one name")
        if sorted(sliding) != sorted(set(self.assembly.slides())):
            raise RefusedError(f"lengths that slide are {', '.join(self.assembly.slides())}")
        self.known |= {name: symbol(name) for name in names}
        self.units: dict[str, Term] = {}
        self.squares: dict[str, Term] = {}
        for group, square in own_ones.items():
            total = sum((self.known[name] * self.known[name] for name in group), -square)
            for label, text in self.proof["units"].items():
                if self.quotients([gap := self.read(text) - total], {}).zero(gap):
                    self.units[label] = total
                    self.squares[group[-1]] = self.known[group[-1]] * self.known[group[-1]] - total
        require(self.units.keys() == self.proof["units"].keys(), "a square that is no link's")
        sought = {name for text in self.proof["loops"].values() for name in re.findall(r"[A-Za-z_][\w']*", text)}
        self.unknowns = {*names} & sought
        self.sliding = {name: self.known[own] for name, own in sliding.items()}
        for name, text in self.proof["vectors"].items():
            require(name not in self.known, f"two unknowns of the name {name}")
            self.values[name] = self.read(text)
        self.known |= {name: symbol(name) for name in self.values}
        self.unknowns |= self.values.keys()

    def _loops(self, turns: Mapping[str, ClaimedTurn]) -> None:
        """The loop equations are those of the file."""
        gaps, self.platform = self.assembly.loops(turns, self.known, self.sliding)
        rows = [own for own in gaps if not self.zero(own)]
        self.loops = {name: term(self.read(text)) for name, text in self.proof["loops"].items()}
        axes = self.proof["axes"]
        for name, claim in axes.items():
            shared = self.orientations.shared(self.loops[name], claim, turns)
            require(shared, f"{name} is not that of an axis which links of {claim['joint']} share")
        loops = {name: own for name, own in self.loops.items() if name not in axes}
        require(len(rows) == len(loops), f"{len(loops)} loop equations, and the mechanism file has {len(rows)}")
        for row, (name, own) in zip(rows, loops.items(), strict=True):
            require(self.zero(row - own), f"{name} is not the mechanism's: another mechanism or version")

    # sets

    def _set(self, given: Mapping[str, Any], proved: Mapping[str, Any]) -> None:
        unknowns = {name for group in given["unknowns"] for name in group}
        polynomial = proved.get("polynomial")
        if polynomial is not None:
            unknowns -= self._known_circle(polynomial["circle"])
        # formulas may use what stands before them alone; so of what is solved later nothing is known
        later = self.unknowns - self.earlier.keys() - self.circles
        everything = dict(self.known)
        choices = {own["root"]: own for own in given["choices"]}
        formulas = self._formulas(given, choices, later)
        self._conditions(given["conditions"], formulas, choices)
        self.known = everything | {name: symbol(name) for name in formulas}
        quantities = {root: term(self.read(own["quantity"])) for root, own in choices.items()}
        self.values |= quantities
        equations = {f"e{k}": self._side(text) for k, text in enumerate(given["equations"], start=1)}
        lines = {f"l{k}": self._side(text) for k, text in enumerate(given["lines"], start=1)}
        self._follow(equations, proved["equations"], self.loops)
        self._follow(lines, proved["lines"], equations | self.units)
        equations |= lines | self.units
        degree = 1 if polynomial is None else self._polynomial(polynomial, formulas, equations)
        for name, own in formulas.items():
            if name in choices or name in later:
                claim = symbol(name) * (symbol(name) if name in choices else 1) - own
                gap = claim - self.total(proved["formulas"][name], equations)
                require(self.zero(gap), f"{name} does not follow: {given['formulas'][name][:60]}")
        require(unknowns <= formulas.keys(), f"nothing says what {', '.join(sorted(unknowns - formulas.keys()))} is")
        for root in choices:
            del self.values[root]
        self.earlier |= {name: own for name, own in formulas.items() if name in later}
        self.numbers.squares |= {name: own for name, own in self.squares.items() if name in formulas}
        require(given["roots"] == degree * 2 ** len(choices), f"{given['roots']} roots are claimed, others follow")
        for name in self.earlier.keys() & self.proof["vectors"].keys():
            self.values.pop(name, None)

    def _known_circle(self, circle: Sequence[str]) -> set[str]:
        """Cosine and sine of which a polynomial is one are taken as known, as are their squares."""
        names = tuple(map(str, circle))
        if names not in self.turning or self.circles or {*names} & self.earlier.keys():
            raise RefusedError(f"a polynomial in {', '.join(names)[:60]}, which are no angle's that is left")
        self.circles |= {*names}
        self.numbers.squares[names[1]] = self.squares[names[1]]
        return {*names}

    def _polynomial(self, own: Mapping[str, Any], formulas: Mapping[str, Term], equations: dict[str, Term]) -> int:
        """How many roots it has at most: it vanishes, by multiples of equations; a quadric `q` is then one of them."""
        if own["quadric"]:
            quadric = self._side(own["quadric"])
            self._follow({"q": quadric}, [own["given"]], equations)
            equations["q"] = quadric
        vanishing = formulas[own["vanishes"]]
        require(self.zero(vanishing - self.total(own["shares"], equations)), f"{own['vanishes']} does not vanish")
        cosine, sine = own["circle"]
        for level in (self.turning_names({cosine, sine}), *self.levels()):
            degree = 2 * self.quotients([vanishing], level).degree(vanishing, cosine, sine)
            if degree == own["degree"]:
                return degree
        raise RefusedError(f"{own['vanishes']} is of degree {degree}, not {own['degree']}")

    def _formulas(self, given: Mapping[str, Any], choices: Mapping[str, Any], later: set[str]) -> dict[str, Term]:
        """Formulas in their order, each of what stands before it; of a root its radicand."""
        self.known = {name: own for name, own in self.known.items() if name not in later}
        formulas: dict[str, Term] = {}
        for name, text in given["formulas"].items():
            if self.proof["named"].get(name) == text:
                continue
            require(name not in self.known, f"{name} has two formulas")
            own = choices[name]["radicand"] if name in choices else text
            require(name not in choices or text == f"sqrt({own})", f"{name} is no root of its radicand")
            formulas[name] = term(self.read(own))
            self.known[name] = symbol(name)
        require(choices.keys() <= formulas.keys(), "choices without a root")
        return formulas

    def _conditions(self, texts: Sequence[str], formulas: Mapping[str, Term], choices: Mapping[str, Any]) -> None:
        """Conditions are formulas of what is known with the set; then what formulas are divided by is looked at."""
        known = formulas.keys() - self.unknowns - choices.keys()
        self.names |= {name: own for name, own in formulas.items() if name in known}
        self.numbers.squares |= {root: formulas[root] for root in choices}
        self._allow(texts)
        for name, own in formulas.items():
            self.divided(own, f"the formula of {name}")

    def _allow(self, texts: Sequence[str]) -> None:
        self.conditions += texts
        self.allowed += (self._side(text, " != 0") for text in texts)

    def _side(self, text: str, end: str = " = 0") -> Term:
        """What an equation says is zero, or a condition that it is not."""
        require(text.endswith(end), f"{text[:60]!r} does not end in{end}")
        return term(self.read(text.removesuffix(end)))

    def _follow(self, equations: Mapping[str, Term], shares: Sequence[Multiples], known: Mapping[str, Term]) -> None:
        """Each equation is a sum of multiples of what is known to vanish."""
        for (name, own), multiples in zip(equations.items(), shares, strict=True):
            require(self.zero(own - self.total(multiples, known)), f"{name} does not follow of {', '.join(multiples)}")

    def _lengths(self) -> None:
        """Lengths after the sets: loops are in lengths that slide and in circles, formulas in vectors of both."""
        self.values |= {name: term(self.read(text)) for name, text in self.proof["vectors"].items()}
        self._allow(self.problem.get("conditions", ()))
        for name, text in self.problem["lengths"].items():
            own = self.checked(text)
            shares = self.proof["lengths"][name]
            level = dict(self.earlier)
            self.earlier = {}
            gap = symbol(name) - own - self.total(shares, self.loops)
            require(self.zero(gap), f"{name} does not follow: {text[:60]}")
            self.earlier = level | {name: own}

    def _results(self, turns: Mapping[str, ClaimedTurn]) -> None:
        """Lengths of the inverse problem; of the direct one the platform's point, and entries of its rotation."""
        results = self.problem["results"]
        if self.name == "inverse":
            require(dict(results) == dict(self.problem["lengths"]), "results that are not the lengths")
            return
        for name in {**dict.fromkeys(LENGTHS), **results}:
            own = self.platform[LENGTHS.index(name)] if name in LENGTHS else None
            if own is None:
                require(re.fullmatch("R[123][123]", name), f"no result is called {name[:40]!r}")
                row, column = int(name[1]) - 1, int(name[2]) - 1
                own = turns[self.mechanism.platform].image(ONE[column], self.known, self.zero)[row]
            require(self.zero(term(own) - self.checked(results[name])), f"the platform's {name} is another")
