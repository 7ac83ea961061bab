"""Terms of the equation of motion from a tape of places: by its derivatives, link for link, and by Cramer's rule."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.validation.check import METRES
from assur.machine.masses.link_masses import all_masses
from assur.machine.motion.inertia import rotors
from assur.machine.motion.pivot_checks import total
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS
from assur.numerics.recording.derivatives import again, exact, is_zero, quotient, rates, second_rates
from assur.numerics.recording.tape import Recorder, Tape
from assur.numerics.vectors import Matrix, Vector, add, apply, cross, dot, minus, plus, scaled, times, transposed

RATE, SECOND, PUSH = "{}'", "{}''", "f_{}"
"""How the rate and the acceleration of a coordinate, and the force along it, are named on a tape."""
COSINE, SINE = "cos {}", "sin {}"
"""How these of an angle of the pose are named."""


def pose_numbers(pose: Sequence[str]) -> list[str]:
    """What tapes are given of a pose: lengths, and cosines and sines of angles.

    >>> pose_numbers(("x", "phi"))
    ['x', 'cos phi', 'sin phi']
    """
    pairs = ((name,) if name in LENGTHS else (COSINE.format(name), SINE.format(name)) for name in pose)
    return [number for pair in pairs for number in pair]


FloatArray = NDArray[np.float64]
Sums = tuple[dict[tuple[int, int], Any], dict[int, Any], dict[int, Any]]


@dataclass(frozen=True, eq=False)
class _Moving:
    """Entries of the tape of places with their derivatives; what is not there is zero.

    Attributes:
        places: the tape.
        entries: recorded once more.
        partial: how fast they change with each coordinate of the pose.
        first, second: how fast at the rates of the pose, and how fast that changes while these stay as they are.
    """

    places: Tape
    entries: Sequence[Any]
    partial: Sequence[Sequence[Any]]
    first: Sequence[Any]
    second: Sequence[Any]

    def vector(self, name: str, numbers: Sequence[Any]) -> Vector:
        """Three numbers of a name."""
        return vector(self._number(f"{name},{a}", numbers) for a in range(3))

    def matrix(self, name: str, numbers: Sequence[Any]) -> Matrix:
        """Nine numbers of a name."""
        return _rows(self._number(f"{name},{a}", numbers) for a in range(9))

    def input_rate(self, place: int, numbers: Sequence[Any]) -> Any:
        """Rate of an input: of a length its own, of an angle by its cosine and sine."""
        if f"cos {place}" not in self.places.outputs and f"sin {place}" not in self.places.outputs:
            return self._number(f"q {place}", numbers)
        cosine, sine = (self._number(f"{name} {place}", self.entries) for name in ("cos", "sin"))
        turning = times(cosine, self._number(f"sin {place}", numbers))
        return minus(turning, times(sine, self._number(f"cos {place}", numbers)))

    def _number(self, name: str, numbers: Sequence[Any]) -> Any:
        place = self.places.outputs.get(name)
        return 0 if place is None else numbers[place]


def terms(record: MechanismRecord, places: Tape, axes: Mapping[str, FloatArray]) -> Tape:
    """Of D^T tau = u (M a + c) + g - f, from places and their derivatives; see `MotionFormulas`.

    Links with `axes` (3,) are the same however they turn about these, which is left out: they turn across them alone.
    """
    recorder, names = Recorder(), record.platform.pose
    entries = again(recorder, places)
    velocity, acceleration, pushed = (
        [recorder.varying(form.format(name)) for name in names] for form in (RATE, SECOND, PUSH)
    )
    given = dict(zip(places.varying, (entries[k] for k in _varying(places)), strict=True))
    along = [[_change(given, number, name) for number in given] for name in names]  # per rate of each coordinate
    first = rates(places, entries, [_sum_of(ways, velocity) for ways in zip(*along, strict=True)])
    squares = [times(rate, rate) for rate in velocity]
    bent = [[0 if name in LENGTHS or number.split()[-1] != name else minus(0, given[number]) for number in given]
            for name in names]  # fmt: skip
    second = second_rates(places, entries, first, [_sum_of(ways, squares) for ways in zip(*bent, strict=True)])
    moving = _Moving(places, entries, [rates(places, entries, ways) for ways in along], first, second)
    mass, bias, weight = _summed(record, moving, axes)
    driven = {
        (d, k): moving.input_rate(d, own) for d in range(len(record.drives)) for k, own in enumerate(moving.partial)
    }
    for place, item in enumerate(record.drives):
        rotor = rotors(record)[item.coordinate.index]
        rotor = exact(rotor / (1.0 if item.coordinate.kind == "length" else METRES[record.unit] ** 2))
        for i, j in mass:
            mass[i, j] = plus(mass[i, j], times(rotor, times(driven[place, i], driven[place, j])))
        for i in bias:
            speeding = times(rotor, moving.input_rate(place, moving.second))
            bias[i] = plus(bias[i], times(driven[place, i], speeding))
    needed = {}
    for i in bias:
        inert = total(times(mass[min(i, j), max(i, j)], acceleration[j]) for j in bias)
        inert = times(exact(METRES[record.unit]), plus(inert, bias[i]))
        needed[i] = minus(plus(inert, weight[i]), pushed[i])
    outputs = {f"D {place},{k}": value for (place, k), value in driven.items()}
    outputs |= {f"g {i}": value for i, value in weight.items()}
    outputs |= {f"M {i},{j}": value for (i, j), value in mass.items()}
    outputs |= {f"c {i}": value for i, value in bias.items()}
    outputs |= {f"r {i}": value for i, value in needed.items()}
    outputs |= {f"tau {d}": value for d, value in enumerate(_borne(driven, [*needed.values()], len(record.drives)))}
    return recorder.tape({name: value for name, value in outputs.items() if not is_zero(value)})


def _varying(places: Tape) -> Iterator[int]:
    return (k for k, operation in enumerate(places.operations) if operation.name == "varying")


def _change(given: Mapping[str, Any], number: str, name: str) -> Any:
    """How a number of the pose changes per rate of a coordinate."""
    if number == COSINE.format(name):
        return minus(0, given[SINE.format(name)])
    return given[COSINE.format(name)] if number == SINE.format(name) else int(number == name)


def _sum_of(ways: Sequence[Any], rates_of: Sequence[Any]) -> Any:
    return total(times(way, rate) for way, rate in zip(ways, rates_of, strict=True))


def _summed(record: MechanismRecord, moving: _Moving, axes: Mapping[str, FloatArray]) -> Sums:
    """Mass matrix, bias and gravity of the links."""
    unit, known, count = METRES[record.unit], all_masses(record), len(record.platform.pose)
    mass: dict[tuple[int, int], Any] = {}
    bias: dict[int, Any] = {}
    weight: dict[int, Any] = {}
    for link, body in known.carried(record.platform.link).items():
        own, inertia = exact(body.mass), _rows(exact(x) for x in (body.inertia / unit**2).ravel())
        ways = [moving.vector(f"c {link}", part) for part in moving.partial]
        speeding = moving.vector(f"c {link}", moving.second)
        turns: list[Vector] = []
        torque: Vector = (0, 0, 0)
        axis = axes.get(link)
        if axis is not None:
            own_inertia = exact(_across(body.inertia, axis) / unit**2)
            turns = [moving.vector(f"e {link}", part) for part in moving.partial]
            torque = scaled(moving.vector(f"e {link}", moving.second), own_inertia)
        elif np.any(body.inertia):
            rotation, change, second = (
                moving.matrix(f"r {link}", part) for part in (moving.entries, moving.first, moving.second)
            )
            turns = [_turning(rotation, moving.matrix(f"r {link}", part)) for part in moving.partial]
            spin = _turning(rotation, change)
            speeding_up = _turning(rotation, second, change)
            torque = add(apply(inertia, speeding_up), cross(spin, apply(inertia, spin)))
        for i in range(count):
            pull = dot(vector(map(exact, known.gravity)), ways[i])
            weight[i] = minus(weight.get(i, 0), times(own, pull))
            needed = times(own, dot(ways[i], speeding))
            bias[i] = plus(bias.get(i, 0), plus(needed, dot(turns[i], torque)) if turns else needed)
            for j in range(i, count):
                inert = times(own, dot(ways[i], ways[j]))
                if turns:
                    bent = apply(inertia, turns[j]) if axis is None else scaled(turns[j], own_inertia)
                    inert = plus(inert, dot(turns[i], bent))
                mass[i, j] = plus(mass.get((i, j), 0), inert)
    return mass, bias, weight


def _across(inertia: FloatArray, axis: FloatArray) -> float:
    """Of a body that is the same however it turns about an axis (3,), about one across."""
    return 0.5 * float(np.trace(inertia) - axis @ inertia @ axis)


def _turning(rotation: Matrix, change: Matrix, before: Matrix | None = None) -> Vector:
    """Angular velocity in the link's axes of an orientation that changes; its rate by the second and first change."""
    pairs = (2, 1), (0, 2), (1, 0)
    own = vector(dot(change[i], rotation[j]) for i, j in pairs)
    if before is not None:
        own = add(own, vector(dot(before[i], before[j]) for i, j in pairs))
    return apply(transposed(rotation), own)


def _borne(driven: Mapping[tuple[int, int], Any], needed: Sequence[Any], drives: int) -> list[Any]:
    """What the actuators exert, by Cramer's rule; with more of them than freedoms the least."""
    k = len(needed)
    if drives == k:
        return _solved([[driven[d, i] for d in range(drives)] for i in range(k)], needed)
    square = [[total(times(driven[d, i], driven[d, j]) for d in range(drives)) for j in range(k)] for i in range(k)]
    own = _solved(square, needed)
    return [total(times(driven[d, i], own[i]) for i in range(k)) for d in range(drives)]


def _solved(matrix: Sequence[Sequence[Any]], right: Sequence[Any]) -> list[Any]:
    """The solution of a few linear equations."""
    whole = _determinant(matrix)
    columns = range(len(right))
    return [
        quotient(
            _determinant([[*row[:k], value, *row[k + 1 :]] for row, value in zip(matrix, right, strict=True)]), whole
        )
        for k in columns
    ]


def _determinant(matrix: Sequence[Sequence[Any]]) -> Any:
    if len(matrix) == 1:
        return matrix[0][0]
    whole: Any = 0
    for k, entry in enumerate(matrix[0]):
        if not is_zero(entry):
            part = times(entry, _determinant([[*row[:k], *row[k + 1 :]] for row in matrix[1:]]))
            whole = minus(whole, part) if k % 2 else plus(whole, part)
    return whole


def _rows(numbers: Iterable[Any]) -> Matrix:
    a, b, c, d, e, f, g, h, i = numbers
    return (a, b, c), (d, e, f), (g, h, i)


def vector(numbers: Iterable[Any]) -> Vector:
    """Three numbers.

    >>> vector(range(3))
    (0, 1, 2)
    """
    x, y, z = numbers
    return x, y, z
