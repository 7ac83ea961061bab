"""Whether the formulas of a certificate close the joint graph of a mechanism file: exactly, but for a small error.

The formulas say where the joints stand at a pose, in one working mode. Modulo a prime that is drawn anew, at poses,
rates, signs of roots and, if the certificate says so, dimensions that are drawn, the plain joint graph of the file must
close with these joints, its platform be at the pose, its velocities obey Jp v = Jq q', and both determinants be the
products of their factors.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from assur.verifier.field import CircleField, Element, NoExactError, NoRootError
from assur.verifier.formula import AngleSum, FloatNumbers
from assur.verifier.graph import SIZES, STEPS, Frame, Graph
from assur.verifier.mechanism import COORDINATES, mechanism
from assur.verifier.places import CIRCLE, DrawnPlace, FormulaTape, RatedNumber, RootPlan, Sizing
from assur.verifier.reading import AT_PLACES, EXACT, OF_THESE, RefusedError
from assur.verifier.sizes import Size
from assur.verifier.vectors import (
    ONE,
    ZERO,
    Matrix,
    Vector,
    about,
    add,
    apply,
    cross,
    plus,
    product,
    scaled,
    subtract,
    times,
    transposed,
)

SURE = 1e-15
ENOUGH = 1e-18
LEAST, MOST = 72, 5000
"""Places at which roots are looked at, and that are tried at most."""
NEAR = 1e-12
"""Share by which a dimension in the formulas may differ from the file's: two programs round differently."""
Claim = tuple[str, Any]


def closes(document: Mapping[str, Any], text: str) -> dict[str, Any] | None:
    """How sure it is that the formulas close the joint graph, as the certificate says: prime, places, degree and error.

    None where it says so of places only, and that is all that can be seen.

    Args:
        document: a certificate, as `assur.verifier.reading.read` gives it.
        text: the mechanism's file.

    Errors:
        RefusedError: they do not, or do where it says less, or the file is not that of the certificate's dimensions.
    """
    says, program = document["exact"]["says"], document["program"]
    for kind in ("parallel", "serial"):
        own = document["exact"][kind]
        if own != [name for name, _ in program["factors"] if name in own]:
            raise RefusedError(f"factors of kind {kind!r} that are not those of the formulas in their order")
    if says == EXACT:
        return _result(document, text, general=True)
    for general in (True,) if says == OF_THESE else (True, False):
        if _closes(document, text, general):
            which = "any dimensions" if general else "the dimensions of the file"
            raise RefusedError(f"{says!r} is claimed, but they close the joint graph with {which}, exactly")
    return None if says == AT_PLACES else _result(document, text, general=False)


def _closes(document: Mapping[str, Any], text: str, general: bool) -> bool:
    try:
        return bool(_result(document, text, general))
    except RefusedError:
        return False


def _result(document: Mapping[str, Any], text: str, general: bool) -> dict[str, Any]:
    try:
        return _Check(document, text, general).result()
    except (ArithmeticError, ValueError, KeyError, TypeError, IndexError, AttributeError, RecursionError) as error:
        raise RefusedError(f"the formulas do not fit the mechanism file: {type(error).__name__}: {error}") from error


class _Check:
    def __init__(self, document: Mapping[str, Any], text: str, general: bool) -> None:
        statement, program = document["statement"], document["program"]
        changed = {name: float.fromhex(value) for name, value in statement["parameters"].items()}
        self.mechanism = mechanism(text, changed)
        self.held = frozenset(statement["held"])
        self.coordinates = {*statement["coordinates"], *self.held}
        self.program, self.general = program, general
        self.kinds: Mapping[str, Sequence[str]] = {name: document["exact"][name] for name in ("parallel", "serial")}
        groups = ("joints", "jp", "jq", "factors")
        self.places = {group: dict(map(tuple, program[group])) for group in groups}
        outputs = [k for group in self.places.values() for k in group.values()]
        self.formulas = FormulaTape(program["operations"], outputs)
        self._numbers(statement)

    def _numbers(self, statement: Mapping[str, Any]) -> None:
        """The numbers with names are those of the file and of the statement; both ends of each are the same.

        Of the cosine and the sine of an angle among the dimensions they are bounds.
        """
        own = self.mechanism.dimensions(FloatNumbers())
        floats = {n: FloatNumbers().radians(v) if isinstance(v, AngleSum) else float(v) for n, v in own.items()}
        floats |= {name: float.fromhex(value) for name, value in statement["held"].items()}
        for k in self.formulas.order:
            name, *arguments = self.formulas.operations[k]
            if name == "number":
                low, high = (float.fromhex(text) for text in arguments[:2])
                part, _, angle = arguments[2].partition(" ")
                if part in CIRCLE and angle in floats:
                    turned = {"cos": math.cos, "sin": math.sin}[part](floats[angle])
                    if not low <= turned <= high <= low + NEAR:
                        raise RefusedError(f"{arguments[2]} is {low} to {high}, and {turned} in the mechanism file")
                    continue
                expected = floats.get(arguments[2], low)
                if low != high or abs(low - expected) > NEAR * abs(expected):
                    raise RefusedError(f"{arguments[2] or 'a number'} is {low}, and {expected} in the mechanism file")

    def result(self) -> dict[str, Any]:
        """Look at places until the error is small enough."""
        field, roots = CircleField(), RootPlan()
        place = checked = 0
        guarded = False
        while place < LEAST or checked < self._enough(roots):
            if place >= MOST:
                raise RefusedError(f"the formulas have values at {checked} of {place} places only")
            place += 1
            ns = DrawnPlace(place, self.mechanism, field, roots, self.general)
            try:
                values = self.formulas.values(ns, self.mechanism, self.held)
                if checked < self._enough(roots):
                    self._look(ns, values, field)
                    checked += 1
            except NoRootError:
                continue
            guarded = guarded or ns.guarded
        degree, error = self._error(field, roots, checked, place)
        if error >= SURE:
            raise RefusedError(f"the degrees of the formulas leave an error of {error:.0e}")
        return {"prime": str(field.p), "places": checked, "degree": degree, "error": error, "guards_left_out": guarded}

    def _enough(self, roots: RootPlan) -> int:
        """So many places show an error that is there for some signs of tied roots."""
        share = 2.0**-roots.tied
        return 2 if share == 1 else math.ceil(math.log(ENOUGH) / math.log(1 - share))

    def _look(self, ns: DrawnPlace, values: Mapping[int, Any], field: CircleField) -> None:
        for what, number in self.claims(ns, values):
            wrong = number if isinstance(number, Element) else field.number(Fraction(number))
            if not wrong.zero:
                which = "any dimensions" if self.general else "the dimensions of the file"
                raise RefusedError(f"the formulas do not close the joint graph with {which}: {what} (modulo {field.p})")

    def _error(self, field: CircleField, roots: RootPlan, checked: int, places: int) -> tuple[float, float]:
        """The largest degree, and how likely it is that something is wrong and was not seen."""
        ns = Sizing(self.mechanism, roots, self.general)
        degree = error = 0.0
        some = 2.0**-roots.tied
        for _, number in self.claims(ns, self.formulas.values(ns, self.mechanism, self.held)):
            if isinstance(number, Size):
                own, bits = number.whole
                share = min(1.0, own * places / max(checked, 1) / field.p)
                error += field.missed(bits) + (1 - some + some * share) ** checked
                degree = max(degree, own)
        return degree, error

    def claims(self, ns: DrawnPlace | Sizing, values: Mapping[int, Any]) -> Iterator[Claim]:
        """Numbers that must vanish."""
        state, rates = self._state(values)
        graph = Graph(self.mechanism, ns, ns.names)
        frames = graph.frames(state)
        for name, joint in self.mechanism.joints.items():
            yield from _numbers_of(name, joint.type, state[name])
        for name in graph.cut:
            distance, turn = graph.gap(name, state, frames)
            yield from ((f"the loop at joint {name} does not close", number) for number in distance)
            yield from ((f"the loop at joint {name} does not close", number) for number in _apart(turn, ONE))
        motions = _motions(graph, state, frames, rates)
        rotation, origin = frames[self.mechanism.platform]
        point = add(origin, apply(rotation, graph.point))
        yield from self._platform(ns, rotation, point)
        yield from self._velocities(graph, motions, point, ns, rates, values)
        yield from self._determinants(values)

    def _state(self, values: Mapping[int, Any]) -> tuple[dict[str, list[Any]], dict[str, list[Any]]]:
        """Numbers of each joint, and the rates of its coordinates."""
        state: dict[str, list[Any]] = {}
        rates: dict[str, list[Any]] = {}
        for name, joint in self.mechanism.joints.items():
            kinds = [kind for kind, _ in STEPS[joint.type]]
            if "screw" in kinds:
                raise NoExactError("the angle of a screw beside its cosine")
            count = sum(SIZES[kind] for kind in kinds)
            both = [_both(values[self.places["joints"][f"{name} {k}"]]) for k in range(count)]
            state[name], rates[name], start = [value for value, _ in both], [], 0
            for kind in kinds:
                rates[name] += _rates(kind, both[start : start + SIZES[kind]])
                start += SIZES[kind]
        return state, rates

    def _platform(self, ns: DrawnPlace | Sizing, rotation: Matrix, point: Vector) -> Iterator[Claim]:
        for k, name in enumerate("xyz"):
            if name in self.coordinates:
                yield f"the platform's {name} is another", plus(ns.given[name].value, times(-1, point[k]))
        angles = [name for name in ("phi", "theta", "psi") if name in self.coordinates]
        circles = {name: [_both(part)[0] for part in ns.circle(AngleSum({f" {name}": Fraction(1)}))] for name in angles}
        if len(angles) == 3:
            turned = (about(axis, *circles[name]) for name, axis in zip(angles, reversed(ONE), strict=True))
            expected = product(product(next(turned), next(turned)), next(turned))
            yield from (("the platform's orientation is another", number) for number in _apart(rotation, expected))
        elif angles:
            cosine, sine = circles.get("theta", (1, 0))  # between -90 and 90 deg; of a pose without it, zero
            yield "the platform's theta is another", plus(rotation[2][0], sine)
            first = {"phi": (rotation[0][0], rotation[1][0]), "psi": (rotation[2][2], rotation[2][1])}
            for name in angles:
                for number, own in zip(first.get(name, ()), circles[name], strict=False):
                    yield f"the platform's {name} is another", plus(number, times(-1, times(cosine, own)))

    def _velocities(
        self,
        graph: Graph,
        motions: Mapping[str, tuple[Vector, Vector]],
        point: Vector,
        ns: DrawnPlace | Sizing,
        rates: Mapping[str, Sequence[Any]],
        values: Mapping[int, Any],
    ) -> Iterator[Claim]:
        """Loops stay closed, and Jp v = Jq q' for the motion."""
        for name, apart in _loops(graph, motions):
            yield from ((f"velocities of the loop at joint {name} do not fit", number) for number in apart)
        angular, velocity = motions[self.mechanism.platform]
        moving = add(velocity, cross(angular, point))
        pose = [name for name in self.mechanism.pose if not name.startswith("q")]
        v = [ns.rates[name] if name not in "xyz" else moving["xyz".index(name)] for name in pose]
        v += angular if "qw" in self.mechanism.pose else ()
        driven = [rates[joint][COORDINATES[self.mechanism.joints[joint].type].index(part)]
                  for joint, part in self.mechanism.inputs]  # fmt: skip
        for row in range(max(int(name.split(",")[0]) for name in self.places["jp"]) + 1):
            total: Any = 0
            for group, sense, own in (("jp", 1, v), ("jq", -1, driven)):
                for column, number in enumerate(own):
                    entry = self._entry(group, row, column, values)
                    total = plus(total, times(sense, times(entry, number)))
            yield f"row {row + 1} of Jp v = Jq q' does not hold", total

    def _determinants(self, values: Mapping[int, Any]) -> Iterator[Claim]:
        for group, kind in (("jp", "parallel"), ("jq", "serial")):
            rows, columns = (max(int(name.split(",")[k]) for name in self.places[group]) + 1 for k in (0, 1))
            if rows != columns:
                continue
            matrix = [[self._entry(group, row, column, values) for column in range(rows)] for row in range(rows)]
            factors: Any = 1
            for name in self.kinds[kind]:
                factors = times(factors, _both(values[self.places["factors"][name]])[0])
            label = f"det {group.capitalize()} is not the product of its factors"
            yield label, plus(_determinant(matrix), times(-1, factors))

    def _entry(self, group: str, row: int, column: int, values: Mapping[int, Any]) -> Any:
        return _both(values[self.places[group][f"{row},{column}"]])[0]


def _both(number: Any) -> tuple[Any, Any]:
    """Value and rate; of rationals 0, 1 and -1 integers."""
    if isinstance(number, RatedNumber):
        return number.value, number.rate
    if isinstance(number, Fraction) and number in (0, 1, -1):
        return int(number), 0
    return number, 0


def _rates(kind: str, numbers: Sequence[tuple[Any, Any]]) -> list[Any]:
    """Rates of a length, of an angle by its cosine and sine, or the angular velocity of a rotation in the parent."""
    if kind == "slide":
        return [numbers[0][1]]
    if kind == "turn":
        (cosine, falling), (sine, rising) = numbers
        return [plus(times(cosine, rising), times(-1, times(sine, falling)))]
    rows = [tuple(numbers[3 * k : 3 * k + 3]) for k in range(3)]
    turn, change = (tuple(tuple(entry[k] for entry in row) for row in rows) for k in (0, 1))
    spin = product(change, transposed(turn))  # type: ignore[arg-type]
    return [spin[2][1], spin[0][2], spin[1][0]]


def _numbers_of(name: str, kind: str, numbers: Sequence[Any]) -> Iterator[Claim]:
    """Cosine and sine are those of an angle, and nine numbers a rotation."""
    start = 0
    for step, _ in STEPS[kind]:
        own = numbers[start : start + SIZES[step]]
        start += SIZES[step]
        if step == "turn":
            size = plus(times(own[0], own[0]), times(own[1], own[1]))
            yield f"joint {name} has cosine and sine of no angle", plus(size, -1)
        elif step == "ball":
            turn = (tuple(own[:3]), tuple(own[3:6]), tuple(own[6:]))
            for number in _apart(product(turn, transposed(turn)), ONE):
                yield f"joint {name} has no rotation", number
            yield f"joint {name} has no rotation", plus(_determinant(turn), -1)


def _motions(
    graph: Graph, state: Mapping[str, Sequence[Any]], frames: Mapping[str, Frame], rates: Mapping[str, Sequence[Any]]
) -> dict[str, tuple[Vector, Vector]]:
    """Angular velocity of each link, and its velocity at the base's origin; of each joint what it adds, by its name."""
    result: dict[str, tuple[Vector, Vector]] = {graph.mechanism.base: (ZERO, ZERO)}
    for name in graph.mechanism.joints:
        total: tuple[Vector, Vector] = (ZERO, ZERO)
        for (angular, velocity), rate in zip(graph.twists(name, state, frames), rates[name], strict=True):
            total = add(total[0], scaled(angular, rate)), add(total[1], scaled(velocity, rate))
        result[f" {name}"] = total
    for name, forward in graph.tree:
        joint, own = graph.mechanism.joints[name], result[f" {name}"]
        near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
        join = add if forward else subtract
        result[far] = join(result[near][0], own[0]), join(result[near][1], own[1])
    return result


def _loops(graph: Graph, motions: Mapping[str, tuple[Vector, Vector]]) -> Iterator[tuple[str, Vector]]:
    """How a cut joint's child moves along the tree, less how it moves through the joint."""
    for name in graph.cut:
        joint = graph.mechanism.joints[name]
        for k in (0, 1):
            yield name, subtract(add(motions[joint.parent][k], motions[f" {name}"][k]), motions[joint.child][k])


def _apart(first: Matrix, second: Matrix) -> list[Any]:
    return [plus(a, times(-1, b)) for x, y in zip(first, second, strict=True) for a, b in zip(x, y, strict=True)]


def _determinant(matrix: Sequence[Sequence[Any]]) -> Any:
    """By the first row."""
    if len(matrix) == 1:
        return matrix[0][0]
    total: Any = 0
    for k, entry in enumerate(matrix[0]):
        if type(entry) is int and entry == 0:
            continue
        minor = [[*row[:k], *row[k + 1 :]] for row in matrix[1:]]
        total = plus(total, times((-1) ** k, times(entry, _determinant(minor))))
    return total
