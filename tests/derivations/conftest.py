"""The reduced model of Zeng et al. (2019) written down from its text, beside its kernels; and exact zero tests.

The closure shares nothing with the kernels: it is the three walks from the base to O' along the links of
Fig. 2, where a joint angle enters as a pair (cosine, sine). The derivation tests prove what they prove about
these walks.
"""

from types import SimpleNamespace
from typing import Any

import pytest
import sympy as sp

from assur.mechanisms.zeng2019 import closed_form

LENGTHS = "b d l1 l2 l3 l4 l6 l7 l8"
SIZES = {"b": 150, "d": 50, "l1": 30, "l2": 280, "l3": 140, "l4": 180, "l6": 230, "l7": 0, "l8": 0}


class Roots:
    """Number namespace whose roots stay new symbols, so that an identity with roots is one of polynomials."""

    def __init__(self) -> None:
        self.radicands: list[tuple[sp.Symbol, sp.Expr]] = []

    def sqrt(self, radicand: Any, /) -> sp.Symbol:
        root = sp.Symbol(f"root{len(self.radicands)}")
        self.radicands.append((root, sp.sympify(radicand)))
        return root

    def vanishes(self, expression: Any, signs: tuple[sp.Symbol, ...] = ()) -> bool:
        """Whether the expression is zero by root^2 = radicand and sign^2 = 1 alone, whatever the letters are."""
        numerator = sp.numer(sp.together(sp.sympify(expression)))
        squares = [(sign, sp.Integer(1)) for sign in signs]
        relations = [
            (symbol, *sp.fraction(sp.together(square))) for symbol, square in [*reversed(self.radicands), *squares]
        ]
        letters = numerator.free_symbols.union(*(part.free_symbols for relation in relations for part in relation))
        ring = sp.ring(sorted(letters, key=str) or [sp.Symbol("unused")], sp.QQ)[0]
        rest = ring.from_expr(numerator)
        for symbol, top, bottom in relations:
            rest = _without_squares(rest, ring.symbols.index(symbol), ring.from_expr(top), ring.from_expr(bottom))
        return not rest


def _without_squares(polynomial: Any, index: int, top: Any, bottom: Any) -> Any:
    """The polynomial with the square of one letter put as top / bottom, times a power of bottom."""
    by_power: dict[int, dict[Any, Any]] = {}
    for monomial, coefficient in polynomial.terms():
        power, odd = divmod(monomial[index], 2)
        lowered = (*monomial[:index], odd, *monomial[index + 1 :])
        by_power.setdefault(power, {})[lowered] = coefficient
    highest = max(by_power, default=0)
    ring = polynomial.ring
    return sum((ring.from_dict(part) * top**k * bottom ** (highest - k) for k, part in by_power.items()), ring.zero)


def closure(p: Any, inputs: Any, pose: Any, joints: Any) -> dict[str, sp.Expr]:
    """What must vanish: the three walks to O', link by link, with every angle a pair (cosine, sine)."""
    x, y, z = pose
    first, second, third, alpha, beta = (joints[name] for name in ("B1", "B2", "B3", "alpha", "beta"))

    def walk(*steps: tuple[Any, Any, Any]) -> list[Any]:
        return [sum(component) for component in zip(*steps, strict=True)]

    to_platform = ((p.l4 * alpha[0], 0, p.l4 * alpha[1]), (p.d, 0, 0))  # D1D2, D2O'
    ends = {
        "via_B1": walk((-p.b, inputs[0], p.l1), (0, p.l2 * first[0], p.l2 * first[1]), (0, -p.l3 / 2, 0), *to_platform),
        "via_B2": walk(
            (-p.b, inputs[1], p.l1), (0, p.l2 * second[0], p.l2 * second[1]), (0, p.l3 / 2, 0), *to_platform
        ),
        "via_B3": walk(
            (p.b, inputs[2], p.l1),
            (0, p.l6 * third[0], p.l6 * third[1]),  # B3C3
            (0, 0, p.l7),  # C3D3
            (p.l6 * beta[0], 0, p.l6 * beta[1]),  # D3E3
            (0, 0, p.l8),  # E3F3
            (-p.d, 0, 0),  # F3O'
        ),
    }
    gaps = {
        f"{name}_{axis}": end - coordinate
        for name, walked in ends.items()
        for axis, end, coordinate in zip("xyz", walked, (x, y, z), strict=True)
    }
    circles = {f"circle_{name}": c * c + s * s - 1 for name, (c, s) in joints.items()}
    return gaps | circles


def kernel_joints(p: Any, core: Any) -> dict[str, tuple[Any, Any]]:
    """The angles that the kernel's core means."""
    return {
        "B1": (core.u1 / p.l2, core.w / p.l2),
        "B2": (core.u2 / p.l2, core.w / p.l2),
        "B3": (core.u3 / p.l6, core.v / p.l6),
        "alpha": (core.cos_alpha, core.sin_alpha),
        "beta": (core.cos_beta, core.sin_beta),
    }


@pytest.fixture(scope="session")
def model() -> SimpleNamespace:
    """Symbols of the lengths (`p`), inputs, pose and angles; `sizes`: the lengths of Table 1's example."""
    angles = {name: sp.Symbol(name, real=True) for name in ("B1", "B2", "B3", "alpha", "beta")}
    return SimpleNamespace(
        p=SimpleNamespace(**{name: sp.Symbol(name, positive=True) for name in LENGTHS.split()}),
        sizes=SimpleNamespace(**{name: sp.Integer(value) for name, value in SIZES.items()}),
        inputs=sp.symbols("yA1 yA2 yA3", real=True),
        pose=sp.symbols("x y z", real=True),
        angles=angles,
        joints={name: (sp.cos(angle), sp.sin(angle)) for name, angle in angles.items()},
        closure=closure,
        kernel_joints=kernel_joints,
        Roots=Roots,
        kernels=closed_form,
    )
