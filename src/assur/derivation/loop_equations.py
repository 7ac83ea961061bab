"""Loop equations: linear in the unknowns of links that turn, and in lengths along fixed directions.

Axes that links share which turn about different directions are one: three equations more. A link on an axis that turns
itself is turned by two circles; the one that carries the axis is a coefficient then.

Where several joints slide on one link that turns, the loops through them are written in its frame, in which their
directions stand still.

A loop is a sum of vectors from joint to joint, each fixed in a link. One in a link that turns about u is
w_u + cos psi (w - w_u) + sin psi u x w; one in a rod is a multiple of its direction; one in a link that three balls
hold is a sum of multiples of two sides of their triangle, which closes as a loop does. What is not linear belongs to
one direction alone: cos^2 + sin^2 = 1, the direction of a rod has length 1, and a side has its own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import sympy

from assur.derivation.carried_vectors import CarriedVectors
from assur.derivation.definitions import Definition
from assur.derivation.dimension_relations import dimension_relations
from assur.derivation.hinges import Hinge
from assur.derivation.linear import ONE, Form, form_of, value_of
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.orientations import LinkOrientations, Orientation
from assur.derivation.symbols import GivenSymbols
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import UNTURNED, about
from assur.model.mechanism import Joint
from assur.model.pose import LENGTHS
from assur.numerics.vectors import Vector, add, apply, cross, dot, scaled, subtract, transposed


@dataclass(frozen=True)
class SharedAxis:
    """One equation of an axis that two links share: the axis in the parent less that in the child, along this."""

    turn: Hinge
    along: Vector


@dataclass(frozen=True, eq=False)
class LoopEquations:
    """What vanishes.

    Attributes:
        forms: linear equations, each zero; the first of them are those of axes that links share.
        directions: unknowns of links that turn, and of rods.
        lengths: index in the joint values -> symbol of a length that is sought.
        strokes: such a length along a direction that turns -> the circle by which it turns. It is a coefficient.
        point: the platform's point as linear forms, but for what of it is beside the plane of three balls.
        relations: dimensions that follow from others, without which no loop closes.
        carriers: circles of links that carry axes of other links which turn. They are coefficients.
        shared: of each of the first equations the axis and what it is taken along.
        framed: circles of links in whose frame loops are written, as several joints slide on each.
        beside: that of the platform's point, along the product of two sides.
        oblique: length of a slider oblique to the axis about which it turns -> its symbol in what turns. Both are one.
        cranks: circle of a link that carries a rod on a hinge, which an input turns and which is in no loop -> linear
            equations in it, as that rod leans on its hinge.
    """

    forms: tuple[Form, ...]
    directions: tuple[UnknownDirection, ...]
    lengths: Mapping[int, sympy.Symbol]
    point: tuple[Form, Form, Form]
    strokes: Mapping[sympy.Symbol, UnknownDirection] = field(default_factory=dict)
    relations: tuple[Definition, ...] = ()
    carriers: tuple[UnknownDirection, ...] = ()
    shared: tuple[SharedAxis, ...] = ()
    framed: tuple[UnknownDirection, ...] = ()
    oblique: Mapping[sympy.Symbol, sympy.Symbol] = field(default_factory=dict)
    beside: Vector = (0, 0, 0)
    cranks: Mapping[UnknownDirection, tuple[Form, ...]] = field(default_factory=dict)

    @property
    def axes(self) -> int:
        """How many equations of axes that links share there are."""
        return len(self.shared)

    def carried_by(self, circle: UnknownDirection, witness: ModularWitness) -> LoopEquations:
        """The same with a circle as coefficients, so that lengths along its directions are linear unknowns."""
        strokes = {length: own for length, own in self.strokes.items() if own != circle}
        free = [length for length, own in self.strokes.items() if own == circle]
        unknowns = [key for form in self.forms for key in form if key != ONE and key not in circle.unknowns]
        linear = list(dict.fromkeys([*free, *unknowns]))
        forms = tuple(form_of(value_of(form), linear, witness) for form in self.forms)
        return replace(self, forms=forms, strokes=strokes, carriers=(*self.carriers, circle))


def loop_equations(symbols: GivenSymbols, placed: LinkOrientations) -> LoopEquations:
    """The equations of all loops, and of the platform's point where the pose is given. Errors: NotDerivedError."""
    return _Loops(symbols, placed).equations()


class _Loops:
    def __init__(self, symbols: GivenSymbols, placed: LinkOrientations) -> None:
        self.symbols, self.record, self.placed = symbols, symbols.record, placed
        self.graph = joint_graph(self.record)
        self.lengths: dict[int, sympy.Symbol] = {}
        self.strokes: dict[sympy.Symbol, UnknownDirection] = {}
        self.oblique: dict[sympy.Symbol, sympy.Symbol] = {}
        self.carried = CarriedVectors(symbols, placed)

    def equations(self) -> LoopEquations:
        point: dict[str, tuple[Vector, Vector]] = {self.record.base: ((0, 0, 0), (0, 0, 0))}
        gaps: list[Vector] = []
        for joint, forward in self.graph.tree:
            near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
            start, end = self._points(joint) if forward else self._points(joint)[::-1]
            place = add(self._place(near, start, point), scaled(self._slid(joint), 1 if forward else -1))
            point[far] = end, place
        for joint in self.graph.cut:
            start, end = self._points(joint)
            reached = add(self._place(joint.parent, start, point), self._slid(joint))
            gaps.append(subtract(reached, self._place(joint.child, end, point)))
        platform, beside = self._platform(point)
        shared = [own for turn in self.placed.hinges for own in self._apart(turn)]
        framed = self._framed()
        gaps = [self._in_frame(gap, framed) for gap in gaps]
        around = [[own.unknowns for own in sides] for sides in self.carried.sides.values()]
        gaps += [add(add((*a,), (*b,)), (*c,)) for a, b, c in around]
        rows = [part for gap in gaps for part in gap]
        rows += [platform[LENGTHS.index(name)] - symbol for name, symbol in self.symbols.place.items()]
        used = {
            symbol
            for row in (*(row for row, _ in shared), *rows, *platform)
            for symbol in sympy.sympify(row).free_symbols
        }
        sides = (own for group in self.carried.sides.values() for own in group)
        every = (*self.carried.circles.values(), *self.carried.rods.values(), *sides)
        directions = [direction for direction in every if used & {*direction.unknowns}]
        forms = [self._form(row, directions, framed) for row in rows]
        unknowns = self._plain_lengths(framed)
        unknowns += [unknown for direction in directions for unknown in direction.unknowns]
        relations = () if self._seconds else dimension_relations(self.symbols, forms, unknowns)
        if relations:
            forms = [self._form(row, directions, framed) for row in rows]
        x, y, z = (self._form(part, directions) for part in platform)
        axes = [(form, own) for row, own in shared if (form := self._form(row, directions))]
        own = [form for form in forms if form]
        cranks = self._cranks(directions)
        carriers = tuple(own for own in directions if own in self._carriers)
        return LoopEquations(
            (*(form for form, _ in axes), *own),
            (*directions, *cranks),
            dict(self.lengths),
            (x, y, z),
            {length: own for length, own in self.strokes.items() if own not in framed},
            relations,
            carriers,
            tuple(own for _, own in axes),
            framed,
            dict(self.oblique),
            beside,
            cranks,
        )

    def _cranks(self, used: Sequence[UnknownDirection]) -> dict[UnknownDirection, tuple[Form, ...]]:
        """Circles of which an input says something, and no loop: of links that carry rods."""
        if self.symbols.problem == "direct":
            return {}
        turning = [own.coordinate.joint for own in self.record.inputs if own.coordinate.kind == "angle"]
        joints = [self.record.joints[name] for name in turning]
        driven = {link for joint in joints for link in (joint.parent, joint.child)}
        turned = {own.circle for link, own in self.placed.links.items() if link in driven}
        rods = [own for own in used if own.kind == "rod"]
        cranks: dict[UnknownDirection, tuple[Form, ...]] = {}
        for number, circle in self.carried.circles.items():
            if number in turned and circle not in used and (rows := self.carried.leanings([*rods, circle])):
                cranks[circle] = tuple(form_of(row, circle.unknowns, self.symbols.witness) for row in rows)
        return cranks

    def _framed(self) -> tuple[UnknownDirection, ...]:
        """Circles of links on which several joints slide."""
        circles = [own for own in self.strokes.values() if own.kind == "circle"]
        framed = tuple(own for own in dict.fromkeys(circles) if circles.count(own) > 1)
        if framed and self.oblique:
            names = " and ".join(own.name for own in framed)
            raise NotDerivedError(f"several joints slide on {names}, which turns, oblique to its axis")
        return framed

    def _in_frame(self, gap: Vector, framed: Sequence[UnknownDirection]) -> Vector:
        """A loop in the frame of the link along whose directions its lengths run. Errors: NotDerivedError."""
        used = {symbol for part in gap for symbol in sympy.sympify(part).free_symbols}
        circles = {own for length, own in self.strokes.items() if length in used and own in framed}
        if not circles:
            return gap
        if len(circles) > 1:
            names = " and ".join(sorted(own.name for own in circles))
            raise NotDerivedError(f"joints slide on {names}, which turn, several on each")
        (own,) = circles
        cosine, sine = own.unknowns
        back = apply(about(self.placed.links[own.links[0]].axis or (0, 0, 0), cosine, -sine), gap)
        x, y, z = (sympy.expand(sympy.expand(part).subs(sine**2, 1 - cosine**2)) for part in back)
        return x, y, z

    def _plain_lengths(self, framed: Sequence[UnknownDirection]) -> list[sympy.Symbol]:
        """Lengths in which the loops are linear."""
        return [length for length in self.lengths.values() if self.strokes.get(length) in (None, *framed)]

    def _form(
        self, row: sympy.Expr, directions: Sequence[UnknownDirection], framed: Sequence[UnknownDirection] = ()
    ) -> Form:
        """Linear in all unknowns, or where links are turned by two circles in those of the second ones."""
        unknowns = self._plain_lengths(framed)
        symbols = sympy.sympify(row).free_symbols
        twice = any(symbols & {*own.unknowns} for own in self._seconds)
        kept = [own for own in directions if not (twice and own in self._carriers)]
        unknowns += [unknown for direction in kept for unknown in direction.unknowns]
        form = form_of(row, unknowns, self.symbols.witness)
        beside = {symbol for part in form.values() for symbol in part.free_symbols} & {*unknowns}
        if framed and beside:
            names = " and ".join(own.name for own in framed)
            raise NotDerivedError(f"several joints slide on {names}, which turns, in loops with other links that turn")
        return form

    @cached_property
    def _seconds(self) -> list[UnknownDirection]:
        numbers = {own.second for own in self.placed.links.values() if own.second is not None}
        return [self.carried.circles[number] for number in numbers]

    @cached_property
    def _carriers(self) -> list[UnknownDirection]:
        numbers = {own.circle for own in self.placed.links.values() if own.second is not None}
        return [self.carried.circles[number] for number in numbers if number is not None]

    def _apart(self, turn: Hinge) -> Iterator[tuple[sympy.Expr, SharedAxis]]:
        """How far an axis w in two links is from being one, along what turns one of them.

        That one turns about v: it has v.w, and w - v (v.w) and v x w turn by its angle.
        """
        ends = [(link, self._axis_in(link, turn)) for link in (turn.parent, turn.child)]
        first, second = (self.placed.links[link] for link, _ in ends)
        if any(own.rod is not None for own in (first, second)):
            return
        axes = [self.carried.vector(link, axis) for link, axis in ends]
        gap = self.carried.tidied(subtract(*axes))
        if not any(gap):
            return
        turning = [k for k, own in enumerate((first, second)) if own.circle is not None and own.second is None]
        if not turning:
            yield from ((part, SharedAxis(turn, along)) for part, along in zip(gap, UNTURNED, strict=True))
            return
        k = max(turning, key=lambda k: len({symbol for part in axes[k] for symbol in sympy.sympify(part).free_symbols}))
        (link, axis), own, other = ends[k], (first, second)[k], axes[1 - k]
        if own.axis is None or own.circle is None:
            return
        share = sympy.simplify(dot(self._within(link, own), axis))
        start = self.carried.short(own.axis, subtract(apply(own.constant, axis), scaled(own.axis, share)))
        cosine, sine = self.carried.circles[own.circle].unknowns
        size = 1 - share**2
        beside = self.carried.short(own.axis, cross(own.axis, start))
        for along, number in ((own.axis, share), (start, size * cosine), (beside, size * sine)):
            yield dot(along, other) - number, SharedAxis(turn, scaled(along, 1 if k else -1))

    def _within(self, link: str, own: Orientation) -> Vector:
        """The axis about which a link turns, in its own frame."""
        axis = own.axis or (0, 0, 0)
        for turn in self.placed.hinges:
            if link in (turn.parent, turn.child):
                for sense in (1, -1):
                    inside = scaled(self._axis_in(link, turn), sense)
                    if all(map(self.symbols.witness.is_zero, subtract(apply(own.constant, inside), axis))):
                        return inside
        return apply(transposed(own.constant), axis)

    def _axis_in(self, link: str, turn: Hinge) -> Vector:
        """The axis of a hinge in one of its links: as the file has it, if that joint is its own."""
        joint = self.record.joints.get(next(iter(turn.joints), ""))
        if joint is not None and joint.type.turns == 1:
            own = self.symbols.geometry.joints[joint.name]
            axis = next(own.axes[step.direction] for step in joint.type.steps if step.kind == "turn")
            if link in (joint.parent, joint.child):
                return axis if link == joint.parent else apply(transposed(own.turn), axis)
        return turn.axis if link == turn.parent else scaled(turn.back.axis, -1)

    def _points(self, joint: Joint) -> tuple[Vector, Vector]:
        own = self.symbols.geometry.joints[joint.name]
        return own.at, own.child_at

    def _place(self, link: str, vector: Vector, point: Mapping[str, tuple[Vector, Vector]]) -> Vector:
        known, place = point[link]
        return add(place, self.carried.vector(link, subtract(vector, known)))

    def _slid(self, joint: Joint) -> Vector:
        total: Vector = (0, 0, 0)
        for axis, index in self._sliding(joint):
            along, length = self.carried.vector(joint.parent, axis), self.symbols.locked.get(index)
            if length is not None:
                total = add(total, scaled(along, length))
                continue
            length = self.lengths.setdefault(index, sympy.Symbol(f"q_{joint.name.replace('.', '_')}", real=True))
            circle, still = self._turning(joint, along)
            if circle is not None and any(still):
                total = add(total, scaled(still, length))
                across = sympy.Symbol(f"{length.name}_across", real=True)
                self.oblique[length], along, length = across, self.carried.tidied(subtract(along, still)), across
            if circle is not None:
                self.strokes[length] = circle
            total = add(total, scaled(along, length))
        return total

    def _sliding(self, joint: Joint) -> Iterator[tuple[Vector, int]]:
        axes, start = self.symbols.geometry.joints[joint.name].axes, self.graph.slices[joint.name].start
        for step, first in joint.type.places:
            if step.kind == "slide":
                yield axes[step.direction], start + first

    def _turning(self, joint: Joint, along: Vector) -> tuple[UnknownDirection | None, Vector]:
        """The circle by which the direction of a slider turns, or the rod that it is the direction of, and what stands.

        Errors:
            NotDerivedError: it slides otherwise.
        """
        used = {symbol for part in along for symbol in sympy.sympify(part).free_symbols}
        turning = [
            own for own in (*self.carried.circles.values(), *self.carried.rods.values()) if used & {*own.unknowns}
        ]
        if not turning:
            return None, (0, 0, 0)
        circle = turning[0]
        x, y, z = (sympy.sympify(part).subs(dict.fromkeys(circle.unknowns, 0)) for part in along)
        still = self.carried.tidied((x, y, z))
        if len(turning) > 1 or (circle.kind == "rod" and any(still)):
            raise NotDerivedError(f"{joint.name} slides on a link that turns, not along its line")
        if circle.kind == "rod" and circle in self.strokes.values():
            raise NotDerivedError(f"{joint.name} slides on a link that turns, beside another slider")
        return circle, still

    def _platform(self, point: Mapping[str, tuple[Vector, Vector]]) -> tuple[Vector, Vector]:
        """The platform's point, and what of it is along the product of two sides."""
        link, at = self.record.platform.link, self.symbols.geometry.platform
        triangle, constant = self.placed.links[link].triangle, self.placed.links[link].constant
        if triangle is None:
            return self._place(link, at, point), (0, 0, 0)
        known, place = point[link]
        vector = apply(constant, subtract(at, known))
        first, last = (own.unknowns for own in self.carried.sides[triangle.number][::2])
        share = triangle.beside(vector)
        return add(place, self.carried.of_sides(triangle, vector)), scaled(cross((*first,), (*last,)), share)
