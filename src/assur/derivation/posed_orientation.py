"""What a pose says of the platform's orientation: all of it, or all but the turns about one direction.

A pose that leaves an angle out says nothing about it. Where the joints let that angle change, the platform turns
against what is given about one direction: about Z where phi is left out, about X of its own where psi is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy

from assur.derivation.definitions import Definition, FreeNames
from assur.derivation.hinges import HOME, Hinge, RigidPair
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.symbols import GivenSymbols, circle_of
from assur.joints.steps import UNTURNED
from assur.kinematics.home import home_values
from assur.kinematics.parasitic import all_coordinates, moving
from assur.model.pose import ANGLES, QUATERNION, has_quaternion
from assur.numerics.vectors import Matrix, about_x, about_y, about_z, apply, of_quaternion, product

TURNS = {"phi": about_z, "theta": about_y, "psi": about_x}
AXES = {"phi": (0, 0, 1), "theta": (0, 1, 0), "psi": (1, 0, 0)}


@dataclass(frozen=True)
class PosedOrientation:
    """What a pose says of the platform against the base.

    Attributes:
        pair: as a joint between the two.
        definitions: entries of the rotation that have names.
    """

    pair: RigidPair | Hinge
    definitions: tuple[Definition, ...] = ()


def posed_orientation(symbols: GivenSymbols) -> PosedOrientation | None:
    """What the given pose says of the platform against the base; None where it says nothing.

    Errors:
        NotDerivedError: it says too little.

    >>> from assur.derivation.witness import ModularWitness
    >>> from assur.model.registry import load_record
    >>> own = posed_orientation(GivenSymbols(load_record("three_rps"), "inverse", ModularWitness()))
    >>> own.pair.axis
    (0, 0, 1)
    """
    record, pose = symbols.record, symbols.record.platform.pose
    base, platform = record.base, record.platform.link
    if symbols.problem == "direct":
        return None
    if has_quaternion(pose):
        w, x, y, z = (sympy.Symbol(name, real=True) for name in QUATERNION)
        return _named(symbols, of_quaternion(w, x, y, z))
    if not {*ANGLES} & {*pose}:
        return None
    left_out = [name for name in ANGLES if name not in pose]
    free = [name for name in moving(record) if name in left_out] if left_out else []
    if len(free) > 1:
        raise NotDerivedError(
            f"the platform turns by {' and '.join(free)} too, which are no coordinates of the pose: it says too little"
        )
    _straight(symbols, [name for name in left_out if name not in free])
    turns: dict[str, Any] = {name: circle_of(name) if name in pose else (1, 0) for name in ANGLES}
    if not left_out:
        return _named(symbols, _product(turns, ANGLES))
    if not free:
        return PosedOrientation(RigidPair(base, platform, _product(turns, ANGLES)))
    place = ANGLES.index(free[0])
    before, after = _product(turns, ANGLES[:place]), _product(turns, ANGLES[place + 1 :])
    return PosedOrientation(Hinge(base, platform, product(before, after), apply(before, AXES[free[0]])))


def _named(symbols: GivenSymbols, rotation: Matrix) -> PosedOrientation:
    """A rotation whose entries have names: formulas of these are short."""
    record = symbols.record
    names = FreeNames({*record.parameters, *(driven.name for driven in record.inputs)})
    own = [[Definition(names.named(f"R{i}{k}"), entry) for k, entry in enumerate(row, 1)] for i, row in
           enumerate(rotation, 1)]  # fmt: skip
    definitions = tuple(part for row in own for part in row)
    for part in definitions:
        symbols.witness.define(part.symbol, part.formula)
    a, b, c = ((row[0].symbol, row[1].symbol, row[2].symbol) for row in own)
    return PosedOrientation(RigidPair(record.base, record.platform.link, (a, b, c)), definitions)


def _product(turns: dict[str, Any], names: tuple[str, ...]) -> Matrix:
    whole: Matrix = UNTURNED
    for name in names:
        whole = product(whole, TURNS[name](turns[name]))
    return whole


def _straight(symbols: GivenSymbols, names: list[str]) -> None:
    """Angles that neither the pose has nor the joints let change are zero, or the method does not know them exactly."""
    at_home = all_coordinates(symbols.record, home_values(symbols.record))
    turned = [name for name in names if abs(float(at_home[name])) > HOME]
    if turned:
        raise NotDerivedError(f"the platform stands turned by {' and '.join(turned)}, which the pose does not say")
