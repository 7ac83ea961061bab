"""Tapes as programs: arrays go through NumPy, short ones level by level, a few elements through Python's own floats.

Where NumPy has worked for as long as machine code takes to load, that goes on: a few elements at a time stay in the
cache, and the bits are the same.

Python's lines are like `v7 = v3 * v5`; nothing but the tape's operations and numbers is in them.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import sqrt
from types import CodeType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from assur.numerics.recording.levels import Levels, levels
from assur.numerics.recording.tape import Tape

if TYPE_CHECKING:
    from assur.numerics.recording.interval_plan import IntervalPlan

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

FEW = 40
"""Operations on Python's floats that take as long as one on arrays, however many rows that has: some 30 ns each."""
WIDE = 256
"""Elements from which rows are so long that NumPy is better called for one operation after the other."""
AT_ONCE = 256
"""Elements that machine code works on at a time."""
REPAID = 1_000_000_000
"""Elements times operations after which machine code is loaded: by NumPy they take about a second."""
TEXT = {
    **{name: f"    v%d = v%d {name} v%d" for name in "+-*/"},
    "negative": "    v%d = -v%d",
    "root": "    v%d = root(v%d)",
}


@dataclass(frozen=True, eq=False)
class StraightLine:
    """A tape without comparisons, ready to be called.

    Attributes:
        tape: the tape.
        levels: its operations on arrays.
        code: its lines as Python's own code, where these are the faster way for one element; else made when needed.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x, p = recorder.varying("x"), recorder.uniform("p")
    >>> straight_line(recorder.tape({"y": x * p, "z": recorder.sqrt(x)}))(np.array([[4.0, 9.0]]), [0.5])
    array([[2. , 4.5],
           [2. , 3. ]])
    """

    tape: Tape
    levels: Levels
    code: CodeType | None

    def __call__(self, varying: FloatArray, uniform: Sequence[float]) -> FloatArray:
        """Outputs (m, N) in the tape's order, of numbers (k, N) and (u,)."""
        answer = np.empty((len(self.tape.outputs), varying.shape[1]))
        self.fill(answer, range(len(answer)), varying, uniform)
        return answer

    def fill(self, answer: NDArray[Any], rows: Sequence[int], varying: NDArray[Any], uniform: Sequence[float]) -> None:
        """The same, each output into its row of a larger answer (M, N); without roots, numbers may be complex."""
        work = len(self.tape.operations) * varying.shape[1]
        few = self.code and work <= FEW * len(self.levels.steps)
        if few and self._filled_one_by_one(answer, rows, varying, uniform):
            return
        if answer.dtype == varying.dtype == float and _DONE.repaid(work):
            self.fill_by_code(answer, rows, varying, uniform)
            return
        if varying.shape[1] < WIDE:
            answer[rows] = self.levels.outputs_of(varying, uniform)
            return
        with np.errstate(all="ignore"):
            for row, numbers in zip(rows, self._run(list(varying), uniform, _roots), strict=True):
                answer[row] = numbers

    def fill_by_code(
        self, answer: FloatArray, rows: Sequence[int], varying: FloatArray, uniform: Sequence[float]
    ) -> None:
        """The same by machine code."""
        from assur.numerics.recording.float_code import run  # numba takes long to start

        plan, row_of = self._plan
        work = np.empty((plan.places, AT_ONCE))
        work[: len(uniform) + len(plan.numbers)] = np.array([*uniform, *plan.numbers])[:, None]
        places = np.array(rows, dtype=np.intp)
        run(plan.steps, np.ascontiguousarray(varying), answer, places[row_of[0]], work)
        for first, other in row_of[1]:  # outputs that are one number
            answer[places[other]] = answer[places[first]]

    @cached_property
    def _plan(self) -> tuple[IntervalPlan, tuple[IntArray, list[tuple[int, int]]]]:
        """The tape as rows; of each stored number the first output that it is, and outputs that are alike."""
        from assur.numerics.recording.interval_plan import interval_plan

        plan, first = interval_plan(self.tape), dict[int, int]()
        alike = [
            (first[entry], place)
            for place, entry in enumerate(self.tape.outputs.values())
            if first.setdefault(entry, place) != place
        ]
        stored = {plan.rows[entry]: place for entry, place in first.items()}
        return plan, (np.array([stored[row] for row in range(len(stored))], dtype=np.intp), alike)

    def _filled_one_by_one(
        self, answer: NDArray[Any], rows: Sequence[int], varying: NDArray[Any], uniform: Sequence[float]
    ) -> bool:
        """Whether Python's floats came to the end; where they would be infinite they stop."""
        try:
            columns = [self._run(column, uniform, _root) for column in varying.T.tolist()]
        except (ZeroDivisionError, OverflowError):
            return False
        answer[rows] = np.transpose(columns)
        return True

    @cached_property
    def _run(self) -> Callable[..., Sequence[Any]]:
        names: dict[str, Any] = {"inf": float("inf"), "nan": float("nan")}
        exec(self.code or compiled(self.tape), names)
        run: Callable[..., Sequence[Any]] = names["run"]
        return run


@dataclass
class _Done:
    """Work done so far that machine code could have done."""

    work: int = 0
    compilable: bool = field(default_factory=lambda: importlib.util.find_spec("numba") is not None)

    def repaid(self, work: int) -> bool:
        """Whether machine code is to be used from now on."""
        self.work = min(self.work + work, REPAID)
        return self.compilable and self.work >= REPAID


_DONE = _Done()


def straight_line(tape: Tape) -> StraightLine:
    """The program of a tape."""
    own = levels(tape)
    return StraightLine(tape, own, compiled(tape) if len(tape.operations) <= FEW * len(own.steps) else None)


def compiled(tape: Tape) -> CodeType:
    """Its lines as Python's own code; to compile them takes as long as to record the tape."""
    return compile("\n".join(lines(tape)), "<tape>", "exec")


def lines(tape: Tape) -> list[str]:
    """The text of `run(varying, uniform, root)`, which returns the tape's outputs in their order.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> lines(recorder.tape({"y": -(x * x)}))
    ['def run(varying, uniform, root):', '    v0 = varying[0]', '    v0 = v0 * v0', '    v0 = -v0', '    return [v0]']
    """
    from assur.numerics.recording.registers import assignments  # where code is kept, nobody asks

    text = ["def run(varying, uniform, root):"]
    register: dict[int, int] = {}
    for entry, operation, place, arguments, given in assignments(tape, tape.outputs.values()):
        if operation.name in ("varying", "uniform"):
            text.append(f"    v{place} = {operation.name}[{given}]")
        elif operation.name == "number":
            text.append(f"    v{place} = {operation.number!r}")
        else:
            text.append(TEXT[operation.name] % (place, *arguments))
        register[entry] = place
    return [*text, f"    return [{', '.join(f'v{register[k]}' for k in tape.outputs.values())}]"]


def _root(radicand: float) -> float:
    return sqrt(radicand) if radicand > 0.0 else 0.0 * radicand


def _roots(radicand: Any) -> Any:
    return np.sqrt(np.maximum(radicand, 0.0))
