"""What a pose must satisfy to be reached in a working mode, as one straight-line program for any number type.

Over intervals it says for a whole box at once what holds at each of its poses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.modes import mode_signs, sign_names
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, QUATERNION, has_quaternion, is_angle
from assur.numerics.intervals.functions import cosine_sine
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.number_types import Intervals
from assur.numerics.recording.tape import Recorded, Recorder, Tape
from assur.workspace.bounds import Stroke, bounds
from assur.workspace.slices import Slice, slice_at

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Criteria:
    """Margins and parallel factors of a working mode over the free coordinates of a slice.

    Attributes:
        slice: which coordinates vary, and at what the others are held.
        tape: outputs are the margins and factors by name; its varying numbers are lengths, and cosines and sines
            of angles (of half of them where the pose is a quaternion).
        uniform: values of what does not vary.
        margins: names of what must not be negative.
        regular: names of what must not be zero: the formulas divide by it.
        factors: names of the parallel factors; where one is zero the pose is singular.
    """

    slice: Slice
    tape: Tape
    uniform: tuple[Any, ...]
    margins: tuple[str, ...]
    regular: tuple[str, ...]
    factors: tuple[str, ...]

    def over(self, box: Sequence[Interval]) -> dict[str, Interval]:
        """Every margin and factor over boxes: one interval (...) per free coordinate, in lengths and rad."""
        found = self.tape.evaluate(components(self.tape, self.slice, box), self.uniform, Intervals())
        return {name: as_interval(value) for name, value in found.items()}

    @cached_property
    def used(self) -> tuple[bool, ...]:
        """Per free coordinate whether any margin depends on it; the others only give the region its length."""
        depends = self.tape.dependence()
        names = frozenset[str]().union(*(depends[name] for name in (*self.margins, *self.regular)))
        return tuple(any(_coordinate(name) == free for name in names) for free in self.slice.free)


def criteria(
    record: MechanismRecord,
    mode: str | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    held: Mapping[str, float] | None = None,
) -> Criteria:
    """The criteria of a working mode, strokes and limits of joints among them; the mode and strokes of the file by default.

    Errors:
        UsageError: no closed form, an unknown mode, coordinate or input, a stroke that is none.

    Example: no margin of the paper's mechanism depends on y.

    >>> from assur.model.registry import load_record
    >>> found = criteria(load_record("zeng2019"))
    >>> found.margins, found.slice.free, found.used
    (('n_alpha', 'n_beta', 'M12', 'M3'), ('x', 'y', 'z'), (True, False, True))
    """
    form, poses, recorder = closed_form_of(record), slice_at(record, held), Recorder()
    mode = mode or record.modes.default_working
    uniform: dict[str, Any] = {}

    def given(name: str, value: Any) -> Recorded:
        uniform[name] = value
        return recorder.uniform(name)

    p = SimpleNamespace(**{name: given(name, value) for name, value in vars(record.values).items()})
    signs = zip(sign_names(record, "inverse"), mode_signs(record, "inverse", mode), strict=True)
    sign = SimpleNamespace(**{name: given(f"sign {name}", float(value)) for name, value in signs})
    branch = form.inverse(recorder, p, _pose(recorder, poses, given), sign)
    joints = form.joints(recorder, p, branch.core)
    margins = {item.name: branch.margins[item.name] for item in form.inverse_margins if item.zero == "merge"}
    margins |= {name: bound(joints) for name, bound in bounds(record, strokes).items()}
    regular = {item.name: branch.margins[item.name] for item in form.inverse_margins if item.zero == "degenerate"}
    values = form.factors(recorder, p, branch.core)
    factors = {item.name: values[item.name] for item in form.factor_list if item.kind == "parallel"}
    tape = recorder.tape({**margins, **regular, **factors})
    numbers = tuple(as_interval(uniform[name]) for name in tape.uniform)  # so that p.l * p.l is enclosed too
    return Criteria(poses, tape, numbers, tuple(margins), tuple(regular), tuple(factors))


def components(tape: Tape, poses: Slice, box: Sequence[Any]) -> list[Any]:
    """The varying numbers of the tape at values of the free coordinates: intervals, or arrays of floats."""
    found: dict[str, Any] = {}
    for name, value in zip(poses.free, box, strict=True):
        if not is_angle(name):
            found[name] = value
            continue
        angle = value / 2 if has_quaternion(poses.pose) else value
        pair = cosine_sine(angle) if isinstance(angle, Interval) else (np.cos(angle), np.sin(angle))
        found |= zip((f"cos {name}", f"sin {name}"), pair, strict=True)
    return [found[name] for name in tape.varying]


def _coordinate(component: str) -> str:
    return component.removeprefix("cos ").removeprefix("sin ")


def _pose(recorder: Recorder, poses: Slice, given: Any) -> tuple[Any, ...]:
    """The pose as the kernel takes it, recorded."""
    half = 2 if has_quaternion(poses.pose) else 1
    values: dict[str, Any] = {}
    for name in (*poses.free, *poses.held):
        free = name in poses.free
        if not is_angle(name):
            values[name] = recorder.varying(name) if free else given(name, poses.held[name])
        elif free:
            values[name] = (recorder.varying(f"cos {name}"), recorder.varying(f"sin {name}"))
        else:
            angle = poses.held[name] / half
            values[name] = (given(f"cos {name}", math.cos(angle)), given(f"sin {name}", math.sin(angle)))
    if half == 2:
        values |= zip(QUATERNION, _quaternion(*(values[name] for name in ANGLES)), strict=True)
    return tuple(values[name] for name in poses.pose)


def _quaternion(phi: Any, theta: Any, psi: Any) -> tuple[Any, ...]:
    """Unit quaternion of Rz(phi) Ry(theta) Rx(psi) from (cosine, sine) of half of each angle, scalar first."""
    (c1, s1), (c2, s2), (c3, s3) = phi, theta, psi
    return (
        c1 * c2 * c3 + s1 * s2 * s3,
        c1 * c2 * s3 - s1 * s2 * c3,
        c1 * s2 * c3 + s1 * c2 * s3,
        s1 * c2 * c3 - c1 * s2 * s3,
    )
