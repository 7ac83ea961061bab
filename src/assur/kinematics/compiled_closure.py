"""Newton's method on the joint graph as one compiled loop, for many starts that are near an assembly.

One step is recorded as a straight-line program: frames along the spanning tree, gaps of the loops, their derivative by
screws, and its solution by pivots that were chosen beforehand, at assemblies around home. There the derivative is
exact, also where an entry that always vanishes was left out; Newton's method needs no more. Redundant equations are
not solved, but judged: a start counts as closed by the gaps of all loops. What does not close goes to `assemble`.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.closure import Assembly, assemble, characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.loop_equations import LoopEquations
from assur.kinematics.loop_state import move, state_names, state_of
from assur.model.joint_graph import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.numerics.recording.elimination import NOTHING, solved
from assur.numerics.recording.folding import Folded, Folding
from assur.numerics.recording.loops import Loop, compiled
from assur.numerics.recording.tape import Tape

FloatArray = NDArray[np.float64]

Engine = Literal["auto", "numpy", "compiled"]

BLOCK = 1024
"""Configurations that are closed at a time: their numbers stay in the cache."""
MAX_STEPS = 8
"""Newton steps before a start is given to damped least squares."""
TOLERANCE = 1e-13
"""Newton's steps end where all gaps are at most this times the characteristic length."""
ENOUGH = 1e-12
"""A start whose gaps are larger after all steps is given to damped least squares, which ends there."""
REPAID = 500_000
"""Starts from which making machine code, which takes seconds, is repaid."""
WALKERS, WALKS = 8, 3
"""Assemblies around home at which pivots are chosen: so many at a time, so many times."""
STRIDE = 0.1
"""Step from one of them to the next, in rad and in characteristic lengths."""
DIGITS = 11
"""Significant digits of an entry of the derivative that is the same at all of them."""


@dataclass(frozen=True, eq=False)
class CompiledClosure:
    """Newton's method for the loops of a mechanism with some joint values held; call it with starts.

    Attributes:
        record, held: the mechanism, and which of its joint values do not change.
        tape: one step. Varying numbers: the state; outputs: what moves of it, then squared gaps of the cut joints
            before the step.
        numbers: its uniform numbers.
        unknowns: the joint values that move, as many as there are independent equations; the others stay.
    """

    record: MechanismRecord
    held: tuple[int, ...]
    tape: Tape
    numbers: FloatArray
    unknowns: tuple[int, ...]

    @cached_property
    def loop(self) -> Loop:
        """The step as machine code."""
        return compiled(self.tape)

    def __call__(self, start: FloatArray, *, engine: Engine = "auto") -> Assembly:
        """Close the loops from starts (..., n) near assemblies, as `assemble` with `near` does.

        Args:
            start: joint values (..., n), those that are held as they must be.
            engine: "numpy" works the recorded step out operation by operation, "compiled" as machine code, to the same
                bits; "auto" as machine code where numba is installed and the code is at hand or soon repaid.

        Returns:
            Joint values, the largest gap of all loops, whether it is within tolerance, and the most steps that were
            made. Angles are those nearest the start's.
        """
        count = len(self.record.coordinates)
        if start.shape[-1:] != (count,):
            raise UsageError(f"joint values of shape {start.shape}; {count} of them are wanted")
        flat = np.array(start, dtype=float).reshape(int(np.prod(start.shape[:-1])), count)
        step = self.stepper(engine, len(flat))
        values, gaps, steps = np.ascontiguousarray(flat.T), np.full(len(flat), np.inf), 0
        for first in range(0, len(flat), BLOCK):
            block = slice(first, first + BLOCK)
            values[:, block], gaps[block], made = self._close(values[:, block], step)
            steps = max(steps, made)
        answer = np.ascontiguousarray(values.T)
        missed = np.flatnonzero(~(gaps <= ENOUGH * characteristic_length(self.record)))
        closed = np.ones(len(flat), dtype=bool)
        if len(missed):
            found = assemble(self.record, flat[missed], held=self.held, near=True)
            answer[missed], gaps[missed], closed[missed] = found.values, found.residual, found.closed
            steps = max(steps, found.steps)
        shape = start.shape[:-1]
        return Assembly(answer.reshape(start.shape), gaps.reshape(shape), closed.reshape(shape), steps)

    def stepper(self, engine: Engine, count: int) -> Callable[[FloatArray, FloatArray], None]:
        """What writes the outputs (m, b) of a state (k, b)."""
        if engine not in get_args(Engine):
            raise UnknownNameError("engine of a closure", engine, get_args(Engine))
        absent = importlib.util.find_spec("numba") is None
        if engine == "numpy" or (engine == "auto" and (absent or not (self.loop.loaded or count >= REPAID))):
            return self._evaluated
        return self._compiled

    def _evaluated(self, state: FloatArray, answer: FloatArray) -> None:
        for row, value in zip(answer, self.tape.evaluate(list(state), list(self.numbers)).values(), strict=True):
            row[:] = value

    def _compiled(self, state: FloatArray, answer: FloatArray) -> None:
        rows = (
            np.array([self.loop.places[name] for name in self.tape.outputs], dtype=np.intp),
            np.empty(0, dtype=np.intp),
        )
        truths = np.empty((0, answer.shape[1]), dtype=bool)
        self.loop.fill(state, self.numbers, (answer, truths), rows, (0, answer.shape[1]))

    def _close(
        self, values: FloatArray, step: Callable[[FloatArray, FloatArray], None]
    ) -> tuple[FloatArray, FloatArray, int]:
        """Joint values (n, b) that close, their largest gaps (b,), and how many steps were made."""
        values, state = values.copy(), state_of(self.record, values)
        begun, moving = state.copy(), self._moving
        answer = np.empty((len(self.tape.outputs), values.shape[1]))
        bound, made = TOLERANCE * characteristic_length(self.record), 0
        with np.errstate(all="ignore"):  # a start that is not near may end anywhere; it is then not closed
            while True:
                step(state, answer)
                gaps = self._largest(answer[len(moving) :])
                apart = ~(gaps <= bound)
                if made == MAX_STEPS or not apart.any():
                    break
                for row, moved in zip(moving, answer, strict=False):
                    np.copyto(state[row], moved, where=apart)  # the others stay, whatever their neighbours need
                made += 1
            move(self.record, values, begun, state, set(moving))
        return values, gaps, made

    def _largest(self, squares: FloatArray) -> FloatArray:
        """The largest gap (b,) of squared ones, rotations times the characteristic length."""
        names = list(self.tape.outputs)[len(self._moving) :]
        units = [characteristic_length(self.record) if name.startswith("rotation") else 1.0 for name in names]
        largest = np.zeros(squares.shape[1])
        for unit, row in zip(units, squares, strict=True):
            np.maximum(largest, unit**2 * row, out=largest)
        return np.sqrt(largest)

    @cached_property
    def _moving(self) -> list[int]:
        """Rows of the state that the tape's first outputs replace."""
        return [k for k, name in enumerate(self.tape.varying) if name in self.tape.outputs]


def compiled_closure(
    record: MechanismRecord, held: Sequence[int] = (), *, around: FloatArray | None = None
) -> CompiledClosure:
    """Newton's method on a mechanism's joint graph, recorded for one set of held joint values.

    Args:
        record: a mechanism without helical joints.
        held: indices of joint values that do not change, a ball joint's all or none: the inputs, in a direct problem.
        around: an assembly (n,) around which pivots are chosen, where another mode than that of home is asked for.

    Returns:
        What closes starts (..., n) as `assemble(record, start, held=held, near=True)` does. Where more values are free
        than the loops determine, some of them stay as they are: a rod that spins does not spin.

    Errors:
        UsageError: a helical joint; part of a ball joint held; no joint values of these indices; no loops; no assembly
            around which pivots can be chosen, or only singular ones; `around` of another shape.

    Example: the direct problem of a five-bar, a little away from home; a compiled loop needs numba.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> closure = compiled_closure(record, [item.coordinate.index for item in record.inputs])
    >>> start = home_values(record) + [[0.01, 0.0, 0.0, 0.02, 0.0]]
    >>> found = closure(start)
    >>> bool(found.closed[0]), bool(np.allclose(found.values, assemble(record, start, held=closure.held).values))
    (True, True)
    """
    fixed = _checked(record, held)
    folding = Folding()
    equations = LoopEquations(record, folding)
    given = home_values(record) if around is None else around
    if given.shape != (len(record.coordinates),):
        raise UsageError(
            f"around: joint values of shape {given.shape}; one assembly ({len(record.coordinates)},) is wanted"
        )
    samples = assemblies_around(record, given, fixed)
    entries, matrices = _derivative(equations, samples, fixed)
    changes = solved(entries, [-gap for gap in equations.gaps], matrices)
    moved = equations.moved(changes)
    outputs = {name: part for k, own in moved.items() for name, part in zip(state_names(record)[k], own, strict=True)}
    for k, squares in enumerate(equations.squares):
        named = {f"distance{k}": squares[0], f"rotation{k}": squares[1]}
        outputs |= {name: square for name, square in named.items() if isinstance(square, Folded) or square != 0.0}
    return CompiledClosure(record, fixed, folding.tape(outputs), folding.numbers, tuple(sorted(changes)))


def _checked(record: MechanismRecord, held: Sequence[int]) -> tuple[int, ...]:
    count = len(record.coordinates)
    wrong = [index for index in held if index not in range(count)]
    if wrong:
        raise UsageError(f"held: no joint values {wrong} among 0 .. {count - 1}")
    for first, names in state_names(record).items():
        if len(names) == 4 and len({first, first + 1, first + 2} & set(held)) in (1, 2):
            raise UsageError("held: part of a ball joint", hint=f"hold all of {first} .. {first + 2}, or none")
    if not joint_graph(record).cut:
        raise UsageError(f"{record.name} has no loops to close")
    return tuple(sorted(set(held)))


def assemblies_around(record: MechanismRecord, start: FloatArray, held: Sequence[int]) -> FloatArray:
    """Assemblies (S, n) in general position near one (n,): short walks in all joint values, closed by `assemble`.

    Errors:
        UsageError: none of the walks closes.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> assemblies_around(record, home_values(record), [0, 3]).shape
    (24, 5)
    """
    rng = np.random.default_rng(0)
    length = characteristic_length(record)
    stride = STRIDE * np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    found, last = [], np.repeat(start[None], WALKERS, axis=0)
    for _ in range(WALKS):
        closed = assemble(record, last + rng.uniform(-stride, stride, last.shape), held=held, near=True)
        last = np.where(closed.closed[:, None], closed.values, last)
        found.append(closed.values[closed.closed])
    samples = np.concatenate(found)
    if not len(samples):
        where = f"{record.name}: no assembly near the one that was given"
        raise UsageError(where, hint="give another by around, or hold no more joint values than there are freedoms")
    return samples


def _derivative(
    equations: LoopEquations, samples: FloatArray, held: Sequence[int]
) -> tuple[dict[tuple[int, int], Any], FloatArray]:
    """The gaps' derivative for what is free, and its value (S, 6 v, n) at samples, in units of length and rad.

    An entry that is the same at all samples is a plain number.
    """
    record, folding = equations.record, equations.folding
    entries = {place: entry for place, entry in equations.derivative.items() if place[1] not in held}
    tape = folding.tape({f"{i} {j}": entry for (i, j), entry in entries.items()})
    found = tape.evaluate(list(state_of(record, samples.T)), list(folding.numbers))
    length = characteristic_length(record)
    matrices = np.zeros((len(samples), len(equations.gaps), len(record.coordinates)))
    for i, j in entries:
        values = np.broadcast_to(found[f"{i} {j}"], len(samples))
        unit = (length if record.coordinates[j].kind == "length" else 1.0) / (length if i % 6 < 3 else 1.0)
        matrices[:, i, j] = values * unit
        if np.ptp(values) * unit <= NOTHING:
            entries[i, j] = float(f"{np.mean(values):.{DIGITS}g}") if abs(np.mean(values)) * unit > NOTHING else 0.0
    return entries, matrices
