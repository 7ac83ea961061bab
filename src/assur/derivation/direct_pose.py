"""What a branch of the direct problem has beside its unknowns: locked lengths, other links, the pose."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.platform_rotation import platform_rotation
from assur.derivation.solution import AnalyticSolution
from assur.derivation.symbols import circle_of
from assur.derivation.trigonometric import shorter
from assur.derivation.unknown_directions import UnknownDirection
from assur.joints.steps import about
from assur.kinematics.modes import Problem
from assur.model.pose import ANGLES, LENGTHS
from assur.numerics.vectors import Matrix, Vector, apply, cross, dot, product, scaled, subtract, transposed

Pair = tuple[sympy.Expr, sympy.Expr]
TILT = sympy.Symbol("tilt", real=True)
"""The square of cos(theta)."""
UPRIGHT = circle_of("theta")[0] ** 2


def direct_rest(direct: AnalyticSolution, inverse: AnalyticSolution) -> Iterator[tuple[sympy.Symbol, sympy.Expr]]:
    """Symbols of the pose and of the inverse problem's unknowns that the direct one does not have, with formulas."""
    record = direct.symbols.record
    known = {own.symbol for own in direct.definitions}
    for index, symbol in inverse.loops.lengths.items():
        if index in direct.symbols.locked:
            yield symbol, direct.symbols.locked[index]
    triangle = of_triangle(direct)
    if triangle:
        yield from _angles_of_triangle(direct)
    for direction in inverse.loops.directions:
        if direction.kind == "circle" and not known & {*direction.unknowns}:
            turned = zip(direction.unknowns, _turn_in_direct(direct, inverse, direction), strict=True)
            yield from ((unknown, own) for unknown, own in turned if unknown != own)
        elif direction.kind == "rod" and not known & {*direction.unknowns}:
            yield from zip(direction.unknowns, _line_in_direct(direct, inverse, direction), strict=True)
    named = dict(zip(LENGTHS, direct.point, strict=True))
    for name in record.platform.pose:
        if name in named:
            yield sympy.Symbol(name, real=True), named[name]
        elif not triangle:
            yield from zip(circle_of(name), turned_by(direct, name), strict=True)


def of_triangle(direct: AnalyticSolution) -> bool:
    """Whether three balls say how the platform is turned."""
    return direct.placed.links[direct.symbols.record.platform.link].triangle is not None


def upright(problem: Problem) -> Iterator[tuple[str, sympy.Expr]]:
    """The margin of theta: it is no right angle."""
    yield "upright", TILT if problem == "direct" else UPRIGHT


def _angles_of_triangle(direct: AnalyticSolution) -> Iterator[tuple[sympy.Symbol, sympy.Expr]]:
    """The angles phi, theta, psi of R = Rz(phi) Ry(theta) Rx(psi), of those that the pose has."""
    (cosine, sine), rotation = circle_of("theta"), platform_rotation(direct)
    yield sine, -rotation[2][0]
    yield TILT, rotation[0][0] ** 2 + rotation[1][0] ** 2
    yield cosine, sympy.sqrt(TILT)
    pairs = {"phi": (rotation[0][0], rotation[1][0]), "psi": (rotation[2][2], rotation[2][1])}
    for name, entries in pairs.items():
        if name in direct.symbols.record.platform.pose:
            yield from zip(circle_of(name), (own / cosine for own in entries), strict=True)


def _turn_in_direct(direct: AnalyticSolution, inverse: AnalyticSolution, direction: UnknownDirection) -> Pair:
    """Cosine and sine of a circle of the inverse problem, in what the direct one knows. Errors: NotDerivedError."""
    link = direction.links[0]
    own, other = inverse.placed.links[link], direct.placed.links[link]
    if own.axis is None or other.rod is not None:
        raise NotDerivedError(f"the angle of {link} in the direct problem")
    if other.triangle is not None:
        return _left_out_of_triangle(direct, link)
    turned = product(_turn(direct, link), transposed(own.constant))
    cosine = (sum(turned[k][k] for k in range(3)) - 1) / sympy.Integer(2)
    across = (turned[2][1] - turned[1][2], turned[0][2] - turned[2][0], turned[1][0] - turned[0][1])
    return sympy.simplify(cosine), sympy.simplify(dot(own.axis, across) / sympy.Integer(2))


def _turn(direct: AnalyticSolution, link: str) -> Matrix:
    """The rotation of a link that is fixed, or on a circle."""
    own = direct.placed.links[link]
    if own.axis is None:
        return own.constant
    circle = next(part for part in direct.loops.directions if link in part.links)
    return product(about(own.axis, *circle.unknowns), own.constant)


def _line_in_direct(direct: AnalyticSolution, inverse: AnalyticSolution, rod: UnknownDirection) -> Vector:
    """The direction of a rod of the inverse problem, on whose hinge an input is given in the direct one.

    Errors: NotDerivedError.
    """
    link = rod.links[0]
    own, other = inverse.placed.links[link], direct.placed.links[link]
    if own.line is None or other.rod is not None or other.triangle is not None or other.second is not None:
        raise NotDerivedError(f"the direction of {link} in the direct problem")
    x, y, z = apply(_turn(direct, link), apply(transposed(own.constant), own.line))
    return tuple(sympy.factor_terms(sympy.simplify(part)) for part in (x, y, z))


def hinge_angles(direct: AnalyticSolution, inverse: AnalyticSolution) -> Iterator[tuple[sympy.Symbol, sympy.Expr]]:
    """Cosine and sine of rods that turn about hinges which inputs place, by the inputs and the rods' directions."""
    for turn in direct.loops.directions:
        link = turn.links[0]
        own, other = direct.placed.links[link], inverse.placed.links[link]
        if turn.kind != "circle" or own.axis is None or other.line is None or other.hinge is None:
            continue
        rod = next(part for part in inverse.loops.directions if link in part.links)
        start = apply(own.constant, apply(transposed(other.constant), other.line))
        across = subtract(start, scaled(own.axis, dot(own.axis, start)))
        level = 1 - sympy.simplify(dot(other.line, other.hinge)) ** 2
        vectors = {turn.unknowns[0]: across, turn.unknowns[1]: cross(own.axis, across)}
        shares = {symbol: sympy.expand(dot(rod.unknowns, vector) / level) for symbol, vector in vectors.items()}
        yield from shorter(shares, direct.symbols.circles, direct.symbols.witness).items()


def _left_out_of_triangle(direct: AnalyticSolution, link: str) -> Pair:
    """The angle that the pose leaves out of a platform on three balls. Errors: NotDerivedError."""
    platform = direct.symbols.record.platform
    left_out = [name for name in ANGLES if name not in platform.pose]
    (cosine, sine), rotation = circle_of("theta"), platform_rotation(direct)
    if link != platform.link or len(left_out) != 1:
        raise NotDerivedError(f"the angle of {link} in the direct problem")
    if left_out[0] == "theta":
        return cosine, sine
    x, y = (rotation[0][0], rotation[1][0]) if left_out[0] == "phi" else (rotation[2][2], rotation[2][1])
    return x / cosine, y / cosine


def turned_by(direct: AnalyticSolution, name: str) -> Pair:
    """Cosine and sine of an angle of the pose, of a platform that turns about Z: of a link's own, or of an input.

    Errors: NotDerivedError.
    """
    link = direct.symbols.record.platform.link
    own = direct.placed.links[link]
    if name == "phi" and own.rod is None and own.triangle is None and own.second is None:
        rotation = platform_rotation(direct)
        cosine, sine = rotation[0][0], rotation[1][0]
        if tuple(rotation[2]) == (0, 0, 1) and cosine.is_Symbol and sine.is_Symbol:
            return cosine, sine
    raise NotDerivedError(
        f"{name} of the pose is written of a platform that turns about Z alone, and {link} turns otherwise"
    )
