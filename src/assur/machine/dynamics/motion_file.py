"""The file of a motion: a prescribed one, or a start from which the mechanism is left to forces.

Poses are in the mechanism's unit and the angle unit of its file, times in s, omega in rad/s, phase in rad, forces in N
and N m.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import KeyPath, UsageError
from assur.kinematics.answers.at_border import coordinate_unit
from assur.kinematics.border import LARGEST, drive_names
from assur.machine.dynamics.prescribed_motion import LEAST, MOST, PrescribedMotion, harmonic, sampled
from assur.machine.dynamics.release import MOMENTS, Release, constant_forces, forces_in_time
from assur.model.file.faults import Faults, listed, nearest
from assur.model.file.toml_source import read_toml
from assur.model.file.values import shown
from assur.model.mechanism import MechanismRecord
from assur.model.pose import rate_names
from assur.results.reading import file_text

FloatArray = NDArray[np.float64]
HARMONIC = ("centre", "amplitude", "omega", "phase", "t_end", "count")
SAMPLES = ("t", "pose")
START = ("pose", "velocity", "t_end", "count")
IN_TIME = ("t", "values")


@dataclass(frozen=True, eq=False)
class MotionFile:
    """What a file says: a prescribed motion, or a start and forces; the other is None."""

    prescribed: PrescribedMotion | None
    release: Release | None


def read_motion(record: MechanismRecord, path: Path) -> MotionFile:
    """The motion of a mechanism that a file says.

    Errors:
        MechanismFileError: the file has faults; all of them are in it, with their lines.
        UsageError: there is no such file.
    """
    return motion_of_text(record, file_text(path), str(path))


def motion_of_text(record: MechanismRecord, text: str, file: str) -> MotionFile:
    r"""The same of the text of a file, whose name stands in errors.

    >>> from assur.model.registry import load_record
    >>> text = "[harmonic]\ncentre = [0, 224]\namplitude = [10, 0]\nomega = 2"
    >>> read = motion_of_text(load_record("fivebar"), text, "sway.toml")
    >>> len(read.prescribed.times), read.release is None
    (65, True)
    """
    source = read_toml(text, file)
    reading = _Reading(record, Faults(file, source), source.data)
    read = reading.motion()
    reading.faults.raise_any()
    return read


@dataclass(frozen=True, eq=False)
class _Reading:
    """A document that is read, its faults noted."""

    record: MechanismRecord
    faults: Faults
    data: dict[str, Any]

    def motion(self) -> MotionFile:
        """What it says; of no use where faults were noted."""
        kinds = [name for name in self.data if name in ("harmonic", "samples", "forces")]
        if len(kinds) > 1:
            self.faults.add((kinds[1],), f"[{kinds[0]}] and [{kinds[1]}]", "allowed: one of them")
            return MotionFile(None, None)
        if not self.data:
            self.faults.add(("harmonic",), "missing", "allowed: [harmonic], [samples], or pose, t_end and [forces]")
            return MotionFile(None, None)
        prescribed = kinds and kinds[0] != "forces"
        self._known(self.data, (), (*kinds, *(() if prescribed else (*START, "forces"))), ("harmonic", "samples"))
        table = self.data.get(kinds[0], {}) if kinds else {}
        if not isinstance(table, dict):
            self.faults.add((kinds[0],), shown(table), "allowed: a table [...] of its own")
            return MotionFile(None, None)
        if prescribed:
            return MotionFile(self._harmonic(table) if kinds[0] == "harmonic" else self._samples(table), None)
        return MotionFile(None, self._release(table))

    def _harmonic(self, table: dict[str, Any]) -> PrescribedMotion | None:
        names, own = self.record.platform.pose, ("harmonic",)
        self._known(table, own, HARMONIC)
        units = self._units(names)
        read = {
            "centre": self._vector(table, own, "centre", names, units),
            "amplitude": self._vector(table, own, "amplitude", names, units),
            "omega": self._vector(table, own, "omega", names, spread=True),
            "phase": self._vector(table, own, "phase", names, spread=True, default=0.0),
        }
        end = self._positive(table, own, "t_end", needed=False)
        count = self._count(table, own)
        return self._sound(own, lambda: harmonic(self.record, **read, t_end=end, count=count))

    def _samples(self, table: dict[str, Any]) -> PrescribedMotion | None:
        own = ("samples",)
        self._known(table, own, SAMPLES)
        times = self._times(table, own, LEAST)
        names = self.record.platform.pose
        poses = self._rows(table, own, "pose", names, self._units(names), len(times))
        return self._sound(own, lambda: sampled(self.record, times, poses))

    def _release(self, table: dict[str, Any]) -> Release | None:
        drives, names = drive_names(self.record), self.record.platform.pose
        labels = [self.record.coordinate_label(item.coordinate) for item in self.record.drives]
        inside = [key for key in START if key in table]  # as a table of TOML takes in what follows it
        in_time = any(key in table for key in IN_TIME)
        self._known(table, ("forces",), (*inside, *(IN_TIME if in_time else (*drives, *labels))))
        for key in inside:
            if key in self.data:
                self.faults.add(("forces", key), f"{key} a second time", "allowed: once")
        start, own = {**self.data, **{key: table[key] for key in inside}}, ("forces",) if inside else ()
        rates = rate_names(names)
        pose = self._vector(start, own, "pose", names, self._units(names))
        velocity = self._vector(start, own, "velocity", rates, self._units(rates), default=0.0)
        end, count = self._positive(start, own, "t_end"), self._count(start, own)
        if in_time:
            times = self._times(table, ("forces",), 2)
            values = self._rows(table, ("forces",), "values", drives, np.ones(len(drives)), len(times))
        else:
            constant = np.array([self._of_drive(table, pair) for pair in zip(drives, labels, strict=True)])
        if self.faults.problems or end is None:
            return None
        exerted = forces_in_time(times, values) if in_time else constant_forces(constant)
        return Release(pose, velocity, end, exerted, count=count or MOMENTS)

    def _of_drive(self, table: dict[str, Any], names: Sequence[str]) -> float:
        """The force of an actuator by the name of its input or of its joint; 0 where none is said."""
        for name in names:
            if name in table:
                return self._number(table[name], ("forces", name))
        return 0.0

    def _sound(self, own: KeyPath, made: Any) -> PrescribedMotion | None:
        if self.faults.problems:
            return None
        try:
            prescribed: PrescribedMotion = made()
        except UsageError as error:
            self.faults.add(own, error.message, f"allowed: {error.hint}" if error.hint else "allowed: another motion")
            return None
        return prescribed

    def _units(self, names: Sequence[str]) -> FloatArray:
        return np.array([coordinate_unit(self.record, name) for name in names])

    def _known(self, table: dict[str, Any], path: KeyPath, keys: Iterable[str], others: Iterable[str] = ()) -> None:
        """Note keys that are none of these; `others` are told as well."""
        allowed = tuple(dict.fromkeys((*keys, *others)))
        for key in table:
            if key not in tuple(keys):
                self.faults.add((*path, key), "unknown key", f"allowed here: {listed(allowed)}", nearest(key, allowed))

    def _number(self, value: Any, path: KeyPath) -> float:
        """A finite number; 0 in place of what is none."""
        plain = isinstance(value, int | float) and not isinstance(value, bool)
        if plain and math.isfinite(value) and abs(value) <= LARGEST:
            return float(value)
        self.faults.add(path, shown(value), "allowed: a finite number")
        return 0.0

    def _positive(self, table: dict[str, Any], path: KeyPath, key: str, *, needed: bool = True) -> float | None:
        if key not in table:
            if needed:
                self.faults.add((*path, key), "missing", "this key must be there")
            return None
        number = self._number(table[key], (*path, key))
        if number <= 0.0:
            self.faults.add((*path, key), shown(table[key]), "allowed: a number above 0, in s")
        return number

    def _count(self, table: dict[str, Any], path: KeyPath) -> int | None:
        """Of moments; None where the file leaves it open."""
        count = table.get("count")
        if count is not None and (type(count) is not int or not LEAST <= count <= MOST):
            self.faults.add((*path, "count"), shown(count), f"allowed: a whole number from {LEAST} to {MOST}")
            return None
        return count

    def _vector(
        self,
        table: dict[str, Any],
        path: KeyPath,
        key: str,
        names: Sequence[str],
        units: FloatArray | float = 1.0,
        *,
        spread: bool = False,
        default: float | None = None,
    ) -> FloatArray:
        """A number for each name; one for all of them where it may be `spread`."""
        place = (*path, key)
        value = table.get(key, default)
        if value is None:
            self.faults.add(place, "missing", f"this key must be there: {', '.join(names)}")
            return np.zeros(len(names))
        if key not in table or (spread and not isinstance(value, list)):
            return np.full(len(names), self._number(value, place))
        if not isinstance(value, list) or len(value) != len(names):
            self.faults.add(place, shown(value), f"allowed: a list of {len(names)}: {', '.join(names)}")
            return np.zeros(len(names))
        return np.array([self._number(part, (*place, index)) for index, part in enumerate(value)]) * units

    def _times(self, table: dict[str, Any], path: KeyPath, least: int) -> FloatArray:
        """Times that grow, with `least` of them; none where they are not in form."""
        place, value = (*path, "t"), table.get("t")
        if not isinstance(value, list) or len(value) < least:
            self.faults.add(place, "missing" if value is None else shown(value), f"allowed: a list of {least} at least")
            return np.empty(0)
        times = np.array([self._number(part, (*place, index)) for index, part in enumerate(value)])
        late = np.flatnonzero(np.diff(times) <= 0.0)
        if len(late) and not self.faults.problems:
            index = int(late[0]) + 1
            self.faults.add((*place, index), f"{times[index]:g} after {times[index - 1]:g}", "allowed: times that grow")
        return times

    def _rows(
        self, table: dict[str, Any], path: KeyPath, key: str, names: Sequence[str], units: FloatArray, count: int
    ) -> FloatArray:
        """A row of numbers for each of `count` times."""
        place, value = (*path, key), table.get(key)
        if not isinstance(value, list) or (count and len(value) != count):
            given = "missing" if value is None else shown(value)
            self.faults.add(place, given, f"allowed: a list of {count or 'as many'} rows, one for each time")
            return np.empty((0, len(names)))
        rows = []
        for index, row in enumerate(value):
            if not isinstance(row, list) or len(row) != len(names):
                self.faults.add((*place, index), shown(row), f"allowed: a list of {len(names)}: {', '.join(names)}")
                return np.empty((0, len(names)))
            rows.append([self._number(part, (*place, index, at)) for at, part in enumerate(row)])
        return np.array(rows).reshape(-1, len(names)) * units
