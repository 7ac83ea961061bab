"""Lines of links: for each unknown direction where its link points, about what it turns, and where it hangs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import sympy

from assur.derivation.exact_vectors import ExactVectors
from assur.derivation.hinges import point_on
from assur.derivation.loop_equations import LoopEquations
from assur.derivation.orientations import LinkOrientations, Orientation
from assur.derivation.phrases import NamedDirection, NamedJoint, NamedLink
from assur.derivation.symbols import GivenSymbols
from assur.derivation.unknown_directions import UnknownDirection
from assur.joints.steps import UNTURNED
from assur.model.mechanism import Joint
from assur.numerics.vectors import Vector, add, apply, cross, dot, scaled, subtract

ZERO = sympy.Integer(0)


@dataclass(frozen=True)
class LinkLine:
    """Where a link points, by the unknowns of its direction.

    Attributes:
        direction: the unknowns.
        vector: from a joint of the link to another, of a rod over its length; of a link that turns what lies across
            the axis.
        axis: about which it turns; none of a rod's.
        still: the vector where the angle is zero.
        square: of how long the link is along it.
        joints: the two joints; of a slide that one twice; none for the platform's point.
    """

    direction: UnknownDirection
    vector: Vector
    axis: Vector | None
    still: Vector
    square: sympy.Expr
    joints: tuple[str, str]


@dataclass(frozen=True, eq=False)
class LinkLines:
    """The geometry of the links of a problem."""

    symbols: GivenSymbols
    placed: LinkOrientations
    loops: LoopEquations

    @cached_property
    def exact(self) -> ExactVectors:
        """Compares vectors."""
        return ExactVectors(self.symbols.witness)

    def of(self, direction: UnknownDirection) -> LinkLine | None:
        """The line of a direction; None where no two joints of a link lie apart across its axis."""
        if direction not in self._lines:
            self._lines[direction] = next(self.all(direction), None)
        return self._lines[direction]

    @cached_property
    def _lines(self) -> dict[UnknownDirection, LinkLine | None]:
        return {}

    def all(self, direction: UnknownDirection) -> Iterator[LinkLine]:
        """The lines from the first joint of a link to each other one."""
        for link in direction.links:
            if link not in self.symbols.record.links:
                continue
            own = self.placed.links[link]
            first, *others = self.joints(link)
            for other in others:
                line = self._line(direction, own, link, first, other)
                if line is not None:
                    yield line
        yield from self._slides(direction)

    def to_platform(self, direction: UnknownDirection) -> Iterator[LinkLine]:
        """The lines of a platform that turns from its joints to its point."""
        link = self.symbols.record.platform.link
        own = self.placed.links[link]
        for joint in self.joints(link) if own.axis is not None else ():
            apart = subtract(self.symbols.geometry.platform, point_on(self.symbols, joint, link))
            yield from self._turned(direction, own.axis or (0, 0, 0), apply(own.constant, apart), (joint.name, ""))

    def _slides(self, direction: UnknownDirection) -> Iterator[LinkLine]:
        """The axes of sliders on links that turn, across the axis of these."""
        for joint in self.symbols.record.joints.values():
            own = self.placed.links[joint.parent]
            if joint.type.slides and joint.parent in direction.links and own.axis is not None and own.rod is None:
                along = apply(own.constant, self.symbols.geometry.joints[joint.name].axes[0])
                yield from self._turned(direction, own.axis, along, (joint.name, joint.name))

    def joints(self, link: str) -> list[Joint]:
        """The joints of a link, in the file's order."""
        return [joint for joint in self.symbols.record.joints.values() if link in (joint.parent, joint.child)]

    def _line(
        self, direction: UnknownDirection, own: Orientation, link: str, first: Joint, other: Joint
    ) -> LinkLine | None:
        apart = subtract(point_on(self.symbols, other, link), point_on(self.symbols, first, link))
        whole = apply(own.constant, apart) if own.constant is not UNTURNED else apart
        names = first.name, other.name
        if own.rod is not None:
            x, y, z = direction.unknowns
            reach = dot(own.line or (0, 0, 0), whole)
            apart_along = not self.symbols.witness.is_zero(reach)
            return LinkLine(direction, (x, y, z), None, own.line or (0, 0, 0), reach**2, names) if apart_along else None
        if own.axis is None:
            return None
        return next(self._turned(direction, own.axis, whole, names), None)

    def _turned(
        self, direction: UnknownDirection, axis: Vector, whole: Vector, names: tuple[str, str]
    ) -> Iterator[LinkLine]:
        """What of a vector lies across the axis about which it turns, if any does."""
        across = self.exact.tidied(subtract(whole, scaled(axis, dot(axis, whole))))
        if any(across):
            cosine, sine = direction.unknowns[:2] if direction.kind == "circle" else self._angle(direction)
            turned = add(scaled(across, cosine), scaled(self.exact.tidied(cross(axis, across)), sine))
            yield LinkLine(direction, turned, axis, across, dot(across, across), names)

    def _angle(self, direction: UnknownDirection) -> tuple[sympy.Symbol, sympy.Symbol]:
        """Cosine and sine of a direction for which the components of a vector are solved."""
        own = next(own for own in self.loops.directions if own.links == direction.links)
        return own.unknowns[0], own.unknowns[1]

    def name(self, direction: UnknownDirection) -> NamedLink:
        """How the links of a direction are called: as the parallelogram that they are, or by the first of them."""
        for group in self.symbols.record.generalised.values():
            members = {
                link
                for name in group.joints
                for link in (self.symbols.record.joints[name].parent, self.symbols.record.joints[name].child)
            }
            if {*direction.links} == members - {group.parent, group.child}:
                return NamedLink(group.name, parallelogram=True)
        return NamedLink(next((link for link in direction.links if link in self.symbols.record.links), direction.name))

    def named(self, vector: Vector) -> NamedDirection | NamedJoint | None:
        """A direction: along an axis of the base, along that of a joint, or by components that are numbers; or none."""
        for k in range(3):
            base: list[int] = [0, 0, 0]
            base[k] = 1
            if self.exact.along(vector, (base[0], base[1], base[2])):
                return NamedDirection((base[0], base[1], base[2]))
        for name, axis in self.fixed_axes.items():
            if self.exact.along(vector, axis):
                return NamedJoint(name)
        parts = [sympy.sympify(part) for part in vector]
        if not all(part.is_number for part in parts):
            return None
        x, y, z = self.exact.upright(self.exact.unit((parts[0], parts[1], parts[2])))
        return NamedDirection((x, y, z))

    @cached_property
    def fixed_axes(self) -> Mapping[str, Vector]:
        """Joint -> its axis in the base, where that stands still; of joints of several axes the first."""
        axes: dict[str, Vector] = {}
        for name, joint in self.symbols.record.joints.items():
            own = self.placed.links[joint.parent]
            written = self.symbols.geometry.joints[name].axes
            if own.axis is None and own.rod is None and len(written) > 0:
                axes[name] = self.exact.tidied(apply(own.constant, written[0]))
        return axes

    def centre(self, direction: UnknownDirection, inside: Sequence[UnknownDirection], known: set[str]) -> str | None:
        """A joint at which the links of a direction hang on a link that no direction of the set has, a known one first.

        Args:
            direction: of whose links.
            inside: the directions of the set.
            known: links whose place is known.
        """
        moving = {link for own in inside for link in own.links}
        own = [(joint, link) for link in direction.links for joint in self.joints(link)]
        ends = [(joint.name, joint.parent if joint.child == link else joint.child) for joint, link in own]
        ends = [(name, other) for name, other in ends if other not in moving]
        return next((name for name, other in ends if other in known), ends[0][0] if ends else None)
