"""The closed form as a file: both problems, joints, velocity equations and what vanishes, as kernels that are read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import sympy

from assur.derivation.elimination import Definition, Root
from assur.derivation.joint_formulas import BallRotation, SolvedJoints, joint_formulas
from assur.derivation.kernel_text import KernelPrinter
from assur.derivation.orientations import NotDerivedError
from assur.derivation.sizes import Sizes
from assur.derivation.solution import AnalyticSolution
from assur.derivation.symbols import circle_of
from assur.derivation.velocities import VelocityEquations, velocity_equations
from assur.kinematics.modes import Problem
from assur.model.pose import ANGLES, LENGTHS
from assur.numerics.vectors import dot

CODE_HEAD = '''"""Closed form of {name}, derived from its joint graph: {sets}."""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Factor, Margin, Sign
{imports}
'''


@dataclass(frozen=True, eq=False)
class ClosedFormText:
    """Writes the closed form of a mechanism whose direct and inverse problems were solved.

    Attributes:
        direct, inverse: the solutions.
        signs: problem, symbol of a root -> the name of its sign, and whether it is that sign or its opposite.
    """

    direct: AnalyticSolution
    inverse: AnalyticSolution
    signs: Mapping[tuple[Problem, sympy.Symbol], tuple[str, int]]
    constraint_singular: tuple[tuple[str, ...], ...] = ()

    def text(self) -> str:
        """The file."""
        parts = [self._head(), self._problem("inverse"), self._problem("direct"), self._core(), self._joints(),
                 self._factors(), self._jacobians(), self._declaration()]  # fmt: skip
        return "\n\n".join(part.strip("\n") + "\n" for part in parts)

    @cached_property
    def printer(self) -> KernelPrinter:
        """Prints formulas."""
        return KernelPrinter(self.inverse.symbols.record.parameters)

    @cached_property
    def joints(self) -> SolvedJoints:
        """Formulas of all joints."""
        return joint_formulas(self.inverse)

    @cached_property
    def velocities(self) -> VelocityEquations:
        """Jp and Jq."""
        return velocity_equations(self.inverse)

    @cached_property
    def unknowns(self) -> list[sympy.Symbol]:
        """What the core is made of, beside the pose: unknowns of the inverse problem."""
        lengths = [*self.inverse.loops.lengths.values()]
        return lengths + [unknown for item in self.inverse.loops.items for unknown in item.unknowns]

    @cached_property
    def posed(self) -> list[sympy.Symbol]:
        """GivenSymbols of the pose."""
        names = self.inverse.symbols.record.platform.pose
        return [symbol for name in names for symbol in (circle_of(name) if name in ANGLES else (_real(name),))]

    def _head(self) -> str:
        record = self.inverse.symbols.record
        sets = "; ".join(" and ".join(item.name for item in part.items) for part in self.direct.sets)
        imports = []
        if self.joints.pointings:
            imports.append("from assur.numerics.legs import pointing")
        used = {"taking": bool(self.joints.tilts), "product": self._many, "transposed": self._turned}
        vectors = sorted(name for name, needed in used.items() if needed)
        if vectors:
            imports.append(f"from assur.numerics.vectors import {', '.join(vectors)}")
        return CODE_HEAD.format(name=record.name, sets=sets, imports="\n".join(imports))

    @cached_property
    def _balls(self) -> list[BallRotation]:
        return [value for value in self.joints.values.values() if isinstance(value, BallRotation)]

    @cached_property
    def _many(self) -> bool:
        return any(len(ball.parts) > 1 for ball in self._balls)

    @cached_property
    def _turned(self) -> bool:
        return any(turned for ball in self._balls for _, turned in ball.parts)

    def _problem(self, problem: Problem) -> str:
        solution = self.direct if problem == "direct" else self.inverse
        names = [self.signs[problem, root.symbol][0] for root in solution.roots]
        title = "Pose at given inputs" if problem == "direct" else "Inputs at a pose"
        given = "inputs" if problem == "direct" else "pose"
        lines = [f"def {problem}(ns, p, {given}, sign):"]
        lines.append(f'    """{title}. Signs: {", ".join(names) or "none"}."""')
        lines += self._given(problem)
        roots = {root.symbol: root for root in solution.roots}
        for own in solution.definitions:
            lines.append(self._line(problem, own, roots))
        lines += [f"    {symbol.name} = {self.printer.doprint(value)}" for symbol, value in self._rest(problem)]
        lines.append(f"    core = _core(ns, p, {', '.join(map(str, [*self.posed, *self.unknowns]))})")
        margins = ", ".join(f'"{name}": {self.printer.doprint(value)}' for name, value in self._margins(problem))
        pose, inputs = self._pair_text(self.posed_pairs), self._pair_text(self.input_pairs)
        lines.append(f"    margins = {{{margins}}}")
        lines.append(f"    return Branch({pose}, {inputs}, margins, core)")
        return "\n".join(lines)

    def _line(self, problem: Problem, own: Definition, roots: Mapping[sympy.Symbol, Root]) -> str:
        text = self.printer.doprint(own.formula)
        if own.symbol in roots:
            name, sense = self.signs[problem, own.symbol]
            text = f"{'-' if sense < 0 else ''}sign.{name} * {text}"
        return f"    {own.symbol.name} = {text}"

    def _given(self, problem: Problem) -> list[str]:
        pairs = self.posed_pairs if problem == "inverse" else self.printed_inputs
        left = self._pair_text(pairs, calls=False)
        return [f"    {left} = {'pose' if problem == 'inverse' else 'inputs'}"]

    @cached_property
    def posed_pairs(self) -> list[Any]:
        """Coordinates of the pose as a branch has them."""
        names = self.inverse.symbols.record.platform.pose
        return [circle_of(name) if name in ANGLES else _real(name) for name in names]

    @cached_property
    def printed_inputs(self) -> list[Any]:
        """GivenSymbols of the inputs of the direct problem."""
        record = self.direct.symbols.record
        return [
            circle_of(driven.name) if driven.coordinate.kind == "angle" else _real(driven.name)
            for driven in record.inputs
        ]

    @cached_property
    def input_pairs(self) -> list[Any]:
        """Inputs as formulas of the unknowns of the inverse problem."""
        own: list[Any] = []
        for driven in self.inverse.symbols.record.inputs:
            name = driven.coordinate.joint
            value: Any = self.joints.values.get(name, self.joints.values.get(f"{name}.{driven.coordinate.component}"))
            if driven.coordinate.kind == "angle":
                if driven.offset:
                    raise NotDerivedError(f"{driven.name} is an angle with an offset")
                cosine, sine = value
                own.append((cosine, int(driven.sign) * sine))
            else:
                own.append(value * int(driven.sign) + sympy.nsimplify(driven.offset, rational=True))
        return own

    def _rest(self, problem: Problem) -> Iterator[tuple[sympy.Symbol, sympy.Expr]]:
        """What the core asks for and the problem's own formulas do not say."""
        if problem == "inverse":
            return
        record = self.direct.symbols.record
        known = {own.symbol for own in self.direct.definitions}
        lengths = self.inverse.loops.lengths
        for index, symbol in lengths.items():
            if index in self.direct.symbols.locked:
                yield symbol, self.direct.symbols.locked[index]
        for driven, pair in zip(record.inputs, self.input_pairs, strict=True):
            if driven.coordinate.kind == "angle":  # the angle of a link that an input turns, from that of the input
                cosine, sine = circle_of(driven.name)
                for part, value in zip(pair, (cosine, sine), strict=True):
                    (symbol,) = part.free_symbols
                    if symbol not in known:
                        yield symbol, value * part.coeff(symbol)
        named = dict(zip(LENGTHS, self.direct.point, strict=True))
        for name in record.platform.pose:
            if name in named:
                yield _real(name), named[name]
            else:
                yield from zip(circle_of(name), self._turned_by(name), strict=True)

    def _turned_by(self, name: str) -> tuple[sympy.Expr, sympy.Expr]:
        """Cosine and sine of an angle of the pose."""
        own = self.direct.placed.links[self.direct.symbols.record.platform.link]
        if name != "phi" or own.axis is None or tuple(own.axis) != (0, 0, 1) or own.rod is not None:
            raise NotDerivedError(f"the platform's {name}")
        for item in self.direct.loops.items:
            if self.direct.symbols.record.platform.link in item.links:
                return item.unknowns[0], item.unknowns[1]
        raise NotDerivedError(f"the platform's {name}")

    def _margins(self, problem: Problem) -> Iterator[tuple[str, sympy.Expr]]:
        solution = self.direct if problem == "direct" else self.inverse
        for part in solution.sets:
            for number, condition in enumerate(part.conditions, start=1):
                if condition.free_symbols - {*self.inverse.symbols.parameters.values()}:
                    yield self._condition_name(condition, part.items[0].name, number), condition
            for root in part.roots:
                yield root.radicand.name, root.radicand
        for tilt in self.joints.tilts:
            yield f"upright_{tilt.name.removeprefix('tilt_')}", 1 + dot(tilt.line, tilt.direction)

    def _condition_name(self, condition: sympy.Expr, link: str, number: int) -> str:
        return condition.name if condition.is_Symbol else f"c{number}_{link}"

    def _pair_text(self, values: Sequence[Any], calls: bool = True) -> str:
        def one(value: Any) -> str:
            if isinstance(value, tuple):
                return f"({', '.join(map(one, value))})"
            return self.printer.doprint(value) if calls else str(value)

        text = ", ".join(map(one, values))
        return f"({text},)" if len(values) == 1 else f"({text})"

    @cached_property
    def sign_values(self) -> dict[str, sympy.Expr]:
        """Name of a sign -> what it is the sign of, in the unknowns of the inverse problem and the pose."""
        values = {}
        for solution in (self.inverse, self.direct):
            known = {own.symbol: own.formula for own in solution.definitions}
            kept = {unknown for item in solution.loops.items for unknown in item.unknowns}
            for root in solution.roots:
                name, sense = self.signs[solution.symbols.problem, root.symbol]
                value = root.quantity
                while any(symbol in known and symbol not in kept for symbol in value.free_symbols):
                    value = value.subs(
                        {
                            symbol: known[symbol]
                            for symbol in value.free_symbols
                            if symbol not in kept and symbol in known
                        }
                    )
                if solution is self.direct:
                    value = value.subs(self._inputs_in_unknowns)
                values[name] = sympy.factor_terms(sense * value)
        return values

    @cached_property
    def _inputs_in_unknowns(self) -> dict[sympy.Symbol, sympy.Expr]:
        """GivenSymbols of the direct problem's inputs as formulas of the inverse problem's unknowns."""
        pairs = zip(self.printed_inputs, self.input_pairs, strict=True)
        values: dict[sympy.Symbol, sympy.Expr] = {}
        for printed, own in pairs:
            values |= dict(zip(printed, own, strict=True)) if isinstance(printed, tuple) else {printed: own}
        return values

    def _core(self) -> str:
        names = [str(symbol) for symbol in (*self.posed, *self.unknowns)]
        lines = [f"def _core(ns, p, {', '.join(names)}):"]
        for own in self.joints.pointings:
            sense = "-" if own.back else ""
            (a, b), (c, d) = own.carrier, own.hinge
            ahead, beside = (self.printer.doprint(-part if own.back else part) for part in (own.ahead, own.beside))
            along = self.printer.doprint(own.along)
            lines.append(f"    ({a}, {b}), ({c}, {d}), _ = pointing(ns, {ahead}, {beside}, {along}, 1e-30)")
            if sense:
                lines.append(f"    {c} = -{c}")
            names += [str(symbol) for symbol in (a, b, c, d)]
        lines.append("    return SimpleNamespace(")
        lines += [f"        {name}={name}," for name in names]
        lines += [f"        of_{name}={self.printer.doprint(value)}," for name, value in self.sign_values.items()]
        lines.append("    )")
        return "\n".join(lines)

    def _taken(self, expressions: Sequence[Any]) -> list[str]:
        """Lines that take out of the core what formulas need."""
        named = [*self.posed, *self.unknowns]
        named += [symbol for own in self.joints.pointings for pair in (own.carrier, own.hinge) for symbol in pair]
        used = {symbol for part in expressions for symbol in sympy.sympify(part).free_symbols}
        names = [str(symbol) for symbol in named if symbol in used]
        return [f"    {name} = core.{name}" for name in names]

    def _joints(self) -> str:
        flat: list[Any] = []
        for value in self.joints.values.values():
            if isinstance(value, BallRotation):
                flat += [entry for part, _ in value.parts if not isinstance(part, str) for row in part for entry in row]
            else:
                flat += [*value] if isinstance(value, tuple) else [value]
        flat += [entry for tilt in self.joints.tilts for entry in (*tilt.line, *tilt.direction)]
        lines = ["def joints(ns, p, core):", '    """Every joint\'s value."""', *self._taken(flat)]
        for tilt in self.joints.tilts:
            line, direction = self._pair_text(tilt.line), self._pair_text(tilt.direction)
            lines.append(f"    {tilt.name} = taking({line}, {direction})")
        lines.append("    return {")
        lines += [f'        "{name}": {self._value(value)},' for name, value in self.joints.values.items()]
        lines.append("    }")
        return "\n".join(lines)

    def _value(self, value: Any) -> str:
        if isinstance(value, BallRotation):
            texts = []
            for part, turned in value.parts:
                text = part if isinstance(part, str) else self._pair_text([tuple(row) for row in part])
                texts.append(f"transposed({text})" if turned else text)
            whole = texts[0] if texts else "((1, 0, 0), (0, 1, 0), (0, 0, 1))"
            for text in texts[1:]:
                whole = f"product({whole}, {text})"
            return whole
        return self._pair_text(value) if isinstance(value, tuple) else self.printer.doprint(value)

    @cached_property
    def factors(self) -> list[tuple[str, str, sympy.Expr]]:
        """Name, kind and value of each factor of both determinants, numbers and dimensions in the first ones."""
        own: list[tuple[str, str, sympy.Expr]] = []
        parameters = {*self.inverse.symbols.parameters.values()}
        for kind, letter, powers in (
            ("parallel", "f", self.velocities.parallel), ("serial", "g", self.velocities.serial),
        ):  # fmt: skip
            constants = [base for base, power in powers for _ in range(power) if not base.free_symbols - parameters]
            varying = [base for base, power in powers for _ in range(power) if base.free_symbols - parameters]
            if not varying:
                if sympy.simplify(sympy.prod(constants) - 1) != 0:
                    varying = [sympy.prod(constants)]
                constants = []
            for k, constant in enumerate(constants):
                varying[k % len(varying)] *= constant
            own += [(f"{letter}{k}", kind, value) for k, value in enumerate(varying, start=1)]
        return own

    def _factors(self) -> str:
        lines = ["def factors(ns, p, core):", '    """Factors of det Jp and det Jq."""']
        lines += self._taken([value for _, _, value in self.factors])
        lines.append("    return {")
        lines += [f'        "{name}": {self.printer.doprint(value)},' for name, _, value in self.factors]
        lines.append("    }")
        return "\n".join(lines)

    def _jacobians(self) -> str:
        jp, jq = self.velocities.jp, self.velocities.jq
        lines = ["def jacobians(ns, p, core):", '    """Rows of Jp and of Jq, with Jp v = Jq q\'."""']
        lines += self._taken([*jp, *jq])
        for name, matrix in (("jp", jp), ("jq", jq)):
            lines.append(f"    {name} = (")
            lines += [f"        {self._pair_text(row)}," for row in matrix.tolist()]
            lines.append("    )")
        lines.append("    return jp, jq")
        return "\n".join(lines)

    def _declaration(self) -> str:
        record = self.inverse.symbols.record
        reduced = bool(record.generalised) or bool(self.joints.pointings)
        lines = ["CLOSED_FORM = ClosedForm("]
        lines.append(f'    complete_for="{"reduced" if reduced else "joint_graph"}",')
        if reduced:
            lines.append(
                '    reduced_because="parallelograms stay such, and what they keep from turning is not turned over",'
            )
        lines += [f"    {name}={name}," for name in ("direct", "inverse", "joints", "factors", "jacobians")]
        lines.append("    signs={")
        lines += [
            f'        "{name}": Sign("of_{name}", "{self._scale(value)}"),' for name, value in self.sign_values.items()
        ]
        lines.append("    },")
        for problem in ("direct", "inverse"):
            lines.append(f"    {problem}_margins=(")
            lines += [f"        {text}," for text in self._margin_list(problem)]
            lines.append("    ),")
        lines.append("    factor_list=(")
        for name, kind, value in self.factors:
            unit, scale = self._unit(value), self._scale(value)
            lines.append(f'        Factor("{name}", "{kind}", "{scale}", "{name} vanishes", unit={unit}),')
        lines.append("    ),")
        if self.constraint_singular:
            lines.append(f"    constraint_singular={self.constraint_singular!r},")
        lines.append(")")
        return "\n".join(lines)

    def _margin_list(self, problem: Problem) -> Iterator[str]:
        solution = self.direct if problem == "direct" else self.inverse
        known = {own.symbol: own.formula for own in solution.definitions}
        kept = {unknown for item in solution.loops.items for unknown in item.unknowns}
        radicands = {root.radicand: root for root in solution.roots}
        for name, value in self._margins(problem):
            whole = value
            while any(symbol in known and symbol not in kept for symbol in whole.free_symbols):
                whole = whole.subs(
                    {symbol: known[symbol] for symbol in whole.free_symbols if symbol not in kept and symbol in known}
                )
            unit, scale = self._unit(whole), self._scale(whole)
            if value in radicands:
                sign, _ = self.signs[problem, radicands[value].symbol]
                items = next(part.items for part in solution.sets if radicands[value] in part.roots)
                meaning = f"{' and '.join(item.name for item in items)} do{'es' if len(items) == 1 else ''} not reach"
                yield f'Margin("{name}", "{scale}", "{meaning}", unit={unit}, signs=("{sign}",))'
            else:
                yield f'Margin("{name}", "{scale}", "{name} vanishes", unit={unit}, zero="degenerate")'

    def _unit(self, value: sympy.Expr) -> int:
        """Power of the length unit."""
        return self._sizes.unit(value)

    def _scale(self, value: sympy.Expr) -> str:
        """A formula of dimensions: the size of a quantity, its terms added up."""
        return self._sizes.scale(value)

    @cached_property
    def _sizes(self) -> Sizes:
        return Sizes(self.inverse, frozenset(own for own in self.printed_inputs if not isinstance(own, tuple)))


def _real(name: str) -> sympy.Symbol:
    return sympy.Symbol(name, real=True)
