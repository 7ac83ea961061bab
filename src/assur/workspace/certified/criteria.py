"""What a pose must satisfy to be reached in a working mode, as one straight-line program for any number type.

Over intervals it says for a whole box at once what holds at each of its poses.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.certified.given import dimension_intervals
from assur.kinematics.contract.admission import checked_form
from assur.kinematics.modes import mode_signs, sign_names
from assur.model.closed_form import ClosedForm
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, QUATERNION, has_quaternion, is_angle
from assur.numerics.intervals.functions import cosine_sine, from_degrees
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.sloped import Sloped, coordinate, turn
from assur.numerics.recording.interval_program import IntervalProgram
from assur.numerics.recording.interval_tapes import SlopedProgram, folded, sloped_program
from assur.numerics.recording.tape import Recorded, Recorder, Tape
from assur.workspace.bounds import Stroke, bounds
from assur.workspace.certified.programs import with_radicands
from assur.workspace.slices import Slice, quaternion_of, slice_at

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Criteria:
    """Margins, and factors where they are asked for, of a working mode over the free coordinates of a slice.

    A pose is reached where every operation of the formulas has a value, no margin is negative and nothing is zero that
    they divide by. The dimensions are exactly the floats of the record.

    Attributes:
        slice: which coordinates vary, and at what the others are held.
        tape: outputs are all the names below; its varying numbers are lengths, and cosines and sines of angles (of
            half of them where the pose is a quaternion).
        uniform: enclosures of what does not vary.
        margins: names of what must not be negative.
        radicands: names of radicands that are no margins; they must not be negative either.
        regular: names of what must not be zero: the formulas divide by it.
        roots: those of `margins` and `radicands` of which a root is taken.
        factors: names of factors by kind; where one is zero the pose is singular. Of kind "constraint" are groups
            of factors that must not all be zero, as the sum of their squares, or the factor where it is one.
    """

    slice: Slice
    tape: Tape
    uniform: tuple[Interval, ...]
    margins: tuple[str, ...]
    radicands: tuple[str, ...]
    regular: tuple[str, ...]
    roots: tuple[str, ...]
    factors: Mapping[str, tuple[str, ...]]

    def over(self, box: Sequence[Interval]) -> dict[str, Interval]:
        """Every output over boxes (...): one interval per free coordinate, in lengths and rad.

        Roots of negative numbers are zero here. That loses no pose that is reached, where no radicand is negative: so
        a margin below zero all over a box proves that none of it is reached, and margins and radicands that are
        nowhere negative and everywhere defined prove that all of it is.
        """
        return self._program(components(self.tape, self.slice, box), self.uniform)

    def sloped(self, box: Sequence[Interval], middles: Sequence[FloatArray | None]) -> dict[str, Sloped]:
        """Every output over boxes (N,) with its slopes; no slopes by coordinates whose middle is None."""
        varying = _sloped_components(self.tape, self.slice, box, middles)
        shape = tuple(middle is not None for middle in middles)
        if shape not in self._sloped_programs:
            self._sloped_programs[shape] = sloped_program(self.tape, varying, sum(shape))
        return self._sloped_programs[shape](varying, self.uniform)

    @cached_property
    def _program(self) -> IntervalProgram:
        return IntervalProgram(self.tape, clamped=True)

    @cached_property
    def _sloped_programs(self) -> dict[tuple[bool, ...], SlopedProgram]:
        return {}

    @property
    def names(self) -> tuple[str, ...]:
        """Every factor that is asked for."""
        return tuple(name for names in self.factors.values() for name in names)

    @property
    def nonsingular(self) -> Criteria:
        """The same where a pose is wanted only if no factor is zero: factors count among what formulas divide by."""
        return replace(self, regular=(*self.regular, *self.names))

    @property
    def analytic(self) -> bool:
        """Whether every output is analytic wherever it is defined and no radicand is zero."""
        return not any(item.name in ("magnitude", ">=", ">", "and") for item in self.tape.operations)

    @cached_property
    def used(self) -> tuple[bool, ...]:
        """Per free coordinate whether any output depends on it; the others only give the region its length."""
        names = frozenset[str]().union(*self.tape.dependence().values())
        return tuple(any(_coordinate(name) == free for name in names) for free in self.slice.free)


def criteria(
    record: MechanismRecord,
    mode: str | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    held: Mapping[str, float] | None = None,
    factors: Sequence[str] = (),
) -> Criteria:
    """The criteria of a working mode, strokes and limits of joints among them.

    Args:
        record: the mechanism.
        mode: signs of the working mode; the file's default where none is given.
        strokes: input -> (low, high) as printed, or None for no limit; the file's for what is left out.
        held: pose coordinates that stand still, as `assur.workspace.slices.slice_at` takes them; an angle of a
            mechanism with angles in degrees with bounds that hold the degrees that it was converted from.
        factors: kinds of factors wanted beside the margins: "parallel", "serial", "constraint".

    Errors:
        UsageError: no closed form, an unknown mode, coordinate or input, a stroke that is none.
        MechanismFileError: the closed form does not agree with the joint graph.

    Example: no margin of the paper's mechanism depends on y.

    >>> from assur.model.registry import load_record
    >>> found = criteria(load_record("zeng2019"))
    >>> found.margins, found.slice.free, found.used
    (('n_alpha', 'n_beta', 'M12', 'M3'), ('x', 'y', 'z'), (True, False, True))
    """
    form, poses, recorder = checked_form(record), slice_at(record, held), Recorder()
    mode = mode or record.modes.default_working
    uniform: dict[str, Interval] = {}

    def given(name: str, value: Interval | float) -> Recorded:
        uniform[name] = as_interval(value)
        return recorder.uniform(name)

    dimensions = dimension_intervals(record)
    p = kernel_dimensions(record, lambda name: given(name, dimensions[name]))
    signs = zip(sign_names(record, "inverse"), mode_signs(record, "inverse", mode), strict=True)
    sign = SimpleNamespace(**{name: given(f"sign {name}", float(value)) for name, value in signs})
    branch = form.inverse(recorder, p, _pose(record, recorder, poses, given), sign)
    joints = form.joints(recorder, p, branch.core)
    margins = {item.name: branch.margins[item.name] for item in form.inverse_margins if item.zero == "merge"}
    limits = bounds(record, strokes, lambda value: given(f"constant {len(uniform)}", value))
    margins |= {name: bound(joints) for name, bound in limits.items()}
    regular = {item.name: branch.margins[item.name] for item in form.inverse_margins if item.zero == "degenerate"}
    kinds = _factors(form, form.factors(recorder, p, branch.core), factors)
    wanted = {name: value for values in kinds.values() for name, value in values.items()}
    tape, radicands, roots = with_radicands(recorder.tape({**margins, **regular, **wanted}), tuple(margins))
    names = {kind: tuple(values) for kind, values in kinds.items()}
    program = folded(tape)
    numbers = program.numbers([uniform[name] for name in tape.uniform])
    return Criteria(poses, program.varying, numbers, tuple(margins), radicands, tuple(regular), roots, names)


def _factors(form: ClosedForm, values: Mapping[str, Any], kinds: Sequence[str]) -> dict[str, dict[str, Any]]:
    """What must not be zero, by kind and name."""
    found: dict[str, dict[str, Any]] = {}
    for kind in kinds:
        if kind != "constraint":
            found[kind] = {item.name: values[item.name] for item in form.factor_list if item.kind == kind}
            continue
        found[kind] = {}
        for group in form.constraint_singular:
            name = " and ".join(group)
            found[kind][name] = values[name] if len(group) == 1 else sum(values[item] * values[item] for item in group)
    return found


def components(tape: Tape, poses: Slice, box: Sequence[Any]) -> list[Any]:
    """The varying numbers of the tape at values of the free coordinates: intervals, or arrays of floats."""
    found: dict[str, Any] = {}
    for name, value in zip(poses.free, box, strict=True):
        if not is_angle(name):
            found[name] = value
            continue
        angle = value / _parts_of_a_turn(poses)
        pair = cosine_sine(angle) if isinstance(angle, Interval) else (np.cos(angle), np.sin(angle))
        found |= zip((f"cos {name}", f"sin {name}"), pair, strict=True)
    return [found[name] for name in tape.varying]


def _sloped_components(
    tape: Tape, poses: Slice, box: Sequence[Interval], middles: Sequence[FloatArray | None]
) -> list[Any]:
    """The varying numbers of the tape with their slopes; plain intervals where the middle is None."""
    size = sum(middle is not None for middle in middles)
    found: dict[str, Any] = dict(zip(tape.varying, components(tape, poses, box), strict=True))
    index = 0
    for name, whole, middle in zip(poses.free, box, middles, strict=True):
        if middle is None:
            continue
        if is_angle(name):
            pair = turn(whole, middle, index, size, 1 / _parts_of_a_turn(poses))
            found |= zip((f"cos {name}", f"sin {name}"), pair, strict=True)
        else:
            found[name] = coordinate(whole, middle, index, size)
        index += 1
    return [found[name] for name in tape.varying]


def _parts_of_a_turn(poses: Slice) -> float:
    """Quaternions are made of half angles."""
    return 2.0 if has_quaternion(poses.pose) else 1.0


def _coordinate(component: str) -> str:
    return component.removeprefix("cos ").removeprefix("sin ")


def _pose(record: MechanismRecord, recorder: Recorder, poses: Slice, given: Any) -> tuple[Any, ...]:
    """The pose as the kernel takes it, recorded."""
    values: dict[str, Any] = {}
    for name in (*poses.free, *poses.held):
        free = name in poses.free
        if not is_angle(name):
            values[name] = recorder.varying(name) if free else given(name, poses.held[name])
        elif free:
            values[name] = (recorder.varying(f"cos {name}"), recorder.varying(f"sin {name}"))
        else:
            angle = from_degrees(poses.held[name]) if record.angle == "deg" else Interval.of(poses.held[name])
            cosine, sine = cosine_sine(angle / _parts_of_a_turn(poses))
            values[name] = (given(f"cos {name}", cosine), given(f"sin {name}", sine))
    if has_quaternion(poses.pose):
        values |= zip(QUATERNION, quaternion_of(*(values[name] for name in ANGLES)), strict=True)
    return tuple(values[name] for name in poses.pose)
