"""The formulas of a working mode written down for a certificate: nothing worked out before, every number exact.

A verifier must not trust what the prover computed. So dimensions stay numbers of their own, and cosines and sines of
coordinates are operations; only the constants of angular strokes and cones are enclosures.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.certified.given import dimension_intervals
from assur.kinematics.contract.admission import checked_form
from assur.kinematics.modes import mode_signs, sign_names
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, QUATERNION, has_quaternion, is_angle
from assur.numerics.intervals.functions import cosine_sine
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.recording.tape import MEANING, Recorded, Recorder, Tape
from assur.workspace.bounds import Stroke, bounds
from assur.workspace.slices import Slice, quaternion_of, slice_at

BoolArray = NDArray[np.bool_]
GROUPS = ("margins", "nonzero", "factors", "joints", "jp", "jq")
VELOCITIES = ("jp", "jq")
"""What no leaf of a proof needs: the velocity equation, which the exact check holds against the joint graph."""
CONSTANT = "constant"
SLACK = 2.0**-46
"""Constants of strokes are given wider bounds, by this share: another machine's library then still agrees."""


@dataclass(frozen=True, eq=False)
class RegionFormulas:
    """Margins, divisors and factors of a working mode over the free coordinates of a slice.

    Attributes:
        slice: which coordinates vary, and at what the others are held.
        tape: its outputs are (group, name); "margins" must not be negative, "nonzero" must not be zero because the
            formulas divide by it, "factors" are zero where the pose is singular, serial or parallel; "joints" say where
            each joint stands, "jp" and "jq" are the velocity equation. It has two operations more than tapes of
            kernels: "cosine" and "sine".
        numbers: name -> enclosure of what does not vary; exact but for constants of angular strokes and cones.
    """

    slice: Slice
    tape: Tape
    numbers: Mapping[str, Interval]

    def names(self, group: str) -> tuple[str, ...]:
        """Names of the margins, of what must not be zero, or of the factors."""
        return tuple(key.partition(": ")[2] for key in self.tape.outputs if key.startswith(f"{group}: "))

    def over(self, box: Sequence[Interval]) -> tuple[dict[str, Interval], BoolArray]:
        """Outputs over boxes (N,), and where every joint has a value; roots are those of max(x, 0).

        There no radicand can be negative, nor what joints are divided by zero. `defined` of an output is False where
        something that it needs divides by what may be zero. The velocity equation is left out.
        """
        values: list[Any] = []
        varying, numbers = iter(box), iter(self.numbers.values())
        real = np.ones(box[0].shape, dtype=bool)
        for k, operation in enumerate(self.tape.operations):
            arguments = [values[j] for j in operation.arguments]
            if operation.name == "varying":
                values.append(next(varying))
            elif operation.name == "uniform":
                values.append(next(numbers))
            elif k not in self._needed:
                values.append(None)
            elif operation.name == "number":
                values.append(as_interval(operation.number))
            elif operation.name == "root":
                root = arguments[0].sqrt()
                real = real & (arguments[0].low >= 0)
                values.append(Interval(root.low, root.high, arguments[0].defined))
            elif operation.name in ("cosine", "sine"):
                values.append(cosine_sine(arguments[0])[operation.name == "sine"])
            else:
                values.append(MEANING[operation.name](*arguments))
        outputs = {name: values[k] for name, k in self._outputs.items()}
        for name in self.names("joints"):
            real = real & outputs.pop(f"joints: {name}").defined
        return outputs, real

    @cached_property
    def _outputs(self) -> dict[str, int]:
        """Those that leaves need."""
        return {name: k for name, k in self.tape.outputs.items() if name.partition(": ")[0] not in VELOCITIES}

    @cached_property
    def _needed(self) -> frozenset[int]:
        needed = set(self._outputs.values())
        for k in range(len(self.tape.operations) - 1, -1, -1):
            if k in needed:
                needed.update(self.tape.operations[k].arguments)
        return frozenset(needed)

    @cached_property
    def used(self) -> tuple[bool, ...]:
        """Per free coordinate whether any margin, divisor or factor depends on it."""
        dependence = self.tape.dependence()
        asked = (f"{group}: {name}" for group in GROUPS[:3] for name in self.names(group))
        names = frozenset[str]().union(*(dependence[key] for key in asked))
        return tuple(name in names for name in self.slice.free)

    def to_json(self) -> dict[str, Any]:
        """Operations as lists: a name and earlier entries, a coordinate, or bounds of a number and what it is."""
        varying, numbers = iter(self.tape.varying), iter(self.numbers.items())
        operations: list[list[Any]] = []
        for operation in self.tape.operations:
            if operation.name == "varying":
                operations.append(["coordinate", next(varying)])
            elif operation.name == "uniform":
                name, value = next(numbers)
                operations.append(["number", float(value.low).hex(), float(value.high).hex(), name])
            elif operation.name == "number":
                operations.append(["number", operation.number.hex(), operation.number.hex(), ""])
            else:
                operations.append([operation.name, *operation.arguments])
        places = {
            group: [[name, self.tape.outputs[f"{group}: {name}"]] for name in self.names(group)] for group in GROUPS
        }
        return {"operations": operations, **places}


def formulas(
    record: MechanismRecord,
    mode: str | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    held: Mapping[str, float] | None = None,
) -> RegionFormulas:
    """The formulas of a working mode; mode and strokes are those of the file by default.

    Args:
        record: the mechanism; it needs a closed form.
        mode: working mode.
        strokes: input -> (low, high), or None for none; the file's for what is left out.
        held: values of coordinates that do not vary, lengths and rad.

    Errors:
        UsageError: no closed form, an unknown mode, coordinate or input, a stroke that is none.
        MechanismFileError: the closed form does not agree with the joint graph.

    >>> from assur.model.registry import load_record
    >>> found = formulas(load_record("zeng2019"))
    >>> found.names("margins"), found.names("factors")[:4], found.used
    (('n_alpha', 'n_beta', 'M12', 'M3'), ('u1_minus_u2', 'w', 'v', 'sin_alpha_minus_beta'), (True, False, True))
    """
    form, poses, recorder = checked_form(record), slice_at(record, held), Recorder()
    numbers: dict[str, Interval] = {}

    def given(name: str, value: Interval | float) -> Recorded:
        numbers[name] = as_interval(value)
        return recorder.uniform(name)

    dimensions = dimension_intervals(record)
    p = kernel_dimensions(record, lambda name: given(name, dimensions[name]))
    signs = mode_signs(record, "inverse", record.modes.default_working if mode is None else mode)
    named = zip(sign_names(record, "inverse"), signs, strict=True)
    sign = SimpleNamespace(**{name: given(f"sign {name}", float(value)) for name, value in named})
    branch = form.inverse(recorder, p, _pose(recorder, poses, given), sign)
    joints = form.joints(recorder, p, branch.core)
    limits = bounds(record, strokes, lambda value: given(f"{CONSTANT} {len(numbers)}", _wider(value)))
    factors = form.factors(recorder, p, branch.core)
    outputs = {f"margins: {m.name}": branch.margins[m.name] for m in form.inverse_margins if m.zero == "merge"}
    outputs |= {f"margins: {name}": bound(joints) for name, bound in limits.items()}
    outputs |= {f"nonzero: {m.name}": branch.margins[m.name] for m in form.inverse_margins if m.zero == "degenerate"}
    outputs |= {f"factors: {f.name}": factors[f.name] for f in form.factor_list if f.kind != "other"}
    outputs |= {f"joints: {name}": number for name, number in _joint_numbers(record, joints).items()}
    for group, matrix in zip(VELOCITIES, form.jacobians(recorder, p, branch.core), strict=True):
        rows = ((f"{group}: {i},{j}", number) for i, row in enumerate(matrix) for j, number in enumerate(row))
        outputs |= dict(rows)
    return RegionFormulas(poses, recorder.tape(outputs), numbers)


def _joint_numbers(record: MechanismRecord, joints: Mapping[str, Any]) -> dict[str, Any]:
    """Lengths, cosines and sines, and rows of rotations, of each joint in the order of its steps: "joint place"."""
    numbers: dict[str, Any] = {}
    for name, joint in record.joints.items():
        own = [joints[name]] if name in joints else [joints[f"{name}.{part}"] for part in joint.type.components]
        flat = [number for value in own for number in (value if isinstance(value, tuple) else (value,))]
        flat = [number for row in flat for number in (row if isinstance(row, tuple) else (row,))]
        numbers |= {f"{name} {k}": number for k, number in enumerate(flat)}
    return numbers


def _wider(value: Interval) -> Interval:
    slack = as_interval(SLACK * np.maximum(value.magnitude, 1e-300))
    return Interval((value - slack).low, (value + slack).high, value.defined)


def _pose(recorder: Recorder, poses: Slice, given: Any) -> tuple[Any, ...]:
    """The pose as the kernel takes it, with cosines and sines of angles as operations."""
    values: dict[str, Any] = {}
    for name in (*poses.free, *poses.held):
        value = recorder.varying(name) if name in poses.free else given(name, poses.held[name])
        if is_angle(name):
            angle = value / 2 if has_quaternion(poses.pose) else value
            value = (recorder.apply("cosine", angle), recorder.apply("sine", angle))
        values[name] = value
    if has_quaternion(poses.pose):
        values |= zip(QUATERNION, quaternion_of(*(values[name] for name in ANGLES)), strict=True)
    return tuple(values[name] for name in poses.pose)
