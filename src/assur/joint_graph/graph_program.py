"""A program of the joint graph: numbers of configurations over arrays.

Dimensions are uniform numbers of a program, so that a mechanism with other dimensions runs the same one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import geometry
from assur.joint_graph.state import Numbers, ball_rates, changes_of, state_of
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.numerics.dual import Dual
from assur.numerics.recording.straight_line import StraightLine

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class GraphProgram:
    """Numbers of a configuration as a program of its state.

    Attributes:
        line: of a tape whose varying numbers are of the state, rates of ball joints, others that are given; uniform
            ones are those that are the same everywhere, then dimensions.
        places: of the varying numbers among all these.
        names: of all outputs, in their order.
        constants: outputs that are the same at every configuration of every mechanism of the structure.
    """

    line: StraightLine
    places: tuple[int, ...]
    names: tuple[str, ...]
    constants: Mapping[str, float]

    def __call__(
        self,
        record: MechanismRecord,
        values: FloatArray,
        given: FloatArray | None = None,
        same: Sequence[float] = (),
    ) -> FloatArray:
        """All outputs (m, N) at joint values (N, n) of a mechanism of the structure.

        Of other numbers those that are the same everywhere are `same`, the others `given` (g, N).
        """
        answer = np.empty((len(self.names), len(values)))
        numbers = self._varying(record, np.ascontiguousarray(values.T), given)
        self.line.fill(answer, self._rows, numbers, [*same, *dimensions(record)])
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
        self.line.fill(answer, self._rows, np.array(numbers), dimensions(record))
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
        outputs = self.line.tape.evaluate(list(map(Dual, numbers, changes)), dimensions(record))
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
    def _rows(self) -> list[int]:
        return [k for k, name in enumerate(self.names) if name not in self.constants]

    @cached_property
    def _constant_rows(self) -> list[int]:
        return [k for k, name in enumerate(self.names) if name in self.constants]

    @cached_property
    def _constant_values(self) -> FloatArray:
        return np.array([self.constants[name] for name in self.names if name in self.constants], dtype=float)


@lru_cache(maxsize=64)
def dimensions(record: MechanismRecord) -> list[float]:
    """The uniform numbers of a mechanism's programs."""
    numbers: dict[float, None] = {}

    def noted(number: float) -> float:
        numbers[number] = None
        return number

    geometry(record).mapped(noted)
    return list(numbers)
