"""Where the platform certainly is while dimensions and inputs stay within their tolerances: bounds by intervals.

Unknown are the passive joints q, off by d are dimensions and inputs. Independent equations F(q, d) = 0 of the loops,
as many as joints are unknown, have bounds J and G of their derivatives over boxes of q and d. With Y about the inverse
of J and m the nominal q, every zero near by lies in

    m - Y F(m, 0) - Y G d + (I - Y J) (q - m),

and if that lies inside the box of q there is exactly one for each d (Krawczyk's test with parameters). The mean value
theorem then bounds the pose: x(m, 0) + (x_d - x_q J^-1 G) d. In an overconstrained mechanism the equations that are
left out hold for dimensions that assemble; of these the bounds are. A rod's spin is held, it moves nothing else.

Where x certainly rises with d_k all over the box, it is largest at the end of d_k. So the bounds of each coordinate are
drawn in: what has a sign is put at its end, the rest is bounded again there, and the zero is the same one as it lies
in the box in which there is one. Nothing has to be split, however many dimensions are off.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Placed
from assur.joint_graph.geometry import joint_scales
from assur.joint_graph.tree import joint_graph
from assur.kinematics.certified.enclosed import enclosed, loop_rows
from assur.kinematics.certified.given import number
from assur.kinematics.certified.platform import pose_parts
from assur.kinematics.closure import closing_system
from assur.machine.accuracy.toleranced_geometry import toleranced_geometry
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, QUATERNION
from assur.numerics.dual import Dual
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.shapes import broadcast, stack
from assur.numerics.krawczyk import total
from assur.work import stage

FloatArray = NDArray[np.float64]
DEPENDENT = 1e-7
"""Length of a row, the largest entry of all being 1, below which an equation counts as dependent on those before."""
GROWTH, TRIES = 1.5, 8
"""By how much boxes of joint values are widened until the test holds, and how often."""
FLOOR = 1e-12
"""Half the width of a box at least, in characteristic lengths and rad."""
ROUNDING = 1.0 + 1e-12
"""Above what sums of a few hundred floats are off by, as a share."""


@dataclass(frozen=True, eq=False)
class ProvedPoses:
    """Bounds (low, high) of each coordinate of the pose, in the mechanism's unit and rad; and why there are none."""

    bounds: Mapping[str, tuple[float, float]]
    resists: str = ""


@dataclass(frozen=True, eq=False)
class _Slopes:
    """Values (r,) and bounds (r, q + t) of the derivatives of equations, and those of coordinates of the pose.

    `whole` is whether the frames at all cuts certainly differ by less than a quarter turn.
    """

    values: Interval
    rows: Interval
    pose: dict[str, Interval]
    whole: bool


@stage("proved poses")
def proved_poses(record: MechanismRecord, values: FloatArray, off: Mapping[str, float]) -> ProvedPoses:
    """Bounds of the pose at joint values (n,) near home's assembly while copies and inputs are off by at most `off`.

    Angles of a quaternion have none.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> own = proved_poses(record, home_values(record), {"l1": 0.05, "rod1.l2": 0.02})
    >>> low, high = own.bounds["y"]
    >>> round(high - low, 3)
    0.053
    """
    names = tuple(off)
    bounds = np.array([off[name] for name in names])
    chosen = _independent(record, values)
    if chosen is None:
        return ProvedPoses({}, "the inputs do not hold the platform firmly enough")
    equations, unknown = chosen
    centre = _centre(record, values)[unknown]
    graph = _Graph(record, values, names, equations, unknown)
    whole = _proof(graph, centre, bounds)
    if whole is None:
        return ProvedPoses({}, "the tolerances are too wide, or a singularity is too near")
    return ProvedPoses(
        {name: (_end(whole, name, -1.0, bounds), _end(whole, name, 1.0, bounds)) for name in whole.bounds}
    )


@dataclass(frozen=True, eq=False)
class _Proof:
    """One zero for each d: the box of joints (q,) that holds all of them, bounds of coordinates and of their slopes.

    Attributes:
        graph: of what.
        centre: (q,) joint values.
        unique: (q,) the box in which there is one zero.
        moved: (q, t) change of the joints per what is off, in floats.
        bounds: of each coordinate.
        slopes: (t,) of each coordinate, by what is off.
    """

    graph: _Graph
    centre: FloatArray
    unique: Interval
    moved: FloatArray
    bounds: dict[str, tuple[float, float]]
    slopes: dict[str, Interval]


def _proof(graph: _Graph, centre: FloatArray, bounds: FloatArray) -> _Proof | None:
    """Of zeros near joint values (q,) while what is off stays within bounds (t,)."""
    count, scale = len(centre), joint_scales(graph.record)[graph.unknown]
    nominal = graph.slopes(Interval.of(centre), Interval.of(np.zeros(len(bounds))))
    middle = nominal.rows.middle
    answers = np.linalg.lstsq(middle[:, :count], np.column_stack([middle[:, count:], nominal.values.middle]))[0]
    half = GROWTH * np.abs(answers) @ np.append(bounds, 1.0) + FLOOR * scale
    allowed = Interval.of(-bounds, bounds)
    for _ in range(TRIES):
        box = Interval.of(centre - half, centre + half)
        over = graph.slopes(box, allowed)
        parts = _image(nominal, over)
        if parts is None:
            return None
        rest, answer, start = parts
        reach = (_applied(rest, Interval.of(-half, half)) - start - _applied(answer, allowed)).magnitude
        if not np.all(np.isfinite(reach)):
            return None
        if np.all(reach < half):  # proved; what lies in the image is less, and has closer bounds
            closer = graph.slopes(Interval.of(centre - reach, centre + reach), allowed)
            again = _image(nominal, closer)
            if again is None or not over.whole:
                return None
            own, slopes = _bounded(graph.record, nominal, closer, again, allowed, scale)
            return _Proof(graph, centre, box, np.asarray(-answers[:, :-1], dtype=np.float64), own, slopes)
        half = GROWTH * reach + FLOOR * scale
    return None


def _end(whole: _Proof, name: str, sense: float, bounds: FloatArray) -> float:
    """The largest that a coordinate can be, or the least where `sense` is -1.

    What it certainly rises or falls with is put at its end, and again, as more of the rest then has a sign.
    """
    proof, side = whole, 1 if sense > 0.0 else 0
    end = whole.bounds[name][side]
    while True:
        slopes, graph = proof.slopes[name], proof.graph
        signs = sense * (slopes.positive.astype(float) - slopes.negative.astype(float))
        free = signs == 0.0
        if np.all(free):
            return end
        ends = dict(zip(graph.names, (signs * bounds).tolist(), strict=True))
        names = tuple(own for own, left in zip(graph.names, free, strict=True) if left)
        fixed = {**graph.fixed, **{own: off for own, off in ends.items() if own not in names}}
        centre = proof.centre + proof.moved @ (signs * bounds)
        bounds = bounds[free]
        at_ends = _proof(replace(graph, names=names, fixed=fixed), centre, bounds)
        if at_ends is None or not np.all(at_ends.unique.within(whole.unique)):
            return end
        proof, end = at_ends, sense * min(sense * end, sense * at_ends.bounds[name][side])


def _image(nominal: _Slopes, over: _Slopes) -> tuple[Interval, Interval, Interval] | None:
    """I - Y J, Y G and Y F(m, 0); None where Y does not exist."""
    count = len(nominal.values.low)
    middle = over.rows.middle[:, :count]
    if not np.all(np.isfinite(middle)) or np.linalg.det(middle) == 0.0:
        return None
    inverse = Interval.of(np.linalg.inv(middle))
    rest = Interval.of(np.eye(count)) - _product(inverse, over.rows[:, :count])
    return rest, _product(inverse, over.rows[:, count:]), _applied(inverse, nominal.values)


@dataclass(frozen=True, eq=False)
class _Graph:
    """The chosen equations of a joint graph near joint values (n,), over unknown joints and what is off.

    What is `fixed` is off by a number.
    """

    record: MechanismRecord
    values: FloatArray
    names: tuple[str, ...]
    equations: Sequence[int]
    unknown: Sequence[int]
    fixed: Mapping[str, float] = field(default_factory=dict)

    def slopes(self, joints: Interval, off: Interval) -> _Slopes:
        """Values and derivatives over boxes of the unknown joints (q,) and of what is off (t,)."""
        count = len(self.unknown) + len(self.names)
        unit = np.eye(count)
        boxes = [*(joints[[k]] for k in range(len(self.unknown))), *(off[[k]] for k in range(len(self.names)))]
        duals = [Dual(part, Interval.of(unit[:, [k]])) for k, part in enumerate(boxes)]
        shifts: dict[str, Any] = dict(zip(self.names, duals[len(self.unknown) :], strict=True))
        shifts |= {name: Interval.of(np.array([value])) for name, value in self.fixed.items()}
        numbers: list[Any] = [Interval.of(np.array([value])) for value in _centre(self.record, self.values)]
        for place, dual in zip(self.unknown, duals, strict=False):
            numbers[place] = dual
        for item in self.record.drives:
            if item.name in shifts:
                numbers[item.coordinate.index] = shifts[item.name] * item.sign + self.values[item.coordinate.index]
        near = enclosed(self.record, self.values[None], numbers)
        configuration = type(near)(near.graph, toleranced_geometry(self.record, shifts), near.state)
        rows, positive = loop_rows(configuration)
        chosen = [rows[k] for k in self.equations]
        pose = {name: _slope(value, count) for name, value in _coordinates(self.record, configuration.platform).items()}
        exact = pose_parts(self.record.platform.pose, _plain(configuration.platform))
        pose |= {f"value {name}": number(part) for name, part in zip(self.record.platform.pose, exact, strict=True)}
        return _Slopes(
            values=stack([broadcast(_value(row), (1,)) for row in chosen], axis=0)[:, 0],
            rows=stack([_slope(row, count) for row in chosen], axis=0),
            pose=pose,
            whole=all(bool(np.all(_value(number_).positive)) for number_ in positive),
        )


def _centre(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Joint values (n,), those of balls counted from where they stand."""
    centre = values.copy()
    for turn in joint_graph(record).turns:
        centre[turn] = 0.0
    return centre


def _independent(record: MechanismRecord, values: FloatArray) -> tuple[list[int], list[int]] | None:
    """Equations of the loops and unknown joints, as many, by elimination in floats; what is left of joints is idle."""
    driven = {item.coordinate.index for item in record.drives}
    passive = [k for k in range(len(values)) if k not in driven]
    slopes = closing_system(record, values[None], None)[1][0][:, passive] * joint_scales(record)[passive]
    left = slopes / max(float(np.max(np.abs(slopes), initial=0.0)), 1e-300)
    rows: list[int] = []
    columns: list[int] = []
    while True:
        row, column = np.unravel_index(int(np.argmax(np.abs(left))), left.shape)
        if abs(left[row, column]) <= DEPENDENT:
            return (sorted(rows), [passive[k] for k in sorted(columns)]) if rows else None
        rows.append(int(row))
        columns.append(int(column))
        left = left - np.outer(left[:, column], left[row]) / left[row, column]
        left[row], left[:, column] = 0.0, 0.0


def _bounded(
    record: MechanismRecord,
    nominal: _Slopes,
    over: _Slopes,
    parts: tuple[Interval, Interval, Interval],
    allowed: Interval,
    scale: FloatArray,
) -> tuple[dict[str, tuple[float, float]], dict[str, Interval]]:
    """Bounds of the coordinates by the mean value theorem, and of their slopes (t,) by what is off.

    `parts` are I - Y J, Y G and Y F(m, 0).
    """
    rest, answer, start = parts
    count = len(scale)
    whole = stack([*(answer[:, k] for k in range(answer.shape[1])), start], axis=1)  # (q, t + 1)
    size = np.max(whole.magnitude / scale[:, None], axis=0) * ROUNDING
    share = float(np.max(np.sum(rest.magnitude * scale / scale[:, None], axis=1))) * ROUNDING
    more = ROUNDING * share / (1.0 - share) * size * scale[:, None] if share < 1.0 else np.full(whole.shape, np.inf)
    moved = whole + Interval.of(-more, more)
    for _ in range(2):
        moved = whole + _product(rest, moved)  # what it encloses is so made of itself
    bounds, slopes = {}, {}
    for name in record.platform.pose:
        if name in QUATERNION:
            continue
        slope = over.pose[name]
        along = total(moved * slope[:count][:, None], axis=0)
        slopes[name], base = slope[count:] - along[:-1], nominal.pose[f"value {name}"] - along[[-1]]
        reached = base + total(slopes[name] * allowed, axis=-1)
        bounds[name] = (float(np.squeeze(reached.low)), float(np.squeeze(reached.high)))
    return bounds, slopes


def _coordinates(record: MechanismRecord, platform: Placed) -> dict[str, Any]:
    """Lengths of the pose as they are, of angles numbers with their derivatives alone."""
    rotation, point = platform
    pairs = {"phi": (rotation[0][0], rotation[1][0]), "psi": (rotation[2][2], rotation[2][1])}
    own: dict[str, Any] = {}
    for name in record.platform.pose:
        if name in LENGTHS:
            own[name] = point[LENGTHS.index(name)]
        elif name in pairs:
            own[name] = _turned(*pairs[name])
        elif name == "theta":
            sine = -_dual(rotation[2][0])
            cosine = (1.0 - as_interval(sine.value).square()).sqrt()
            own[name] = Dual(as_interval(0.0), sine.derivative / cosine)
    return own


def _turned(cosine: Any, sine: Any) -> Dual:
    """The derivative of the angle of a pair of any length."""
    c, s = _dual(cosine), _dual(sine)
    square = as_interval(c.value).square() + as_interval(s.value).square()
    return Dual(as_interval(0.0), (c.value * s.derivative - s.value * c.derivative) / square)


def _dual(value: Any) -> Dual:
    return value if isinstance(value, Dual) else Dual(as_interval(value), as_interval(0.0))


def _plain(platform: Placed) -> Placed:
    """The platform's frame without derivatives, whole numbers as they are."""

    def plain(value: Any) -> Any:
        return as_interval(value.value) if isinstance(value, Dual) else value

    (a, b, c), point = platform
    rows = tuple((plain(row[0]), plain(row[1]), plain(row[2])) for row in (a, b, c))
    return (rows[0], rows[1], rows[2]), (plain(point[0]), plain(point[1]), plain(point[2]))


def _value(number_: Any) -> Interval:
    return as_interval(number_.value if isinstance(number_, Dual) else number_)


def _slope(number_: Any, count: int) -> Interval:
    """Derivatives (count,)."""
    slope = as_interval(number_.derivative if isinstance(number_, Dual) else 0.0)
    return broadcast(slope, (count, 1))[:, 0]


def _product(first: Interval, second: Interval) -> Interval:
    """Of matrices (a, b) and (b, c)."""
    terms = first[:, :, None] * second[None]
    return total(terms, axis=1)


def _applied(matrix: Interval, vector: Interval) -> Interval:
    """A matrix (a, b) times a vector (b,)."""
    return total(matrix * vector[None], axis=-1)
