"""How the platform is turned where a direct problem is solved: its rotation as formulas, and what its pose has."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.orientations import Orientation
from assur.derivation.solution import AnalyticSolution
from assur.derivation.unknown_directions import UnknownDirection
from assur.joints.steps import UNTURNED, about
from assur.model.pose import ANGLES, has_quaternion
from assur.numerics.vectors import Matrix, Vector, add, apply, cross, product, scaled, transposed


def platform_rotation(solution: AnalyticSolution) -> Matrix:
    """The platform's rotation in the unknowns of the loops. Errors: NotDerivedError, of a platform that is a rod.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> platform_rotation(analytic_solution(load_record("three_rps"), "direct"))[2][0]
    (-dz_platform_12 + dz_platform_31)/(3*r)
    """
    link = solution.symbols.record.platform.link
    own = solution.placed.links[link]
    if own.rod is not None:
        raise NotDerivedError(f"the orientation of {link}, a rod")
    if own.triangle is not None:
        return _of_triangle(solution, own, link)
    if own.axis is None or own.circle is None:
        return own.constant
    circles = {solution.placed.links[part.links[0]].circle: part for part in solution.loops.directions
               if part.kind == "circle" and solution.placed.links[part.links[0]].second is None}  # fmt: skip
    turned = own.constant
    if own.second is not None and own.hinge is not None:
        second = next(part for part in solution.loops.directions if link in part.links)
        turned = product(about(own.hinge, *_pair(second)), turned)
    if own.circle not in circles:
        raise NotDerivedError(f"the orientation of {link}, about an axis that no loop determines")
    return product(about(own.axis, *_pair(circles[own.circle])), turned)


def _pair(direction: UnknownDirection) -> tuple[sympy.Symbol, sympy.Symbol]:
    cosine, sine = direction.unknowns
    return cosine, sine


def _of_triangle(solution: AnalyticSolution, own: Orientation, link: str) -> Matrix:
    """Of each axis what it has of two sides, and of what is across both."""
    if own.triangle is None:
        return own.constant
    sides = [part.unknowns for part in solution.loops.directions if part.kind == "side" and link in part.links]
    (a, b, c), _, (x, y, z) = sides
    columns: list[Vector] = []
    for axis in UNTURNED:
        vector = apply(own.constant, axis)
        (first, last), beside = own.triangle.shares(vector), own.triangle.beside(vector)
        column = add(scaled((a, b, c), first), scaled((x, y, z), last))
        if beside != 0:
            column = add(column, scaled(cross((a, b, c), (x, y, z)), beside))
        p, q, r = (sympy.factor_terms(part) for part in column)
        columns.append((p, q, r))
    return transposed((columns[0], columns[1], columns[2]))


def posed_entries(solution: AnalyticSolution) -> Iterator[tuple[str, sympy.Expr]]:
    """Entries of the rotation that say the orientation that the pose has, by their names, where it is no single angle.

    R31 is -sin(theta); R32 and R33 are cos(theta) times sine and cosine of psi, R21 and R11 times those of phi.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> [name for name, _ in posed_entries(analytic_solution(load_record("three_rps"), "direct"))]
    ['R31', 'R32', 'R33']
    >>> [*posed_entries(analytic_solution(load_record("planar_3rpr"), "direct"))]
    []
    """
    pose = solution.symbols.record.platform.pose
    posed = [name for name in ANGLES if name in pose]
    own = solution.placed.links[solution.symbols.record.platform.link]
    if (not posed and not has_quaternion(pose)) or own.triangle is None:
        return
    entries = dict.fromkeys(["11", "21"] if "phi" in posed else [])
    entries |= dict.fromkeys(["31"] if "theta" in posed else [])
    entries |= dict.fromkeys(["32", "33"] if "psi" in posed else [])
    if has_quaternion(pose):
        entries = dict.fromkeys(f"{i}{k}" for i in (1, 2, 3) for k in (1, 2, 3))
    rotation = platform_rotation(solution)
    for name in entries:
        yield f"R{name}", rotation[int(name[0]) - 1][int(name[1]) - 1]
