"""Every joint's value as formulas of the unknowns: cosine and sine of an angle, a length, or the rows of a rotation."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import sympy

from assur.derivation.hinges import cross_of
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.orientations import Orientation
from assur.derivation.solution import AnalyticSolution
from assur.derivation.unknown_directions import UnknownDirection
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import UNTURNED, about
from assur.model.mechanism import Joint
from assur.numerics.vectors import Matrix, Vector, apply, cross, dot, product, scaled, subtract, transposed

Pair = tuple[sympy.Expr, sympy.Expr]


@dataclass(frozen=True)
class Pointing:
    """How a rod on a hinge points: angles of what carries it, and of its hinge, by its direction.

    Attributes:
        carrier, hinge: cosine and sine of both angles.
        ahead, beside, along: parts of the direction, as `assur.numerics.legs.pointing` takes them.
        back: whether the hinge's cosine is negative at home, so that everywhere.
        lean, level: sine and cosine of the angle of the rod from the plane across its hinge.
        axis: about which what carries it turns.
    """

    carrier: Pair
    hinge: Pair
    ahead: sympy.Expr
    beside: sympy.Expr
    along: sympy.Expr
    back: bool
    lean: sympy.Expr
    level: sympy.Expr
    axis: Vector

    @property
    def name(self) -> str:
        """Of the rod."""
        return str(self.hinge[0].name.removeprefix("cos_"))

    @property
    def square(self) -> sympy.Expr:
        """What is zero where the rod points along the axis of what carries it."""
        return self.ahead**2 + self.beside**2

    def at(self, values: Mapping[sympy.Symbol, float]) -> dict[sympy.Expr, float]:
        """Numbers of the cosines and sines of both angles, at values of the unknowns."""
        sense = -1.0 if self.back else 1.0
        x, y, along, lean, level = (
            float(sympy.sympify(part).subs(values))
            for part in (sense * self.ahead, sense * self.beside, self.along, sense * self.lean, self.level)
        )
        square = x * x + y * y
        across = math.sqrt(max(square - lean * lean, 0.0))
        carrier = (x * across + y * lean) / square, (y * across - x * lean) / square
        return dict(zip((*self.carrier, *self.hinge), (*carrier, sense * across / level, along / level), strict=True))

    @property
    def room(self) -> sympy.Expr:
        """What is negative where a rod oblique to its hinge points too far along that axis."""
        return self.square - self.lean**2


@dataclass(frozen=True)
class Tilt:
    """The orientation of a rod between ball joints: turned from a line to its direction by the smallest rotation."""

    name: str
    line: Vector
    direction: tuple[sympy.Symbol, ...]


@dataclass(frozen=True)
class BallRotation:
    """The rotation of a child against its parent: a product of matrices, each by rows or the name of a tilt.

    A tilt may be transposed.
    """

    parts: tuple[tuple[Matrix | str, bool], ...]


@dataclass(frozen=True, eq=False)
class SolvedJoints:
    """What a closed form says of its joints.

    Attributes:
        values: joint, or joint and component -> its value.
        pointings, tilts: what is worked out before.
    """

    values: Mapping[str, Pair | sympy.Expr | BallRotation]
    pointings: tuple[Pointing, ...] = ()
    tilts: tuple[Tilt, ...] = ()

    @property
    def leaning(self) -> dict[sympy.Expr, Pointing]:
        """What must not be negative, and what not zero -> the rod oblique to its hinge of which that is said."""
        return {value: own for own in self.pointings if own.lean != 0 for value in (own.room, own.square)}


def joint_formulas(solution: AnalyticSolution) -> SolvedJoints:
    """The joints of an inverse problem that was solved. Errors: NotDerivedError."""
    return _Joints(solution).formulas()


@dataclass(eq=False)
class _Joints:
    solution: AnalyticSolution
    pointings: list[Pointing] = field(default_factory=list)
    tilts: dict[int, Tilt] = field(default_factory=dict)

    def formulas(self) -> SolvedJoints:
        values: dict[str, Any] = {}
        for joint in self.solution.symbols.record.joints.values():
            values |= dict(self._values(joint))
        return SolvedJoints(values, tuple(self.pointings), tuple(self.tilts.values()))

    def _values(self, joint: Joint) -> Iterator[tuple[str, Any]]:
        own = self.solution.symbols.geometry.joints[joint.name]
        start = joint_graph(self.solution.symbols.record).slices[joint.name].start
        if joint.type.ball:
            yield joint.name, self._ball(joint)
            return
        links = [joint.parent, *[cross_of(joint)] * (joint.type.turns - 1), joint.child]
        turned = 0
        for component, (step, first) in zip(joint.type.components, joint.type.places, strict=True):
            name = joint.name if len(joint.type.components) == 1 else f"{joint.name}.{component}"
            if step.kind == "slide":
                yield name, self._length(start + first)
            else:
                after = own.turn if links[turned + 1] == joint.child else UNTURNED
                yield name, self._angle(links[turned], links[turned + 1], own.axes[step.direction], after)
                turned += 1

    def _length(self, index: int) -> sympy.Expr:
        return self.solution.loops.lengths[index]

    def _angle(self, parent: str, child: str, axis: Vector, after: Matrix) -> Pair:
        ends = self._about(parent, axis, parent), self._about(child, axis, parent)
        if ends[0] is not None and ends[1] is not None and self._parallel_at_zero(parent, child, after):
            (c, s), (k, t) = ends[0], ends[1]
            return (sympy.expand(c * k + s * t), sympy.expand(c * t - s * k))
        relative = product(product(transposed(self._rotation(parent)), self._rotation(child)), transposed(after))
        cosine = sum(relative[k][k] for k in range(3)) - 1
        sine = dot(
            axis, (relative[2][1] - relative[1][2], relative[0][2] - relative[2][0], relative[1][0] - relative[0][1])
        )
        return self._reduced(cosine / 2), self._reduced(sine / sympy.Integer(2))

    def _about(self, link: str, axis: Vector, parent: str) -> Pair | None:
        """The angle by which a link has turned about a joint's axis, if that is how it turns."""
        own, carrier = self.solution.placed.links[link], self.solution.placed.links[parent]
        if own.axis is None or own.circle is None:
            return (sympy.Integer(1), sympy.Integer(0)) if own.rod is None else None
        if own.hinge is not None or carrier.rod is not None:
            return None
        turned = apply(carrier.constant, axis)
        cosine, sine = self._circle(own.circle)
        for sense in (1, -1):
            if all(map(self.solution.symbols.witness.is_zero, subtract(turned, scaled(own.axis, sense)))):
                return cosine, sense * sine
        return None

    def _parallel_at_zero(self, parent: str, child: str, after: Matrix) -> bool:
        """Whether the joint's value is zero where both links have not turned."""
        first, second = (self.solution.placed.links[link].constant for link in (parent, child))
        zero = product(product(transposed(first), second), transposed(after))
        ones = (zero[i][j] - int(i == j) for i in range(3) for j in range(3))
        return all(map(self.solution.symbols.witness.is_zero, ones))

    def _reduced(self, formula: Any) -> sympy.Expr:
        """A formula modulo cos^2 + sin^2 = 1, as a product where it is one."""
        expanded = sympy.expand(formula)
        for cosine, sine in self._circles:
            expanded = sympy.expand(expanded.replace(
                lambda part, own=sine: part.is_Pow and part.base == own and part.exp.is_Integer and part.exp > 1,
                lambda part, c=cosine, s=sine: (1 - c**2) ** (int(part.exp) // 2) * s ** (int(part.exp) % 2),
            ))  # fmt: skip
        return sympy.factor_terms(sympy.simplify(expanded) if expanded.has(sympy.sqrt) else expanded)

    @property
    def _circles(self) -> list[Pair]:
        pairs: list[Any] = [
            direction.unknowns for direction in self.solution.loops.directions if direction.kind == "circle"
        ]
        pairs += [pair for own in self.pointings for pair in (own.carrier, own.hinge)]
        return pairs + self.solution.symbols.circles

    def _rotation(self, link: str) -> Matrix:
        own = self.solution.placed.links[link]
        if own.rod is not None and own.hinge is None:
            raise NotDerivedError(f"{link}, a rod between ball joints, has a joint that is none")
        if own.axis is None or own.circle is None:
            return own.constant
        if own.hinge is None:
            return product(about(own.axis, *self._circle(own.circle)), own.constant)
        pointing = self._pointing[own.rod or 0]
        lean = product(about(own.hinge, *self._from_line(own, pointing)), own.constant)
        return product(about(own.axis, *pointing.carrier), lean)

    def _from_line(self, own: Orientation, pointing: Pointing) -> Pair:
        """The hinge's angle, less that of the rod's line at zero."""
        line, across = own.line or (0, 0, 0), cross(own.hinge or (0, 0, 0), own.axis or (0, 0, 0))
        cosine, sine = dot(line, across), scaled(own.axis or (0, 0, 0), -1)
        start = cosine / pointing.level, dot(line, sine) / pointing.level
        c, s = pointing.hinge
        return c * start[0] + s * start[1], s * start[0] - c * start[1]

    def _circle(self, number: int) -> Pair:
        for direction in self.solution.loops.directions:
            if direction.kind == "circle" and any(
                self.solution.placed.links[link].circle == number for link in direction.links
            ):
                return direction.unknowns[0], direction.unknowns[1]
        for rod, own in self._carriers.items():
            if own == number:
                return self._pointing[rod].carrier
        raise NotDerivedError("a link that turns, and that no loop determines")

    @cached_property
    def _carriers(self) -> dict[int, int]:
        """Number of a rod on a hinge -> that of the circle of what carries it."""
        links = self.solution.placed.links.values()
        return {own.rod: own.circle for own in links if own.rod is not None and own.circle is not None}

    @cached_property
    def _pointing(self) -> dict[int, Pointing]:
        pointings: dict[int, Pointing] = {}
        witness = self.solution.symbols.witness
        for own in self.solution.placed.links.values():
            if own.rod is None or own.hinge is None or own.axis is None or own.rod in pointings:
                continue
            direction = self._rod(own.rod)
            across = cross(own.hinge, own.axis)
            ahead, beside, along = (
                sympy.expand(dot(part, direction.unknowns)) for part in (across, own.hinge, scaled(own.axis, -1))
            )
            start = dot(own.line or (0, 0, 0), across)
            back = witness.at_home(start) < 0.0
            names = (
                f"cos_{direction.name}_carrier",
                f"sin_{direction.name}_carrier",
                f"cos_{direction.name}",
                f"sin_{direction.name}",
            )
            c, s, k, t = sympy.symbols(names, real=True)
            lean = dot(own.line or (0, 0, 0), own.hinge)
            lean = sympy.Integer(0) if witness.is_zero(lean) else sympy.simplify(lean)
            level = sympy.sqrt(sympy.factor_terms(sympy.simplify(1 - lean**2)))
            crank = next((turned for turned in self.solution.loops.cranks if self._turns(turned, own)), None)
            if crank is not None:
                c, s = crank.unknowns
                k, t = (c * ahead + s * beside) / level, along / level
            pointings[own.rod] = Pointing((c, s), (k, t), ahead, beside, along, back, lean, level, own.axis)
            self.pointings += [] if crank is not None else [pointings[own.rod]]
        return pointings

    def _turns(self, circle: UnknownDirection, rod: Orientation) -> bool:
        """Whether a circle is that of what carries a rod."""
        return self.solution.placed.links[circle.links[0]].circle == rod.circle

    def _rod(self, number: int) -> UnknownDirection:
        links = self.solution.placed.links
        return next(
            direction
            for direction in self.solution.loops.directions
            if direction.kind == "rod" and links[direction.links[0]].rod == number
        )

    def _ball(self, joint: Joint) -> BallRotation:
        after = self.solution.symbols.geometry.joints[joint.name].turn
        parts = [(self._placed(joint.parent), True), (self._placed(joint.child), False), (after, True)]
        return BallRotation(tuple((part, turned) for part, turned in parts if part != UNTURNED))

    def _placed(self, link: str) -> Matrix | str:
        """The rotation of a link, or the name of a tilt."""
        own = self.solution.placed.links[link]
        if own.rod is None or own.hinge is not None:
            a, b, c = (tuple(map(self._reduced, row)) for row in self._rotation(link))
            return UNTURNED if (a, b, c) == UNTURNED else (a, b, c)
        direction = self._rod(own.rod)
        self.tilts.setdefault(own.rod, Tilt(f"tilt_{direction.name}", own.line or (0, 0, 0), direction.unknowns))
        return self.tilts[own.rod].name
