"""The equation of motion as formulas of the pose, its rates and accelerations: by the closed form, link for link.

Places of links follow from the joint values of the closed form, and their derivatives from the rules of calculus. What
is the same at poses drawn at random is taken for one number: sums of squares of a cosine and a sine, turns that cancel
out. So the formulas are those of the mechanism with its dimensions, and are held against `actuator_forces`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.configuration import Configuration
from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length, geometry
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closed_form.kernel_state import kernel_state, screws
from assur.kinematics.home import home_values
from assur.kinematics.modes import mode_signs, sign_names
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.status import closed_form_of
from assur.kinematics.validation.check import METRES
from assur.machine.forces.actuator_forces import forces
from assur.machine.forces.motion_terms import COSINE, SINE, pose_numbers, terms, vector
from assur.machine.masses.link_masses import all_masses
from assur.machine.motion.inertia import link_inertia
from assur.machine.motion.joint_motion import closed_motion
from assur.machine.motion.pivots import graph_pivots
from assur.machine.motion.screws import paths
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, has_quaternion
from assur.numerics.recording.derivatives import done, exact, is_zero
from assur.numerics.recording.tape import MEANING, Recorder, Tape
from assur.numerics.vectors import add, apply, minus, times

FloatArray = NDArray[np.float64]
POSES, TRIED = 12, 400
"""At how many poses numbers are compared, of how many that are drawn."""
PUSH = 10.0
"""In N: how large forces are in which numbers are compared."""
TRIGONOMETRY: Mapping[str, Any] = {"cos": np.cos, "sin": np.sin}
SAME = 1e-10
"""Share of the largest by which numbers differ that are the same."""


class MotionTerms(NamedTuple):
    """Of N poses: mass matrix (N, k, k), bias (N, k), gravity (N, k), rates of the inputs (N, d, k), forces (N, d)."""

    mass: FloatArray
    bias: FloatArray
    gravity: FloatArray
    driven: FloatArray
    forces: FloatArray


@dataclass(frozen=True, eq=False)
class MotionFormulas:
    """A straight line from a motion to D^T tau = r = u (M a + c) + g - f, in kg, N, the mechanism's unit and s.

    The metres u of the unit make newtons of M a + c; what turns is driven by N times the unit.

    Attributes:
        record, mode: of which mechanism, in which working mode.
        tape: outputs "D k,i", "g i", "M i,j" (j >= i), "c i", "r i" and "tau k", those that are not zero; given are the
            pose, its rates, its accelerations, the force on the platform, and the dimensions.
        values: (u,) of the dimensions.
    """

    record: MechanismRecord
    mode: str
    tape: Tape
    values: FloatArray

    def __call__(
        self,
        poses: FloatArray,
        velocity: FloatArray | None = None,
        acceleration: FloatArray | None = None,
        load: FloatArray | None = None,
    ) -> MotionTerms:
        """The terms at poses (N, k), their rates and accelerations (N, k), and forces (N, k) in N on the platform."""
        count, k, d = len(poses), len(self.record.platform.pose), len(self.record.drives)
        given = [np.zeros((count, k)) if part is None else part for part in (velocity, acceleration, load)]
        columns = _columns(self.record, np.concatenate([poses, *given], axis=1))
        outputs = self.tape.evaluate(list(columns), self.values.tolist())
        shapes = {"M": (k, k), "c": (k,), "g": (k,), "D": (d, k), "tau": (d,)}
        numbers = {kind: np.zeros((count, *shape)) for kind, shape in shapes.items()}
        for name, value in outputs.items():
            kind, place = name.split()
            places: list[Any] = [int(number) for number in place.split(",")]
            if kind in numbers:
                numbers[kind][(slice(None), *places)] = value
            if kind == "M":
                numbers[kind][(slice(None), *reversed(places))] = value
        return MotionTerms(*numbers.values())


def motion_formulas(record: MechanismRecord, mode: str | None = None) -> MotionFormulas:
    """The formulas of a working mode, the file's default where none is given.

    Errors:
        UsageError: no closed form, a pose by a quaternion, screws, rods that swing beside their axes, whose motion no
            pose tells; links without a mass.

    >>> from assur.model.registry import load_record
    >>> own = motion_formulas(load_record("tripteron"))
    >>> sorted(own.tape.outputs)[:3]
    ['D 0,0', 'D 1,1', 'D 2,2']
    """
    mode = mode or record.modes.default_working
    _refuse(record)
    drawn = _drawn(record, mode)
    first, values = _places(record, mode)
    columns = _columns(record, drawn)
    moved = terms(record, _simplified(first, columns, values), _rod_axes(record))
    return MotionFormulas(record, mode, _simplified(moved, columns, values), np.array(values))


def difference(formulas: MotionFormulas) -> float:
    """The largest difference from `actuator_forces` in motions drawn at random, as a share of the largest number."""
    record, unit = formulas.record, METRES[formulas.record.unit]
    drawn = _drawn(record, formulas.mode, seed=1)  # others than those at which numbers were taken for the same
    poses, velocity, acceleration, load = np.split(drawn, 4, axis=1)
    pushed = np.zeros((len(poses), 3))
    lengths = np.array([name in LENGTHS for name in record.platform.pose])
    load = load * lengths
    pushed[:, [LENGTHS.index(name) for name in record.platform.pose if name in LENGTHS]] = load[:, lengths]
    answer = forces(record, poses, velocity, acceleration, pushed, mode=formulas.mode)
    told = formulas(poses, velocity, acceleration, load)
    turning = np.array([item.coordinate.kind == "angle" for item in record.drives])
    each = np.where(lengths, 1.0, unit)  # newtons in m and rad are told in the unit
    own = told.mass * np.outer(each, each), unit * told.bias * each, told.gravity * each, told.forces
    own = *own[:3], told.forces * np.where(turning, unit, 1.0)
    numbers = answer.mass_matrix, answer.bias, answer.gravity, answer.forces
    far = 1.0 / np.where(lengths, 1.0, unit * characteristic_length(record))
    scales = np.outer(far, far), far, far, np.ones(len(turning))
    inert = np.einsum("nij,nj->ni", answer.mass_matrix, acceleration * np.where(lengths, unit, 1.0))
    borne = np.stack([inert, answer.bias, answer.gravity]) * far
    largest = [np.max(np.abs(part)) for part in (answer.mass_matrix * scales[0], borne, borne, answer.forces)]
    pairs = zip(own, numbers, scales, largest, strict=True)
    return max(float(np.max(np.abs(first - second) * scale) / size) for first, second, scale, size in pairs)


def _refuse(record: MechanismRecord) -> None:
    name, pivots = record.name, graph_pivots(record)
    if record.closed_form is None:
        hint = "assur derive M -o closed_form.py, where there is one"
        raise UsageError(f"{name}: no formulas of motion without a closed form", hint=hint)
    all_masses(record)
    if any(screws(record)):
        raise UsageError(f"{name}: no formulas of motion with screws, whose turns cosines do not tell")
    if lacking := [own for own in record.platform.pose if own not in record.box]:
        raise UsageError(f"{name}: no box of {', '.join(lacking)} to compare numbers in", hint="say it in [workspace]")
    if has_quaternion(record.platform.pose):
        raise UsageError(f"{name}: formulas of motion are written for poses of lengths and angles, not by a quaternion")
    if pivots is None:
        raise UsageError(f"{name}: no formulas of motion where the pose's rates are not free")
    home = home_values(record)[None]
    motion = closed_motion(link_inertia(record, home, all_masses(record)), home)
    if motion.swings or any(len(own.links) > 1 for own in pivots.idle):
        raise UsageError(f"{name}: no formulas of motion: what swings beside an axis that nothing drives no pose tells")


def _rod_axes(record: MechanismRecord) -> dict[str, FloatArray]:
    """Axes (3,), along the frames of links, about which these spin as nothing drives them."""
    home, own = home_values(record)[None], paths(record)
    motion, placed = closed_motion(link_inertia(record, home, all_masses(record)), home), frames(record, home)
    pivots = graph_pivots(record)
    axes = {}
    for link in {link for item in (pivots.idle if pivots else ()) for link in item.links}:
        turning = (motion.inertia.turning[0, own.links.index(link)] @ motion.idle[0]).T
        turned = turning[np.argmax(np.linalg.norm(turning, axis=1))]
        axes[link] = placed[link][0][0].T @ (turned / np.linalg.norm(turned))
    return axes


def _columns(record: MechanismRecord, drawn: FloatArray) -> FloatArray:
    """What a tape is given of motions (N, 4 k), as rows: of angles of the pose cosines and sines."""
    numbers = dict(zip(record.platform.pose, drawn.T, strict=False))
    numbers |= {f"{kind} {name}": form(row) for name, row in numbers.items() for kind, form in TRIGONOMETRY.items()}
    own = [numbers[name] for name in pose_numbers(record.platform.pose)]
    return np.array([*own, *drawn.T[len(record.platform.pose) :]])


def _drawn(record: MechanismRecord, mode: str, seed: int = 0) -> FloatArray:
    """Poses, rates, accelerations and forces (N, 4 k) in which numbers are compared."""
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    random = np.random.default_rng(seed)
    poses = random.uniform(low, high, size=(TRIED, len(low)))
    reached = np.isfinite(joints_in_mode(record, poses, mode)).all(axis=1)
    if np.sum(reached) < POSES:
        raise UsageError(f"{record.name}: mode {mode} reaches too few poses of the box to compare numbers at")
    kept = poses[reached][:POSES]
    sizes = np.repeat([characteristic_length(record)] * 2 + [PUSH], len(low))
    return np.concatenate([kept, sizes * random.normal(size=(len(kept), 3 * len(low)))], axis=1)


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
    given = {name: recorder.varying(name) for name in pose_numbers(record.platform.pose)}
    pose = tuple(
        given[name] if name in given else (given[COSINE.format(name)], given[SINE.format(name)])
        for name in record.platform.pose
    )
    signs = dict(zip(sign_names(record, "inverse"), mode_signs(record, "inverse", mode), strict=True))
    branch = form.inverse(recorder, p, pose, SimpleNamespace(**{name: float(sign) for name, sign in signs.items()}))
    state, _ = kernel_state(record, form.joints(recorder, p, branch.core))
    configuration = Configuration(joint_graph(record), geometry(record).mapped(exact), state)
    outputs: dict[str, Any] = {}
    axes = {link: [exact(part) for part in axis] for link, axis in _rod_axes(record).items()}
    for link, body in all_masses(record).carried(record.platform.link).items():
        rotation, origin = configuration.frames[link]
        centre = add(origin, apply(rotation, vector(map(exact, body.centre / METRES[record.unit]))))
        outputs |= {f"c {link},{k}": number for k, number in enumerate(centre)}
        if link in axes:
            outputs |= {f"e {link},{k}": number for k, number in enumerate(apply(rotation, vector(axes[link])))}
        elif np.any(body.inertia):
            outputs |= {f"r {link},{k}": number for k, number in enumerate((*rotation[0], *rotation[1], *rotation[2]))}
    for place, item in enumerate(record.drives):
        numbers = state[item.coordinate.joint]
        if item.coordinate.kind == "length":
            outputs[f"q {place}"] = times(int(item.sign), numbers[0])
        else:
            outputs |= {f"cos {place}": numbers[0], f"sin {place}": times(int(item.sign), numbers[1])}
    return recorder.tape(outputs), values


def _simplified(tape: Tape, drawn: FloatArray, values: Sequence[float]) -> Tape:
    """A tape in which numbers that are the same at all poses are one, and those that do not vary are written."""
    numbers = _numbers_at(tape, drawn, values)
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
            entry = done(recorder, operation, [entries[k] for k in operation.arguments])
        if np.ptp(value) > 0.0:
            known.setdefault(_key(value), entry)
        entries.append(entry)
    return recorder.tape({name: entries[k] for name, k in tape.outputs.items() if not is_zero(entries[k])})


def _whole(value: FloatArray) -> int | None:
    """The integer 0, 1 or -1 that a number is everywhere."""
    for number in (0, 1, -1):
        if np.all(np.abs(value - number) <= SAME):
            return number
    return None


def _key(value: FloatArray) -> tuple[float, ...]:
    size = float(np.max(np.abs(value)))
    return (float(f"{size:.8g}"), *np.round(value / (size or 1.0), 8).tolist())


def _numbers_at(tape: Tape, drawn: FloatArray, values: Sequence[float]) -> list[FloatArray]:
    count = drawn.shape[1]
    given = {"varying": iter(drawn), "uniform": iter([np.full(count, value) for value in values])}
    numbers: list[Any] = []
    for operation in tape.operations:
        arguments = [numbers[k] for k in operation.arguments]
        if operation.name in given:
            numbers.append(next(given[operation.name]))
        elif operation.name == "number":
            numbers.append(np.full(count, operation.number))
        elif operation.name == "root":
            numbers.append(np.sqrt(np.maximum(arguments[0], 0.0)))
        else:
            numbers.append(np.asarray(MEANING[operation.name](*arguments), dtype=float))
    return numbers
