"""The mass matrix, gravity and the rates of the inputs as formulas of the pose: by the closed form, link for link.

Places of links follow from the joint values of the closed form, and their derivatives from the rules of calculus. What
is the same at poses drawn at random is taken for one number: sums of squares of a cosine and a sine, turns that cancel
out. So the formulas are those of the mechanism with its dimensions, and are held against `actuator_forces`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import geometry
from assur.joint_graph.tree import joint_graph
from assur.kinematics.modes import mode_signs, sign_names
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.status import closed_form_of
from assur.kinematics.validation.check import METRES
from assur.machine.forces.actuator_forces import forces
from assur.machine.masses.link_masses import all_masses
from assur.machine.motion.inertia import rotors
from assur.machine.motion.pivots import graph_pivots
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS
from assur.numerics.recording.tape import MEANING, Operation, Recorder, Tape
from assur.numerics.vectors import Matrix, Vector, add, apply, dot, minus, plus, times, transposed

FloatArray = NDArray[np.float64]
POSES, TRIED = 12, 400
"""At how many poses numbers are compared, of how many that are drawn."""
SAME = 1e-10
"""Share of the largest by which numbers differ that are the same."""


@dataclass(frozen=True, eq=False)
class MotionFormulas:
    """A straight line from the pose to the terms of D^T tau = M a + c + g - w, in kg, N and the mechanism's unit.

    Attributes:
        record, mode: of which mechanism, in which working mode.
        tape: outputs "M i,j" (j >= i), "g i" and "D k,i"; given are the pose, dimensions and masses.
        values: (u,) of the dimensions and the masses.
    """

    record: MechanismRecord
    mode: str
    tape: Tape
    values: FloatArray

    def __call__(self, poses: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """M (N, k, k), g (N, k) and D (N, d, k) at poses (N, k)."""
        count, k, d = len(poses), len(self.record.platform.pose), len(self.record.drives)
        outputs = self.tape.evaluate(list(poses.T), self.values.tolist())
        mass, weight, driven = np.zeros((count, k, k)), np.zeros((count, k)), np.zeros((count, d, k))
        for name, value in outputs.items():
            kind, place = name.split()
            first, *rest = map(int, place.split(","))
            if kind == "g":
                weight[:, first] = value
            elif kind == "D":
                driven[:, first, rest[0]] = value
            else:
                mass[:, first, rest[0]] = mass[:, rest[0], first] = value
        return mass, weight, driven


def motion_formulas(record: MechanismRecord, mode: str | None = None) -> MotionFormulas:
    """The formulas of a working mode, the file's default where none is given.

    Errors:
        UsageError: no closed form, a pose with angles, ball joints or other freedoms that nothing drives, whose motion
            no pose tells; links without a mass.

    >>> from assur.model.registry import load_record
    >>> own = motion_formulas(load_record("tripteron"))
    >>> sorted(own.tape.outputs)[:3]
    ['D 0,0', 'D 1,1', 'D 2,2']
    """
    mode = mode or record.modes.default_working
    _refuse(record)
    poses = _poses(record, mode)
    first, values = _places(record, mode)
    moved = _terms(record, _simplified(first, poses, values))
    return MotionFormulas(record, mode, _simplified(moved, poses, values), np.array(values))


def difference(formulas: MotionFormulas) -> float:
    """The largest difference from `actuator_forces` at poses drawn at random, as a share of the largest number."""
    record = formulas.record
    poses = _poses(record, formulas.mode, seed=1)  # others than those at which numbers were taken for the same
    answer, (mass, weight, driven) = forces(record, poses, mode=formulas.mode), formulas(poses)
    lengths = np.array([item.coordinate.kind == "length" for item in record.drives])
    balanced = np.einsum("ndk,nd->nk", driven, answer.forces / np.where(lengths, 1.0, METRES[record.unit]))
    return max(
        float(np.max(np.abs(own - other)) / max(float(np.max(np.abs(other))), 1e-9))
        for own, other in ((mass, answer.mass_matrix), (weight, answer.gravity), (balanced, answer.gravity))
    )


def _refuse(record: MechanismRecord) -> None:
    name, pivots = record.name, graph_pivots(record)
    closed_form_of(record)
    all_masses(record)
    if lacking := [own for own in record.platform.pose if own not in record.box]:
        raise UsageError(f"{name}: no box of {', '.join(lacking)} to compare numbers in", hint="say it in [workspace]")
    if not set(record.platform.pose) <= set(LENGTHS):
        raise UsageError(f"{name}: formulas of motion are written for poses of lengths alone")
    if any(joint.type.ball for joint in record.joints.values()) or pivots is None or pivots.idle:
        raise UsageError(f"{name}: no formulas of motion: a spin that nothing drives is told by no pose")


def _poses(record: MechanismRecord, mode: str, seed: int = 0) -> FloatArray:
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    poses = np.random.default_rng(seed).uniform(low, high, size=(TRIED, len(low)))
    reached = np.isfinite(joints_in_mode(record, poses, mode)).all(axis=1)
    if np.sum(reached) < POSES:
        raise UsageError(f"{record.name}: mode {mode} reaches too few poses of the box to compare numbers at")
    return np.asarray(poses[reached][:POSES])


def _places(record: MechanismRecord, mode: str) -> tuple[Tape, list[float]]:
    """Centres "c link,k", orientations "r link,k" where there is inertia, inputs "q k", or "cos k" and "sin k".

    The numbers beside are those of the dimensions.
    """
    recorder, values, form = Recorder(), list[float](), closed_form_of(record)

    def dimension(name: str, value: Any) -> Any:
        if isinstance(value, tuple):  # an angle, which is written
            return value
        values.append(float(value))
        return recorder.uniform(name)

    p = SimpleNamespace(**{name: dimension(name, value) for name, value in vars(kernel_dimensions(record)).items()})
    pose = tuple(recorder.varying(name) for name in record.platform.pose)
    signs = dict(zip(sign_names(record, "inverse"), mode_signs(record, "inverse", mode), strict=True))
    branch = form.inverse(recorder, p, pose, SimpleNamespace(**{name: float(sign) for name, sign in signs.items()}))
    joints = form.joints(recorder, p, branch.core)
    state = {name: _numbers(joints, name, joint) for name, joint in record.joints.items()}
    exact = geometry(record).mapped(lambda number: int(number) if number in (0.0, 1.0, -1.0) else number)
    configuration = Configuration(joint_graph(record), exact, state)
    outputs: dict[str, Any] = {}
    for link, body in all_masses(record).carried(record.platform.link).items():
        rotation, origin = configuration.frames[link]
        centre = add(origin, apply(rotation, _vector(map(_exact, body.centre / METRES[record.unit]))))
        outputs |= {f"c {link},{k}": number for k, number in enumerate(centre)}
        if np.any(body.inertia):
            outputs |= {f"r {link},{k}": number for k, number in enumerate((*rotation[0], *rotation[1], *rotation[2]))}
    for place, item in enumerate(record.drives):
        numbers = state[item.coordinate.joint]
        if item.coordinate.kind == "length":
            outputs[f"q {place}"] = times(int(item.sign), numbers[0])
        else:
            outputs |= {f"cos {place}": numbers[0], f"sin {place}": times(int(item.sign), numbers[1])}
    return recorder.tape(outputs), values


def _numbers(joints: Mapping[str, Any], name: str, joint: Any) -> list[Any]:
    own = [joints[name]] if name in joints else [joints[f"{name}.{part}"] for part in joint.type.components]
    return [number for value in own for number in (value if isinstance(value, tuple) else (value,))]


def _terms(record: MechanismRecord, places: Tape) -> Tape:
    """Mass matrix, gravity and rates of the inputs from places and their derivatives."""
    recorder, count = Recorder(), len(record.platform.pose)
    entries = _again(recorder, places)
    rates = [_derivative(places, entries, k) for k in range(count)]
    unit, known = METRES[record.unit], all_masses(record)
    bodies = known.carried(record.platform.link)

    def number(name: str, k: int | None = None) -> Any:
        place = places.outputs.get(name)  # what is not there is zero
        return 0 if place is None else (entries if k is None else rates[k])[place]

    mass: dict[tuple[int, int], Any] = {}
    weight: dict[int, Any] = {}
    outputs: dict[str, Any] = {}
    for link, body in bodies.items():
        moving = [_vector(number(f"c {link},{a}", k) for a in range(3)) for k in range(count)]
        turned = []
        if np.any(body.inertia):
            rotation = _rows(number(f"r {link},{a}") for a in range(9))
            for k in range(count):
                change = _rows(number(f"r {link},{a}", k) for a in range(9))
                x, y, z = (dot(change[i], rotation[j]) for i, j in ((2, 1), (0, 2), (1, 0)))
                turned.append(apply(transposed(rotation), (x, y, z)))
        inertia = _rows(_exact(x) for x in (body.inertia / unit**2).ravel())
        for i in range(count):
            pull = dot(_vector(map(_exact, known.gravity)), moving[i])
            weight[i] = minus(weight.get(i, 0), times(_exact(body.mass), pull))
            for j in range(i, count):
                own = times(_exact(body.mass), dot(moving[i], moving[j]))
                if turned:
                    own = plus(own, dot(turned[i], apply(inertia, turned[j])))
                mass[i, j] = plus(mass.get((i, j), 0), own)
    driven = {}
    for place, item in enumerate(record.drives):
        for k in range(count):
            if item.coordinate.kind == "length":
                driven[place, k] = number(f"q {place}", k)
            else:
                cosine, sine = number(f"cos {place}"), number(f"sin {place}")
                turning = times(cosine, number(f"sin {place}", k))
                driven[place, k] = minus(turning, times(sine, number(f"cos {place}", k)))
    for place, item in enumerate(record.drives):
        rotor = rotors(record)[item.coordinate.index] / (1.0 if item.coordinate.kind == "length" else unit**2)
        for i, j in mass:
            mass[i, j] = plus(mass[i, j], times(_exact(rotor), times(driven[place, i], driven[place, j])))
    outputs |= {f"M {i},{j}": value for (i, j), value in mass.items()}
    outputs |= {f"g {i}": value for i, value in weight.items()}
    outputs |= {f"D {place},{k}": value for (place, k), value in driven.items()}
    return recorder.tape({name: value for name, value in outputs.items() if not _zero(value)})


def _rows(numbers: Iterable[Any]) -> Matrix:
    a, b, c, d, e, f, g, h, i = numbers
    return (a, b, c), (d, e, f), (g, h, i)


def _vector(numbers: Iterable[Any]) -> Vector:
    x, y, z = numbers
    return x, y, z


def _exact(number: float) -> Any:
    return int(number) if number in (0.0, 1.0, -1.0) else float(number)


def _zero(number: Any) -> bool:
    return type(number) is int and number == 0


def _again(recorder: Recorder, tape: Tape) -> list[Any]:
    """All entries of a tape, recorded once more; written numbers 0, 1 and -1 as integers, which leave no trace."""
    given = {"varying": (iter(tape.varying), recorder.varying), "uniform": (iter(tape.uniform), recorder.uniform)}
    entries: list[Any] = []
    for operation in tape.operations:
        if operation.name in given:
            names, record = given[operation.name]
            entries.append(record(next(names)))
        else:
            entries.append(_done(recorder, operation, [entries[k] for k in operation.arguments]))
    return entries


def _done(recorder: Recorder, operation: Operation, numbers: Sequence[Any]) -> Any:
    """An operation, with what 0, 1 and -1 make of it left out."""
    name = operation.name
    if name == "number":
        return _exact(operation.number)
    if name == "root":
        return recorder.sqrt(numbers[0])
    if name == "negative":
        return minus(0, numbers[0])
    if name == "/":
        a, b = numbers
        return 0 if _zero(a) else a if b == 1 and type(b) is int else a / b
    return {"+": plus, "-": minus, "*": times}[name](*numbers)


def _derivative(tape: Tape, entries: Sequence[Any], place: int) -> list[Any]:
    """How fast all entries of a tape change with one of the varying numbers."""
    rates: list[Any] = []
    given = iter(range(len(tape.varying)))
    for k, operation in enumerate(tape.operations):
        a, b = (operation.arguments * 2)[:2] if operation.arguments else (0, 0)
        if operation.name == "varying":
            rate: Any = int(next(given) == place)
        elif not operation.arguments:
            rate = 0
        elif operation.name in ("+", "-"):
            rate = (plus if operation.name == "+" else minus)(rates[a], rates[b])
        elif operation.name == "*":
            rate = plus(times(rates[a], entries[b]), times(entries[a], rates[b]))
        elif operation.name == "/":
            rest = minus(rates[a], times(entries[k], rates[b]))
            rate = 0 if _zero(rest) else rest / entries[b]
        elif operation.name == "root":
            rate = 0 if _zero(rates[a]) else rates[a] / (2 * entries[k])
        else:
            rate = minus(0, rates[a])
        rates.append(rate)
    return rates


def _simplified(tape: Tape, poses: FloatArray, values: Sequence[float]) -> Tape:
    """A tape in which numbers that are the same at all poses are one, and those that do not vary are written."""
    numbers = _numbers_at(tape, poses, values)
    recorder, entries = Recorder(), list[Any]()
    given = {"varying": (iter(tape.varying), recorder.varying), "uniform": (iter(tape.uniform), recorder.uniform)}
    known: dict[tuple[float, ...], Any] = {}
    for operation, value in zip(tape.operations, numbers, strict=True):
        if operation.name in given:
            names, record = given[operation.name]
            entry: Any = record(next(names))
        elif (whole := _whole(value)) is not None:
            entry = whole
        elif (key := _key(value)) in known:
            entry = known[key]
        elif (other := _key(-value)) in known:
            entry = minus(0, known[other])
        else:
            entry = _done(recorder, operation, [entries[k] for k in operation.arguments])
        if np.ptp(value) > 0.0:
            known.setdefault(_key(value), entry)
        entries.append(entry)
    return recorder.tape({name: entries[k] for name, k in tape.outputs.items() if not _zero(entries[k])})


def _whole(value: FloatArray) -> int | None:
    """The integer 0, 1 or -1 that a number is everywhere."""
    for number in (0, 1, -1):
        if np.all(np.abs(value - number) <= SAME):
            return number
    return None


def _key(value: FloatArray) -> tuple[float, ...]:
    size = float(np.max(np.abs(value)))
    return (float(f"{size:.8g}"), *np.round(value / (size or 1.0), 8).tolist())


def _numbers_at(tape: Tape, poses: FloatArray, values: Sequence[float]) -> list[FloatArray]:
    given = {"varying": iter(poses.T), "uniform": iter([np.full(len(poses), value) for value in values])}
    numbers: list[Any] = []
    for operation in tape.operations:
        arguments = [numbers[k] for k in operation.arguments]
        if operation.name in given:
            numbers.append(next(given[operation.name]))
        elif operation.name == "number":
            numbers.append(np.full(len(poses), operation.number))
        elif operation.name == "root":
            numbers.append(np.sqrt(np.maximum(arguments[0], 0.0)))
        else:
            numbers.append(np.asarray(MEANING[operation.name](*arguments), dtype=float))
    return numbers
