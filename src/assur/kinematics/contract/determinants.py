"""The third law: det Jp and det Jq are the products of their factors."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.status import closed_form_of, relative_factors

FloatArray = NDArray[np.float64]

SAME = 1e-7
"""Share of the sum of a determinant's terms by which it may differ from its product: rounding, and no more."""
OFF = 0.2
"""A factor whose power in the determinant, fitted to the samples, is further than this from one is to blame."""
UNEXPLAINED = 0.3
"""Where the factors explain the determinant no better than this, one is missing: none of them is to blame."""


def wrong_factors(solutions: Solutions) -> list[Mismatch]:
    """Determinants that are not the products of their factors, with the factors to blame."""
    kinds: tuple[tuple[Literal["parallel", "serial"], FloatArray], ...] = (
        ("parallel", solutions.jp),
        ("serial", solutions.jq),
    )
    return [item for kind, matrix in kinds for item in _of_kind(solutions, kind, matrix)]


def _of_kind(solutions: Solutions, kind: Literal["parallel", "serial"], matrix: FloatArray) -> list[Mismatch]:
    if not len(solutions) or matrix.shape[-1] != matrix.shape[-2]:
        return []
    record, form = solutions.record, closed_form_of(solutions.record)
    names = [item.name for item in form.factor_list if item.kind == kind]
    determinant = np.linalg.det(np.nan_to_num(matrix, nan=np.inf, posinf=0.0, neginf=0.0))
    product = np.prod([solutions.factors[name] for name in names], axis=0) * np.ones(len(solutions))
    size = np.prod(np.linalg.norm(matrix, axis=-1), axis=-1) + np.abs(product)
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.nan_to_num(np.abs(determinant - product) / size, nan=0.0)
    lost = SAME + 1e-12 / np.maximum(solutions.near, 1e-12)
    row = int(np.argmax(share / lost))
    if share[row] <= lost[row]:
        return []
    label = {"parallel": "det Jp", "serial": "det Jq"}[kind]
    relative = relative_factors(record, solutions.factors)
    sizes = ", ".join(f"{name} = {float(relative[name][row]):.3g}" for name in names)
    shares = f"in units of their scales: {sizes}" if sizes else "no factor of that kind is declared"
    mode = f"mode {solutions.labels[row]}" if solutions.labels[row] else "the only mode"
    text = (
        f"{label} is {determinant[row]:.6g} and the product of its factors {product[row]:.6g} in "
        f"{mode} of the {solutions.problem} problem at "
        f"{place_text(record, solutions.problem, solutions.given[row])}; "
        f"{shares}"
    )
    allowed = f"{label} must be the product of the factors of kind '{kind}'"
    blamed = _to_blame(determinant, [solutions.factors[name] for name in names], names)
    return [Mismatch("factor", name, solutions.problem, text, allowed) for name in blamed] or [
        Mismatch("factor", "", solutions.problem, text, allowed, "is one missing, or one too many?")
    ]


def _to_blame(determinant: FloatArray, values: list[FloatArray], names: list[str]) -> list[str]:
    """Factors that do not vary as the determinant does: their powers in it are not one."""
    if len(names) == 1:
        return names
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.log(np.abs(np.array([determinant, *values])))
    logs = logs[:, np.all(np.isfinite(logs), axis=0)]
    if not names or logs.shape[1] < 4 * len(logs):
        return []
    varying = np.ptp(logs[1:], axis=1) > 1e-9
    columns = np.vstack([np.ones(logs.shape[1]), logs[1:][varying]]).T
    powers = np.linalg.lstsq(columns, logs[0], rcond=1e-9)[0][1:]
    missed = logs[0] - columns @ np.linalg.lstsq(columns, logs[0], rcond=1e-9)[0]
    if np.std(missed) > UNEXPLAINED * np.std(logs[0]):
        return []
    own = [name for name, varies in zip(names, varying, strict=True) if varies]
    off = [name for name, power in zip(own, powers, strict=True) if abs(power - 1) > OFF]
    return [*off, *(name for name, varies in zip(names, varying, strict=True) if not varies)]
