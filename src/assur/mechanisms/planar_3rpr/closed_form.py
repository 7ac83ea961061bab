"""Closed form of the planar 3-RPR mechanism: one polynomial of degree six in the tangent of half the platform's angle.

A1 is the origin and B1 the platform's point. In the direct problem the corners of the platform lie on three circles
about A1, A2, A3 (see `assur.numerics.triangles`).
"""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm, Eliminant, Factor, Margin, Quantity, Sign
from assur.numerics import triangles
from assur.numerics.vectors import difference_of_angles


def inverse(ns, p, pose, sign):
    """Leg lengths at a pose; they are positive."""
    legs = _legs(p, pose)
    squares = tuple(dx * dx + dy * dy for dx, dy in legs)
    lengths = tuple(ns.sqrt(square) for square in squares)
    margins = {f"square{k}": square for k, square in enumerate(squares, 1)}
    return Branch(pose, lengths, margins, _core(p, pose, legs, lengths))


def coefficients(ns, p, inputs):
    """The seven coefficients of the polynomial in t = tan(phi/2)."""
    return triangles.polynomial(_anchors(p), _corners(p), _squares(inputs))


def back(ns, p, inputs, phi):
    """Position at given legs and platform angle: two linear equations."""
    (x, y), area = triangles.position(_anchors(p), _corners(p), _squares(inputs), phi)
    pose = (x, y, phi)
    return Branch(pose, tuple(inputs), {"area": area}, _core(p, pose, _legs(p, pose), inputs))


def _squares(inputs):
    return tuple(length * length for length in inputs)


def _anchors(p):
    return (0, 0), (p.a2, 0), (p.a3, p.h3)


def _corners(p):
    return (0, 0), (p.d1, 0), (p.c3, p.e3)


def _legs(p, pose):
    """Vectors from A_i to B_i."""
    x, y, phi = pose
    return tuple(
        (x + corner[0] - anchor[0], y + corner[1] - anchor[1])
        for anchor, corner in zip(_anchors(p), _turned(p, phi), strict=True)
    )


def _turned(p, phi):
    return tuple(triangles.rotated(corner, phi) for corner in _corners(p))


def _core(p, pose, legs, lengths):
    x, y, phi = pose
    corners = _turned(p, phi)
    return SimpleNamespace(
        x=x, y=y, phi=phi, legs=legs, lengths=lengths,
        rows=tuple((*leg, triangles.cross(corner, leg)) for corner, leg in zip(corners, legs, strict=True)),
        lines=triangles.lines(legs, corners),
    )  # fmt: skip


def joints(ns, p, core):
    """Every joint's value: direction of the leg, its length, and the platform against the leg."""
    values = {}
    for k, ((dx, dy), length) in enumerate(zip(core.legs, core.lengths, strict=True), 1):
        turn = (dx / length, dy / length)
        values |= {f"A{k}": turn, f"P{k}": length, f"B{k}": difference_of_angles(core.phi, turn)}
    return values


def factors(ns, p, core):
    """Det Jp is the determinant of the lines of the legs times their lengths; det Jq is the product of the lengths."""
    first, second, third = core.lengths
    return {"lines": core.lines, "rho1": first, "rho2": second, "rho3": third}


def jacobians(ns, p, core):
    """From |A_i B_i|^2 = rho_i^2: d_i . v + (R b_i x d_i) omega = rho_i drho_i."""
    first, second, third = core.lengths
    return core.rows, ((first, 0, 0), (0, second, 0), (0, 0, third))


def quantities(ns, p, core):
    """Directions of the legs."""
    return {f"theta{k}": joints(ns, p, core)[f"A{k}"] for k in (1, 2, 3)}


CLOSED_FORM = ClosedForm(
    complete_for="reduced",
    reduced_because="a leg of negative length is left out: the same pose with that leg turned half round",
    direct=Eliminant("phi", "angle", 6, coefficients, back),
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    quantities=quantities,
    signs={"e": Sign("lines", "d1*d1*d1*d1")},
    direct_margins=(
        Margin("area", "d1*d1", "w2 and w3 are parallel: the two linear equations are one", unit=2, zero="degenerate"),
    ),
    inverse_margins=tuple(
        Margin(f"square{k}", "d1*d1", f"A{k} and B{k} coincide: leg {k} has no direction", unit=2, zero="degenerate")
        for k in (1, 2, 3)
    ),
    factor_list=(
        Factor(
            "lines",
            "parallel",
            "d1*d1*d1*d1",
            "the lines of the three legs meet in a point or are parallel",
            r"\det(d_i,\ Rb_i\times d_i)",
            unit=4,
        ),
        *(
            Factor(f"rho{k}", "serial", "d1", f"leg {k} has no length: A{k} and B{k} coincide", rf"\rho_{k}")
            for k in (1, 2, 3)
        ),
    ),
    quantity_list=tuple(
        Quantity(f"theta{k}", "angle", "", latex=rf"\theta_{k}", meaning=f"angle of leg {k} from the X axis")
        for k in (1, 2, 3)
    ),
)
