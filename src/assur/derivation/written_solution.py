"""A solution as a paper writes it: reasons, then set by set what is unknown, equations, elimination, result."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

import sympy

from assur.derivation.elimination import Root, SolvedSet
from assur.derivation.formula_latex import width
from assur.derivation.letters_of_names import input_letter, joint_letter
from assur.derivation.linear import never_zero
from assur.derivation.phrases import listed, words
from assur.derivation.platform_rotation import posed_entries
from assur.derivation.reach_meanings import ReachMeanings
from assur.derivation.rod_vectors import rod_vectors
from assur.derivation.written_equations import SetSteps
from assur.derivation.written_parts import Block, FlowNode, WrittenFormula, WrittenPart
from assur.derivation.written_polynomial import WrittenPolynomial
from assur.model.pose import ANGLES

NOT_ZERO = r"\ne 0$"
ENTRIES = {
    "R11": r"\cos\theta \cos\varphi", "R21": r"\cos\theta \sin\varphi", "R31": r"-\sin\theta",
    "R32": r"\cos\theta \sin\psi", "R33": r"\cos\theta \cos\psi",
}  # fmt: skip
"""What entries of the platform's rotation are in the angles of its pose."""


class WrittenSolution(WrittenPolynomial):
    """Writes one problem: reasons, sets in their order, result."""

    def reasons(self) -> tuple[str, ...]:
        """Why links do not turn: axes and chains, one sentence each."""
        return tuple(self._reasons())

    def parts(self) -> tuple[WrittenPart, ...]:
        """The sets in their order, then the result."""
        own = [self._set(number, part) for number, part in enumerate(self.solution.sets, start=1)]
        return (*own, self._result())

    def _reasons(self) -> Iterator[str]:
        for reason in self.solution.placed.reasons:
            ways = (
                f"axes along {self.axis(axis)} ({', '.join(f'${joint_letter(joint)}$' for joint in joints)})"
                for axis, joints in ((reason.first, reason.first_joints), (reason.second, reason.second_joints))
            )
            first, second = ways
            link, carrier = words(reason.link), words(reason.carrier)
            yield f"{link} hangs on {carrier} by {first} and by {second}; so it does not turn against it."

    def _set(self, number: int, part: SolvedSet) -> WrittenPart:
        links = listed([*dict.fromkeys(words(own.links[0]) for own in part.directions)])
        return WrittenPart(f"Set {number}: {links}", tuple(self._blocks(part)))

    def _blocks(self, part: SolvedSet) -> Iterator[Block]:
        joints = ", ".join(f"${joint_letter(joint)}$" for joint in self.joints(part))
        unknown = listed([f"${self.printed.angle(own)}$" for own in part.directions])
        yield f"The chain of {joints}. Unknown: {unknown}. {self._given_by(part)}"
        yield tuple(self._equation(form) for form in part.equations)
        steps = SetSteps(part)
        if steps.known:
            yield "where"
            yield tuple(self.line(own.symbol, own.formula) for own in steps.known)
        yield from self._elimination(part, steps)
        yield from self._choice(part)

    def _given_by(self, part: SolvedSet) -> str:
        """What the equations of a set say."""
        if part.directions[0] not in self.solution.loops.cranks:
            return "The loop equations in which nothing else is unknown are"
        return "The rod that hangs there by a hinge stands at the same angle to its axis all the time, so that"

    def joints(self, part: SolvedSet) -> list[str]:
        """Joints of the links that a set solves for, the parts of a parallelogram as one."""
        record = self.solution.symbols.record
        links = {link for own in part.directions for link in own.links}
        whole = {joint: name for name, group in record.generalised.items() for joint in group.joints}
        names = [name for name, joint in record.joints.items() if {joint.parent, joint.child} & links]
        return list(dict.fromkeys(whole.get(name, name) for name in names))

    def _elimination(self, part: SolvedSet, steps: SetSteps) -> Iterator[Block]:
        if part.eliminant is not None:
            yield from self._polynomial(part, part.eliminant, steps)
            return
        if any(own.kind == "stroke" for own in part.directions):
            left_out = {own.symbol for own in steps.known} | {root.symbol for root in part.roots}
            said = {self._equation(form).latex for form in part.equations}
            lines = [self.line(own.symbol, own.formula) for own in part.definitions if own.symbol not in left_out]
            yield "and so"
            yield tuple(own for own in lines if own.latex not in said)
            return
        base, others = part.directions[0], part.directions[1:]
        vectors = rod_vectors(part)
        if part.lines:
            left = listed([f"${self.printed.angle(own)}$" for own in others])
            yield f"These are solved for {left}. {self._quadrics(others)}, ${self.printed.angle(base)}$ satisfies"
            if vectors is None:
                yield tuple(self._named_equation(form, steps) for form in part.lines)
            else:
                yield tuple(self._planes(vectors))
        if vectors is not None:
            yield "where"
            yield tuple(self._of_vectors(vectors, steps))
            yield "and so"
            yield (self._direction(vectors),)
        else:
            if steps.named:
                yield "where" if part.lines else "with"
                yield tuple(self.line(own.symbol, own.formula) for own in steps.named)
            yield "and so"
            said = {self._equation(form).latex for form in part.equations}
            lines = [self.line(own.symbol, own.formula) for own in steps.of((*base.unknowns, *steps.late))]
            yield tuple(own for own in lines if own.latex not in said)
        rest = [own for other in others for own in steps.of(other.unknowns)]
        if rest:
            yield "Back in the loop equations,"
            yield tuple(self.line(own.symbol, own.formula) for own in rest)

    @cached_property
    def flow(self) -> tuple[FlowNode, ...]:
        """What each set takes of what is given and of sets before it, what it gives; the result last."""
        owner = {symbol: k for k, part in enumerate(self.solution.sets) for own in part.directions
                 for symbol in own.unknowns}  # fmt: skip
        nodes = []
        for k, part in enumerate(self.solution.sets):
            given, before = self._sources([form for line in part.equations for form in line.values()], owner, {k})
            found = ", ".join(self.printed.angle(own) for own in part.directions)
            nodes.append(FlowNode(f"Set {k + 1}", found, given, before))
        rows = self._result().blocks[0]
        if not isinstance(rows, str):
            direct = self.solution.symbols.problem == "direct"
            ahead = [*self.solution.point] if direct else [own.formula for own in self.solution.lengths]
            given, before = self._sources(ahead, owner, set())
            nodes.append(FlowNode("", ", ".join(row.left for row in rows), given, before))
        return tuple(nodes)

    def _sources(
        self, ahead: Sequence[sympy.Expr], owner: Mapping[sympy.Symbol, int], inside: set[int]
    ) -> tuple[tuple[str, ...], tuple[int, ...]]:
        """Letters that are given and places of sets, of which formulas are worked out."""
        formulas = {own.symbol: own.formula for own in self.solution.definitions}
        dimensions = {*self.solution.symbols.parameters.values()}
        left, given, before = [*ahead], dict[str, None](), set[int]()
        while left:
            for symbol in sorted(sympy.sympify(left.pop(0)).free_symbols - dimensions, key=str):
                if symbol in owner:
                    before |= {owner[symbol]} - inside
                elif symbol in formulas:
                    left.append(formulas[symbol])
                else:
                    given[self.writer.letters[symbol].latex] = None
        order = [self.writer.letters[symbol].latex for symbol in self.solution.symbols.given]
        return tuple(own for own in dict.fromkeys(order) if own in given), tuple(sorted(before))

    def _choice(self, part: SolvedSet) -> Iterator[Block]:
        for root in part.roots:
            sign = self.printed.signs[root.symbol][0]
            radicand = self.writer.text(root.radicand)
            meaning = self.phrase(self._reach.radicands[root.radicand])
            real = f"Branches are real where ${radicand} \\ge 0$; where ${radicand} < 0$, {meaning}."
            if any(own.symbol == root.radicand and own.formula.is_Symbol for own in part.definitions):
                real = f"Every branch is real, as ${radicand}$ is a sum of squares."
            yield f"${sign} = \\pm 1$: {self._said(root)}. {real}"
        told: dict[str, list[str]] = {}
        for own in part.conditions:
            if not never_zero(own):
                free = self._free(part) if own in part.shared else ""
                same = told.setdefault(self.phrase(self._reach.condition(part, own)) + free, [])
                same += [text for text in [self._condition(own)] if text not in same]
        if told:
            texts = listed([rf"${text} {NOT_ZERO}" for same in told.values() for text in same])
            fails = "; ".join(
                f"where {listed([f'${text} = 0$' for text in same], 'or')}, {meaning}" for meaning, same in told.items()
            )
            yield f"The formulas hold where {texts}: {fails}."

    def _free(self, part: SolvedSet) -> str:
        """What follows where all of the one line vanishes: the platform moves on a curve."""
        if self.solution.symbols.problem == "inverse" or len(part.lines) > 1 or part.directions[0].kind != "circle":
            return ""
        angle = self.printed.angle(part.directions[0])
        return (
            f", so that ${angle}$ may have any value and the platform moves on a curve while every input stands, "
            "by the equations of the sets that follow"
        )

    @cached_property
    def _reach(self) -> ReachMeanings:
        return ReachMeanings(self.solution)

    def _said(self, root: Root) -> str:
        meaning = self.meanings.get(root.symbol, "")
        if r"\theta_{" in meaning:
            meaning += r", $\theta_{J}$ the angle of joint $J$"
        return f"$+$ where {meaning}" if meaning else f"the sign of ${self.writer.text(root.quantity)}$"

    def _result(self) -> WrittenPart:
        direct = self.solution.symbols.problem == "direct"
        rows = tuple(self._pose() if direct else self._inputs())
        blocks: tuple[Block, ...] = (rows,) if rows else (self._solved(),)
        if conditions := [rf"${self._condition(own)} {NOT_ZERO}" for own in self.solution.length_conditions]:
            blocks += (f"These hold where {listed(conditions)}.",)
        return WrittenPart("The pose" if direct else "The inputs", blocks)

    def _pose(self) -> Iterator[WrittenFormula]:
        yield from (self.line(own.symbol, own.formula) for own in self.solution.lengths)
        for name, formula in zip("xyz", self.solution.point, strict=True):
            if name in self.solution.symbols.record.platform.pose:
                yield self.line(sympy.Symbol(name, real=True), formula)
        for name, formula in posed_entries(self.solution):
            left = ENTRIES[name] if {*ANGLES} & {*self.solution.symbols.record.platform.pose} else f"R_{{{name[1:]}}}"
            yield WrittenFormula(left, self.writer.rows(sympy.factor_terms(formula), width(left) + 2))

    def _inputs(self) -> Iterator[WrittenFormula]:
        formulas = {own.symbol: own.formula for own in self.solution.lengths}
        record = self.solution.symbols.record
        lengths = self.solution.loops.lengths
        driven = {lengths[own.coordinate.index]: own for own in record.inputs if own.coordinate.index in lengths}
        for symbol, formula in formulas.items():
            if symbol in driven:
                own = driven[symbol]
                symbol = sympy.Symbol(own.name, real=True)
                formula = int(own.sign) * formula + sympy.nsimplify(own.offset, rational=True)
            yield self.line(symbol, formula)

    def _solved(self) -> str:
        letters = listed([f"${input_letter(driven)}$" for driven in self.solution.symbols.record.inputs])
        return f"The inputs are {letters}, found above."
