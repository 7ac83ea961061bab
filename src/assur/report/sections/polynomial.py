"""A direct problem that ends in one polynomial, its coefficients and its roots; or in a system of polynomials."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.at_border import angle_at_border
from assur.kinematics.closed_form.roots import coefficients_of
from assur.model.closed_form import Eliminant, PolynomialSystem
from assur.model.mechanism import MechanismRecord
from assur.numerics import polynomials
from assur.report.findings import Findings
from assur.results.kinds import FLOATING, Cell, Table
from assur.results.plain_text import count
from assur.results.typeset_text import short

DIGITS = 8
REAL = 1e-6
"""The imaginary part of a root that is shown as real: at most this share of its size and 1 together."""


def polynomial_words(findings: Findings, eliminant: Eliminant) -> str:
    """What the polynomial is in, and how many of its roots are poses."""
    name = eliminant.unknown
    unknown = f"tan({name}/2)" if _angular(eliminant) else name
    parts = polynomials_at(findings, eliminant)
    degree = parts[0][1].size - 1
    distinguished = [
        name for k, name in enumerate(eliminant.signs) if len({label[k : k + 1] for label, _ in parts}) > 1
    ]
    choices = f"{len(parts)} polynomials, by the choice of {', '.join(distinguished)},"
    which = "one polynomial" if len(parts) == 1 else choices
    meant = next(
        (quantity.meaning for quantity in findings.form.quantity_list if quantity.name == name and quantity.meaning), ""
    )
    said = f"{unknown} ({meant})" if meant else unknown
    return (
        f"The direct problem ends in {which} of degree {degree}, counted on its coefficients, in {said}, "
        f"so that there are at most {eliminant.degree} poses. All complex roots are found; here they give "
        f"{count(len(findings.direct), 'pose')}."
    )


def system_words(findings: Findings, system: PolynomialSystem) -> str:
    """What the system is, how many solutions it has, and by whom that is known."""
    return (
        f"The direct problem is a system of polynomials in the unknowns {', '.join(system.unknowns)}, known up to a "
        f"common factor; for dimensions in general it has {system.degree} complex solutions ({system.because}), so "
        f"that there are at most {system.degree} poses. All of them are followed from those of a start mechanism with "
        f"complex dimensions; here they give {count(len(findings.direct), 'pose')}."
    )


def polynomial(findings: Findings, eliminant: Eliminant) -> list[Table]:
    """Its coefficients, the largest of them 1, and its roots, real ones first."""
    parts = polynomials_at(findings, eliminant)
    scaled = [values / np.max(np.abs(values), initial=1e-300) for _, values in parts]
    heads = ("power", *(f"coefficient {label}".strip() for label, _ in parts))
    rows = tuple((str(k), *(short(float(v), DIGITS) for v in row)) for k, row in enumerate(zip(*scaled, strict=True)))
    coefficients = Table(
        "Coefficients of the polynomial", heads, rows, "The largest is made 1.", folded=True, known_by=FLOATING
    )
    angle = (f"{eliminant.unknown} [{findings.style.kind_unit('angle')}]",) if _angular(eliminant) else ()
    columns = ("root", "real part", "imaginary part", *angle)
    listed = tuple(row for label, values in parts for row in _roots(findings.record, eliminant, label, values))
    of_what = "the tangent of half of the angle" if _angular(eliminant) else "the unknown itself"
    caption = f"Of {of_what}. Real roots come first; a double one is one pose."
    return [coefficients, Table("Roots of the polynomial", columns, listed, caption, folded=True, known_by=FLOATING)]


def polynomials_at(findings: Findings, eliminant: Eliminant) -> list[tuple[str, NDArray[np.float64]]]:
    """(signs, coefficients (d + 1,), the constant term first) at the inputs that the report is about."""
    coefficients, _ = coefficients_of(findings.record, eliminant, findings.inputs[None])
    flat = coefficients.reshape(-1, coefficients.shape[-1])
    signs = list(itertools.product("+-", repeat=len(eliminant.signs)))
    labels = ["".join(choice) for choice in signs] if len(flat) == len(signs) else [""] * len(flat)
    return _distinct(list(zip(labels, flat, strict=True)))


def _distinct(parts: list[tuple[str, NDArray[np.float64]]]) -> list[tuple[str, NDArray[np.float64]]]:
    """Polynomials of which no two are the same; a sign that only chooses the pose makes no other one."""
    kept: list[tuple[str, NDArray[np.float64]]] = []
    for label, values in parts:
        if not any(np.array_equal(values, other) for _, other in kept):
            kept.append((label, values))
    return kept


def _angular(eliminant: Eliminant) -> bool:
    return eliminant.kind == "angle"


def _roots(
    record: MechanismRecord, eliminant: Eliminant, label: str, coefficients: NDArray[np.float64]
) -> list[tuple[Cell, ...]]:
    roots = polynomials.roots(coefficients)
    order = np.lexsort((roots.real, np.abs(roots.imag) > REAL * (1 + np.abs(roots))))
    return [
        _root(record, eliminant, f"{number} {label}".strip(), complex(roots[k])) for number, k in enumerate(order, 1)
    ]


def _root(record: MechanismRecord, eliminant: Eliminant, name: str, root: complex) -> tuple[Cell, ...]:
    real = abs(root.imag) <= REAL * (1 + abs(root))
    cells: tuple[Cell, ...] = (name, short(root.real, DIGITS), "0" if real else short(root.imag, DIGITS))
    if not _angular(eliminant):
        return cells
    return (*cells, short(float(angle_at_border(record, 2 * np.arctan(root.real))), DIGITS) if real else None)
