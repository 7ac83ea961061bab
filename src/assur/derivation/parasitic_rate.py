"""The angle that a pose leaves out and the joints say: its rate is parasitic, and goes from the velocity equations.

A limb says S v + r w = g q', with w that rate; one equation more, of the platform's orientation, says c v + D w = 0. So
(D S - r c) v = D g q'. Where D vanishes the joints do not say the angle. Of n limbs that have w,

    det(D S - r c) = D^(n - 1) det [[S, r], [c, D]].

With phi, theta and psi all among the columns the latter has the factor cos(theta), which is no matter of the mechanism:
the axis of psi, with sin(theta) times that of phi added, is cos(theta) times one that is across Z.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy

from assur.derivation.determinant_factors import factors_of
from assur.derivation.linear import Form
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import AnalyticSolution
from assur.derivation.symbols import circle_of
from assur.derivation.unknown_directions import UnknownDirection
from assur.kinematics.parasitic import moving
from assur.model.pose import ANGLES

Factors = tuple[tuple[sympy.Expr, int], ...]
ZERO = sympy.Integer(0)
RIGHT_ANGLE = "theta is a right angle: phi and psi turn about one axis"
UNSAID = "the joints do not say how {} turns about the direction that its pose leaves out"


def parasitic_circle(solution: AnalyticSolution) -> UnknownDirection | None:
    """That of a platform of whose orientation the pose says all but one angle; None of others.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> parasitic_circle(analytic_solution(load_record("three_rps"), "inverse")).name
    'platform'
    """
    platform = solution.symbols.record.platform
    own = solution.placed.links[platform.link]
    if solution.symbols.problem != "inverse" or own.axis is None or not {*ANGLES} & {*platform.pose}:
        return None
    circles = (part for part in solution.loops.directions if part.kind == "circle" and platform.link in part.links)
    return next(circles, None)


def without_rate(
    solution: AnalyticSolution,
    rows: Sequence[Form],
    rate: sympy.Symbol,
    pose: Sequence[sympy.Symbol],
    inputs: Sequence[sympy.Symbol],
) -> tuple[sympy.Matrix, sympy.Matrix, Factors, Factors]:
    """Jp, Jq and the factors of their determinants, of n + 1 equations between rates.

    Args:
        solution: of the inverse problem.
        rows: each a sum of multiples of rates that is zero.
        rate: the parasitic one.
        pose: rates of its coordinates.
        inputs: their rates.

    Errors:
        NotDerivedError: there are others than n equations with inputs and one without.
    """
    beside = [row for row in rows if not row.keys() & {*inputs}]
    limbs = [row for row in rows if row.keys() & {*inputs}]
    if len(beside) != 1 or len(limbs) != len(pose) or rate not in beside[0]:
        raise NotDerivedError(f"{len(rows)} velocity equations for {len(pose)} rates of the pose and a parasitic one")
    (condition,) = beside
    under, many = condition[rate], sum(rate in row for row in limbs)
    jp = sympy.Matrix([[_across(row, condition, rate, key) for key in pose] for row in limbs])
    plain = sympy.Matrix([[-row.get(key, ZERO) for key in inputs] for row in limbs])
    jq = sympy.Matrix([[under * own if rate in row else own for own in plain.row(k)] for k, row in enumerate(limbs)])
    columns = [*pose, rate]
    whole = [[row.get(key, ZERO) for key in columns] for row in (*limbs, condition)]
    number, powers = factors_of(plain)[0], factors_of(plain)[1:]
    parallel = [(under, many - 1)] if many > 1 else []
    right = _right_angle(solution, whole, columns)
    parallel += [(circle_of("theta")[0], 1)] * right + [(_determinant(whole), 1)]
    return jp, jq, ((sympy.Integer(1), 1), *parallel), (number, (under, many), *powers)


def _across(row: Form, condition: Form, rate: sympy.Symbol, key: sympy.Symbol) -> sympy.Expr:
    """An entry of a limb's equation without the rate; a limb that does not have it keeps its own."""
    own = row.get(key, ZERO)
    return own if rate not in row else condition[rate] * own - row[rate] * condition.get(key, ZERO)


def _right_angle(solution: AnalyticSolution, rows: list[list[sympy.Expr]], columns: Sequence[sympy.Symbol]) -> bool:
    """Whether rows have the three angles; their column of psi is then that of an axis across Z."""
    record = solution.symbols.record
    left_out = [name for name in moving(record) if name in ANGLES and name not in record.platform.pose]
    circle = parasitic_circle(solution)
    if len(left_out) != 1 or circle is None or not {*ANGLES} <= {*record.platform.pose, *left_out}:
        return False
    places = dict(zip(record.platform.pose, range(len(columns)), strict=False)) | {left_out[0]: len(columns) - 1}
    cosine, sine = circle.unknowns if left_out[0] == "theta" else circle_of("theta")
    across = [sympy.expand(row[places["psi"]] + sine * row[places["phi"]]) for row in rows]
    across = [sympy.expand(own.subs(sine**2, 1 - cosine**2)) for own in across]
    if any(sympy.expand(own.subs(cosine, 0)) != 0 for own in across):
        return False
    for row, own in zip(rows, across, strict=True):
        row[places["psi"]] = sympy.factor_terms(sympy.expand(own / cosine))
    return left_out[0] != "theta"


def _determinant(rows: Sequence[Sequence[sympy.Expr]]) -> sympy.Expr:
    """By Laplace's rule along the row with the fewest entries, not expanded."""
    if len(rows) == 1:
        return rows[0][0]
    k = min(range(len(rows)), key=lambda k: sum(own != 0 for own in rows[k]))
    others = [row for place, row in enumerate(rows) if place != k]
    terms = (
        (-1) ** (k + j) * own * _determinant([[*row[:j], *row[j + 1 :]] for row in others])
        for j, own in enumerate(rows[k])
        if own != 0
    )
    return sympy.Add(*terms)
