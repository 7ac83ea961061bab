"""Loops of a mechanism file over any number type, where each link has an orientation in place of joint values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from assur.verifier.derivations.turning import ClaimedTurn, Hop, IsZero, Triangle, hops, point
from assur.verifier.formula import NumberType, number
from assur.verifier.graph import STEPS, Graph
from assur.verifier.mechanism import COORDINATES, FileMechanism
from assur.verifier.reading import RefusedError
from assur.verifier.vectors import ONE, ZERO, Matrix, Vector, about, add, apply, plus, product, scaled, subtract, times

ANGLES = ("phi", "theta", "psi")
LENGTHS = ("x", "y", "z")
QUATERNION = ("qw", "qx", "qy", "qz")


def given_names(mechanism: FileMechanism, problem: str) -> tuple[list[str], list[str]]:
    """Names of lengths and of angles that are given: inputs, or coordinates of the pose but for a quaternion."""
    if problem == "inverse":
        return [own for own in mechanism.pose if own in LENGTHS], [own for own in mechanism.pose if own in ANGLES]
    kinds = [kind_of(mechanism, *own) for own in mechanism.inputs]
    lengths = [own.name for own, kind in zip(mechanism.printed, kinds, strict=True) if kind == "slide"]
    return lengths, [own.name for own, kind in zip(mechanism.printed, kinds, strict=True) if kind != "slide"]


def has_quaternion(mechanism: FileMechanism, problem: str) -> bool:
    """Whether a unit quaternion is given."""
    return problem == "inverse" and {*QUATERNION} <= {*mechanism.pose}


def of_quaternion(w: Any, x: Any, y: Any, z: Any) -> Matrix:
    """The rotation of a unit quaternion."""

    def entry(i: int, k: int) -> Any:
        square = 2 * (w * w + own[i] * own[i]) - 1
        return square if i == k else 2 * (own[i] * own[k] + (-1 if (k - i) % 3 == 1 else 1) * w * own[3 - i - k])

    own = (x, y, z)
    a, b, c = (tuple(entry(i, k) for k in range(3)) for i in range(3))
    return a, b, c


def kind_of(mechanism: FileMechanism, joint: str, component: str) -> str:
    """What a coordinate of a joint is: a slide or a turn."""
    own = mechanism.joints[joint].type
    return STEPS[own][COORDINATES[own].index(component)][0]


class FileAssembly:
    """The joint graph with what is given of it.

    Args:
        mechanism: as its file has it.
        problem: "direct" or "inverse".
        numbers: the number type.
        names: values of the parameters.
        given: lengths and a unit quaternion by their names, angles as `cos_<name>` and `sin_<name>`.
        zero: whether a number vanishes.
        orientations: as claimed: the platform may turn by the one angle that the pose leaves out, which is zero else.

    Attributes:
        hops: what is said of orientations.
        sliding: "joint.coordinate" -> a length that is given.
    """

    def __init__(
        self,
        mechanism: FileMechanism,
        problem: str,
        numbers: NumberType,
        names: Mapping[str, Any],
        given: Mapping[str, Any],
        zero: IsZero,
        orientations: Sequence[Mapping[str, Any]],
    ) -> None:
        self.graph, self.problem, self.given, self.zero = Graph(mechanism, numbers, names), problem, given, zero
        self.mechanism, self.sliding, self.orientations = mechanism, dict[str, Any](), orientations
        locked: dict[str, tuple[Any, Any]] = {}
        inputs = zip(mechanism.inputs, mechanism.printed, strict=True) if problem == "direct" else ()
        for (joint, component), own in inputs:
            if kind_of(mechanism, joint, component) == "slide":
                offset = number(own.offset, names, numbers)
                self.sliding[f"{joint}.{component}"] = times(own.sense, plus(given[own.name], times(-1, offset)))
                continue
            place = COORDINATES[mechanism.joints[joint].type].index(component)
            cosine, sine = given[f"cos_{own.name}"], given[f"sin_{own.name}"]
            if own.offset not in (0, "0"):
                c, s = numbers.circle(mechanism.angle(own.offset, names, numbers))
                cosine, sine = cosine * c + sine * s, sine * c - cosine * s
            locked[f"{joint} {place}"] = cosine, times(own.sense, sine)
        self.hops = [*hops(self.graph, locked)]
        if has_quaternion(mechanism, problem):
            turned = of_quaternion(*(given[name] for name in QUATERNION))
            self.hops.append(Hop(mechanism.base, mechanism.platform, turned))
        if problem == "inverse" and {*ANGLES} & {*mechanism.pose}:
            left_out = [name for name in ANGLES if name not in mechanism.pose]
            turning = any(own["link"] == mechanism.platform and own["kind"] == "circle" for own in orientations)
            free = ANGLES.index(left_out[0]) if turning and len(left_out) == 1 else len(ANGLES)
            before, after = self._turned(ANGLES[:free]), self._turned(ANGLES[free + 1 :])
            axis = apply(before, ONE[2 - free]) if free < len(ANGLES) else None
            self.hops.append(Hop(mechanism.base, mechanism.platform, product(before, after), axis))

    def _turned(self, names: Sequence[str]) -> Matrix:
        """By angles that are given, as far as they are coordinates of the pose."""
        turn = ONE
        for name in names:
            if name in self.mechanism.pose:
                axis = ONE[2 - ANGLES.index(name)]
                turn = product(turn, about(axis, self.given[f"cos_{name}"], self.given[f"sin_{name}"]))
        return turn

    def claimed(self, own: Mapping[str, Any], vector: Callable[[Any], Vector]) -> ClaimedTurn:
        """An orientation as it is written; its vectors are read."""

        def constant(other: Mapping[str, Any]) -> Matrix:
            a, b, c = map(vector, other["constant"])
            return a, b, c

        axis, hinge, line = (None if own[key] is None else vector(own[key]) for key in ("axis", "hinge", "line"))
        circle, rod, second = (
            None if own.get(key) is None else tuple(map(str, own[key])) for key in ("circle", "rod", "second")
        )
        triangle = None
        if "triangle" in own:
            leader = next(other for other in self.orientations if other["link"] == own["triangle"]["link"])
            triangle = self._triangle(own["triangle"], constant(leader))
        return ClaimedTurn(own["link"], own["kind"], constant(own), axis, circle, hinge, line, rod, second, triangle)

    def _triangle(self, claim: Mapping[str, Any], constant: Matrix) -> Triangle:
        """Balls of a link that is turned by a constant in the frame of its orientation. Errors: RefusedError."""
        link, names = str(claim["link"]), tuple(map(str, claim["joints"]))
        joints = [self.mechanism.joints[name] for name in names]
        if len({*names}) != len(ONE) or not all(link in (own.parent, own.child) for own in joints):
            raise RefusedError(f"{', '.join(names)[:60]} are no three joints of {link[:40]}")
        a, b, c = (apply(constant, point(self.graph, name, link)) for name in names)
        sides = tuple(tuple(map(str, side)) for side in claim["sides"])
        if [len(side) for side in sides] != [len(ONE)] * len(ONE):
            raise RefusedError(f"{link[:40]} has three sides of three components")
        return Triangle(link, names, (a, b, c), sides)

    def slides(self) -> list[str]:
        """Lengths that are sought, as "joint.coordinate"."""
        every = (
            f"{name}.{COORDINATES[joint.type][place]}"
            for name, joint in self.mechanism.joints.items()
            for place, (kind, _) in enumerate(STEPS[joint.type])
            if kind == "slide"
        )
        return [name for name in every if name not in self.sliding]

    def loops(
        self, turns: Mapping[str, ClaimedTurn], values: Mapping[str, Any], sliding: Mapping[str, Any]
    ) -> tuple[list[Any], Vector]:
        """What vanishes where all loops close and the platform is at its pose; and the platform's point.

        Args:
            turns: link -> its orientation.
            values: unknowns of orientations, and what is given.
            sliding: "joint.coordinate" -> a length that is sought.
        """
        lengths = {**self.sliding, **sliding}

        def place(link: str, vector: Vector) -> Vector:
            known, reached = placed[link]
            return add(reached, turns[link].image(subtract(vector, known), values, self.zero))

        def slid(name: str) -> Vector:
            joint, total = self.mechanism.joints[name], ZERO
            for step, (kind, direction) in enumerate(STEPS[joint.type]):
                if kind == "slide":
                    axis = self.graph.joints[name].axes[direction]
                    along = turns[joint.parent].image(axis, values, self.zero)
                    total = add(total, scaled(along, lengths[f"{name}.{COORDINATES[joint.type][step]}"]))
            return total

        placed: dict[str, tuple[Vector, Vector]] = {self.mechanism.base: (ZERO, ZERO)}
        gaps: list[Any] = []
        for name, forward in self.graph.tree:
            joint = self.mechanism.joints[name]
            near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
            end = add(place(near, point(self.graph, name, near)), scaled(slid(name), 1 if forward else -1))
            placed[far] = point(self.graph, name, far), end
        for name in self.graph.cut:
            joint = self.mechanism.joints[name]
            start = add(place(joint.parent, point(self.graph, name, joint.parent)), slid(name))
            gaps += subtract(start, place(joint.child, point(self.graph, name, joint.child)))
        for sides in dict.fromkeys(own.triangle.sides for own in turns.values() if own.triangle is not None):
            gaps += [plus(plus(values[a], values[b]), values[c]) for a, b, c in zip(*sides, strict=True)]
        platform = place(self.mechanism.platform, self.graph.point)
        if self.problem == "inverse":
            for name in self.mechanism.pose:
                if name in LENGTHS:
                    gaps.append(plus(platform[LENGTHS.index(name)], times(-1, self.given[name])))
        return gaps, platform
