"""A kernel as its straight-line program, with all that is worked out from its branch: what depends on what."""

from __future__ import annotations

import dataclasses
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import MechanismFileError
from assur.kinematics import border
from assur.kinematics.modes import Problem, sign_names
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import Branch, Eliminant, Margin, PolynomialSystem
from assur.model.kernel_dimensions import dimension_numbers, kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.model.registry import CLOSED_FORM
from assur.numerics.expanded import Expanded
from assur.numerics.recording.tape import Operation, Recorded, Recorder, Tape, pruned

FloatArray = NDArray[np.float64]
PLACED = frozenset({"jp", "jq", "pose", "input"})
"""Outputs whose plain numbers are entries too, as each stands in its place; of others only what is recorded counts."""
KINDS = (
    *sorted(PLACED),
    "joint",
    "margin",
    "factor",
    "sign",
    "quantity",
    "coefficient",
    "equation",
    "left over",
    "finite",
)
"""All outputs: a closed form without margins or factors has none of that kind, and says so by an empty table."""
Question = Literal["inverse", "direct", "self_motion"]


class _Recorder(Recorder):
    """A recorder beside which polynomials are multiplied out; it can stop at an operation, which tells its line."""

    def __init__(self, stop: Operation | None = None) -> None:
        super().__init__()
        self._stop = stop

    def apply(self, name: str, *arguments: Any) -> Any:
        if any(isinstance(item, Expanded) for item in arguments):
            return NotImplemented  # a polynomial knows how to go on
        return super().apply(name, *arguments)

    def shared(self, operation: Operation) -> Recorded:
        if operation == self._stop:
            raise ZeroDivisionError(operation.name)
        return super().shared(operation)

    def whole(self, outputs: Mapping[str, Any]) -> Tape:
        """Everything recorded, what no output needs too: entries keep their places."""
        places = {name: self._number(value).index for name, value in outputs.items()}
        return Tape(tuple(self._operations), tuple(self._varying), tuple(self._uniform), places)


@dataclass(frozen=True, eq=False)
class Kernel:
    """One question of a mechanism, recorded.

    Attributes:
        tape: every number that the kernels of the question work out.
        given: name, and whether it is an angle, of what is given for each problem.
        margins: those that the question judges.
        outputs: each of `KINDS` -> name -> its entries of the tape; an angle has two.
        numbers: the same -> name -> a plain number, which has no entry.
    """

    record: MechanismRecord
    question: Question
    tape: Tape
    given: tuple[tuple[str, bool], ...]
    margins: tuple[Margin, ...]
    outputs: Mapping[str, Mapping[str, tuple[int, ...]]]
    numbers: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    @cached_property
    def needs(self) -> tuple[frozenset[int], ...]:
        """For each entry all those that it is made of, itself among them."""
        found: list[frozenset[int]] = []
        for k, item in enumerate(self.tape.operations):
            found.append(frozenset([k]).union(*(found[j] for j in item.arguments)))
        return tuple(found)

    @cached_property
    def uniform(self) -> Mapping[str, int]:
        """Dimension, or "sign.name" -> its entry of the tape."""
        places = [k for k, item in enumerate(self.tape.operations) if item.name == "uniform"]
        return dict(zip(self.tape.uniform, places, strict=True))

    def values(self, given: FloatArray, signs: NDArray[Any]) -> list[FloatArray]:
        """Every entry of the tape (S,) at problems (S, k) and branches of these signs (S, s)."""
        record = self.record
        problem: Problem = "inverse" if self.question == "inverse" else "direct"
        convert = border.pose_components if problem == "inverse" else border.input_components
        varying = [part for item in convert(record, given) for part in _flat(item)]
        return self.evaluated(varying, {name: signs[:, k] for k, name in enumerate(sign_names(record, problem))})

    def evaluated(self, varying: Sequence[FloatArray], signs: Mapping[str, FloatArray]) -> list[FloatArray]:
        """Every entry of the tape (S,) at given components (S,) and signs (S,), plus where none is given."""
        known: dict[str, Any] = dict(dimension_numbers(self.record))
        known |= {f"sign.{name}": value for name, value in signs.items()}
        everything = {str(k): k for k in range(len(self.tape.operations))}
        whole = dataclasses.replace(self.tape, outputs=everything)
        with np.errstate(all="ignore"):
            answer = whole.evaluate(varying, [known.get(name, 1.0) for name in self.tape.uniform])
        shape = np.shape(varying[0])
        return [np.broadcast_to(np.asarray(answer[name], dtype=float), shape) for name in everything]

    def entry(self, k: int) -> Kernel:
        """The kernel with what one entry needs alone; `tape.outputs["entry"]` is its place."""
        tape = pruned(self.tape.operations, self.tape.varying, self.tape.uniform, {"entry": k})
        return dataclasses.replace(self, tape=tape, outputs={})

    @cached_property
    def used(self) -> frozenset[int]:
        """Entries that an answer needs."""
        places = [k for named in self.outputs.values() for entries in named.values() for k in entries]
        return frozenset().union(*(self.needs[k] for k in places))

    @cached_property
    def roots(self) -> tuple[int, ...]:
        """Radicands: entries of which a root is drawn."""
        operations = self.tape.operations
        return tuple(sorted({operations[k].arguments[0] for k in self.used if operations[k].name == "root"}))

    @cached_property
    def divisors(self) -> tuple[int, ...]:
        """Entries by which something is divided."""
        operations = self.tape.operations
        return tuple(sorted({operations[k].arguments[1] for k in self.used if operations[k].name == "/"}))

    def text(self, k: int, depth: int = 4) -> str:
        """An entry as a formula, cut off where it goes deep."""
        item = self.tape.operations[k]
        if item.name in ("varying", "uniform"):
            names = self.tape.varying if item.name == "varying" else self.tape.uniform
            return names[[j for j, other in enumerate(self.tape.operations) if other.name == item.name].index(k)]
        if item.name == "number" or depth == 0:
            return f"{item.number:g}" if item.name == "number" else ".."
        parts = [self.text(part, depth - 1) for part in item.arguments]
        return f"({f' {item.name} '.join(parts)})" if len(parts) == 2 else f"{item.name}({parts[0]})"


def questions(record: MechanismRecord) -> tuple[Question, ...]:
    """What the kernels of a closed form answer.

    >>> from assur.model.registry import load_record
    >>> questions(load_record("fivebar")), questions(load_record("three_rrrp4r"))
    (('inverse', 'direct', 'self_motion'), ('inverse',))
    """
    form = closed_form_of(record)
    there = {"inverse": True, "direct": form.direct is not None, "self_motion": form.self_motion is not None}
    asked: tuple[Question, ...] = ("inverse", "direct", "self_motion")
    return tuple(question for question in asked if there[question])


def recorded(record: MechanismRecord, question: Question) -> Kernel:
    """The program of one question.

    >>> from assur.model.registry import load_record
    >>> found = recorded(load_record("fivebar"), "inverse")
    >>> [name for name, _ in found.given], len(found.roots), list(found.outputs["margin"])
    (['x', 'y'], 2, ['distance1', 'distance2', 'reach1', 'reach2'])
    """
    return _Writer(record, question).kernel()


def line_where(kernel: Kernel, name: str, place: int, number: int) -> int | None:
    """The line of the file at which an operation of that name first has an entry as an argument, by its number."""
    stop = next(
        item for item in kernel.tape.operations if item.name == name and item.arguments[number : number + 1] == (place,)
    )
    try:
        _Writer(kernel.record, kernel.question, stop).kernel()
    except MechanismFileError as error:  # a text that is read tells the line itself
        return error.problems[0].line
    except ZeroDivisionError as error:
        frames = traceback.extract_tb(error.__traceback__)
        return next((frame.lineno for frame in reversed(frames) if Path(frame.filename).name == CLOSED_FORM), None)
    return None


class _Writer:
    """Reads the kernels of a question over recorded numbers."""

    def __init__(self, record: MechanismRecord, question: Question, stop: Operation | None = None) -> None:
        self.record, self.question, self.form, self.ns = record, question, closed_form_of(record), _Recorder(stop)
        self.p = kernel_dimensions(record, self.ns.uniform)
        self.given: list[tuple[str, bool]] = []
        self.values: dict[str, dict[str, list[Any]]] = {kind: {} for kind in KINDS}
        self.margins: tuple[Margin, ...] = ()
        self.numbers: dict[str, dict[str, float]] = {}

    def kernel(self) -> Kernel:
        """Everything recorded, with a place for each output."""
        {"inverse": self._inverse, "direct": self._direct, "self_motion": self._self_motion}[self.question]()
        flat = {
            f"{kind} {name} {k}": value
            for kind, named in self.values.items()
            for name, values in named.items()
            for k, value in enumerate(values)
        }
        tape = self.ns.whole(flat)
        outputs = {
            kind: {
                name: tuple(tape.outputs[f"{kind} {name} {k}"] for k in range(len(values)))
                for name, values in named.items()
            }
            for kind, named in self.values.items()
        }
        return Kernel(self.record, self.question, tape, tuple(self.given), self.margins, outputs, self.numbers)

    def _inverse(self) -> None:
        pose = tuple(self._number(name, is_angle(name)) for name in self.record.platform.pose)
        signs = self._signs(sign_names(self.record, "inverse"))
        self._after(self.form.inverse(self.ns, self.p, pose, signs), self.form.inverse_margins)

    def _direct(self) -> None:
        direct, inputs, margins = self.form.direct, self._inputs(), self.form.direct_margins
        if isinstance(direct, PolynomialSystem):
            unknowns = tuple(self._number(name) for name in direct.unknowns)
            for k, value in enumerate(direct.equations(self.ns, self.p, inputs, unknowns)):
                self._put("equation", str(k), value)
            self._put("finite", "finite", direct.finite(unknowns))
            self._after(direct.back(self.ns, self.p, inputs, unknowns), margins)
        elif isinstance(direct, Eliminant):
            extra = (self._signs(direct.signs),) if direct.signs else ()
            for k, value in enumerate(direct.coefficients(self.ns, self.p, inputs, *extra)):
                self._put("coefficient", str(k), value)
            root = self._number(direct.unknown, direct.kind == "angle")
            if direct.left_over is not None:
                self._put("left over", "left over", direct.left_over(self.ns, self.p, inputs, (*root, 1), *extra))
            self._after(direct.back(self.ns, self.p, inputs, root, *extra), margins)
        elif direct is not None:
            self._after(direct(self.ns, self.p, inputs, self._signs(sign_names(self.record, "direct"))), margins)

    def _self_motion(self) -> None:
        curve, inputs = self.form.self_motion, self._inputs()
        if curve is None:
            return
        turn = self._number(curve.parameter, True)
        branch = curve.kernel(self.ns, self.p, inputs, turn, self._signs(sign_names(self.record, "direct")))
        self._after(branch, [item for item in self.form.direct_margins if item.name in branch.margins])

    def _after(self, branch: Branch, margins: Sequence[Margin]) -> None:
        """What is worked out from a branch."""
        form, ns, p, core = self.form, self.ns, self.p, branch.core
        self.margins = tuple(margins)
        for item in margins:
            self._put("margin", item.name, branch.margins[item.name])
        for name, value in zip(self.record.platform.pose, branch.pose, strict=True):
            self._put("pose", name, value)
        for actuated, value in zip(self.record.inputs, branch.inputs, strict=True):
            self._put("input", actuated.name, value)
        known = vars(core)
        signs = {name: known[item.attribute] for name, item in form.signs.items() if item.attribute in known}
        answers = (("joint", form.joints(ns, p, core)), ("factor", form.factors(ns, p, core)), ("sign", signs))
        for kind, named in answers:
            for name, value in named.items():
                self._put(kind, name, value)
        for kind, rows in zip(("jp", "jq"), form.jacobians(ns, p, core), strict=True):
            for r, row in enumerate(rows):
                self._put(kind, str(r), tuple(row))
        self._quantities(branch)

    def _quantities(self, branch: Branch) -> None:
        """Those that the question is asked for: one of the direct problem need not exist in the inverse one."""
        if self.form.quantities is None:
            return
        found = self.form.quantities(self.ns, self.p, branch.core)
        own = "inverse" if self.question == "inverse" else "direct"
        asked = {item.name for item in self.form.quantity_list if item.problem in (own, "both")}
        for name, value in found.items():
            if name in asked:
                self._put("quantity", name, value)

    def _put(self, kind: str, name: str, value: Any) -> None:
        parts = _flat(value)
        if kind in PLACED:
            parts = [part if isinstance(part, Recorded) else self.ns.number(part) for part in parts]
        self.values[kind][name] = [part for part in parts if isinstance(part, Recorded)]
        if kind not in PLACED and len(parts) == 1 and not isinstance(parts[0], Recorded):
            self.numbers.setdefault(kind, {})[name] = float(parts[0])

    def _number(self, name: str, angle: bool = False) -> Any:
        self.given.append((name, angle))
        if angle:
            return self.ns.varying(f"cos {name}"), self.ns.varying(f"sin {name}")
        return self.ns.varying(name)

    def _inputs(self) -> tuple[Any, ...]:
        return tuple(self._number(item.name, item.coordinate.kind == "angle") for item in self.record.inputs)

    def _signs(self, names: Sequence[str]) -> SimpleNamespace:
        return SimpleNamespace(**{name: self.ns.uniform(f"sign.{name}") for name in names})


def _flat(value: Any) -> list[Any]:
    return [part for item in value for part in _flat(item)] if isinstance(value, (tuple, list)) else [value]
