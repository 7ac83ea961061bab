"""A derivation checked: its loop equations are those of the mechanism file, and each step is an identity.

Every solution of the loop equations has the values that the formulas give, since each unknown less its formula is a
sum of multiples of the loop equations, whose multipliers are divided by nothing that may vanish where the conditions
hold. Every choice of roots is a solution, since its values close the file's joint graph, modulo a prime that is drawn.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from assur.verifier.derivations.assembly import FileAssembly, given_names
from assur.verifier.derivations.branches import closing_branches
from assur.verifier.derivations.terms import Quotients, Term, WrittenNumbers, divisors, symbol, term
from assur.verifier.derivations.turning import ClaimedTurn, Hop, fixes, is_rotation, point, reached, rods, same
from assur.verifier.formula import AngleSum, plain, value
from assur.verifier.mechanism import FileMechanism, mechanism
from assur.verifier.reading import MalformedError, RefusedError, printable
from assur.verifier.vectors import ONE, Matrix, Vector, apply, cross, dot, plus, product, subtract, transposed

FORMAT, VERSION = "assur derivation", 1
LONGEST = 1_000_000
"""Letters of a formula."""
Multiples = Mapping[str, str]


@dataclass(frozen=True)
class ProvedProblem:
    """What is proved of a problem: these branches, and no others where the conditions hold.

    Attributes:
        problem: "direct" or "inverse".
        branches: how many.
        conditions: what must not vanish, as written.
        assumed: parallelograms of the file that are taken to stay such.
        closed: branches that were held against the joint graph.
    """

    problem: str
    branches: int
    conditions: tuple[str, ...]
    assumed: tuple[str, ...]
    closed: int


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


class _ProblemCheck:
    def __init__(self, own: FileMechanism, problem: Mapping[str, Any]) -> None:
        self.mechanism, self.problem = own, problem
        self.proof, self.name = problem["proof"], str(problem["problem"])
        if self.name not in ("direct", "inverse"):
            raise MalformedError(f"no such problem: {self.name[:40]!r}")
        self.numbers = WrittenNumbers()
        self.parameters: dict[str, Any] = {
            name: AngleSum({name: 1}) if unit else symbol(name) for name, (_, unit) in own.parameters.items()
        }
        lengths, angles = given_names(own, self.name)
        self.given: dict[str, Any] = {name: symbol(name) for name in lengths}
        for name in angles:
            cosine, sine = symbol(f"cos_{name}"), symbol(f"sin_{name}")
            self.numbers.squares[f"sin_{name}"] = 1 - cosine * cosine
            self.given |= {f"cos_{name}": cosine, f"sin_{name}": sine}
        self.known: dict[str, Any] = {**self.parameters, **self.given}
        self.values: dict[str, Term] = {}
        self.names: dict[str, Term] = {}
        self.earlier: dict[str, Term] = {}
        self.conditions: list[str] = []
        self.allowed: list[Term] = []
        self.assembly = FileAssembly(own, self.name, self.numbers, self.parameters, self.given, self.zero)
        graph = self.assembly.graph
        axes = [part for joint in graph.joints.values() for axis in (*joint.axes, *joint.turn) for part in axis]
        self.allowed += divisors(part for part in axes if isinstance(part, Term))  # a direction has a length

    def findings(self) -> ProvedProblem:
        """What is proved."""
        turns = self._turns()
        self._unknowns(turns)
        self._loops(turns)
        if len(self.problem["sets"]) != len(self.proof["sets"]):
            raise RefusedError("sets without identities")
        for given, proved in zip(self.problem["sets"], self.proof["sets"], strict=True):
            self._set(given, proved)
        self._lengths()
        missing = self.unknowns - self.earlier.keys()
        if missing:
            raise RefusedError(f"nothing says what {', '.join(sorted(missing))} is")
        roots = [choice["root"] for own in self.problem["sets"] for choice in own["choices"]]
        count = 2 ** len(roots)
        if self.problem["branches"] != count:
            raise RefusedError(f"{self.problem['branches']} branches are claimed, {count} follow of the roots")
        checked = closing_branches(self.mechanism, self.problem, self.conditions)
        assumed = tuple(own.name for own in self.mechanism.parallelograms)
        return ProvedProblem(self.name, count, tuple(self.conditions), assumed, checked)

    # formulas and identities

    def read(self, text: Any) -> Any:
        """A formula of what is known so far; what it is divided by must not vanish."""
        try:
            own = value(text, self.known, self.numbers, LONGEST)
        except KeyError as error:
            raise RefusedError(f"{error} is not known where {str(text)[:60]!r} needs it") from error
        return plain(own, self.numbers)

    def checked(self, text: Any) -> Term:
        """The same, where what it is divided by is looked at."""
        own = term(self.read(text))
        for divisor in divisors([own]):
            if not self._nonzero(divisor):
                raise RefusedError(f"{str(text)[:80]!r} is divided by what may vanish")
        return own

    def zero(self, own: Any) -> bool:
        """Whether a number vanishes, by known squares, then by what names stand for, then by what is solved."""
        if not isinstance(own, Term):
            return bool(own == 0)
        return any(self._quotients([own], level).zero(own) for level in self._levels())

    def _levels(self) -> Iterator[dict[str, Term]]:
        yield self.values
        if self.names:
            yield {**self.names, **self.values}
        if self.earlier:
            yield {**self.names, **self.values, **self.earlier}

    def _quotients(self, terms: Iterable[Term], level: Mapping[str, Term]) -> Quotients:
        return Quotients(terms, self.numbers.squares, level)

    def _nonzero(self, own: Term) -> bool:
        for level in self._levels():
            field = self._quotients([own, *self.allowed], level)
            positive = self.mechanism.positive | {
                name for name in field.names if name.startswith("sqrt(") and "-" not in name
            }
            if field.never_zero(own, self.allowed, positive):
                return True
        return False

    def _sum(self, shares: Multiples, equations: Mapping[str, Term]) -> Term:
        total = term(0)
        for name, share in shares.items():
            total = total + self.checked(share) * equations[name]
        return total

    # orientations

    def _vector(self, parts: Any) -> Vector:
        x, y, z = (_plain(self.read(part)) for part in parts)
        return x, y, z

    def _matrix(self, rows: Any) -> Matrix:
        a, b, c = map(self._vector, rows)
        return a, b, c

    def _tidy(self, turn: Matrix) -> Matrix:
        """0, 1 and -1 where an entry is that."""

        def entry(own: Any) -> Any:
            if not isinstance(own, Term):
                return own
            constant = self._quotients([own], {}).constant(own)
            return int(constant) if constant in (0, 1, -1) else own

        a, b, c = (tuple(map(entry, row)) for row in turn)
        return a, b, c

    def _reached(self, root: str, axis: Vector | None) -> dict[str, Matrix]:
        return reached(self.assembly.hops, root, axis, self.zero, self._tidy)

    def _turns(self) -> dict[str, ClaimedTurn]:
        """Orientations as they are claimed, each held against what the joints say."""
        for reason in self.proof["reasons"]:
            self._reason(reason)
        turns: dict[str, ClaimedTurn] = {}
        for own in self.proof["orientations"]:
            axis, hinge, line = (
                None if own[key] is None else self._vector(own[key]) for key in ("axis", "hinge", "line")
            )
            circle, rod = (None if own[key] is None else tuple(map(str, own[key])) for key in ("circle", "rod"))
            turn = ClaimedTurn(own["link"], own["kind"], self._matrix(own["constant"]), axis, circle, hinge, line, rod)
            turns[turn.link] = turn
        fixed = self._reached(self.mechanism.base, None)
        for turn in turns.values():
            if turn.kind == "fixed":
                fine = turn.link in fixed and same(fixed[turn.link], turn.constant, self.zero)
            elif turn.kind == "circle" and turn.axis is not None:
                fine = self._on_circle(turn, turn.axis, turns)
            else:
                fine = turn.kind == "rod" and turn.rod is not None and self._on_rod(turn, turns)
            if not fine:
                raise RefusedError(f"the joints do not say that {turn.link} is turned so")
        return turns

    def _reason(self, reason: Mapping[str, Any]) -> None:
        """A link that hangs on another along two directions does not turn against it."""
        carrier, link, constant = str(reason["carrier"]), str(reason["link"]), self._matrix(reason["constant"])
        axes = self._vector(reason["first"]), self._vector(reason["second"])
        across = [self.zero(part) for part in cross(*axes)]
        fine = not all(across) and is_rotation(constant, self.zero)
        for axis in axes:
            own = self._reached(carrier, axis).get(link)
            fine = fine and own is not None and fixes(product(constant, transposed(own)), axis, self.zero)
        if not fine:
            raise RefusedError(f"the joints do not say that {link} does not turn against {carrier}")
        self.assembly.hops.append(Hop(carrier, link, constant))

    def _on_circle(self, turn: ClaimedTurn, axis: Vector, turns: Mapping[str, ClaimedTurn]) -> bool:
        """It turns about the axis alone, as far as the first link does that has the same unknowns."""
        own = self._reached(self.mechanism.base, axis).get(turn.link)
        if own is None or not self.zero(plus(dot(axis, axis), -1)):
            return False
        psi = product(turn.constant, transposed(own))
        leader = next(o for o in turns.values() if o.circle == turn.circle and o.kind == "circle")
        if turn.circle is None or leader is turn:
            return is_rotation(psi, self.zero) and fixes(psi, axis, self.zero)
        between = self._reached(leader.link, None).get(turn.link)
        alike = leader.axis is not None and all(map(self.zero, subtract(axis, leader.axis)))
        return alike and between is not None and same(product(leader.constant, between), turn.constant, self.zero)

    def _on_rod(self, turn: ClaimedTurn, turns: Mapping[str, ClaimedTurn]) -> bool:
        """A link between two balls, or one on a hinge across the axis about which its carrier turns."""
        line, hinge, graph = turn.line, turn.hinge, self.assembly.graph
        if line is None or not self.zero(plus(dot(line, line), -1)):
            return False
        leader = next(own for own in turns.values() if own.rod == turn.rod)
        parallel = any(
            {leader.link, turn.link} == {*rods(self.mechanism, own)} for own in self.mechanism.parallelograms
        )
        if hinge is None:
            joints = [name for name, own in self.mechanism.joints.items() if turn.link in (own.parent, own.child)]
            balls = all(self.mechanism.joints[name].type == "spherical" for name in joints)
            near, far = (point(graph, name, turn.link) for name in joints)
            straight = all(map(self.zero, cross(line, subtract(far, near))))
            return balls and straight and (leader is turn or parallel) and same(turn.constant, ONE, self.zero)
        axis = turn.axis
        if axis is None or not all(self.zero(dot(*pair)) for pair in ((hinge, axis), (hinge, line))):
            return False
        if leader is not turn:
            between = self._reached(leader.link, None).get(turn.link)
            return between is not None and same(product(leader.constant, between), turn.constant, self.zero)
        return any(self._carries(own, turn, axis, hinge) for own in self.assembly.hops)

    def _carries(self, hop: Hop, turn: ClaimedTurn, axis: Vector, hinge: Vector) -> bool:
        """Whether a hop is the hinge of a rod: Rot(axis, psi) Rot(hinge, phi) constant is its orientation."""
        inside = self._reached(turn.link, None)
        for start, end, forward in ((hop.start, hop.end, True), (hop.end, hop.start, False)):
            carried = self._reached(self.mechanism.base, axis).get(start)
            if hop.axis is None or end not in inside or carried is None:
                continue
            after = hop.after if forward else transposed(hop.after)
            along = hop.axis if forward else apply(transposed(hop.after), hop.axis)
            whole = product(product(carried, after), transposed(inside[end]))
            own = apply(carried, along)
            # the carrier's psi may count from elsewhere: then the hinge tells from where
            turned = product(turn.constant, transposed(whole))
            if (
                all(map(self.zero, cross(own, hinge)))
                and fixes(turned, hinge, self.zero)
                and is_rotation(turned, self.zero)
            ):
                return True
        return False

    # unknowns and loops

    def _unknowns(self, turns: Mapping[str, ClaimedTurn]) -> None:
        """Unknowns of orientations with their squares, lengths that are sought, and components of vectors of these."""
        circles = {own.circle for own in turns.values() if own.circle}
        own_ones = [*circles, *{own.rod for own in turns.values() if own.rod}]
        sliding = dict(self.proof["sliding"])
        names = [name for group in own_ones for name in group] + [*sliding.values()]
        if len({*names}) != len(names) or {*names} & self.known.keys():
            raise RefusedError("two unknowns of one name")
        if sorted(sliding) != sorted(set(self.assembly.slides())):
            raise RefusedError(f"lengths that slide are {', '.join(self.assembly.slides())}")
        self.known |= {name: symbol(name) for name in names}
        self.units: dict[str, Term] = {}
        self.squares: dict[str, Term] = {}
        for group in own_ones:
            total = sum((self.known[name] * self.known[name] for name in group), term(-1))
            for label, text in self.proof["units"].items():
                if self._quotients([gap := self.read(text) - total], {}).zero(gap):
                    self.units[label] = total
                    self.squares[group[-1]] = self.known[group[-1]] * self.known[group[-1]] - total
        if self.units.keys() != self.proof["units"].keys():
            raise RefusedError("a square that is no link's")
        self.unknowns = {
            name for name in names if any(name in _symbols_of(text) for text in self.proof["loops"].values())
        }
        self.sliding = {name: self.known[own] for name, own in sliding.items()}
        for name, text in self.proof["vectors"].items():
            if name in self.known:
                raise RefusedError(f"two unknowns of the name {name}")
            self.values[name] = self.read(text)
        self.known |= {name: symbol(name) for name in self.values}
        self.unknowns |= self.values.keys()

    def _loops(self, turns: Mapping[str, ClaimedTurn]) -> None:
        """The loop equations are those of the file."""
        gaps, self.platform = self.assembly.loops(turns, self.known, self.sliding)
        rows = [own for own in gaps if not self.zero(own)]
        self.loops = {name: term(self.read(text)) for name, text in self.proof["loops"].items()}
        if len(rows) != len(self.loops):
            raise RefusedError(f"{len(self.loops)} loop equations, and the mechanism file has {len(rows)}")
        for row, (name, own) in zip(rows, self.loops.items(), strict=True):
            if not self.zero(row - own):
                raise RefusedError(f"{name} is not the mechanism's: another mechanism or version")

    # sets

    def _set(self, given: Mapping[str, Any], proved: Mapping[str, Any]) -> None:
        unknowns = {name for group in given["unknowns"] for name in group}
        # formulas may use what stands before them alone; so of what is solved later nothing is known
        later = self.unknowns - self.earlier.keys()
        everything = dict(self.known)
        choices = {own["root"]: own for own in given["choices"]}
        self._conditions(given["conditions"])
        formulas = self._formulas(given, choices, later)
        self._conditions_read(given, formulas)
        self.known = everything | {name: symbol(name) for name in formulas}
        quantities = {root: term(self.read(own["quantity"])) for root, own in choices.items()}
        self.values |= quantities
        self.names |= {name: own for name, own in formulas.items() if name not in later and name not in choices}
        equations = {f"e{k}": self._equation(text) for k, text in enumerate(given["equations"], start=1)}
        lines = {f"l{k}": self._equation(text) for k, text in enumerate(given["lines"], start=1)}
        self._follow(equations, proved["equations"], self.loops)
        self._follow(lines, proved["lines"], equations | self.units)
        equations |= lines | self.units
        for name, own in formulas.items():
            if name in choices:
                claim = symbol(name) * symbol(name) - own
            elif name in later:
                claim = symbol(name) - own
            else:
                continue
            if not self.zero(claim - self._sum(proved["formulas"][name], equations)):
                raise RefusedError(f"{name} does not follow: {given['formulas'][name][:60]}")
        if not unknowns <= formulas.keys():
            raise RefusedError(f"nothing says what {', '.join(sorted(unknowns - formulas.keys()))} is")
        for root in choices:
            del self.values[root]
            self.numbers.squares[root] = formulas[root]
        self.earlier |= {name: own for name, own in formulas.items() if name in later}
        self.numbers.squares |= {name: own for name, own in self.squares.items() if name in formulas}
        if given["roots"] != 2 ** len(choices):
            raise RefusedError(f"{given['roots']} roots are claimed, {2 ** len(choices)} follow of the choices")
        for name in self.earlier.keys() & self.proof["vectors"].keys():
            self.values.pop(name, None)

    def _formulas(self, given: Mapping[str, Any], choices: Mapping[str, Any], later: set[str]) -> dict[str, Term]:
        """Formulas in their order, each of what stands before it; of a root its radicand."""
        self.known = {name: own for name, own in self.known.items() if name not in later}
        formulas: dict[str, Term] = {}
        for name, text in given["formulas"].items():
            if name in self.known:
                raise RefusedError(f"{name} has two formulas")
            if name in choices:
                if text != f"sqrt({choices[name]['radicand']})":
                    raise RefusedError(f"{name} is no root of its radicand")
                formulas[name] = symbol(choices[name]["radicand"])
                if choices[name]["radicand"] not in self.known:
                    raise RefusedError(f"{name} is the root of what is not known")
            else:
                formulas[name] = term(self.read(text))
            self.known[name] = symbol(name)
        if not choices.keys() <= formulas.keys():
            raise RefusedError("choices without a root")
        return formulas

    def _conditions(self, texts: Sequence[str]) -> None:
        for text in texts:
            if not text.endswith(" != 0"):
                raise RefusedError(f"{text[:60]!r} is no condition")
            self.conditions.append(text)

    def _conditions_read(self, given: Mapping[str, Any], formulas: Mapping[str, Term]) -> None:
        """Conditions are formulas of what is known with the set; then what formulas are divided by is looked at."""
        self.names |= {
            name: own
            for name, own in formulas.items()
            if name not in self.unknowns and name not in {c["root"] for c in given["choices"]}
        }
        self.numbers.squares |= {own["root"]: formulas[own["root"]] for own in given["choices"]}
        self.allowed += [term(self.read(text.removesuffix(" != 0"))) for text in given["conditions"]]
        for name, own in formulas.items():
            for divisor in divisors([own]):
                if not self._nonzero(divisor):
                    raise RefusedError(f"the formula of {name} is divided by what may vanish")

    def _equation(self, text: str) -> Term:
        if not text.endswith(" = 0"):
            raise RefusedError(f"{text[:60]!r} is no equation")
        return term(self.read(text.removesuffix(" = 0")))

    def _follow(self, equations: Mapping[str, Term], shares: Sequence[Multiples], known: Mapping[str, Term]) -> None:
        """Each equation is a sum of multiples of what is known to vanish."""
        for (name, own), multiples in zip(equations.items(), shares, strict=True):
            if not self.zero(own - self._sum(multiples, known)):
                raise RefusedError(f"{name} does not follow of {', '.join(multiples)}")

    def _lengths(self) -> None:
        """Lengths after the sets, and of the direct problem the platform's point."""
        for name, text in self.problem["lengths"].items():
            own = self.checked(text)
            shares = self.proof["lengths"][name]
            level = dict(self.earlier)
            self.earlier = {}
            if not self.zero(symbol(name) - own - self._sum(shares, self.loops)):
                raise RefusedError(f"{name} does not follow: {text[:60]}")
            self.earlier = level | {name: own}
        if self.name == "direct":
            for name, reached_point in zip("xyz", self.platform, strict=True):
                if not self.zero(reached_point - self.checked(self.problem["results"][name])):
                    raise RefusedError(f"the platform's {name} is another")
        elif dict(self.problem["results"]) != dict(self.problem["lengths"]):
            raise RefusedError("results that are not the lengths")


def _plain(own: Any) -> Any:
    """0, 1 and -1 as integers."""
    if isinstance(own, Term) and own.kind == "number" and own.parts[0] in (0, 1, -1):
        return int(own.parts[0])
    return own


def _symbols_of(text: str) -> set[str]:
    return {*re.findall(r"[A-Za-z_][\w']*", text)}
