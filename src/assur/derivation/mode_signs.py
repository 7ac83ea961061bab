"""Which sign of a mode each root of a derivation has: by the file's quantities, or by closing blocks, at branches."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass
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
from assur.kinematics.modes import Problem, sign_names
from assur.kinematics.naming import sign_meanings, signs_at
from assur.model.closed_form import ClosedForm
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.kernels.reading import names_of
from assur.model.pose import LENGTHS
from assur.numerics.number_types import Floats

RootSigns = dict[tuple[Problem, sympy.Symbol], tuple[str, int]]
PLACES, NEAR, FAR = 24, 0.05, 1.0
"""Poses about home, in characteristic lengths and rad, at which signs are compared; far ones where they must change."""


@dataclass(frozen=True)
class MatchedSigns:
    """What the signs of modes are those of.

    Attributes:
        roots: problem and root -> the sign of a mode, and whether the root has it or its opposite.
        factors: sign of a mode that no root has -> a product of factors and of quantities that has it.
    """

    roots: RootSigns
    factors: Mapping[str, sympy.Expr]


def matched_signs(direct: AnalyticSolution, inverse: AnalyticSolution) -> MatchedSigns:
    """The signs of both problems. Errors: NotDerivedError."""
    own: RootSigns = {}
    solutions: tuple[tuple[Problem, AnalyticSolution], ...] = (("inverse", inverse), ("direct", direct))
    for problem, solution in solutions:
        own |= {(problem, root.symbol): (f"{problem}{k}", 1) for k, root in enumerate(solution.roots)}
    formulas = ClosedFormFormulas(direct, inverse, own)
    names = names_of(ClosedFormText(formulas).text(), Path("closed_form.py"))
    form: ClosedForm = names["CLOSED_FORM"]
    joints, signs, _ = _branches(inverse, form, [name for name, _ in own.values()], NEAR)
    matched: RootSigns = {}
    products: dict[str, sympy.Expr] = {}
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
        if left and problem == "direct" and direct.eliminant is not None:
            left = {k: name for k, name in left.items() if name in sign_names(record, problem)}
            joints, signs, factors = _branches(inverse, form, [name for name, _ in own.values()], FAR)
            named = signs_at(record, problem, joints)
            quantities = {name: (value, factors[name]) for name, kind, value in formulas.factors if kind != "other"}
            quantities |= {
                name: (formulas.sign_values[name], signs[name]) for (of, _), (name, _) in own.items() if of == "inverse"
            }
            for k in list(left):
                product = _product(named[:, k], {name: values for name, (_, values) in quantities.items()})
                if product is not None:
                    chosen, sense = product
                    products[left.pop(k)] = sense * sympy.prod([quantities[name][0] for name in chosen])
        if left:
            raise NotDerivedError(f"{', '.join(left.values())} name modes, and no root has their sign")
    return MatchedSigns(matched, products)


def _product(signs: NDArray[np.int8], factors: Mapping[str, NDArray[np.float64]]) -> tuple[tuple[str, ...], int] | None:
    """The fewest quantities whose product has these signs (N,), or all the opposite ones; None where none changes."""
    if len({*signs}) < len((1, -1)):
        return None
    for count in range(1, len(factors) + 1):
        for chosen in itertools.combinations(factors, count):
            values = np.prod([factors[name] for name in chosen], axis=0)
            for sense in (1, -1):
                if np.all(signs == sense * values):
                    return chosen, sense
    return None


def _branches(
    inverse: AnalyticSolution, form: ClosedForm, names: list[str], near: float
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]], dict[str, NDArray[np.float64]]]:
    """Joint values (N, n) of branches at poses about home, and the signs of their quantities and factors (N,)."""
    record = inverse.symbols.record
    home = pose.pose_of(record, home_values(record))
    length = characteristic_length(record)
    scales = np.array([length if name in LENGTHS else 1.0 for name in record.platform.pose])
    random = np.random.default_rng(0)
    poses = home + near * scales * random.uniform(-1.0, 1.0, (PLACES, len(home)))
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
    of_signs = {name: np.broadcast_to(getattr(branch.core, sign_attribute(name)), len(many)) for name in names}
    signs = {name: np.sign(value)[real] for name, value in of_signs.items()}
    factors = {
        name: np.sign(np.broadcast_to(value, len(many)))[real]
        for name, value in form.factors(ns, p, branch.core).items()
    }
    return values[real], signs, factors


def _radicands(form: ClosedForm, margins: Mapping[str, Any]) -> list[Any]:
    return [margins[margin.name] for margin in form.inverse_margins if margin.signs]
