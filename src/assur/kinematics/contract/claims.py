"""What a closed form claims, as numbers that must vanish: over any number type that can be drawn and has roots.

A pose, or inputs, and dimensions are drawn; the kernels say the rest; the joint graph's own frames and twists
(`assur.joint_graph.configuration`) are held against it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from types import SimpleNamespace
from typing import Any, Protocol

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import Geometry, written_geometry
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import STILL, UNTURNED, of_quaternion
from assur.kinematics.closed_form.kernel_state import kernel_state, screws
from assur.kinematics.contract.mismatch import Part
from assur.kinematics.modes import Problem, sign_names
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import Branch, Eliminant, PolynomialSystem
from assur.model.file.parameters import parameter_formulas
from assur.model.mechanism import Joint, MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, is_angle, rate_names
from assur.model.written import NumberReading
from assur.numerics import vectors
from assur.numerics.drawn_angles import DrawnAngle, InexactError
from assur.numerics.vectors import Matrix, Vector, minus, plus, times


class DrawnNumbers(Protocol):
    """A namespace whose numbers are drawn."""

    def number(self, value: Any) -> Any:
        """A rational, a float as the simplest one, or the text of a decimal."""

    def uniform(self) -> Any:
        """A number."""

    def circle(self) -> tuple[Any, Any]:
        """Cosine and sine of an angle."""

    def signs(self) -> Any:
        """1 or -1."""

    def sqrt(self, radicand: Any, /) -> Any:
        """A root."""

    def sin(self, angle: Any) -> Any:
        """Sine of an angle."""

    def cos(self, angle: Any) -> Any:
        """Cosine of an angle."""

    def vanishes(self, _number: Any, /) -> bool:
        """Whether a number is zero wherever it is drawn."""

    @property
    def pi(self) -> Any:
        """Half a turn."""

    @property
    def positive(self) -> list[Any]:
        """Numbers that are never negative."""


@dataclass(frozen=True)
class Vanishing:
    """Numbers that must vanish.

    Attributes:
        part, name: of the closed form.
        text: what is wrong where they do not.
        allowed: what the claim is.
        numbers: that must vanish.
    """

    part: Part
    name: str
    text: str
    allowed: str
    numbers: tuple[Any, ...]


@dataclass(frozen=True)
class Rates:
    """The velocity equation: rows over all joint rates, which must be combinations of the closure's rows."""

    closure: tuple[tuple[Any, ...], ...]
    relation: tuple[tuple[Any, ...], ...]


class DrawnProblem:
    """A problem that is drawn, and what the kernels answer.

    Args:
        record: a mechanism with a closed form.
        problem: which kernel answers; the direct problem needs one by signs.
        ns: where numbers are drawn.
        general: whether the dimensions are drawn too; else they are those of the record.
    """

    def __init__(self, record: MechanismRecord, problem: Problem, ns: DrawnNumbers, general: bool) -> None:
        self.record, self.problem, self.ns, self.form = record, problem, ns, closed_form_of(record)
        names = _dimensions(record, ns, general)
        self.geometry: Geometry = written_geometry(record, NumberReading(names, ns, ns.number))
        ns.positive.extend(_positive(record, names, general))
        self.p = SimpleNamespace(**{name: _taken(record, ns, name, value) for name, value in names.items()})
        self.signs = {name: ns.signs() for name in sign_names(record, problem)}
        self.branch: Branch = self._branch(SimpleNamespace(**self.signs))
        joints = self.form.joints(ns, self.p, self.branch.core)
        if any(screws(record)):
            raise InexactError("the angle of a screw beside its cosine")
        self.state, self.rotations = kernel_state(record, joints)
        self.configuration = Configuration(joint_graph(record), self.geometry, self.state)

    def _branch(self, signs: SimpleNamespace) -> Branch:
        ns, record = self.ns, self.record
        if self.problem == "inverse":
            pose = _pose(record, ns)
            if "theta" in record.platform.pose:  # from -90 to 90 deg
                ns.positive.append(pose[record.platform.pose.index("theta")][0])
            return self.form.inverse(ns, self.p, pose, signs)
        kinds = [item.coordinate.kind for item in record.inputs]
        given = tuple(ns.circle() if kind == "angle" else ns.uniform() for kind in kinds)
        if not callable(self.form.direct):
            raise InexactError("a direct problem that is no formula")
        return self.form.direct(ns, self.p, given, signs)

    def claims(self) -> Iterator[Vanishing]:
        """Loops, the platform's pose, and inputs."""
        yield from self._loops()
        yield from self._platform()
        yield from self._inputs()

    def _loops(self) -> Iterator[Vanishing]:
        for name, given in self.rotations.items():
            own = of_quaternion(*self.state[name])
            yield self._joint(name, "its matrix is no rotation", _differences(given, own))
        for joint in self.configuration.graph.joints:
            for step, numbers in zip(joint.type.steps, joint.type.numbers(self.state[joint.name]), strict=True):
                if step.kind == "turn":
                    cosine, sine = numbers
                    size = minus(plus(times(cosine, cosine), times(sine, sine)), 1)
                    yield self._joint(joint.name, "its cosine and sine are those of no angle", (size,))
        for joint in self.configuration.graph.cut:
            distance, turn = self.configuration.gap(joint)
            text = f"the loop does not close at joint {joint.name}"
            yield self._of_branch(text, "every branch must close all loops", (*distance, *_differences(turn, UNTURNED)))

    def _platform(self) -> Iterator[Vanishing]:
        rotation, point = self.configuration.platform
        given = dict(zip(self.record.platform.pose, self.branch.pose, strict=True))
        for k, name in enumerate(LENGTHS):
            if name in given:
                yield self._agreement(f"coordinate {name}", (minus(given[name], point[k]),))
        if QUATERNION[0] in given:
            own = vectors.of_quaternion(*(given[name] for name in QUATERNION))
            yield self._agreement("the orientation", _differences(rotation, own))
        elif any(is_angle(name) for name in given):
            yield self._agreement("the orientation", _angles(self._levelled(rotation), given))

    def _levelled(self, rotation: Matrix) -> Matrix:
        """A rotation; where theta is not given and is none, its sine is the integer 0."""
        if "theta" in self.record.platform.pose or not self.ns.vanishes(rotation[2][0]):
            return rotation
        return rotation[0], rotation[1], (0, *rotation[2][1:])

    def _inputs(self) -> Iterator[Vanishing]:
        for item, value in zip(self.record.inputs, self.branch.inputs, strict=True):
            own = self._values(self.configuration.graph.joint(item.coordinate.joint), item.coordinate.component)
            pairs = zip(own, value if isinstance(value, tuple) else (value,), strict=True)
            yield self._agreement(f"input {item.name}", tuple(minus(a, b) for a, b in pairs))

    def determinants(self) -> Iterator[Vanishing]:
        """Both determinants; last, as factors that divide neither may have roots that exist at few draws."""
        jp, jq = self.form.jacobians(self.ns, self.p, self.branch.core)
        factors = self.form.factors(self.ns, self.p, self.branch.core)
        for label, kind, matrix in (("det Jp", "parallel", jp), ("det Jq", "serial", jq)):
            if len(matrix) != len(matrix[0]):
                continue
            product: Any = 1
            for item in self.form.factor_list:
                if item.kind == kind:
                    product = times(product, factors[item.name])
            allowed = f"{label} must be the product of the factors of kind '{kind}'"
            text = f"{label} is not the product of its factors"
            yield Vanishing("factor", "", text, allowed, (minus(_determinant(matrix), product),))

    def equations(self) -> Iterator[Vanishing]:
        """Those of the direct problem, at poses."""
        direct, ns = self.form.direct if self.problem == "inverse" else None, self.ns
        pose = dict(zip(self.record.platform.pose, self.branch.pose, strict=True))
        allowed = "every pose must solve the equations of the direct problem"
        if isinstance(direct, PolynomialSystem):
            unknowns = direct.lift(ns, self.p, self.branch.pose)
            for k, value in enumerate(direct.equations(ns, self.p, self.branch.inputs, unknowns), 1):
                yield Vanishing(
                    "branch", "", f"equation {k} is not zero at a pose that has these inputs", allowed, (value,)
                )
        elif isinstance(direct, Eliminant) and not direct.signs and direct.unknown in pose:
            cosine, sine = pose[direct.unknown]
            t, total = sine / (1 + cosine), 0
            for factor in reversed(direct.coefficients(ns, self.p, self.branch.inputs)):
                total = factor + t * total
            text = f"the polynomial in {direct.unknown} is not zero at a pose that has these inputs"
            yield Vanishing("branch", "", text, allowed, (total,))

    def rates(self) -> Rates:
        """The velocity equation of the kernel, beside the closure of the joint graph."""
        graph, configuration = self.configuration.graph, self.configuration
        twists = {
            joint.name: [(*angular, *velocity) for angular, velocity in configuration.twists(joint, STILL)]
            for joint in graph.joints
        }
        count = sum(map(len, twists.values()))
        closure: list[list[Any]] = []
        for joint, loop in zip(graph.cut, graph.loops, strict=True):
            rows: list[list[Any]] = [[0] * count for _ in range(6)]
            for name, sense in ((joint.name, 1), *loop.items()):
                for column, twist in enumerate(twists[name], start=graph.slices[name].start):
                    for row, number in zip(rows, twist, strict=True):
                        row[column] = times(sense, number)
            closure += rows
        jp, jq = self.form.jacobians(self.ns, self.p, self.branch.core)
        pose = self._pose_rates(count)
        relation = []
        for left, right in zip(jp, jq, strict=True):
            row = [_dot(left, [rate[column] for rate in pose]) for column in range(count)]
            for factor, item in zip(right, self.record.inputs, strict=True):
                row[item.coordinate.index] = minus(row[item.coordinate.index], factor)
            relation.append(tuple(row))
        return Rates(tuple(map(tuple, closure)), tuple(relation))

    def _pose_rates(self, count: int) -> list[list[Any]]:
        """Rates of the pose's coordinates per rate of each joint coordinate."""
        graph = self.configuration.graph
        rotation, point = self.configuration.platform
        rotation = self._levelled(rotation)
        columns: list[tuple[Vector, Vector]] = [(STILL, STILL)] * count
        for name, sense in graph.paths[graph.platform].items():
            start = graph.slices[name].start
            for column, (angular, velocity) in enumerate(self.configuration.twists(graph.joint(name), point), start):
                columns[column] = (
                    (times(sense, angular[0]), times(sense, angular[1]), times(sense, angular[2])),
                    (times(sense, velocity[0]), times(sense, velocity[1]), times(sense, velocity[2])),
                )
        given = dict(zip(self.record.platform.pose, self.branch.pose, strict=True))
        names = rate_names(self.record.platform.pose)
        return [[_rate(name, rotation, given, *column) for column in columns] for name in names]

    def _values(self, joint: Joint, component: str) -> tuple[Any, ...]:
        """The numbers of one coordinate."""
        numbers = joint.type.numbers(self.state[joint.name])
        return next(own for name, own in zip(joint.type.components, numbers, strict=True) if name == component)

    def _of_branch(self, text: str, allowed: str, numbers: Sequence[Any]) -> Vanishing:
        return Vanishing("branch", "", text, allowed, tuple(numbers))

    def _joint(self, name: str, text: str, numbers: Sequence[Any]) -> Vanishing:
        allowed = "every joint's value must be a length, an angle or a rotation"
        return Vanishing("joint", name, text, allowed, tuple(numbers))

    def _agreement(self, what: str, numbers: Sequence[Any]) -> Vanishing:
        text = f"{what} is not what the joint values say"
        return Vanishing("branch", "", text, "pose, inputs and joints must agree", tuple(numbers))


def _dimensions(record: MechanismRecord, ns: DrawnNumbers, general: bool) -> dict[str, Any]:
    """What parameters are: drawn, or by their formulas; angles as angles."""
    if general:
        return {
            name: DrawnAngle({name: Fraction(1)}) if item.angular else ns.uniform()
            for name, item in record.parameters.items()
        }
    formulas = parameter_formulas(record)
    values: dict[str, Any] = {}
    while len(values) < len(formulas):
        for name, formula in formulas.items():
            if name not in values and formula.names <= values.keys():
                values[name] = NumberReading(values, ns, ns.number).value(formula)
    return values


def _positive(record: MechanismRecord, names: Mapping[str, Any], general: bool) -> Iterator[Any]:
    """Dimensions that are positive: of those that are drawn as the file says, of its own as they are."""
    for name, item in record.parameters.items():
        if not isinstance(names[name], DrawnAngle):
            own = getattr(record.values, name)
            if item.sign == "positive" or (not general and own):
                yield names[name] if own > 0 else -names[name]


def _taken(record: MechanismRecord, ns: DrawnNumbers, name: str, value: Any) -> Any:
    """A dimension as a kernel takes it: an angle as cosine and sine."""
    return (ns.cos(value), ns.sin(value)) if record.parameters[name].angular else value


def _pose(record: MechanismRecord, ns: DrawnNumbers) -> tuple[Any, ...]:
    names = record.platform.pose
    if QUATERNION[0] not in names:
        return tuple(ns.circle() if is_angle(name) else ns.uniform() for name in names)
    w, x, y, z = (ns.uniform() for _ in QUATERNION)
    size = w * w + x * x + y * y + z * z  # the square of a quaternion, over its size, is a unit one
    parts = (w * w - x * x - y * y - z * z) / size, 2 * w * x / size, 2 * w * y / size, 2 * w * z / size
    unit = dict(zip(QUATERNION, parts, strict=True))
    return tuple(unit[name] if name in unit else ns.uniform() for name in names)


def _angles(rotation: Matrix, given: Mapping[str, Any]) -> tuple[Any, ...]:
    """Numbers that vanish where a rotation has these angles; a pose that leaves some out says nothing of them."""
    names = [name for name in ANGLES if name in given]
    if len(names) == len(ANGLES):
        turned = [about(given[name]) for about, name in zip(_ABOUT, names, strict=True)]
        return _differences(rotation, vectors.product(turned[0], vectors.product(turned[1], turned[2])))
    cosine = given["theta"][0] if "theta" in given else 1 if _is_zero(rotation[2][0]) else None
    pairs = {"phi": (rotation[0][0], rotation[1][0]), "psi": (rotation[2][2], rotation[2][1])}
    numbers = [plus(rotation[2][0], given["theta"][1])] if "theta" in given else []
    for name, (first, second) in pairs.items():
        if name in given and cosine is not None:
            numbers += [minus(first, times(cosine, given[name][0])), minus(second, times(cosine, given[name][1]))]
        elif name in given:
            numbers.append(minus(times(first, given[name][1]), times(second, given[name][0])))
    return tuple(numbers)


_ABOUT = (vectors.about_z, vectors.about_y, vectors.about_x)


def _rate(name: str, rotation: Matrix, given: Mapping[str, Any], angular: Vector, velocity: Vector) -> Any:
    """The rate of a coordinate at an angular velocity, and a velocity of the platform's point."""
    if name in LENGTHS:
        return velocity[LENGTHS.index(name)]
    if name in ("wx", "wy", "wz"):
        return angular["xyz".index(name[1])]
    if "theta" not in given and not _is_zero(rotation[2][0]):
        raise InexactError("angles of a platform whose theta is not given")
    cosine, sine = given.get("theta", (1, 0))
    along, across = (  # times the cosine of theta
        plus(times(rotation[0][0], angular[0]), times(rotation[1][0], angular[1])),
        minus(times(rotation[0][0], angular[1]), times(rotation[1][0], angular[0])),
    )
    if name == "theta":
        return _over(across, cosine)
    psi = _over(_over(along, cosine), cosine)
    return psi if name == "psi" else plus(angular[2], times(sine, psi))


def _over(a: Any, b: Any) -> Any:
    return a if (type(b) is int and b == 1) or _is_zero(a) else a / b


def _is_zero(number: Any) -> bool:
    return type(number) is int and number == 0


def _differences(first: Matrix, second: Matrix) -> tuple[Any, ...]:
    return tuple(minus(a, b) for one, other in zip(first, second, strict=True) for a, b in zip(one, other, strict=True))


def _dot(first: Sequence[Any], second: Sequence[Any]) -> Any:
    total: Any = 0
    for a, b in zip(first, second, strict=True):
        total = plus(total, times(a, b))
    return total


def _determinant(matrix: Sequence[Sequence[Any]]) -> Any:
    """By minors of the last rows, each once: no division."""
    minors: dict[tuple[int, ...], Any] = {(): 1}
    for row in reversed(matrix):
        larger: dict[tuple[int, ...], Any] = {}
        for chosen, minor in minors.items():
            for column, entry in enumerate(row):
                if column not in chosen and not _is_zero(entry) and not _is_zero(minor):
                    columns = tuple(sorted((*chosen, column)))
                    term = times(entry, minor)
                    term = term if columns.index(column) % 2 == 0 else times(-1, term)
                    larger[columns] = plus(larger.get(columns, 0), term)
        minors = larger
    return minors.get(tuple(range(len(matrix))), 0)
