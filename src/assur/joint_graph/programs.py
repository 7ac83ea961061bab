"""The joint graph as straight-line programs: recorded once for all mechanisms of one structure, run over arrays.

Dimensions are uniform numbers of a program, so that a mechanism with other dimensions runs the same one. Dimensions
that are 0, 1 or -1, or equal one another, are structure.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import groupby
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import geometry
from assur.joint_graph.state import Numbers, ball_rates, changes_of, state_names, state_of
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.numerics.dual import Dual
from assur.numerics.recording.straight_line import StraightLine
from assur.numerics.recording.tape import Recorded, Recorder, Tape, pruned, without_unused
from assur.numerics.vectors import Matrix

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]
Outputs = Mapping[str, Any]
Wanted = Callable[..., Outputs]
"""What a configuration, and other numbers that are given, are asked for."""


@dataclass(frozen=True, eq=False)
class GraphProgram:
    """Numbers of a configuration as a program of its state.

    Attributes:
        tape: varying numbers are of the state, rates of ball joints, others that are given; uniform ones dimensions.
        places: of the varying numbers among all these.
        names: of all outputs, in their order.
        constants: outputs that are the same at every configuration of every mechanism of the structure.
    """

    tape: Tape
    places: tuple[int, ...]
    names: tuple[str, ...]
    constants: Mapping[str, float]

    def __call__(self, record: MechanismRecord, values: FloatArray, given: FloatArray | None = None) -> FloatArray:
        """All outputs (m, N) at joint values (N, n) of a mechanism of the structure, and other given numbers (g, N)."""
        answer = np.empty((len(self.names), len(values)))
        numbers = self._varying(record, np.ascontiguousarray(values.T), given)
        self.straight_line.fill(answer, self._rows, numbers, dimensions(record))
        answer[self._constant_rows] = self._constant_values[:, None]
        return answer

    def at_state(self, record: MechanismRecord, state: Numbers) -> Numbers:
        """All outputs (m, N) at a state (k, N), which may be complex.

        The rates of a ball joint are its angular velocity in the parent's frame, not those of a rotation vector.
        """
        answer = np.empty((len(self.names), state.shape[1]), dtype=state.dtype)
        unit = np.tile(np.eye(3).ravel(), len(joint_graph(record).turns))
        numbers = [
            state[place] if place < len(state) else np.full(state.shape[1], unit[place - len(state)], state.dtype)
            for place in self.places
        ]
        self.straight_line.fill(answer, self._rows, np.array(numbers), dimensions(record))
        answer[self._constant_rows] = self._constant_values[:, None]
        return answer

    def derivative(
        self, record: MechanismRecord, values: FloatArray, rates: FloatArray, given: FloatArray | None = None
    ) -> FloatArray:
        """How fast all outputs (m, N) change at joint rates (N, n), given numbers held; the program over dual numbers.

        The rates of a ball joint are its angular velocity in the parent's frame. Outputs that ask for the angular
        velocities of rotation vectors have no derivative here.
        """
        columns = np.ascontiguousarray(values.T)
        numbers = self._varying(record, columns, given)
        changes = np.zeros_like(numbers)
        moving = changes_of(record, columns, rates.T)
        own = [row for row, place in enumerate(self.places) if place < len(moving)]
        changes[own] = moving[[self.places[row] for row in own]]
        outputs = self.tape.evaluate(list(map(Dual, numbers, changes)), dimensions(record))
        answer = np.zeros((len(self.names), len(values)))
        for row in self._rows:
            number = outputs[self.names[row]]
            answer[row] = number.derivative if isinstance(number, Dual) else 0.0
        return answer

    def _varying(self, record: MechanismRecord, columns: FloatArray, given: FloatArray | None) -> FloatArray:
        """The varying numbers (k, N) of the tape, of all that there are."""
        state, places = state_of(record, columns), np.array(self.places, dtype=np.intp)
        count, balls = len(state), 9 * len(joint_graph(record).turns)
        own, turning = places < count, (places >= count) & (places < count + balls)
        parts = [state if np.all(own) and len(own) == count else state[places[own]]]
        if np.any(turning):
            parts.append(ball_rates(record, columns)[places[turning] - count])
        if given is not None:
            parts.append(given[places[~own & ~turning] - count - balls])
        return parts[0] if len(parts) == 1 else np.concatenate(parts)

    def matrix(self, kind: str, numbers: Numbers, shape: tuple[int, int]) -> Numbers:
        """Matrices (N, rows, columns) of the outputs "kind row,column" among all (m, N); others are zero."""
        filled = np.zeros((numbers.shape[1], shape[0] * shape[1]), dtype=numbers.dtype)
        if kind in self._entries:
            row, column = self._entries[kind]
            filled[:, row * shape[1] + column] = numbers[self.rows(kind)].T
        return filled.reshape(numbers.shape[1], *shape)

    def rows(self, kind: str) -> slice:
        """Where the outputs of a kind stand, which follow each other."""
        return self._rows_of.get(kind, slice(0, 0))

    @cached_property
    def _rows_of(self) -> dict[str, slice]:
        kinds = groupby(range(len(self.names)), lambda k: self.names[k].partition(" ")[0])
        runs = [(kind, list(places)) for kind, places in kinds]
        return {kind: slice(places[0], places[-1] + 1) for kind, places in runs}

    @cached_property
    def _entries(self) -> dict[str, IntArray]:
        """Rows and columns (2, m) of all outputs of a kind that is a matrix."""
        kinds = {name.partition(" ")[0]: self.rows(name.partition(" ")[0]) for name in self.names if "," in name}
        return {
            kind: np.array([name.partition(" ")[2].split(",") for name in self.names[rows]], dtype=np.intp).T
            for kind, rows in kinds.items()
        }

    @cached_property
    def straight_line(self) -> StraightLine:
        """The program's code."""
        return StraightLine(self.tape)

    @cached_property
    def _rows(self) -> list[int]:
        return [k for k, name in enumerate(self.names) if name not in self.constants]

    @cached_property
    def _constant_rows(self) -> list[int]:
        return [k for k, name in enumerate(self.names) if name in self.constants]

    @cached_property
    def _constant_values(self) -> FloatArray:
        return np.array([self.constants[name] for name in self.names if name in self.constants], dtype=float)


def program(record: MechanismRecord, asked: Wanted, given: tuple[str, ...] = ()) -> GraphProgram:
    """The program of what a function asks of a configuration.

    Args:
        record: the mechanism.
        asked: names numbers of a configuration; the same function gives the same program.
        given: names of other varying numbers, which the function takes after the configuration.

    Example: the frame of the platform of a five-bar turns and moves in the plane.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> def height(configuration):
    ...     return {"y": configuration.frames["rod1"][1][1]}
    >>> program(record, height)(record, np.array([[np.pi / 2, 0.0, 0.0, 0.0, 0.0]])).shape
    (1, 1)
    """
    return _programs(_structure(record), asked, given)


@lru_cache(maxsize=256)
def _programs(structure: _Structure, asked: Wanted, given: tuple[str, ...]) -> GraphProgram:
    return structure.program(asked, given)


@lru_cache(maxsize=64)
def _structure(record: MechanismRecord) -> _Structure:
    return _Structure(record)


@lru_cache(maxsize=256)
def part(whole: GraphProgram, kind: str) -> GraphProgram:
    """The program of the outputs of one kind alone."""
    names = whole.names[whole.rows(kind)]
    constants = {name: whole.constants[name] for name in names if name in whole.constants}
    outputs = {name: whole.tape.outputs[name] for name in names if name not in constants}
    fewer = pruned(whole.tape.operations, whole.tape.varying, whole.tape.uniform, outputs)
    tape, places = without_unused(fewer)
    return GraphProgram(tape, tuple(whole.places[place] for place in places), names, constants)


class _Structure:
    """What mechanisms have in common that run the same programs."""

    def __init__(self, record: MechanismRecord) -> None:
        self.record = record
        places: dict[float, int] = {}

        def placed(number: float) -> str:
            return f"number {places.setdefault(number, len(places))}"

        self.pattern = geometry(record).mapped(placed)
        joints = tuple((joint.type.name, joint.parent, joint.child) for joint in record.joints.values())
        self._key = (record.base, record.platform.link, joints, self.pattern.key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Structure) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    def program(self, asked: Wanted, given: tuple[str, ...]) -> GraphProgram:
        recorder, record = Recorder(), self.record
        varying = {name: tuple(map(recorder.varying, own)) for name, own in state_names(record).items()}
        rates = {
            name: _matrix(recorder.varying(f"rate {name} {k}") for k in range(9))
            for name, joint in record.joints.items()
            for step in joint.type.steps
            if step.kind == "ball"
        }
        uniform: dict[str, Recorded] = {}

        def number(name: str) -> Recorded:
            if name not in uniform:
                uniform[name] = recorder.uniform(name)
            return uniform[name]

        others = [recorder.varying(name) for name in given]
        outputs = asked(Configuration(joint_graph(record), self.pattern.mapped(number), varying, rates), *others)
        constants = {name: float(value) for name, value in outputs.items() if not isinstance(value, Recorded)}
        tape = recorder.tape({name: value for name, value in outputs.items() if name not in constants})
        return GraphProgram(*without_unused(tape), tuple(outputs), constants)


@lru_cache(maxsize=64)
def dimensions(record: MechanismRecord) -> list[float]:
    """The uniform numbers of a mechanism's programs."""
    numbers: dict[float, None] = {}

    def noted(number: float) -> float:
        numbers[number] = None
        return number

    geometry(record).mapped(noted)
    return list(numbers)


def _matrix(numbers: Iterator[Recorded]) -> Matrix:
    a, b, c, d, e, f, g, h, i = numbers
    return (a, b, c), (d, e, f), (g, h, i)
