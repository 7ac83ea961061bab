"""Compliances of links and of joints from their entries."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from assur.errors import KeyPath
from assur.model.file.build_joints import JointVectors
from assur.model.file.faults import Faults
from assur.model.file.limbs import Instance, Tables
from assur.model.file.values import ComplianceRows
from assur.model.machine_data import RIGID

FloatArray = NDArray[np.float64]
MOVES = ("x", "y", "z", "rx", "ry", "rz")


def link_compliance(
    rows: ComplianceRows | None, path: KeyPath, geometry: JointVectors, instance: Instance | None
) -> FloatArray | None:
    """The compliance (6, 6) of a link in its limb, positive definite; None where none is said, or a wrong one."""
    faults = geometry.numbers.faults
    compliance = None if rows is None else _symmetric(rows, path, faults)
    if compliance is None:
        return None
    rigid = [move for move, size in zip(MOVES, np.diag(compliance), strict=True) if size == 0.0]
    if rigid or np.linalg.eigvalsh(_correlations(compliance))[0] <= RIGID:
        told = f"nothing gives way along {', '.join(rigid)}" if rigid else "there is a way in which nothing gives way"
        hint = "what is rigid but in some ways: [compliances] of the joint at its end may be zero along others"
        faults.add(path, told, "allowed: a positive definite matrix", hint)
        return None
    return _turned(compliance, geometry, instance)


def joint_compliances(
    entries: Mapping[str, ComplianceRows],
    tables: Tables,
    geometry: JointVectors,
    of_joint: Callable[[str, KeyPath], list[str]],
) -> dict[str, FloatArray]:
    """Compliances (6, 6) by joints; what is said of one joint counts more than what is said of a template's."""
    general: dict[str, FloatArray] = {}
    own: dict[str, FloatArray] = {}
    for text, rows in entries.items():
        path: KeyPath = ("compliances", text)
        compliance = _symmetric(rows, path, geometry.numbers.faults)
        joints = of_joint(text, path)
        if compliance is None:
            continue
        for name in joints:
            placed = tables.joints[name]
            turned = _turned(compliance, geometry, placed.instance if text == placed.local != name else None)
            (general if len(joints) > 1 else own)[name] = turned
    return {**general, **own}


def _symmetric(rows: ComplianceRows, path: KeyPath, faults: Faults) -> FloatArray | None:
    """A matrix that is symmetric and has no negative eigenvalue; None, and a fault, of another."""
    matrix = np.array(rows)
    sizes = np.sqrt(np.abs(np.diag(matrix)))
    allowed = "allowed: a symmetric matrix without negative eigenvalues, displacement before rotation"
    apart = np.abs(matrix - matrix.T) - RIGID * sizes * sizes[:, None]
    row, column = np.unravel_index(int(np.argmax(apart)), apart.shape)
    low = int(np.argmin(np.diag(matrix)))
    if apart[row, column] > 0.0:
        unlike = f"{matrix[row, column]:g} in row {row + 1}, column {column + 1}, {matrix[column, row]:g} across"
        faults.add(path, unlike, allowed)
    elif matrix[low, low] < 0.0:
        faults.add(path, f"{matrix[low, low]:g} along {MOVES[low]}", allowed)
    elif np.any(matrix[sizes == 0.0]) or np.linalg.eigvalsh(_correlations(matrix))[0] < -RIGID:
        faults.add(path, "a load that does negative work", allowed)
    else:
        return np.asarray(0.5 * (matrix + matrix.T))
    return None


def _correlations(compliance: FloatArray) -> FloatArray:
    """The matrix with its diagonal brought to 1, or 0."""
    sizes = np.sqrt(np.diag(compliance))
    scale = 1.0 / np.where(sizes > 0.0, sizes, 1.0)
    return np.asarray(compliance * scale * scale[:, None])


def _turned(compliance: FloatArray, geometry: JointVectors, instance: Instance | None) -> FloatArray:
    """As it is in its limb."""
    if instance is None:
        return compliance
    turn = np.kron(np.eye(2), np.stack([geometry.turned(axis, instance) for axis in np.eye(3)], axis=-1))
    return np.asarray(turn @ compliance @ turn.T)
