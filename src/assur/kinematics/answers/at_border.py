"""Numbers at the border: lengths as they are, angles in the unit of the mechanism's file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.model.mechanism import Input, MechanismRecord
from assur.model.pose import is_angle

FloatArray = NDArray[np.float64]
Box = tuple[tuple[float, float], ...]


def coordinate_unit(record: MechanismRecord, name: str) -> float:
    """The unit of a pose's coordinate, in rad; 1 of one that is no angle."""
    return record.angle_unit if is_angle(name) else 1.0


def input_unit(record: MechanismRecord, driven: Input) -> float:
    """The unit of an input, in rad; 1 of one that is no angle."""
    return record.angle_unit if driven.coordinate.kind == "angle" else 1.0


def coordinates_at_border(record: MechanismRecord, values: Mapping[str, float]) -> dict[str, float]:
    """Coordinates of poses by name, with angles in the mechanism's angle unit."""
    return {name: float(value) / coordinate_unit(record, name) for name, value in values.items()}


def box_at_border(record: MechanismRecord, names: Sequence[str], box: Sequence[Sequence[float]]) -> Box:
    """A box (low, high) of coordinates with angles in the mechanism's angle unit."""
    return tuple(
        (low / coordinate_unit(record, name), high / coordinate_unit(record, name))
        for name, (low, high) in zip(names, box, strict=True)
    )


def angle_at_border(record: MechanismRecord, angle: Any) -> Any:
    """Angles in rad as the mechanism's angle unit."""
    return np.degrees(angle) if record.angle == "deg" else angle


def quantity_text(record: MechanismRecord, value: float, kind: str, digits: int = 6) -> str:
    """A length or an angle (rad inside) in the file's unit, or a number.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> quantity_text(record, 1.0, "length"), quantity_text(record, np.pi / 3, "angle", 4)
    ('1 mm', '60 deg')
    """
    unit = {"length": record.unit, "angle": record.angle}.get(kind, "")
    shown = round(float(angle_at_border(record, value)), 9) if kind == "angle" else value
    return f"{shown:.{digits}g} {unit}".rstrip()


def inputs_at_border(record: MechanismRecord, inputs: Any) -> FloatArray:
    """Inputs (..., n), or every one (..., d), with angles in the mechanism's angle unit."""
    angular = _angular(record, np.shape(inputs)[-1])
    return np.asarray(np.where(angular, angle_at_border(record, np.asarray(inputs)), inputs))


def inputs_from_border(record: MechanismRecord, inputs: Any) -> FloatArray:
    """Inputs (..., n), or every one (..., d), in rad and lengths, from the mechanism's angle unit."""
    angular = _angular(record, np.shape(inputs)[-1])
    return np.asarray(np.asarray(inputs, dtype=float) * np.where(angular, record.angle_unit, 1.0))


def _angular(record: MechanismRecord, count: int) -> NDArray[np.bool_]:
    """Which of the first inputs are angles."""
    return np.array([item.coordinate.kind == "angle" for item in record.drives[:count]])


def pose_at_border(record: MechanismRecord, pose: Any) -> FloatArray:
    """Poses (..., m) with angles in the mechanism's angle unit."""
    angular = np.array([is_angle(name) for name in record.platform.pose])
    return np.asarray(np.where(angular, angle_at_border(record, np.asarray(pose)), pose))


def pose_from_border(record: MechanismRecord, pose: Any) -> FloatArray:
    """Poses (..., m) in rad and lengths, from the mechanism's angle unit."""
    angular = np.array([is_angle(name) for name in record.platform.pose])
    factor = record.angle_unit
    given = np.asarray(pose, dtype=float)
    theta = np.array([name == "theta" for name in record.platform.pose])
    if given.shape[-1:] == theta.shape and np.any(np.abs(given[..., theta]) * factor > np.pi / 2):
        raise UsageError(f"pose of {record.name}: theta is between -90 and 90 deg", hint="turn phi and psi instead")
    return np.asarray(given * np.where(angular, factor, 1.0))


def power(unit: str, exponent: int) -> str:
    """A unit to a power: "", "mm", "mm^2"."""
    return "" if exponent == 0 else unit if exponent == 1 else f"{unit}^{exponent}"


def mechanism_header(record: MechanismRecord) -> dict[str, Any]:
    """What answers about a mechanism begin with (`AnswerOfMechanism`)."""
    units = {"unit": record.unit, "angle": record.angle}
    return {"mechanism": record.name, **units, "coordinates": record.platform.pose}
