"""Which sign of a mode each root of a derivation has: by the file's quantities, or by closing blocks, at branches."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import sympy
from numpy.typing import NDArray

from assur.derivation.closed_form_formulas import ClosedFormFormulas
from assur.derivation.closed_form_text import ClosedFormText
from assur.derivation.kernel_text import sign_attribute
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import AnalyticSolution
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border, pose
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.kinematics.naming import sign_meanings, signs_at
from assur.model.closed_form import ClosedForm
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.kernels.reading import names_of
from assur.model.pose import LENGTHS
from assur.numerics.number_types import Floats

RootSigns = dict[tuple[Problem, sympy.Symbol], tuple[str, int]]
PLACES, NEAR = 24, 0.05
"""Poses about home, in characteristic lengths and rad, at which signs are compared."""


def root_signs(direct: AnalyticSolution, inverse: AnalyticSolution) -> RootSigns:
    """Problem and root -> the sign of a mode, and whether the root has it or its opposite. Errors: NotDerivedError."""
    own: RootSigns = {}
    solutions: tuple[tuple[Problem, AnalyticSolution], ...] = (("inverse", inverse), ("direct", direct))
    for problem, solution in solutions:
        own |= {(problem, root.symbol): (f"{problem}{k}", 1) for k, root in enumerate(solution.roots)}
    names = names_of(ClosedFormText(ClosedFormFormulas(direct, inverse, own)).text(), Path("closed_form.py"))
    form: ClosedForm = names["CLOSED_FORM"]
    joints, signs = _branches(inverse, form, [name for name, _ in own.values()])
    matched: RootSigns = {}
    record = inverse.symbols.record
    for problem, solution in solutions:
        named = signs_at(record, problem, joints)
        left = dict(enumerate(sign_meanings(record, problem)))
        for root in solution.roots:
            values = signs[own[problem, root.symbol][0]]
            match = [(k, s) for k in left for s in (1, -1) if np.all(named[:, k] == s * values)]
            if not match:
                raise NotDerivedError(
                    f"the sign of {root.quantity} is none by which the modes of {record.name} are named"
                )
            k, sense = match[0]
            matched[problem, root.symbol] = left.pop(k), sense
        if left:
            raise NotDerivedError(f"{', '.join(left.values())} name modes, and no root has their sign")
    return matched


def _branches(
    inverse: AnalyticSolution, form: ClosedForm, names: list[str]
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """Joint values (N, n) of branches at poses about home, and the signs of their quantities (N,)."""
    record = inverse.symbols.record
    home = pose.pose_of(record, home_values(record))
    length = characteristic_length(record)
    scales = np.array([length if name in LENGTHS else 1.0 for name in record.platform.pose])
    random = np.random.default_rng(0)
    poses = home + NEAR * scales * random.uniform(-1.0, 1.0, (PLACES, len(home)))
    choices = np.array([*itertools.product((1.0, -1.0), repeat=len(inverse.roots))]).reshape(-1, len(inverse.roots))
    many = np.repeat(poses, len(choices), axis=0)
    rows = np.tile(choices, (len(poses), 1))
    roots = [name for name in names if name.startswith("inverse")]
    ns, p = Floats(), kernel_dimensions(record)
    branch = form.inverse(
        ns, p, border.pose_components(record, many), SimpleNamespace(**dict(zip(roots, rows.T, strict=True)))
    )
    real = np.all([np.broadcast_to(value, len(many)) > 0.0 for value in _radicands(form, branch.margins)], axis=0)
    joints = border.joint_values(record, form.joints(ns, p, branch.core))
    values = np.stack([np.broadcast_to(value, len(many)) for value in joints], axis=-1)
    signs = {
        name: np.sign(np.broadcast_to(getattr(branch.core, sign_attribute(name)), len(many)))[real] for name in names
    }
    return values[real], signs


def _radicands(form: ClosedForm, margins: Mapping[str, Any]) -> list[Any]:
    return [margins[margin.name] for margin in form.inverse_margins if margin.signs]
